//! A sharp cone, crushed by a plane or indenting a flat body, as a problem. Nothing but the depth gives it a
//! length, so its force is F = K h².

use crate::scene::Lateral;
use crate::setup::compliance::Compliance;
use crate::setup::contact_estimate::{contact_ratio, expected_pressure, far_field};
use crate::setup::discretisation::ConeDiscretisation;
use crate::setup::problem::{Goal, Problem, Rules, Specimen, held_nodes};
use crate::setup::units::Units;
use asperity_mesh::build::{SelfSimilar, self_similar};
use asperity_mesh::profile::{Asperity, Profile, Shape};
use asperity_solver::contact::slip::Friction;
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;

/// A sharp cone and its material.
#[derive(Clone, Debug, PartialEq)]
pub struct Cone {
    /// Slope β of the flank against the plane, degrees.
    pub slope_deg: f64,
    /// True where a rigid cone indents a flat body of the material; else a cone of the material is crushed by
    /// a rigid plane.
    pub indents: bool,
    /// The material, E = 1.
    pub metal: Metal,
    /// Friction of plane or cone; `None`: it is smooth.
    pub friction: Option<Friction>,
}

impl Cone {
    /// Loading to the depth 1. A far field is added to the depth: the mesh is a part of a half space.
    pub fn problem(&self, discretisation: &ConeDiscretisation) -> Problem {
        let ConeDiscretisation { numbers, sizes, .. } = *discretisation;
        let tan = self.slope_deg.to_radians().tan();
        let radius = contact_ratio(&self.metal, tan, self.indents) / tan;
        let domain = numbers.domain * radius;
        let (slope, tool) = if self.indents {
            (0.0, Tool::Cone { tan_slope: tan, tip_radius: 0.0 })
        } else {
            (tan, Tool::Plane)
        };
        let (elements, kind) = (numbers.elements_in_contact, numbers.element.kind());
        let mesh = self_similar(&SelfSimilar { slope, radius, elements, domain, sizes, kind });
        let cone = Asperity {
            shape: Shape::Cone { tan_slope: tan, tip_radius: 0.0 },
            height: sizes.foot * radius * tan,
            centre: 0.0,
            valley_radius: 0.0,
        };
        let profile = Profile { asperities: if self.indents { Vec::new() } else { vec![cone] }, line: None };
        let symmetry = Symmetry::Axisymmetric;
        Problem {
            units: Units::new(1.0, 1.0, symmetry),
            symmetry,
            metal: self.metal.clone(),
            penalty: expected_pressure(&self.metal, &profile, &tool, 1.0) / numbers.penetration,
            profile,
            tool,
            friction: self.friction,
            half_widths: vec![radius],
            depth: 1.0,
            specimen: Specimen {
                held: held_nodes(&mesh, symmetry, Lateral::Free),
                cut_off: 0.0,
                earlier: None,
            },
            mesh,
            numbers,
            goal: Goal::Depth(1.0),
            unload: false,
            reloads: 0,
            rules: Rules {
                far_field: far_field(&self.metal, domain),
                compliance: Compliance::NONE,
                area_growth: f64::INFINITY,
            },
            formed: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load_path::Path;
    use crate::scene::Accuracy;
    use asperity_material::{Elastic, Hardening, HardeningCurve, HardeningLaw, StressMeasure};
    use asperity_solver::body::analysis::Analyses;

    /// Elements give the same bits, a factorisation without fused multiply-add rounds otherwise, in single
    /// precision. Its directions differ by that, magnified by the condition of the tangent, and what
    /// Newton's tolerance leaves of it is in the force: 1e-3 of some 1e-6. 8e-10 is measured at 10°.
    #[test]
    fn a_processor_without_vector_registers_gives_the_same_force() {
        let hardening = Hardening {
            law: HardeningLaw::Hollomon,
            youngs_modulus: 1.0,
            yield_stress: 0.002,
            exponent: 0.2,
        };
        let metal = Metal {
            elastic: Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 },
            hardening: Some(HardeningCurve::Power(hardening)),
            kinematic_share: 0.0,
            stress_measure: StressMeasure::Cauchy,
        };
        for (slope_deg, indents) in [(10.0, false), (30.0, true)] {
            let cone = Cone { slope_deg, indents, metal: metal.clone(), friction: None };
            let exponent = Some(hardening.exponent);
            let problem =
                cone.problem(&ConeDiscretisation::new(slope_deg, indents, exponent, Accuracy::Draft));
            let force = |any: bool| {
                let mut path = Path::new(&problem, &Analyses::default()).unwrap();
                if any {
                    path.model.without_vector_registers();
                }
                path.load(&mut |_, _| true).unwrap().contact.force
            };
            let (here, there) = (force(false), force(true));
            assert!((here / there - 1.0).abs() < 1e-8, "{slope_deg} degrees: {here} {there}");
        }
    }
}
