//! Second order in the load step: the last plastic increment is extrapolated into the next one (BDF2).
//!
//! The radial return is backward Euler: exact along straight paths, first order where the direction of flow turns,
//! as it does under every growing contact. The two-step backward difference formula (BDF2) is second order:
//!   ε_p(n+1) = ε_p(n) + κ [ε_p(n) - ε_p(n-1)] + Δγ N(n+1),   κ = ω²/(1 + 2ω), ω the ratio of the steps,
//! which is a radial return that starts from a state in which the last plastic increment is extrapolated by κ. Nothing else
//! changes: the yield condition holds at the end of the increment and the tangent stays symmetric. A point that stops
//! yielding is extrapolated once all the same: where flow fades smoothly that is of second order too, and a switch would
//! make the residual jump. The accumulated plastic strain is the length of the flow from one converged state to the
//! next, not the sum of its two pieces, which would count a turn twice.
//!
//! Measured on the single asperity (10°, n 0.3): force error 1.9 %, 0.3 %, 0.0 % at step ratios 1.2, 1.1, 1.05, where
//! backward Euler has 4.5 %, 2.3 %, 1.2 %.

use crate::point::failure::Failure;
use crate::point::material::{Metal, PointState, Spectral};
use crate::point::tensor::{Sym, contract};

/// The plastic increment of a point in the last increment of the load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticIncrement {
    /// Plastic logarithmic strain of the increment, in the frame of its end.
    pub strain: Sym,
    /// Increment of accumulated plastic strain.
    pub accumulated: f64,
}

impl PlasticIncrement {
    /// That of a point that did not yield.
    pub const NONE: PlasticIncrement = PlasticIncrement { strain: [0.0; 4], accumulated: 0.0 };
}

/// κ for the ratio ω = (next step)/(last step).
pub fn extrapolation_factor(ratio: f64) -> f64 {
    ratio * ratio / (1.0 + 2.0 * ratio)
}

/// Flow between the elastic trial b_e - I (`trial`, from the last converged state) and the state `end`.
/// `None` if either is not positive definite.
pub fn plastic_increment(trial: &Sym, end: &PointState) -> Result<PlasticIncrement, Failure> {
    let logarithm = |b: &Sym| Spectral::of(b).map(|s| s.tensor(&s.log_strain));
    let (from, to) = (logarithm(trial)?, logarithm(&end.stretch)?);
    let strain: Sym = std::array::from_fn(|i| from[i] - to[i]);
    Ok(PlasticIncrement { strain, accumulated: (2.0 / 3.0 * contract(&strain, &strain)).sqrt() })
}

/// The state an increment starts from: `old` with the `last` plastic increment extrapolated by `factor`.
pub fn extrapolate(metal: &Metal, old: &PointState, last: &PlasticIncrement, factor: f64) -> PointState {
    let Some(hardening) = metal.hardening.as_ref().filter(|_| factor > 0.0 && last.accumulated > 0.0) else {
        return *old;
    };
    let Ok(spectral) = Spectral::of(&old.stretch) else { return *old };
    let strain = spectral.tensor(&spectral.log_strain);
    let doubled: Sym = std::array::from_fn(|i| 2.0 * (strain[i] - factor * last.strain[i]));
    let plastic_strain = old.plastic_strain + factor * last.accumulated;
    PointState {
        stretch: exponential_minus_identity(&doubled),
        plastic_strain,
        yield_stress: hardening.flow(plastic_strain).yield_stress,
    }
}

/// exp(a) - I of a symmetric tensor.
pub fn exponential_minus_identity(a: &Sym) -> Sym {
    let (mean, half) = (0.5 * (a[0] + a[1]), 0.5 * (a[0] - a[1]));
    let radius = half.hypot(a[3]);
    let direction = if radius > 0.0 { [half / radius, a[3] / radius] } else { [1.0, 0.0] };
    let frame = Spectral { log_strain: [0.0; 3], double_angle: direction, shear_factor: 1.0 };
    frame.tensor(&[(mean + radius).exp_m1(), (mean - radius).exp_m1(), a[2].exp_m1()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_undoes_the_logarithm() {
        let b = [0.3, -0.2, 0.1, 0.25];
        let spectral = Spectral::of(&b).unwrap();
        let doubled = spectral.tensor(&spectral.log_strain.map(|e| 2.0 * e));
        let back = exponential_minus_identity(&doubled);
        assert!((0..4).all(|i| (back[i] - b[i]).abs() < 1e-15));
    }
}
