//! Ranges of the values of a material, and the sentences for values outside of them. The place stands before
//! each sentence, a way out behind it.

use crate::units::Stress;
use thiserror::Error;

/// A value of a file that makes no sense.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{path}: {message}")]
pub struct SceneError {
    /// The place: keys joined by dots, tables of an array by index, for example `asperity[0].height`.
    pub path: String,
    /// The fault: names the value, the allowed range and a way out.
    pub message: String,
}

impl SceneError {
    /// An error of the value at `path`.
    pub fn new(path: impl Into<String>, message: impl ToString) -> SceneError {
        SceneError { path: path.into(), message: message.to_string() }
    }
}

/// Young's modulus over yield stress.
pub const MODULUS_OVER_YIELD: [f64; 2] = [5.0, 1e6];

/// Young's moduli of a fit, GPa.
pub const FITTED_MODULI_GPA: [f64; 2] = [1e-6, 1e4];
/// Poisson's ratios of a fit: what a single scene allows, less the ends, where nothing can be computed.
pub const FITTED_POISSONS_RATIOS: [f64; 2] = [-0.9, 0.4999];
/// Yield stresses of a fit, MPa.
pub const FITTED_YIELD_STRESSES_MPA: [f64; 2] = [1e-6, 1e6];
/// Hardening exponents of a sweep or a fit: less than the 1 of a single scene, where the metal would not
/// yield at all.
pub const VARIED_EXPONENTS: [f64; 2] = [0.0, 0.9];

/// Checks a Young's modulus: finite, above 0.
///
/// # Errors
/// A sentence with range and value.
pub fn youngs_modulus(e: Stress) -> Result<(), String> {
    if e.0 > 0.0 && e.0.is_finite() {
        return Ok(());
    }
    Err(format!("must be finite and above 0, not {} GPa", e.in_unit("GPa")))
}

/// Checks a Poisson's ratio: in (-1, 0.5).
///
/// # Errors
/// A sentence with range and value.
pub fn poissons_ratio(nu: f64) -> Result<(), String> {
    if nu > -1.0 && nu < 0.5 {
        return Ok(());
    }
    Err(format!("must be above -1 and below 0.5, not {nu}"))
}

/// Checks a hardening exponent: in [0, 1).
///
/// # Errors
/// A sentence with range and value.
pub fn hardening_exponent(n: f64) -> Result<(), String> {
    if (0.0..1.0).contains(&n) {
        return Ok(());
    }
    Err(format!("must be at least 0 and below 1, not {n}"))
}

/// Checks a yield stress under the Young's modulus `e`: E/σ_y within [`MODULUS_OVER_YIELD`].
///
/// # Errors
/// A sentence with range and value.
pub fn yield_stress(yield_stress: Stress, e: Stress) -> Result<(), String> {
    let [low, high] = MODULUS_OVER_YIELD;
    if yield_stress.0 > 0.0 && (low..=high).contains(&(e.0 / yield_stress.0)) {
        return Ok(());
    }
    let (e, given) = (e.in_unit("MPa"), yield_stress.in_unit("MPa"));
    Err(format!(
        "must be from {} to {} MPa (E/{high:e} to E/{low} of E = {e} MPa), not {given} MPa",
        e / high,
        e / low
    ))
}
