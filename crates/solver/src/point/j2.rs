//! The stress update: von Mises plasticity, associated flow, isotropic hardening, exponential map.
//!
//! In logarithmic strains the finite-strain return mapping is the small-strain one (Simo 1992; de Souza Neto,
//! Peric, Owen, Computational Methods for Plasticity, ch. 14):
//! 1. trial b_e = f b_e,old fᵀ, ε = ½ ln b_e in its principal frame;
//! 2. τ = K tr ε + 2G dev ε, q = √(3/2)|dev τ|;
//! 3. q ≤ Ĵσ_y: elastic; else q - 3G Δε_p = Ĵσ_y(ε_p + Δε_p) and the deviator shrinks by Ĵσ_y/q;
//! 4. consistent moduli D = ∂τ_A/∂ε_B and the spatial tangent.
//!
//! The yield stress is Cauchy's (true) or Kirchhoff's. Cauchy's times J would make the tangent unsymmetric; Ĵ is a constant of the
//! increment, extrapolated from the last two converged states (see `bdf2`), and an increment keeps its potential.

use crate::point::failure::Failure;
use crate::point::material::{Metal, PointState, Spectral};
use crate::point::tensor::{Gradient, GradientForm, Sym, push_forward};

/// Outcome of a stress update.
#[derive(Clone, Copy, Debug)]
pub struct PointUpdate {
    /// State at the end of the increment.
    pub state: PointState,
    /// Kirchhoff stress τ.
    pub stress: Sym,
    /// Whether the point yielded in the increment.
    pub plastic: bool,
    /// Second derivative of the incremental energy with respect to the current displacement gradient.
    pub tangent: GradientForm,
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

/// Updates a point from the state `old` by f - I = `increment`.
///
/// # Errors
/// f b fᵀ that is not positive definite.
#[inline]
pub fn update(
    metal: &Metal,
    old: &PointState,
    increment: &Gradient,
    tangent: Tangent,
) -> Result<PointUpdate, Failure> {
    // 1. trial
    let trial = push_forward(increment, &old.stretch);
    let spectral = Spectral::of(&trial)?;
    let strain = spectral.log_strain;
    // 2. trial stress
    let (g, k) = (metal.elastic.shear_modulus(), metal.elastic.bulk_modulus());
    let volume = strain[0] + strain[1] + strain[2];
    let dev = [strain[0] - volume / 3.0, strain[1] - volume / 3.0, strain[2] - volume / 3.0];
    let norm = (dev[0] * dev[0] + dev[1] * dev[1] + dev[2] * dev[2]).sqrt();
    let q = 6.0_f64.sqrt() * g * norm;
    // 3. return
    let scale = old.yield_scale;
    let flowing = metal.hardening.as_ref().filter(|_| q > scale * old.yield_stress);
    let (state, left, drop) = match flowing {
        None => (PointState { stretch: trial, ..*old }, 1.0, 0.0),
        Some(hardening) => {
            // over Ĵ: q/Ĵ - 3G/Ĵ Δε_p = σ_y
            let flow = hardening.return_to_yield(q / scale, 3.0 * g / scale, old.plastic_strain);
            let (left, slope) = (scale * flow.yield_stress / q, scale * flow.slope);
            let elastic = dev.map(|d| 2.0 * (left * d + volume / 3.0));
            let state = PointState {
                stretch: spectral.tensor(&elastic.map(f64::exp_m1)),
                plastic_strain: flow.plastic_strain.max(old.plastic_strain),
                yield_stress: flow.yield_stress,
                yield_scale: scale,
            };
            // 2G(left - ĴH/(3G + ĴH)): the loss of the moduli along the direction of plastic flow
            (state, left, 2.0 * g * (left - slope / (3.0 * g + slope)))
        }
    };
    let tau = dev.map(|d| k * volume + 2.0 * g * left * d);
    let stress = spectral.tensor(&tau);
    // 4. tangent
    let form = if tangent == Tangent::None {
        [[0.0; 5]; 5]
    } else {
        let n = if norm > 0.0 { dev.map(|d| d / norm) } else { [0.0; 3] };
        let mut moduli = [[0.0; 3]; 3];
        for a in 0..3 {
            for b in 0..3 {
                let identity = if a == b { 1.0 } else { 0.0 };
                moduli[a][b] = k + 2.0 * g * left * (identity - 1.0 / 3.0) - drop * n[a] * n[b];
            }
        }
        let geometric = match tangent {
            Tangent::WithoutCompression => spectral.tensor(&tau.map(|t| t.max(0.0))),
            _ => stress,
        };
        spectral.tangent(&tau, &moduli, g * left, &geometric)
    };
    Ok(PointUpdate { state, stress, plastic: flowing.is_some(), tangent: form })
}
