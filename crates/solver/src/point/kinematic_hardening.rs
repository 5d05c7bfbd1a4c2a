//! The stress update with kinematic hardening: the yield surface moves, and grows by what does not move it.
//!
//! Written in the space of Lagrangian logarithmic strains (see `log_space`), in which plastic strain E_p and
//! back stress α are symmetric deviators of the undeformed configuration: no rotation has to be tracked, and
//! the tangent is the second derivative of an incremental energy. (A back stress of Kirchhoff's kind, turned
//! with each increment, has no such energy: its tangent is not symmetric.)
//!   T = K tr E + 2G dev(E - E_p),   ξ = dev T - Ĵα,   √(3/2)|ξ| ≤ Ĵr,   ΔE_p = √(3/2) Δε_p N,   N = ξ/|ξ|,
//! with Ĵ of `j2`: the curve of hardening speaks of Cauchy's stress, and so does the back stress. The rule of
//! Prager and Ziegler, Δα ∥ N, with its modulus from the curve of hardening: a share m of what the curve
//! rises by moves the surface, √(3/2)|Δα| = m [σ(ε_p + Δε_p) - σ(ε_p)], and the rest makes it grow, r =
//! σ(ε_p) - m [σ(ε_p) - σ_y]. Along a straight path α keeps pace with the curve, so that monotone tension is
//! that of isotropic hardening, exactly and in steps of any size. Backward Euler: N at the end is that of the
//! trial state, and
//!   q - 3G Δε_p - Ĵm [σ(ε_p + Δε_p) - σ(ε_p)] = Ĵr(ε_p + Δε_p),   q = √(3/2)|ξ_trial|,
//! is the return of isotropic hardening from q/Ĵ + m [σ(ε_p) - σ_y], whatever m. The moduli are those of
//! small strains, symmetric:
//!   ∂T/∂E = K 1⊗1 + 2G (1 - β)(I - ⅓1⊗1) - 2G (3G/(3G + ĴH) - β) N⊗N,   β = 3G Δε_p/q.
//! After a reversal the modulus goes on falling with ε_p: the curve says nothing of cycles. Where the back
//! stress exceeds r, the point yields in reverse before its load is gone: with m = 1 from σ = 2σ_y on, with m
//! ≤ ½ never.
//!
//! Coaxial paths are those of `j2` (with n = 0 the same material). Where principal directions turn in the
//! material, additive strains differ from b_e: simple shear, see `verification`. The second order in the load
//! step is that of `bdf2`, in a frame that does not turn. The plastic work is T : ΔE_p, of which ∫α : dE_p is
//! stored and the rest heat.

use crate::point::bdf2::{PlasticIncrement, exponential_minus_identity};
use crate::point::failure::Failure;
use crate::point::j2::{PointUpdate, Tangent};
use crate::point::log_space::{LogStrain, compose};
use crate::point::material::{Metal, PointState, Spectral, plastic_work, stress};
use crate::point::tensor::{Gradient, Sym, contract, trace, von_mises};
use asperity_material::{Elastic, HardeningCurve};

/// History variables of a point beside its [`PointState`], all in the undeformed configuration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct History {
    /// F - I.
    pub deformation: Gradient,
    /// Plastic logarithmic strain E_p.
    pub plastic: Sym,
    /// Back stress α.
    pub back: Sym,
}

/// √(3/2).
fn root() -> f64 {
    1.5_f64.sqrt()
}

/// Updates a point by f - I = `increment`. Its state holds the b_e whose Hencky stress is the stress of the
/// point.
///
/// # Errors
/// C that is not positive definite.
pub fn update(
    metal: &Metal,
    old: &PointState,
    memory: &History,
    increment: &Gradient,
    tangent: Tangent,
) -> Result<(PointUpdate, History), Failure> {
    let deformation = compose(increment, &memory.deformation);
    let strain = LogStrain::new(&deformation)?;
    let (g, k) = (metal.elastic.shear_modulus(), metal.elastic.bulk_modulus());
    let [e1, e2, e3] = strain.principal;
    let volume = e1 + e2 + e3;
    let (plastic, back) = (strain.into_frame(&memory.plastic), strain.into_frame(&memory.back));
    let total = [e1 - volume / 3.0, e2 - volume / 3.0, e3 - volume / 3.0, 0.0];
    let trial: Sym = std::array::from_fn(|i| 2.0 * g * (total[i] - plastic[i]));
    let scale = old.yield_scale;
    let xi: Sym = std::array::from_fn(|i| trial[i] - scale * back[i]);
    let norm = contract(&xi, &xi).sqrt();
    let q = root() * norm;
    // how far √(3/2)|α| has come along a straight path, and r = σ - moved
    let moved = |h: &HardeningCurve| metal.kinematic_share * (old.yield_stress - h.yield_stress());
    let flowing = metal.hardening.as_ref().filter(|h| q > scale * (old.yield_stress - moved(h)));
    let n: Sym = if norm > 0.0 { xi.map(|x| x / norm) } else { [0.0; 4] };
    let mut end = History { deformation, ..*memory };
    let (flow, left, drop) = match flowing {
        None => (None, 1.0, 0.0),
        Some(curve) => {
            let reach = q / scale + moved(curve);
            let flow = curve.return_to_yield(reach, 3.0 * g / scale, old.plastic_strain, old.yield_stress);
            let length = (flow.plastic_strain - old.plastic_strain).max(0.0);
            let growth = metal.kinematic_share * (flow.yield_stress - old.yield_stress).max(0.0);
            let direction = strain.out_of_frame(&n);
            end.plastic = std::array::from_fn(|i| memory.plastic[i] + root() * length * direction[i]);
            end.back = std::array::from_fn(|i| memory.back[i] + growth / root() * direction[i]);
            let beta = 3.0 * g * length / q;
            let drop = 2.0 * g * (3.0 * g / (3.0 * g + scale * flow.slope) - beta);
            (Some((flow, length)), 1.0 - beta, drop)
        }
    };
    let length = flow.map_or(0.0, |(_, length)| length);
    let pressure = k * volume;
    let mut t: Sym = std::array::from_fn(|i| trial[i] - 2.0 * g * root() * length * n[i]);
    t[..3].iter_mut().for_each(|t| *t += pressure);
    let stress = strain.to_current(&strain.kirchhoff(&t));
    let state = PointState {
        b_minus_i: hencky_stretch(&metal.elastic, &stress),
        plastic_strain: old.plastic_strain + length,
        yield_stress: flow.map_or(old.yield_stress, |(flow, _)| flow.yield_stress),
        yield_scale: scale,
    };
    let form = if tangent == Tangent::None {
        [[0.0; 5]; 5]
    } else {
        let geometric = match tangent {
            Tangent::WithoutCompression => tensile_part(&stress),
            _ => stress,
        };
        strain.tangent(&t, [k, 2.0 * g * left, drop], &n, &geometric)
    };
    Ok((PointUpdate { state, stress, plastic: flow.is_some(), tangent: form }, end))
}

/// The yield function of a point over its yield stress: 0 where it yields, below 0 where it is elastic, -1
/// for a body that never yields. Without `memory` the yield surface has its centre at the origin.
pub fn yield_function(metal: &Metal, state: &PointState, memory: Option<&History>) -> f64 {
    let Some(curve) = &metal.hardening else { return -1.0 };
    let isotropic = || (von_mises(&stress(&metal.elastic, &state.b_minus_i)), state.yield_stress);
    let moved = metal.kinematic_share * (state.yield_stress - curve.yield_stress());
    let shifted = |memory: &History| {
        let strain = LogStrain::new(&memory.deformation).ok()?;
        let [e1, e2, e3] = strain.principal;
        let mean = (e1 + e2 + e3) / 3.0;
        let (plastic, back) = (strain.into_frame(&memory.plastic), strain.into_frame(&memory.back));
        let total = [e1 - mean, e2 - mean, e3 - mean, 0.0];
        let double_g = 2.0 * metal.elastic.shear_modulus();
        let xi: Sym =
            std::array::from_fn(|i| double_g * (total[i] - plastic[i]) - state.yield_scale * back[i]);
        Some((root() * contract(&xi, &xi).sqrt(), state.yield_stress - moved))
    };
    let (q, radius) = memory.and_then(shifted).unwrap_or_else(isotropic);
    q / (state.yield_scale * radius) - 1.0
}

/// b_e - I of the elastic body under `stress`: exp(2ε) - I with ε = dev τ/2G + tr τ/9K.
fn hencky_stretch(elastic: &Elastic, stress: &Sym) -> Sym {
    let mean = trace(stress) / 3.0;
    let (shear, volume) = (1.0 / elastic.shear_modulus(), 2.0 * mean / (3.0 * elastic.bulk_modulus()));
    exponential_minus_identity(&[
        (stress[0] - mean) * shear + volume,
        (stress[1] - mean) * shear + volume,
        (stress[2] - mean) * shear + volume,
        stress[3] * shear,
    ])
}

/// The tensor without its negative principal values.
fn tensile_part(a: &Sym) -> Sym {
    let (mean, half) = (0.5 * (a[0] + a[1]), 0.5 * (a[0] - a[1]));
    let radius = half.hypot(a[3]);
    let double_angle = if radius > 0.0 { [half / radius, a[3] / radius] } else { [1.0, 0.0] };
    let frame = Spectral { log_strain: [0.0; 3], double_angle, shear_factor: 1.0 };
    frame.tensor(&[mean + radius, mean - radius, a[2]].map(|t| t.max(0.0)))
}

/// The state an increment starts from: `old` with the plastic increment `flowed` added, the back stress with
/// it.
pub fn extrapolate(
    metal: &Metal,
    old: &PointState,
    memory: &History,
    flowed: &PlasticIncrement,
) -> (PointState, History) {
    let length = flowed.length();
    let Some(curve) = metal.hardening.as_ref().filter(|_| length > 0.0) else { return (*old, *memory) };
    let plastic_strain = old.plastic_strain + flowed.accumulated;
    let yield_stress = curve.flow(plastic_strain).yield_stress;
    // √(2/3) m (σ - σ_old) N with N = √(2/3) ΔE_p/Δε_p
    let modulus = metal.kinematic_share * 2.0 / 3.0 * (yield_stress - old.yield_stress) / length;
    let memory = History {
        plastic: std::array::from_fn(|i| memory.plastic[i] + flowed.strain[i]),
        back: std::array::from_fn(|i| memory.back[i] + modulus * flowed.strain[i]),
        ..*memory
    };
    (PointState { plastic_strain, yield_stress, ..*old }, memory)
}

/// The plastic increment from `before` to `after`, and its work T : ΔE_p per reference volume along the flow.
///
/// T : N = √(2/3) Ĵ {√(3/2) α_old : N + m [σ(ε_p) - σ_old] + r(ε_p)}.
pub fn plastic_increment(
    metal: &Metal,
    (old, before): (&PointState, &History),
    (new, after): (&PointState, &History),
) -> (PlasticIncrement, f64) {
    let strain: Sym = std::array::from_fn(|i| after.plastic[i] - before.plastic[i]);
    let flowed = PlasticIncrement { strain, accumulated: new.plastic_strain - old.plastic_strain };
    let Some(curve) = metal.hardening.as_ref().filter(|_| flowed.accumulated > 0.0) else {
        return (flowed, 0.0);
    };
    let surface = metal.kinematic_share * (curve.yield_stress() - old.yield_stress);
    let turned = contract(&before.back, &strain) + surface * flowed.accumulated;
    (flowed, new.yield_scale * turned + plastic_work(curve, old, new))
}

/// Elastic energy per reference volume, ½K(tr E)² + G|dev(E - E_p)|²; NaN where C is not positive definite.
pub fn elastic_energy(elastic: &Elastic, memory: &History) -> f64 {
    let Ok(strain) = LogStrain::new(&memory.deformation) else { return f64::NAN };
    let plastic = strain.into_frame(&memory.plastic);
    let volume: f64 = strain.principal.iter().sum();
    let mut dev: Sym = plastic.map(|e| -e);
    for (dev, e) in dev.iter_mut().zip(strain.principal) {
        *dev += e - volume / 3.0;
    }
    0.5 * elastic.bulk_modulus() * volume * volume + elastic.shear_modulus() * contract(&dev, &dev)
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_material::{Hardening, HardeningLaw, StressMeasure};

    const ELASTIC: Elastic = Elastic { youngs_modulus: 500.0, poissons_ratio: 0.3 };

    /// A metal that hardens by a power of its plastic strain, with this share of it kinematic.
    fn metal(kinematic_share: f64) -> Metal {
        let law = HardeningLaw::Swift;
        let curve =
            Hardening { law, yield_stress: 1.0, exponent: 0.2, youngs_modulus: ELASTIC.youngs_modulus };
        let stress_measure = StressMeasure::Kirchhoff;
        Metal { elastic: ELASTIC, hardening: Some(curve.into()), kinematic_share, stress_measure }
    }

    /// Along a line the back stress keeps pace with the curve: √(3/2)|Δα| = m [σ(ε_p + Δε_p) - σ(ε_p)].
    #[test]
    fn an_extrapolated_back_stress_rises_by_its_share_of_the_curve() {
        for share in [0.4, 1.0] {
            let metal = metal(share);
            let start = metal.virgin();
            let flowed = PlasticIncrement { strain: [-0.01, 0.02, -0.01, 0.0], accumulated: 0.02 };
            let (state, memory) = extrapolate(&metal, &start, &History::default(), &flowed);
            assert!(state.plastic_strain == 0.02 && memory.plastic == flowed.strain);
            let rise = state.yield_stress - start.yield_stress;
            assert!(rise > 0.1, "{rise}");
            let size = root() * contract(&memory.back, &memory.back).sqrt();
            assert!((size / (share * rise) - 1.0).abs() < 1e-12, "{size} {rise}");
        }
    }

    /// A point that has flowed lies on its yield surface, wherever that has moved and however it has grown.
    #[test]
    fn a_point_that_flowed_lies_on_its_yield_surface() {
        for share in [0.0, 0.4, 1.0] {
            let metal = metal(share);
            let increment = [0.03, 0.01, 0.0, -0.02, -0.01];
            let (found, memory) =
                update(&metal, &metal.virgin(), &History::default(), &increment, Tangent::None).unwrap();
            assert!(found.plastic && found.state.yield_stress > 1.1);
            let function = yield_function(&metal, &found.state, Some(&memory));
            assert!(function.abs() < 1e-9, "{share}: {function}");
        }
    }

    /// Shear pulls along one diagonal and pushes along the other.
    #[test]
    fn the_tensile_part_of_shear_is_that_along_its_diagonal() {
        assert_eq!(tensile_part(&[0.0, 0.0, 0.0, 2.0]), [1.0, 1.0, 0.0, 1.0]);
        assert_eq!(tensile_part(&[3.0, -1.0, -2.0, 0.0]), [3.0, 0.0, 0.0, 0.0]);
    }

    /// Stretched to the strains 0.01, 0.004, 0 with what part of it is plastic: the energy is that of what is
    /// elastic, a body whose strain is plastic does not yield, and one that is elastic yields by its stress.
    #[test]
    fn energy_and_yielding_go_by_what_is_elastic_of_the_strain() {
        let (strain, volume) = ([0.01_f64, 0.004, 0.0], 0.014);
        let deviator = [strain[0] - volume / 3.0, strain[1] - volume / 3.0, -volume / 3.0, 0.0];
        let stretched = |plastic: Sym| {
            let deformation = [strain[0].exp_m1(), 0.0, 0.0, strain[1].exp_m1(), strain[2].exp_m1()];
            History { deformation, plastic, back: [0.0; 4] }
        };
        let (k, g) = (ELASTIC.bulk_modulus(), ELASTIC.shear_modulus());
        for share in [0.0, 0.4, 1.0] {
            let left = deviator.map(|e| (1.0 - share) * e);
            let found = elastic_energy(&ELASTIC, &stretched(deviator.map(|e| share * e)));
            let exact = 0.5 * k * volume * volume + g * left.iter().map(|e| e * e).sum::<f64>();
            assert!((found / exact - 1.0).abs() < 1e-12, "{share}: {found} {exact}");
        }
        let metal = metal(1.0);
        let start = metal.virgin();
        let size = root() * deviator.iter().map(|e| e * e).sum::<f64>().sqrt();
        for (share, function) in [(0.0, 2.0 * g * size - 1.0), (1.0, -1.0), (0.5, g * size - 1.0)] {
            let history = stretched(deviator.map(|e| share * e));
            let found = yield_function(&metal, &start, Some(&history));
            assert!((found - function).abs() < 1e-9, "{share}: {found} {function}");
        }
    }
}
