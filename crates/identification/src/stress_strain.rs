//! A point of the stress-strain curve with its interval.

use serde::Serialize;

/// Yield stress at a plastic strain with its 95 % interval, MPa.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[allow(non_snake_case, reason = "names of the file")]
pub struct StressAt {
    /// Plastic strain.
    pub plastic_strain: f64,
    /// The best value.
    pub value_MPa: f64,
    /// Lower end.
    pub low_MPa: f64,
    /// Upper end.
    pub high_MPa: f64,
}
