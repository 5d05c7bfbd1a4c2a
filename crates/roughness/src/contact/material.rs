//! The material of the rough body.

use asperity_material::units::Stress;
use asperity_material::{Elastic, HardeningLaw};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The material of the rough body; closures need different parts of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E.
    #[schemars(example = "210 GPa")]
    pub youngs_modulus: Stress,
    /// Poisson's ratio ν.
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    pub poissons_ratio: f64,
    /// Hardness H: force over projected area (Meyer's). A Vickers number HV is H = 10.58 HV in MPa. Without it H is 3 σ_y, and the limit of `half-space-plastic` that of the atlas of cones where n is known.
    #[schemars(example = "1280 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness: Option<Stress>,
    /// Uncertainty ± of the hardness (95 %): it goes into the errors that `half-space-plastic` states. Without it, beside a yield stress and a hardening exponent, the hardness is as uncertain as it is far from the plateau of pressure that they have.
    #[schemars(example = "50 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness_error: Option<Stress>,
    /// Yield stress σ_y.
    #[schemars(example = "300 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_stress: Option<Stress>,
    /// Hardening exponent n.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1))]
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

    /// H, or 3 σ_y where only that is known (eq. (20)), in Pa.
    pub fn limit(&self) -> Option<f64> {
        self.hardness.map_or(self.yield_stress.map(|y| 3.0 * y.0), |h| Some(h.0))
    }
}
