//! Elastic, elastoplastic and fully plastic shares of a contact, by the slopes of its patches.

use crate::half_space::{HalfSpaceContact, each_patch};
use crate::{HeightMap, Material};
use asperity_material::cone_atlas::{Atlas, Contact, SharpCone};
use asperity_material::{Hardening, HardeningLaw};
use asperity_numerics::bisection::bisect;
use std::f64::consts::{FRAC_2_PI, PI};

/// A cone is elastic while its force is at least this share of that of an elastic one.
const ELASTIC_FORCE: f64 = 0.9;
/// A cone is fully plastic from this share of the plateau of its pressure on.
const PLASTIC_PRESSURE: f64 = 0.9;
/// Yield stress of metal of which the hardness alone is known: a third of it (Tabor).
const HARDNESS_OVER_YIELD: f64 = 3.0;
/// tan β between which the regimes end, and the halvings of the search in its logarithm.
const SLOPES: [f64; 2] = [1e-5, 10.0];
const HALVINGS: usize = 40;

/// The slopes at which the regimes of a metal end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RegimeSlopes {
    /// tan β up to which a cone is elastic: its force is 0.9 of an elastic one there.
    pub elastic: f64,
    /// tan β from which on it is fully plastic: its pressure is 0.9 of the plateau there.
    pub plastic: f64,
}

/// Elastic, elastoplastic and fully plastic shares of a contact; each three add up to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares {
    /// Of the load.
    pub load: [f64; 3],
    /// Of the area.
    pub area: [f64; 3],
}

impl RegimeSlopes {
    /// Those of `material`, of hardening law `law` where it names none; None where nothing of its strength is
    /// known. Without an exponent it does not harden.
    pub fn new(material: &Material, law: HardeningLaw) -> Option<RegimeSlopes> {
        let atlas = Atlas::committed()?;
        let known = material.yield_stress.map(|y| y.0);
        let yield_stress = known.or_else(|| Some(material.hardness?.0 / HARDNESS_OVER_YIELD))?;
        let elastic = material.elastic();
        let hardening = Hardening {
            law: material.hardening_law.unwrap_or(law),
            yield_stress,
            exponent: material.hardening_exponent.unwrap_or(0.0),
            youngs_modulus: elastic.youngs_modulus,
        };
        let cone = |tan: f64| SharpCone::new(tan.atan().to_degrees(), &elastic, hardening, Contact::Crushed);
        let over_elastic = |tan: f64| {
            let force = atlas.nearest(&cone(tan)).k_over_e.value * elastic.youngs_modulus;
            force * tan / (FRAC_2_PI * elastic.reduced_modulus())
        };
        let over_plateau = |tan: f64| {
            let (cone, modulus) = (cone(tan), elastic.youngs_modulus);
            let found = atlas.nearest(&cone);
            let ratio = found.contact_ratio.value;
            found.k_over_e.value * modulus * tan * tan / (PI * ratio * ratio) / atlas.plateau(&cone).value
        };
        let found = |holds: &dyn Fn(f64) -> bool| {
            let [low, high] = bisect(SLOPES.map(f64::ln), HALVINGS, |ln| holds(ln.exp()));
            (0.5 * (low + high)).exp()
        };
        Some(RegimeSlopes {
            elastic: found(&|tan| over_elastic(tan) >= ELASTIC_FORCE),
            plastic: found(&|tan| over_plateau(tan) < PLASTIC_PRESSURE),
        })
    }

    /// The shares of `contact` on `map` by the mean slopes of its patches; None without contact.
    pub fn shares(&self, map: &HeightMap, contact: &HalfSpaceContact) -> Option<Shares> {
        let mut sums = [[0.0; 3]; 2];
        let pressures = &contact.pressures;
        each_patch(map, pressures, |patch| {
            let slopes: Vec<f64> = patch.iter().filter_map(|i| slope(map, *i)).collect();
            let mean = slopes.iter().sum::<f64>() / slopes.len().max(1) as f64;
            let regime = usize::from(mean > self.elastic) + usize::from(mean >= self.plastic);
            sums[0][regime] += patch.iter().map(|i| f64::from(pressures[*i])).sum::<f64>();
            sums[1][regime] += patch.len() as f64;
        });
        let [load, area] = sums.map(|sum| {
            let whole = sum.iter().sum::<f64>();
            sum.map(|part| part / whole)
        });
        area[0].is_finite().then_some(Shares { load, area })
    }
}

/// |∇h| at pixel `i`, in each direction the root mean square of the steps to both sides; None where a
/// direction has no measured neighbour.
fn slope(map: &HeightMap, i: usize) -> Option<f64> {
    let (nodes, z) = ([map.columns(), map.rows()], map.heights());
    let at = [i % nodes[0], i / nodes[0]];
    let squared = |axis: usize| {
        let (n, stride) = (nodes[axis], if axis == 0 { 1 } else { nodes[0] });
        let base = i - at[axis] * stride;
        let inside = [at[axis] > 0, at[axis] + 1 < n];
        let places = [(at[axis] + n - 1) % n, (at[axis] + 1) % n];
        let steps = [0, 1].map(|k| {
            let step = (z[base + places[k] * stride] - z[i]) / map.pixel()[axis];
            (map.periodic() || inside[k]).then_some(step).filter(|step| !step.is_nan())
        });
        let known = steps.iter().flatten().count();
        (known > 0).then(|| steps.iter().flatten().map(|s| s * s).sum::<f64>() / known as f64)
    };
    Some((squared(0)? + squared(1)?).sqrt())
}
