//! One cone and its metal, in dimensionless groups.

use asperity_material::{Elastic, Hardening, HardeningLaw, StressMeasure};
use asperity_simulation::scene::Accuracy;
use asperity_simulation::setup::cone::Cone;
use asperity_simulation::setup::discretisation::ConeDiscretisation;
use asperity_simulation::setup::problem::Problem;
use asperity_solver::contact::slip::Friction;
use asperity_solver::point::material::Metal;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The one of the two bodies that is the cone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Tool {
    /// A cone of metal crushed by a rigid plane.
    Plane,
    /// A flat body of metal indented by a rigid cone.
    Cone,
}

/// A metal that yields, by the groups that K/E depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Yielding {
    /// Hardening law.
    pub law: HardeningLaw,
    /// Hardening exponent n.
    pub exponent: f64,
    /// Young's modulus over yield stress.
    pub e_over_sy: f64,
}

/// All that K/E depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Case {
    /// Slope β of the cone against the plane, degrees.
    pub beta_deg: f64,
    /// The way the metal yields; `None`: it is elastic.
    pub yielding: Option<Yielding>,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Crush or indentation.
    pub tool: Tool,
    /// The stress that yields.
    pub stress_measure: StressMeasure,
    /// Friction of plane or cone; `None`: it is smooth.
    pub friction: Option<Friction>,
}

impl Case {
    /// tan β.
    pub fn tan_beta(&self) -> f64 {
        self.beta_deg.to_radians().tan()
    }

    /// Elastic constants in units of E.
    pub fn elastic(&self) -> Elastic {
        Elastic { youngs_modulus: 1.0, poissons_ratio: self.poissons_ratio }
    }

    /// Hardening law in units of E.
    pub fn hardening(&self) -> Option<Hardening> {
        self.yielding.map(|y| Hardening {
            law: y.law,
            yield_stress: 1.0 / y.e_over_sy,
            exponent: y.exponent,
            youngs_modulus: 1.0,
        })
    }

    /// The discretisation at the coarsest level that promises `accuracy`.
    pub fn discretisation(&self, accuracy: Accuracy) -> ConeDiscretisation {
        let exponent = self.yielding.map(|y| y.exponent);
        ConeDiscretisation::new(self.beta_deg, self.tool == Tool::Cone, exponent, accuracy)
    }

    /// The sharp cone of the solver, E = 1.
    pub fn cone(&self) -> Cone {
        let metal = Metal {
            elastic: self.elastic(),
            hardening: self.hardening().map(Into::into),
            kinematic_share: 0.0,
            stress_measure: self.stress_measure,
        };
        Cone { slope_deg: self.beta_deg, indents: self.tool == Tool::Cone, metal, friction: self.friction }
    }

    /// The problem of the solver, loaded to the depth 1, E = 1.
    pub fn problem(&self, discretisation: &ConeDiscretisation) -> Problem {
        self.cone().problem(discretisation)
    }
}
