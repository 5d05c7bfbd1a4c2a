//! Surfaces made from random numbers: self-affine, and three that look like ground, milled and sanded metal
//! surfaces.
//!
//! Every kind is a shape that depends on one length; the length is searched so that the mean slope belongs to
//! the arithmetic mean height, and the heights are then scaled. The random numbers depend on the seed alone.

use crate::surface::fft::Spectrum;
use crate::surface::height_map::{HeightMap, MapError};
use crate::surface::parameters::height_over_slope;
use crate::surface::prepared_surface::Surface;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use thiserror::Error;

/// The reason why a surface cannot be made.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum GenerateError {
    /// Height and slope do not go together on this grid.
    #[error(
        "Ra {ra_um} µm with a mean slope of {slope_deg} degrees needs a surface whose longest wave is {need} for a map of {size_um} µm \
         with pixels of {pixel_um} µm: change size, pixels, ra or mean_slope_deg"
    )]
    NoShape {
        /// Ra asked for, µm.
        ra_um: f64,
        /// Mean slope asked for, degrees.
        slope_deg: f64,
        /// "too long" or "too short".
        need: &'static str,
        /// Shorter side of the map, µm.
        size_um: f64,
        /// Longer side of a pixel, µm.
        pixel_um: f64,
    },
    /// The cut-off is not resolved or above the roll-off.
    #[error(
        "cutoff = {cutoff_um} µm and rolloff = {rolloff_um} µm: 2 pixels ({least_um} µm) <= cutoff < rolloff is needed"
    )]
    Waves {
        /// Shortest wave, µm.
        cutoff_um: f64,
        /// Longest wave of the power law, µm.
        rolloff_um: f64,
        /// Two pixels, µm.
        least_um: f64,
    },
    /// The grid is no map.
    #[error(transparent)]
    Map(#[from] MapError),
}

/// Kind of a surface with its parameters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Lay along y: long scratches of all widths.
    Ground,
    /// Arcs of feed marks with roughness on them.
    Milled,
    /// Isotropic.
    Sanded,
    /// Isotropic Gaussian, spectrum flat above the wavelength `rolloff`, (1/λ)^(-2-2H) down to `cutoff`,
    /// nothing below.
    SelfAffine {
        /// Hurst exponent H in (0, 1].
        hurst: f64,
        /// Longest wave of the power law, in metres.
        rolloff: f64,
        /// Shortest wave, in metres.
        cutoff: f64,
    },
}

/// Height and slope to meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// Ra in metres and mean |∇h|, at once (not for `SelfAffine`).
    Both(f64, f64),
    /// Ra in metres.
    Height(f64),
    /// Mean |∇h|.
    Slope(f64),
}

/// The grid of a surface to be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// Nodes along x and y.
    pub nodes: [usize; 2],
    /// Their distance, in metres.
    pub pixel: [f64; 2],
    /// Start of the random numbers.
    pub seed: u64,
}

/// The accuracy to which height and slope are met, relative.
const MATCH_TOLERANCE: f64 = 1e-5;
/// Hurst exponent of the machined surfaces.
const HURST: f64 = 0.8;
/// Length over width of the scratches of a ground surface.
const LAY_RATIO: f64 = 16.0;
/// Longest over shortest wave of the machined surfaces.
const OCTAVES: f64 = 16.0;
/// Sq of the roughness on feed marks over that of the marks.
const ROUGHNESS_ON_MARKS: f64 = 0.12;

/// Normally distributed numbers (Box and Muller), the same for a seed on every machine up to rounding of ln
/// and cos.
fn noise(seed: u64, count: usize) -> Vec<f64> {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut uniform = || (random.next_u64() >> 11) as f64 * (0.5f64).powi(53);
    let mut out = Vec::with_capacity(count + 1);
    while out.len() < count {
        let (u, v) = (1.0 - uniform(), uniform());
        let radius = (-2.0 * u.ln()).sqrt();
        out.push(radius * (TAU * v).cos());
        out.push(radius * (TAU * v).sin());
    }
    out.truncate(count);
    out
}

/// A surface on a grid; it repeats beyond its edges (but for milled feed marks).
///
/// # Errors
/// Waves that the grid does not hold, or a height and a slope that no surface of the kind has together.
pub fn generate(kind: Kind, grid: &Grid, target: Target) -> Result<HeightMap, GenerateError> {
    let noise = noise(grid.seed, grid.nodes[0].saturating_mul(grid.nodes[1]));
    let noise = Spectrum::of_map(&noise, grid.nodes[0]);
    let (shape, wanted) = match (kind, target) {
        (Kind::SelfAffine { hurst, rolloff, cutoff }, target) => {
            let least = 2.0 * grid.pixel[0].max(grid.pixel[1]);
            if !(cutoff >= least * (1.0 - 1e-9) && rolloff > cutoff) {
                let [cutoff_um, rolloff_um, least_um] = [cutoff, rolloff, least].map(|v| v * 1e6);
                return Err(GenerateError::Waves { cutoff_um, rolloff_um, least_um });
            }
            (self_affine(&noise, grid, hurst, [rolloff, cutoff], 1.0, End::Sharp), target)
        }
        (kind, Target::Both(ra, slope)) => (matched(kind, grid, &noise, ra, slope)?, Target::Height(ra)),
        (kind, target) => (machined(kind, grid, &noise, 0.25 * span(grid)), target),
    };
    let Surface { map, parameters, .. } = on_grid(grid, shape)?;
    let factor = match wanted {
        Target::Height(ra) | Target::Both(ra, _) => ra / parameters.sa,
        Target::Slope(slope) => slope / parameters.mean_gradient,
    };
    Ok(map.mapped(|_, row| row.iter_mut().for_each(|z| *z = (*z - parameters.mean) * factor)))
}

/// The surface of these heights.
fn on_grid(grid: &Grid, heights: Vec<f64>) -> Result<Surface, MapError> {
    Surface::from_map(HeightMap::new(grid.nodes[0], grid.nodes[1], grid.pixel, heights)?)
}

/// The shorter side of the map.
fn span(grid: &Grid) -> f64 {
    (grid.nodes[0] as f64 * grid.pixel[0]).min(grid.nodes[1] as f64 * grid.pixel[1])
}

/// The shape whose Ra over mean slope is `ra`/`slope`: the ratio grows with the longest wave, which is
/// searched.
fn matched(
    kind: Kind,
    grid: &Grid,
    noise: &Spectrum,
    ra: f64,
    slope: f64,
) -> Result<Vec<f64>, GenerateError> {
    let wanted = ra / slope;
    let pixel = grid.pixel[0].max(grid.pixel[1]);
    let tried = |wave: f64| -> Result<(f64, Vec<f64>), GenerateError> {
        let shape = machined(kind, grid, noise, wave);
        let map = HeightMap::new(grid.nodes[0], grid.nodes[1], grid.pixel, shape)?;
        let found = height_over_slope(&map, &map.extent()?);
        Ok((found, map.into_heights()))
    };
    let no_shape = |need| GenerateError::NoShape {
        ra_um: ra * 1e6,
        slope_deg: slope.atan().to_degrees(),
        need,
        size_um: span(grid) * 1e6,
        pixel_um: pixel * 1e6,
    };
    let (mut low, mut high) = (6.0 * pixel, 0.7 * span(grid));
    if low >= high {
        return Err(no_shape("too long"));
    }
    // an end is tried when the search first leaves the bracket there
    let mut untried = [true; 2];
    // the ratio is nearly proportional to the wave: the first guess is scaled, the bracket keeps it honest
    let mut wave = (7.0 * wanted).clamp(low, high);
    for _ in 0..60 {
        let (found, shape) = tried(wave)?;
        if (found / wanted - 1.0).abs() < MATCH_TOLERANCE || high - low < 1e-12 * high {
            return Ok(shape);
        }
        if found < wanted {
            (low, untried[0]) = (wave, false);
        } else {
            (high, untried[1]) = (wave, false);
        }
        let scaled = wave * wanted / found;
        if scaled >= high && std::mem::take(&mut untried[1]) && tried(high)?.0 < wanted {
            return Err(no_shape("too long"));
        }
        if scaled <= low && std::mem::take(&mut untried[0]) && tried(low)?.0 > wanted {
            return Err(no_shape("too short"));
        }
        wave = if scaled > low && scaled < high { scaled } else { (low * high).sqrt() };
    }
    Ok(tried(wave)?.1)
}

/// Heights of a machined surface whose longest wave is `wave`, of any scale.
fn machined(kind: Kind, grid: &Grid, noise: &Spectrum, wave: f64) -> Vec<f64> {
    let pixel = grid.pixel[0].max(grid.pixel[1]);
    let waves = |longest: f64| [longest, (longest / OCTAVES).max(4.0 * pixel).min(0.9 * longest)];
    match kind {
        Kind::Ground => self_affine(noise, grid, HURST, waves(wave), LAY_RATIO, End::Fading),
        Kind::Milled => {
            let marks = feed_marks(grid, wave);
            let rough = self_affine(noise, grid, HURST, waves(0.5 * wave), 1.0, End::Fading);
            let spread = |z: &[f64]| (z.iter().map(|v| v * v).sum::<f64>() / z.len() as f64).sqrt();
            let share = ROUGHNESS_ON_MARKS * spread(&marks) / spread(&rough).max(f64::MIN_POSITIVE);
            marks.iter().zip(rough).map(|(m, r)| m + share * r).collect()
        }
        Kind::Sanded | Kind::SelfAffine { .. } => {
            self_affine(noise, grid, HURST, waves(wave), 1.0, End::Fading)
        }
    }
}

/// The way a spectrum ends at its shortest wave.
#[derive(Clone, Copy, PartialEq)]
enum End {
    /// Nothing below.
    Sharp,
    /// Smoothly, so that height and slope depend smoothly on the wave that is searched.
    Fading,
}

/// Gaussian heights with waves between `waves` = [roll-off, cut-off] (m); `lay` stretches them along y.
fn self_affine(noise: &Spectrum, grid: &Grid, hurst: f64, waves: [f64; 2], lay: f64, end: End) -> Vec<f64> {
    let size = [0, 1].map(|k| grid.nodes[k] as f64 * grid.pixel[k]);
    let [low, high] = waves.map(|w| 1.0 / w);
    noise.shaped(|kx, ky| {
        let q = (kx / size[0]).hypot(lay * ky / size[1]);
        if q == 0.0 || (end == End::Sharp && q > high) {
            return 0.0;
        }
        let fading = if end == End::Sharp { 1.0 } else { (-(q / high).powi(6)).exp() };
        fading * (q.max(low) / low).powf(-1.0 - hurst)
    })
}

/// Circular scallops of distance `feed` along x, bent as by a cutter of ten feeds radius; mean 0.
fn feed_marks(grid: &Grid, feed: f64) -> Vec<f64> {
    let (columns, rows) = (grid.nodes[0], grid.nodes[1]);
    (0..columns * rows)
        .map(|i| {
            let x = (i % columns) as f64 * grid.pixel[0];
            let y = ((i / columns) as f64 - 0.5 * rows as f64) * grid.pixel[1];
            let along = (x + y * y / (20.0 * feed)) / feed;
            let u = 2.0 * (along - along.floor()) - 1.0;
            u * u - 1.0 / 3.0
        })
        .collect()
}

/// Kinds by their names in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum KindName {
    /// Lay along y.
    Ground,
    /// Feed marks.
    Milled,
    /// Isotropic.
    Sanded,
    /// Isotropic with a given spectrum.
    SelfAffine,
}

impl KindName {
    /// The name used in scenes and tables.
    pub fn name(self) -> &'static str {
        match self {
            KindName::Ground => "ground",
            KindName::Milled => "milled",
            KindName::Sanded => "sanded",
            KindName::SelfAffine => "self-affine",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::surface::parameters::Parameters;

    fn grid(n: usize, seed: u64) -> Grid {
        Grid { nodes: [n, n], pixel: [2e-6, 2e-6], seed }
    }

    #[test]
    fn height_and_slope_are_met_at_once_for_every_seed() {
        for (kind, ra, deg) in
            [(Kind::Ground, 0.23e-6, 1.57f64), (Kind::Milled, 2.95e-6, 4.08), (Kind::Sanded, 5.27e-6, 11.38)]
        {
            for seed in 1..4 {
                let map = generate(kind, &grid(512, seed), Target::Both(ra, deg.to_radians().tan())).unwrap();
                let numbers = Parameters::measure(&map, &map.extent().unwrap());
                assert!((numbers.sa / ra - 1.0).abs() < 1e-9, "{kind:?}");
                assert!((numbers.beta_deg() / deg - 1.0).abs() < 2e-5, "{kind:?} {}", numbers.beta_deg());
                let ratio = numbers.mean_slope_x / numbers.mean_gradient;
                // isotropic 0.64; ground and milled slope along x
                assert!(
                    if kind == Kind::Sanded { (ratio - 0.637).abs() < 0.05 } else { ratio > 0.8 },
                    "{kind:?} {ratio}"
                );
            }
        }
    }

    #[test]
    fn a_seed_gives_the_same_surface_and_another_seed_another() {
        let make = |seed| generate(Kind::Sanded, &grid(128, seed), Target::Height(1e-6)).unwrap();
        assert_eq!(make(1), make(1));
        assert_ne!(make(1), make(2));
    }

    /// Gaussian isotropic surfaces: mean |∇h| = √π/2 of its rms, mean |dz/dx| = 1/√π of it, Sa = √(2/π) Sq.
    #[test]
    fn a_self_affine_surface_is_gaussian_and_isotropic() {
        let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 100e-6, cutoff: 20e-6 };
        let map = generate(kind, &grid(1024, 3), Target::Slope(0.1)).unwrap();
        let n = Parameters::measure(&map, &map.extent().unwrap());
        assert!((n.mean_gradient - 0.1).abs() < 1e-12);
        assert!(
            (n.mean_gradient / n.rms_gradient - 0.886).abs() < 0.01
                && (n.mean_slope_x / n.rms_gradient - 0.564).abs() < 0.01
        );
        assert!((n.sa / n.sq - 0.798).abs() < 0.01 && n.ssk.abs() < 0.1 && (n.sku - 3.0).abs() < 0.2);
    }

    #[test]
    fn what_does_not_fit_the_grid_is_refused() {
        let wave = |rolloff, cutoff| Kind::SelfAffine { hurst: 0.8, rolloff, cutoff };
        assert!(generate(wave(100e-6, 3e-6), &grid(64, 1), Target::Slope(0.1)).is_err());
        assert!(generate(wave(5e-6, 8e-6), &grid(64, 1), Target::Slope(0.1)).is_err());
        assert!(generate(Kind::Sanded, &grid(64, 1), Target::Both(5e-6, 1e-3)).is_err());
        assert!(generate(Kind::Sanded, &grid(64, 1), Target::Both(1e-9, 1.0)).is_err());
        let point = Grid { nodes: [1, 1], ..grid(1, 1) };
        assert!(generate(Kind::Sanded, &point, Target::Height(1e-6)).is_err());
    }
}
