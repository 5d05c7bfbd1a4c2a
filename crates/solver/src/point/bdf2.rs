//! Second order in the load step: the last plastic increment is extrapolated into the next one (BDF2).
//!
//! The radial return is backward Euler: exact along straight paths, first order where the direction of flow
//! turns, as it does under every growing contact. The two-step backward difference formula (BDF2) is second
//! order:
//!   ε_p(n+1) = ε_p(n) + κ [ε_p(n) - ε_p(n-1)] + Δγ N(n+1),   κ = ω²/(1 + 2ω), ω the ratio of the steps,
//! which is a radial return that starts from a state in which the last plastic increment is extrapolated by
//! κ. Nothing else changes: the yield condition holds at the end of the increment and the tangent stays
//! symmetric. The formula is stable for steps of different lengths while ω < 1 + √2 (Hairer, Nørsett, Wanner,
//! Solving Ordinary Differential Equations I, III.5): ω is bounded.
//!
//! A point that stops or turns must not be extrapolated: its stress would be carried to the other side of the
//! yield surface. So no point is extrapolated beyond what backward Euler flows along its last direction
//! ([`share`]). That is known only once the increment is nearly solved; it is then frozen, and the increment
//! keeps its potential.
//!
//! The extrapolated part of the accumulated plastic strain is frozen then too, so that the increment of it is
//! the length of the flow from one converged state to the next (the sum of the two pieces would count a turn
//! twice) and the accepted stress lies on the yield surface of that strain.

use crate::point::failure::Failure;
use crate::point::material::{Metal, PointState, Spectral};
use crate::point::tensor::{Sym, contract, trace};
use asperity_numerics::lanes::{Lanes, Real};

/// The plastic increment of a point in the last increment of the load, or of several side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlasticIncrement<T = f64> {
    /// Plastic logarithmic strain of the increment, in the frame of its end.
    pub strain: Sym<T>,
    /// Increment of accumulated plastic strain.
    pub accumulated: T,
}

impl PlasticIncrement<Lanes> {
    /// Four points side by side.
    #[inline(always)]
    pub fn side_by_side(points: &[PlasticIncrement; 4]) -> Self {
        let component = |i: usize| Lanes::each(|q| points[q].strain[i]);
        PlasticIncrement {
            strain: [component(0), component(1), component(2), component(3)],
            accumulated: Lanes::each(|q| points[q].accumulated),
        }
    }

    /// The point in `lane`.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> PlasticIncrement {
        let e = &self.strain;
        PlasticIncrement {
            strain: [e[0].0[lane], e[1].0[lane], e[2].0[lane], e[3].0[lane]],
            accumulated: self.accumulated.0[lane],
        }
    }
}

impl PlasticIncrement {
    /// That of a point that did not yield.
    pub const NONE: PlasticIncrement = PlasticIncrement { strain: [0.0; 4], accumulated: 0.0 };

    /// √(⅔ Δε_p : Δε_p).
    pub fn length(&self) -> f64 {
        (2.0 / 3.0 * contract(&self.strain, &self.strain)).sqrt()
    }

    /// So many times this.
    #[must_use]
    pub fn times(&self, factor: f64) -> PlasticIncrement {
        PlasticIncrement { strain: self.strain.map(|e| factor * e), accumulated: factor * self.accumulated }
    }
}

/// Largest ratio of an increment to the last one with which flow is extrapolated.
const LARGEST_STEP_RATIO: f64 = 2.4;

/// ω within its bound.
pub fn bounded(ratio: f64) -> f64 {
    ratio.min(LARGEST_STEP_RATIO)
}

/// κ for the ratio ω = (next step)/(last step).
pub fn extrapolation_factor(ratio: f64) -> f64 {
    let ratio = bounded(ratio);
    ratio * ratio / (1.0 + 2.0 * ratio)
}

/// Plastic strain between the elastic trial b_e - I (`trial`, from the last converged state) and the state
/// `end`, of which `old` is the start.
///
/// # Errors
/// Either is not positive definite.
#[inline(always)]
pub fn plastic_increment<T: Real>(
    trial: &Sym<T>,
    old: &PointState<T>,
    end: &PointState<T>,
) -> Result<PlasticIncrement<T>, Failure> {
    let (from, to) = (Spectral::new(trial)?, Spectral::new(&end.b_minus_i)?);
    let (from, to) = (from.tensor(&from.log_strain), to.tensor(&to.log_strain));
    let strain = [from[0] - to[0], from[1] - to[1], from[2] - to[2], from[3] - to[3]];
    Ok(PlasticIncrement { strain, accumulated: end.plastic_strain - old.plastic_strain })
}

/// Plastic strain of the radial return from `old` whose elastic trial b_e - I is `trial`.
///
/// # Errors
/// A trial that is not positive definite.
#[inline(always)]
pub fn backward_euler<T: Real>(
    metal: &Metal,
    old: &PointState<T>,
    trial: &Sym<T>,
) -> Result<Sym<T>, Failure> {
    let zero = T::splat(0.0);
    let spectral = Spectral::new(trial)?;
    let mut dev = spectral.tensor(&spectral.log_strain);
    let mean = trace(&dev) / 3.0;
    for e in &mut dev[..3] {
        *e -= mean;
    }
    let (three_g, scale) = (T::splat(3.0 * metal.elastic.shear_modulus()), old.yield_scale);
    let strain = (contract(&dev, &dev) * (2.0 / 3.0)).sqrt();
    let q = three_g * strain;
    let yields = q.is_above(scale * old.yield_stress);
    let Some(hardening) = metal.hardening.as_ref().filter(|_| T::any(yields)) else {
        return Ok([zero; 4]);
    };
    let end = hardening.return_to_yield(q / scale, three_g / scale, old.plastic_strain, old.yield_stress);
    let flowed = (end.plastic_strain - old.plastic_strain).max(zero);
    let share = T::select(yields, flowed / strain, zero);
    Ok([share * dev[0], share * dev[1], share * dev[2], share * dev[3]])
}

/// The part of `factor` times the `last` plastic increment that may be extrapolated into an increment that
/// flows by `flow` with all of it extrapolated, and by `euler` after backward Euler: not beyond `euler` in
/// the last direction. With its accumulated strain the increment's is the length of its flow; where less is
/// extrapolated, its part along `euler`.
pub fn share(factor: f64, last: &PlasticIncrement, flow: &PlasticIncrement, euler: &Sym) -> PlasticIncrement {
    let (along, square) = (contract(euler, &last.strain), contract(&last.strain, &last.strain));
    if !(along > 0.0 && square > 0.0) {
        return PlasticIncrement::NONE;
    }
    let all = last.times(factor);
    if along < factor * square {
        let share = along / square;
        let cosine = along / (contract(euler, euler) * square).sqrt();
        return PlasticIncrement { accumulated: share * cosine * last.length(), ..last.times(share) };
    }
    PlasticIncrement { accumulated: (all.accumulated + flow.length() - flow.accumulated).max(0.0), ..all }
}

/// The state an increment starts from: `old` with the plastic increment `flowed` added.
#[inline(always)]
pub fn extrapolate<T: Real>(
    metal: &Metal,
    old: &PointState<T>,
    flowed: &PlasticIncrement<T>,
) -> PointState<T> {
    let yields = flowed.accumulated.is_above(T::splat(0.0));
    let Some(hardening) = metal.hardening.as_ref().filter(|_| T::any(yields)) else {
        return *old;
    };
    let Ok(spectral) = Spectral::new(&old.b_minus_i) else { return *old };
    let strain = spectral.tensor(&spectral.log_strain);
    let doubled = |i: usize| (strain[i] - flowed.strain[i]) * 2.0;
    let stretch = exponential_minus_identity(&[doubled(0), doubled(1), doubled(2), doubled(3)]);
    let plastic_strain = old.plastic_strain + T::select(yields, flowed.accumulated, T::splat(0.0));
    let new = |i: usize| T::select(yields, stretch[i], old.b_minus_i[i]);
    PointState {
        b_minus_i: [new(0), new(1), new(2), new(3)],
        plastic_strain,
        yield_stress: T::select(yields, hardening.flow(plastic_strain).yield_stress, old.yield_stress),
        ..*old
    }
}

/// exp(a) - I of a symmetric tensor.
#[inline(always)]
pub fn exponential_minus_identity<T: Real>(a: &Sym<T>) -> Sym<T> {
    let (zero, one) = (T::splat(0.0), T::splat(1.0));
    let (mean, half) = ((a[0] + a[1]) * 0.5, (a[0] - a[1]) * 0.5);
    let radius = (half * half + a[3] * a[3]).sqrt();
    let turned = radius.is_above(zero);
    let double_angle = [T::select(turned, half / radius, one), T::select(turned, a[3] / radius, zero)];
    let frame = Spectral { log_strain: [zero; 3], double_angle, shear_factor: one };
    frame.tensor(&[(mean + radius).exp_m1(), (mean - radius).exp_m1(), a[2].exp_m1()])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_undoes_the_logarithm() {
        let b = [0.3, -0.2, 0.1, 0.25];
        let spectral = Spectral::new(&b).unwrap();
        let doubled = spectral.tensor(&spectral.log_strain.map(|e| 2.0 * e));
        let back = exponential_minus_identity(&doubled);
        assert!((0..4).all(|i| (back[i] - b[i]).abs() < 1e-15));
    }
}
