//! The largest pressure that a metal carries under the patches of a contact.
//!
//! A hardness is a limit by itself. Metal of which yield stress and hardening are known carries what the
//! atlas of cones has for a fully plastic cone, and that rises with the slope as the metal hardens. The slope
//! is that of the patch as a whole: of the elliptic cone with the area, the second moments and the volume of
//! the metal above the plane. The mean gradient that closures take grows with every finer wave of the map;
//! volume and area do not.

use crate::surface::cells;
use crate::{Island, Islands, Load, Material, Surface};
use asperity_material::cone_atlas::{Atlas, Contact, SharpCone};
use asperity_material::{Hardening, HardeningLaw};

/// The origin of a limit of pressure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LimitSource {
    /// The hardness.
    Hardness,
    /// 3 σ_y, where no hardening is known or nothing touches.
    YieldStress,
    /// The plateau of the atlas of cones at this slope tan β.
    Atlas(f64),
}

/// The largest pressure that a metal carries.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureLimit {
    /// In Pa.
    pub pressure: f64,
    /// Its origin.
    pub source: LimitSource,
    /// Relative uncertainty (95 %).
    pub error: f64,
    /// The plateau in Pa that yield stress and hardening have, where the limit is a hardness that was given
    /// beside them.
    pub rival: Option<f64>,
}

/// Relative uncertainty of 3 σ_y: perfectly plastic cones have 3.0 to 2.7 times σ_y by their slope (atlas of
/// cones), and what hardening would add is not known.
const YIELD_RULE_ERROR: f64 = 0.1;
/// Relative uncertainty of the slope of the patches: the finer waves of a map change it by as much
/// (`a_map_that_is_sampled_finer_has_the_same_limit`: the limit by 3 % at n = 0.3).
const SLOPE_ERROR: f64 = 0.1;

/// Times that the slope is read anew with the limit of the last, and the change of the limit at which that
/// ends.
const LIMIT_ROUNDS: usize = 8;
const SETTLED_LIMIT_CHANGE: f64 = 1e-3;

impl PressureLimit {
    /// That of `material`, of hardening law `law` where it names none, under patches of the slope `tan`; None
    /// where nothing of its strength is known.
    pub fn at_slope(material: &Material, law: HardeningLaw, tan: f64) -> Option<PressureLimit> {
        let plain = PressureLimit::plain(material)?;
        let (LimitSource::YieldStress, Some(yield_stress), Some(exponent), Some(atlas)) =
            (plain.source, material.yield_stress, material.hardening_exponent, Atlas::committed())
        else {
            return Some(plain);
        };
        if !(tan > 0.0 && tan.is_finite()) {
            return Some(plain);
        }
        let elastic = material.elastic();
        let hardening = Hardening {
            law: material.hardening_law.unwrap_or(law),
            yield_stress: yield_stress.0,
            exponent,
            youngs_modulus: elastic.youngs_modulus,
        };
        let plateau = |tan: f64| {
            atlas.plateau(&SharpCone::new(tan.atan().to_degrees(), &elastic, hardening, Contact::Crushed))
        };
        let found = plateau(tan);
        let steeper = plateau((1.0 + SLOPE_ERROR) * tan).value / found.value - 1.0;
        let (pressure, error) = (found.value, found.error.hypot(steeper));
        Some(PressureLimit { pressure, source: LimitSource::Atlas(tan), error, rival: None })
    }

    /// The same under the patches of `surface` at `load`: the islands that carry it, were each at the limit;
    /// of a separation, those above the plane.
    pub fn on_surface(
        material: &Material,
        law: HardeningLaw,
        surface: &Surface,
        load: Load,
    ) -> Option<PressureLimit> {
        let mut limit = PressureLimit::plain(material)?;
        let idle = matches!(load, Load::Pressure(pressure) if pressure <= 0.0);
        if idle || material.hardening_exponent.is_none() {
            return Some(limit);
        }
        if limit.source == LimitSource::Hardness {
            let bare = Material { hardness: None, hardness_error: None, ..*material };
            limit.rival = PressureLimit::on_surface(&bare, law, surface, load).map(|rival| rival.pressure);
            if material.hardness_error.is_none() {
                limit.error = limit.contradiction();
            }
            return Some(limit);
        }
        for _ in 0..LIMIT_ROUNDS {
            let plane = match load {
                Load::Separation(separation) => surface.parameters.mean + separation,
                Load::Pressure(pressure) => plane_above(surface, pressure / limit.pressure),
            };
            let Some(tan) = patch_slope(surface, plane) else { break };
            let next = PressureLimit::at_slope(material, law, tan)?;
            let change = (next.pressure / limit.pressure - 1.0).abs();
            limit = next;
            if change < SETTLED_LIMIT_CHANGE {
                break;
            }
        }
        Some(limit)
    }

    fn plain(material: &Material) -> Option<PressureLimit> {
        let pressure = material.limit()?;
        let (source, error) = match material.hardness {
            Some(_) => (LimitSource::Hardness, material.hardness_error.map_or(0.0, |e| e.0 / pressure)),
            None => (LimitSource::YieldStress, YIELD_RULE_ERROR),
        };
        Some(PressureLimit { pressure, source, error, rival: None })
    }

    /// The share by which the plateau of yield stress and hardening is off a hardness given beside them; 0
    /// where there is no such contradiction.
    pub fn contradiction(&self) -> f64 {
        self.rival.map_or(0.0, |rival| (rival / self.pressure - 1.0).abs())
    }
}

/// The plane with the share `share` of the nodes above it, one at least.
fn plane_above(surface: &Surface, share: f64) -> f64 {
    let mut heights: Vec<f64> = surface.map.heights().iter().copied().filter(|z| z.is_finite()).collect();
    let above = ((share * heights.len() as f64) as usize).max(1);
    if above >= heights.len() {
        return surface.extent.low;
    }
    *heights.select_nth_unstable_by(above, |a, b| b.total_cmp(a)).1
}

/// tan β of the islands of `surface` above `plane`, each counted by its area; None where nothing lies above.
pub fn patch_slope(surface: &Surface, plane: f64) -> Option<f64> {
    let islands = Islands::above_plane(&surface.map, plane);
    let map = &surface.map;
    let mut volumes = vec![0.0; islands.islands.len()];
    for row in 0..map.cell_rows() {
        let (low, high) = (map.row(row), map.row((row + 1) % map.rows()));
        islands.pieces(map, row, |piece| {
            let left = piece.cell[1] as usize;
            let right = (left + 1) % map.columns();
            let corners = [low[left], low[right], high[right], high[left]].map(|z| z - plane);
            volumes[piece.island as usize] += piece.area * map.cell_area() * cells::mean_above(&corners);
        });
    }
    let (area, weighted) =
        islands.islands.iter().zip(&volumes).fold((0.0, 0.0), |(area, sum), (island, volume)| {
            (area + island.area, sum + island.area * slope(island, volume / island.area))
        });
    (area > 0.0).then(|| weighted / area)
}

/// Mean gradient of the elliptic cone that has the area, the moments and the mean height of an island. One
/// that goes on for ever over the edges of a periodic map has no ellipse: there it is the mean gradient of
/// the map.
fn slope(island: &Island, mean_height: f64) -> f64 {
    let Some(ellipse) = island.ellipse else { return island.slope };
    // of a cone the mean height is a third; the mean gradient of an elliptic one is the perimeter of an
    // ellipse (Ramanujan 1914)
    let [p, q] = ellipse.semi_axes.map(|axis| 3.0 * mean_height / axis);
    0.5 * (3.0 * (p + q) - ((3.0 * p + q) * (p + 3.0 * q)).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Grid, HeightMap, Kind, Target, generate};
    use asperity_material::units::Stress;

    fn metal(exponent: f64) -> Material {
        Material {
            youngs_modulus: Stress(210e9),
            poissons_ratio: 0.3,
            hardness: None,
            hardness_error: None,
            yield_stress: Some(Stress(300e6)),
            hardening_exponent: Some(exponent),
            hardening_law: None,
        }
    }

    fn limit(material: &Material, surface: &Surface, load: f64) -> PressureLimit {
        PressureLimit::on_surface(material, HardeningLaw::Hollomon, surface, Load::Pressure(load)).unwrap()
    }

    fn cones(tan: [f64; 2]) -> Surface {
        let n = 201;
        let at = |i: usize| i as f64 - 100.0;
        let z = (0..n * n).map(|i| -(at(i % n) * tan[0]).hypot(at(i / n) * tan[1]) * 1e-6).collect();
        Surface::from_map(HeightMap::new(n, n, [1e-6; 2], z).unwrap()).unwrap()
    }

    /// A cone has its slope, an elliptic one its mean gradient, as the island has it too.
    #[test]
    fn a_patch_that_is_a_cone_has_the_slope_of_the_cone() {
        for (tan, plane) in [([0.1, 0.1], -6e-6), ([0.05, 0.2], -4e-6)] {
            let surface = cones(tan);
            let found = patch_slope(&surface, plane).unwrap();
            let island = Islands::above_plane(&surface.map, plane).islands[0].slope;
            // what the grid takes off the tip and the rim, and 0.1 % of Ramanujan's formula
            assert!((found / island - 1.0).abs() < 0.01, "{found} {island}");
            assert!(tan[0] != tan[1] || (found / tan[0] - 1.0).abs() < 0.01, "{found}");
        }
    }

    #[test]
    fn metal_that_hardens_bears_more_than_three_times_its_yield_stress() {
        let surface = cones([0.1, 0.1]);
        let [perfect, hardening] = [0.0, 0.3].map(|n| limit(&metal(n), &surface, 20e6).pressure / 300e6);
        assert!((perfect / 3.0 - 1.0).abs() < 0.1, "{perfect}");
        // three times the stress at Tabor's strain, 8 % under the 19.7° of a Vickers pyramid; his rule is
        // good to a tenth
        let tabor = 3.0 * (1.0 + 700.0 * 0.08 / 0.358 * 0.1_f64).powf(0.3);
        assert!((hardening / tabor - 1.0).abs() < 0.1, "{hardening} {tabor}");
        let hardness = Material { hardness: Some(Stress(1e9)), ..metal(0.3) };
        let given = limit(&hardness, &surface, 20e6);
        assert_eq!((given.pressure, given.source), (1e9, LimitSource::Hardness));
        // a hardness beside a yield stress that says otherwise is uncertain by as much, unless its ± is given
        let plateau = limit(&metal(0.3), &surface, 20e6);
        assert_eq!(given.rival, Some(plateau.pressure));
        assert!((given.error - (plateau.pressure / 1e9 - 1.0).abs()).abs() < 1e-12, "{given:?}");
        let stated = Material { hardness_error: Some(Stress(5e7)), ..hardness };
        assert!((limit(&stated, &surface, 20e6).error - 0.05).abs() < 1e-12);
        assert!(plateau.error > 0.02 && plateau.error < 0.1, "{plateau:?}");
        let unknown = Material { hardening_exponent: None, ..metal(0.3) };
        assert_eq!(limit(&unknown, &surface, 20e6).source, LimitSource::YieldStress);
    }

    /// A self-affine surface has a mean gradient that grows with every halving of the pixel; the limit stays
    /// within 3 %: what the finer waves truly change of the patches, to the power of the hardening.
    #[test]
    fn a_map_that_is_sampled_finer_has_the_same_limit() {
        let grid = Grid { nodes: [512; 2], pixel: [0.5e-6; 2], seed: 3 };
        let kind = Kind::SelfAffine { hurst: 0.7, rolloff: 64e-6, cutoff: 1e-6 };
        let fine = generate(kind, &grid, Target::Height(1e-6)).unwrap();
        let of = |step: usize| {
            let n = 512 / step;
            let z = (0..n * n).map(|i| fine.row(i / n * step)[i % n * step]).collect();
            let map = HeightMap::new(n, n, [0.5e-6 * step as f64; 2], z).unwrap().with_periodic(true);
            let surface = Surface::from_map(map).unwrap();
            (surface.parameters.mean_gradient, limit(&metal(0.3), &surface, 60e6))
        };
        let found = [4, 2, 1].map(of);
        for pair in found.windows(2) {
            assert!(pair[1].0 > 1.15 * pair[0].0, "{found:?}");
            assert!((pair[1].1.pressure / pair[0].1.pressure - 1.0).abs() < 0.03, "{found:?}");
        }
    }
}
