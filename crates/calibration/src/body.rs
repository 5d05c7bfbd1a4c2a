//! The mesh of a sharp cone on its substrate, or of the flat body under a cone, and the penalty of its contact.

use crate::case::{Case, Tool};
use crate::layout::Layout;
use crate::resolution::Resolution;
use asperity_mesh::Mesh;
use asperity_solver::body::discrete_body::ToolContact;
use asperity_solver::contact::tool::Tool as RigidTool;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;
use asperity_solver::run::problem::held_nodes;
use asperity_solver::scene::Lateral;
use std::f64::consts::FRAC_2_PI;

/// A cone ready to be crushed to the depth 1, E = 1.
#[derive(Clone, Debug)]
pub struct Body {
    /// The mesh.
    pub mesh: Mesh,
    /// Which displacement components of each node are held.
    pub held: Vec<[bool; 2]>,
    /// Metal.
    pub metal: Metal,
    /// Tool and penalty.
    pub contact: ToolContact,
    /// Size of the elements under the contact.
    pub element: f64,
    /// Radius and depth of the substrate.
    pub domain: f64,
}

/// a tan β/h to be expected: 2/π of an elastic cone, up to 1.08 - 0.6 n of a fully plastic one, more where metal piles
/// up against a steep tool, joined in X = E* tan β/σ_r (read off forty cones, within 0.1). Only the mesh is laid out
/// with it.
fn expected_ratio(case: &Case) -> f64 {
    let Some(hardening) = case.hardening() else { return FRAC_2_PI };
    let t = case.tan_beta();
    let x = case.elastic().reduced_modulus() * t / hardening.representative_stress(0.1 * t);
    let pile_up = match case.tool {
        Tool::Plane => 0.0,
        Tool::Cone => 0.3 * (1.0 - hardening.exponent) * t,
    };
    let plastic = 1.08 - 0.6 * hardening.exponent + pile_up;
    FRAC_2_PI + (plastic - FRAC_2_PI) * (x / (x + 6.0)).powi(2)
}

/// Mean pressure to be expected, in units of E: the elastic cone's ½E* tan β and 2.8 σ_r, joined harmonically. Only
/// the penalty is scaled with it.
fn expected_pressure(case: &Case) -> f64 {
    let t = case.tan_beta();
    let elastic = 0.5 * case.elastic().reduced_modulus() * t;
    match case.hardening() {
        None => elastic,
        Some(h) => 1.0 / (1.0 / elastic + 1.0 / (2.8 * h.representative_stress(0.1 * t))),
    }
}

impl Body {
    /// Lays out `case`.
    pub fn new(case: &Case, resolution: &Resolution) -> Body {
        let r = resolution;
        let tan = case.tan_beta();
        let radius = expected_ratio(case) / tan;
        let element = radius / r.elements as f64;
        let domain = r.domain * radius;
        let columns = (r.core * r.elements as f64).round() as usize;
        let (cone, tool) = match case.tool {
            Tool::Plane => ([tan, r.foot * radius * tan], RigidTool::Plane),
            Tool::Cone => ([0.0; 2], RigidTool::Cone { tan_slope: tan, tip_radius: 0.0 }),
        };
        // the diagonals on which the shells turn stay steeper than the flank
        let row_depth = (r.core_depth * radius).max(1.5 * cone[0] * columns as f64 * element);
        let layout = Layout {
            element,
            columns,
            at_axis: r.at_axis,
            row_depth,
            row_growth: r.row_growth,
            first_shell: r.first_shell,
            growth: r.growth,
            domain,
            cone,
            rounding: r.rounding * radius,
            kind: r.kind,
        };
        let mesh = layout.mesh();
        let held = held_nodes(&mesh, Symmetry::Axisymmetric, Lateral::Free);
        let metal = Metal {
            elastic: case.elastic(),
            hardening: case.hardening().map(Into::into),
            kinematic_share: 0.0,
        };
        let contact = ToolContact { tool, penalty: expected_pressure(case) / r.penetration };
        Body { mesh, held, metal, contact, element, domain }
    }
}
