//! The stress update: von Mises plasticity, associated flow, isotropic hardening, exponential map.
//!
//! In logarithmic strains the finite-strain return mapping is the small-strain one (Simo 1992; de Souza Neto,
//! Peric, Owen, Computational Methods for Plasticity, ch. 14):
//! 1. trial b_e = f b_e,old fᵀ, ε = ½ ln b_e in its principal frame;
//! 2. τ = K tr ε + 2G dev ε, q = √(3/2)|dev τ|;
//! 3. q ≤ Ĵσ_y: elastic (with back stress the same condition stands in `kinematic_hardening`, for the limit
//!    of the extrapolation in `bdf2`); else q - 3G Δε_p = Ĵσ_y(ε_p + Δε_p) and the deviator shrinks by
//!    Ĵσ_y/q;
//! 4. consistent moduli D = ∂τ_A/∂ε_B and the spatial tangent.
//!
//! The yield stress is Cauchy's (true) or Kirchhoff's. Cauchy's times J would make the tangent unsymmetric; Ĵ
//! is a constant of the increment, extrapolated from the last two converged states (see `bdf2`), and an
//! increment keeps its potential.

use crate::point::failure::Failure;
use crate::point::material::{Metal, PointState, Spectral};
use crate::point::tensor::{Gradient, GradientForm, Sym, push_forward};
use asperity_numerics::lanes::Real;

/// Outcome of a stress update.
#[derive(Clone, Copy, Debug)]
pub struct PointUpdate<T: Real = f64> {
    /// State at the end of the increment.
    pub state: PointState<T>,
    /// Kirchhoff stress τ.
    pub stress: Sym<T>,
    /// True where the point yielded in the increment.
    pub plastic: T::Mask,
    /// Second derivative of the incremental energy with respect to the current displacement gradient.
    pub tangent: GradientForm<T>,
}

/// The tangent that is wanted; the stress does not depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tangent {
    /// Not at all.
    None,
    /// The exact derivative of the residual.
    Exact,
    /// Without the part of the geometric term that compression makes negative.
    WithoutCompression,
}

/// Result of a stress update of a point, or of several side by side.
#[derive(Clone, Copy, Debug)]
pub struct Return<T: Real> {
    /// State at the end of the increment.
    pub state: PointState<T>,
    /// True where the point yielded in the increment.
    pub plastic: T::Mask,
    /// Stress there, and what its derivative needs.
    pub response: Linearisation<T>,
}

/// The stress of a point, or of several side by side, and what its derivative needs, in the principal frame
/// of the elastic trial.
#[derive(Clone, Copy, Debug)]
pub struct Linearisation<T> {
    frame: Spectral<T>,
    /// Principal Kirchhoff stresses.
    tau: [T; 3],
    /// Deviator after the return over that of the trial: 1 of an elastic point.
    deviator_scale: T,
    /// Reduction of the consistent moduli along n⊗n by the return mapping.
    modulus_drop: T,
    /// Direction of flow n: the trial deviator over its norm.
    direction: [T; 3],
}

/// Updates a point, or several side by side, from the state `old` by f - I = `increment`, and gives the
/// `tangent` that is wanted.
///
/// # Errors
/// f b fᵀ that is not positive definite.
#[inline(always)]
pub fn update<T: Real>(
    metal: &Metal,
    old: &PointState<T>,
    increment: &Gradient<T>,
    tangent: Tangent,
) -> Result<PointUpdate<T>, Failure> {
    let Return { state, plastic, response } = return_to_yield(metal, old, increment)?;
    Ok(PointUpdate { state, stress: response.stress(), plastic, tangent: response.tangent(metal, tangent) })
}

/// Steps 1 to 3 of the update from the state `old` by f - I = `increment`.
///
/// # Errors
/// f b fᵀ that is not positive definite.
#[inline(always)]
pub fn return_to_yield<T: Real>(
    metal: &Metal,
    old: &PointState<T>,
    increment: &Gradient<T>,
) -> Result<Return<T>, Failure> {
    let zero = T::splat(0.0);
    // 1. trial
    let trial = push_forward(increment, &old.b_minus_i);
    let frame = Spectral::new(&trial)?;
    let strain = frame.log_strain;
    // 2. trial stress
    let (g, k) = (metal.elastic.shear_modulus(), metal.elastic.bulk_modulus());
    let volume = strain[0] + strain[1] + strain[2];
    let third = volume / 3.0;
    let dev = [strain[0] - third, strain[1] - third, strain[2] - third];
    let norm = (dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]).sqrt();
    let q = norm * (6.0_f64.sqrt() * g);
    // 3. return
    let scale = old.yield_scale;
    let mut state = PointState { b_minus_i: trial, ..*old };
    let (mut deviator_scale, mut modulus_drop) = (T::splat(1.0), zero);
    let plastic = match &metal.hardening {
        Some(_) => q.is_above(scale * old.yield_stress),
        None => zero.is_above(zero),
    };
    if let Some(hardening) = metal.hardening.as_ref().filter(|_| T::any(plastic)) {
        // over Ĵ: q/Ĵ - 3G/Ĵ Δε_p = σ_y
        let three_g = T::splat(3.0 * g);
        let (strain, stress) = (old.plastic_strain, old.yield_stress);
        let flow = hardening.return_to_yield(q / scale, three_g / scale, strain, stress);
        let slope = scale * flow.slope;
        deviator_scale = T::select(plastic, scale * flow.yield_stress / q, deviator_scale);
        let mut elastic = dev;
        for e in &mut elastic {
            *e = ((deviator_scale * *e + third) * 2.0).exp_m1();
        }
        let returned = frame.tensor(&elastic);
        for i in 0..4 {
            state.b_minus_i[i] = T::select(plastic, returned[i], trial[i]);
        }
        state.plastic_strain =
            T::select(plastic, flow.plastic_strain.max(old.plastic_strain), old.plastic_strain);
        state.yield_stress = T::select(plastic, flow.yield_stress, old.yield_stress);
        // 2G(deviator_scale - ĴH/(3G + ĴH))
        modulus_drop = T::select(plastic, (deviator_scale - slope / (three_g + slope)) * (2.0 * g), zero);
    }
    let (mean, shear) = (volume * k, deviator_scale * (2.0 * g));
    let tau = [mean + shear * dev[0], mean + shear * dev[1], mean + shear * dev[2]];
    let inverse = T::select(norm.is_above(zero), T::splat(1.0) / norm, zero);
    let direction = [dev[0] * inverse, dev[1] * inverse, dev[2] * inverse];
    Ok(Return {
        state,
        plastic,
        response: Linearisation { frame, tau, deviator_scale, modulus_drop, direction },
    })
}

impl<T: Real> Linearisation<T> {
    /// Kirchhoff stress τ.
    #[inline(always)]
    pub fn stress(&self) -> Sym<T> {
        self.frame.tensor(&self.tau)
    }

    /// Step 4 of the update: the second derivative of the incremental energy with respect to the current
    /// displacement gradient.
    #[inline(always)]
    pub fn tangent(&self, metal: &Metal, tangent: Tangent) -> GradientForm<T> {
        let zero = T::splat(0.0);
        let Linearisation { frame, tau, deviator_scale, modulus_drop, direction } = *self;
        let geometric = match tangent {
            Tangent::None => return [[zero; 5]; 5],
            Tangent::Exact => self.stress(),
            Tangent::WithoutCompression => {
                frame.tensor(&[tau[0].max(zero), tau[1].max(zero), tau[2].max(zero)])
            }
        };
        let (g, k) = (metal.elastic.shear_modulus(), metal.elastic.bulk_modulus());
        let shear = deviator_scale * (2.0 * g);
        let mut moduli = [[zero; 3]; 3];
        for a in 0..3 {
            for b in 0..3 {
                let identity = if a == b { 1.0 } else { 0.0 };
                moduli[a][b] =
                    shear * (identity - 1.0 / 3.0) + k - modulus_drop * direction[a] * direction[b];
            }
        }
        frame.tangent(&tau, &moduli, deviator_scale * g, &geometric)
    }
}
