//! Deflection of the tool and of the machine frame under the force, which the depth includes.
//!
//! The tool is an elastic half space under the pressure of the contact. To first order in its compliance the
//! depth grows by ∂U/∂F of its energy U (Castigliano); what an elastic contact gains in pressure is the
//! pressure of a flat punch as wide as the contact (Johnson 1985, eq. 3.34), so whatever the shape
//!   δ = F/(2 E* a),   E* = E/(1 - ν²),   a = √(A/π)
//! with the tool's E*, and 1/S grows by 1/(2 E* a). Under the even pressure of fully plastic metal what is
//! gained is a rim, whose deflection is 8/π² = 0.81 of that: a fifth of the correction is its own error
//! there.

use crate::scene::Scene;
use crate::setup::units::Units;
use asperity_solver::point::kinematics::Symmetry;
use std::f64::consts::PI;

/// Compliance of the tool and of the machine frame, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Compliance {
    /// Deflection of the machine frame per force.
    pub machine: f64,
    /// 1/E* of the tool.
    pub tool: f64,
}

impl Compliance {
    /// A rigid tool on a stiff machine.
    pub const NONE: Compliance = Compliance { machine: 0.0, tool: 0.0 };

    /// That of a scene, in `units`.
    pub fn new(scene: &Scene, units: &Units) -> Compliance {
        if scene.symmetry == Symmetry::PlaneStrain {
            return Compliance::NONE;
        }
        let machine = scene.tool.machine_compliance.map_or(0.0, |c| c.0 * units.force / units.length);
        let tool = scene.tool.elastic().map_or(0.0, |elastic| units.stress / elastic.reduced_modulus());
        Compliance { machine, tool }
    }

    /// True where both are rigid.
    pub fn is_none(&self) -> bool {
        *self == Compliance::NONE
    }

    /// Deflection per force over a contact of this area.
    fn per_force(&self, area: f64) -> f64 {
        let tool = if self.tool > 0.0 && area > 0.0 { 0.5 * self.tool / (area / PI).sqrt() } else { 0.0 };
        self.machine + tool
    }

    /// Deflection of tool and machine under `force` over a contact of this area.
    pub fn deflection(&self, force: f64, area: f64) -> f64 {
        if self.is_none() { 0.0 } else { force * self.per_force(area) }
    }

    /// Stiffness of body, tool and machine in series.
    pub fn in_series(&self, stiffness: f64, area: f64) -> f64 {
        if self.is_none() { stiffness } else { (stiffness.recip() + self.per_force(area)).recip() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_2_PI;

    /// A cone of Sneddon on a softer tool: F = (2/π) E_r h²/tan β with 1/E_r = 1/E₁ + 1/E₂. To first order in
    /// E₁/E₂ the tool adds ½ E₁/E₂ of the depth, and the same share to 1/S at the same force.
    #[test]
    fn a_tool_gives_way_as_the_second_body_of_a_contact_does() {
        let (tan, tool) = (0.2, 1e-5);
        let h = |e: f64, f: f64| (f * tan / (FRAC_2_PI * e)).sqrt();
        let force = 0.3;
        let (alone, both) = (h(1.0, force), h(1.0 / (1.0 + tool), force));
        let radius = FRAC_2_PI * alone / tan;
        let compliance = Compliance { machine: 0.0, tool };
        let deflection = compliance.deflection(force, PI * radius * radius);
        assert!((deflection / (both - alone) - 1.0).abs() < 1e-5);
        let stiffness = compliance.in_series(2.0 * radius, PI * radius * radius);
        assert!((stiffness / (2.0 * radius / (1.0 + tool)) - 1.0).abs() < 1e-12);
    }
}
