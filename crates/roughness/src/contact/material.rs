use asperity_law::units::Stress;
use asperity_law::{Elastic, HardeningLaw};
use serde::{Deserialize, Serialize};

/// The material of the rough body; closures need different parts of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E.
    pub youngs_modulus: Stress,
    /// Poisson's ratio ν.
    pub poissons_ratio: f64,
    /// Hardness H.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness: Option<Stress>,
    /// Yield stress σ_y.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_stress: Option<Stress>,
    /// Hardening exponent n.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_exponent: Option<f64>,
    /// Hardening law, by default that of the calibration.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_law: Option<HardeningLaw>,
}

impl Material {
    /// Elastic constants, in Pa.
    pub fn elastic(&self) -> Elastic {
        Elastic { youngs_modulus: self.youngs_modulus.0, poissons_ratio: self.poissons_ratio }
    }
}
