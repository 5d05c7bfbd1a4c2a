//! Elastic constants.

use serde::{Deserialize, Serialize};

/// Isotropic elastic constants.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Elastic {
    /// Young's modulus E, in any unit of stress.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν, in (-1, 0.5).
    pub poissons_ratio: f64,
}

impl Elastic {
    /// Shear modulus G = E / (2(1 + ν)), in the unit of E.
    pub fn shear_modulus(&self) -> f64 {
        self.youngs_modulus / (2.0 * (1.0 + self.poissons_ratio))
    }

    /// Bulk modulus K = E / (3(1 - 2ν)), in the unit of E.
    pub fn bulk_modulus(&self) -> f64 {
        self.youngs_modulus / (3.0 * (1.0 - 2.0 * self.poissons_ratio))
    }

    /// Reduced modulus against a rigid tool, E* = E / (1 - ν²), in the unit of E.
    pub fn reduced_modulus(&self) -> f64 {
        self.youngs_modulus / (1.0 - self.poissons_ratio * self.poissons_ratio)
    }
}
