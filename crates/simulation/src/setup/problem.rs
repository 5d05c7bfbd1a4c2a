//! The input of the solver: mesh, material, tool, and the rules of its path. Inside the solver E = 1.

use crate::scene::{Lateral, Scene};
use crate::setup::compliance::Compliance;
use crate::setup::contact_estimate::far_field;
use crate::setup::deformed_surface::{Formed, expected_pressure};
use crate::setup::discretisation::{Discretisation, LEAST_COUNTED_DEPTH};
use crate::setup::units::Units;
use asperity_mesh::Mesh;
use asperity_mesh::profile::Profile;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::discrete_body::{Body, ToolContact};
use asperity_solver::body::failure::Failure;
use asperity_solver::body::state::{State, Unloaded};
use asperity_solver::contact::slip::Friction;
use asperity_solver::contact::tool::Tool;
use asperity_solver::equilibrium::Equilibrium;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;

/// The end of loading, dimensionless.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Goal {
    /// At this travel of the tool from first touch, penetration included.
    Travel(f64),
    /// At this depth.
    Depth(f64),
    /// At this force; the depth is an estimate.
    Force {
        /// The force to reach.
        force: f64,
        /// Depth at which it is expected.
        expected_depth: f64,
        /// Depth beyond which the search is given up.
        limit: f64,
    },
}

/// Rules of a load path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Depth that a substrate of finite size takes away per force and that is added to the depth; 0: not
    /// corrected.
    pub far_field: f64,
    /// Deflection of tool and machine, which is added to the depth.
    pub compliance: Compliance,
    /// An increment in which the contact area grows by more than this factor is halved, as long as halvings
    /// are left.
    pub area_growth: f64,
}

/// A path that grows the contact area by more than this factor in one increment halves it: flat metal comes
/// into contact all at once when an asperity vanishes into its base. The schedule of the draft level grows it
/// by 1.5.
const AREA_GROWTH: f64 = 2.5;

impl Rules {
    /// Those of a path of `scene` in a body of this `size`.
    pub fn new(scene: &Scene, metal: &Metal, units: &Units, size: f64) -> Rules {
        let automatic = scene.mesh.is_none() && scene.substrate.as_ref().is_none_or(|s| s.depth.is_none());
        let half_space =
            automatic && scene.symmetry == Symmetry::Axisymmetric && scene.lateral == Lateral::Free;
        Rules {
            // a substrate that the scene gives is a part of it
            far_field: if half_space { far_field(metal, size) } else { 0.0 },
            compliance: Compliance::new(scene, units),
            area_growth: AREA_GROWTH,
        }
    }

    /// dF/dh of a half space under tool and machine, from that of the meshed body over a contact of this
    /// `area`: the depth holds what the substrate of finite size takes away and how tool and machine give
    /// way, so the slope holds both.
    pub fn whole_stiffness(&self, of_the_mesh: f64, area: f64) -> f64 {
        let half_space =
            if self.far_field > 0.0 { (of_the_mesh.recip() + self.far_field).recip() } else { of_the_mesh };
        self.compliance.in_series(half_space, area)
    }
}

/// Supports of a body, and its earlier loads.
#[derive(Clone, Debug)]
pub struct Specimen {
    /// Fixed displacement components of each node.
    pub held: Vec<[bool; 2]>,
    /// Height of what the mesh cuts off a steep tip: the tool touches the mesh where it is that deep.
    pub cut_off: f64,
    /// The body as earlier loads left it; `None`: virgin.
    pub earlier: Option<Unloaded>,
}

/// A problem made ready, dimensionless.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Values of 1 in SI.
    pub units: Units,
    /// Axisymmetric or plane strain.
    pub symmetry: Symmetry,
    /// The material, E = 1.
    pub metal: Metal,
    /// The surface before the crush.
    pub profile: Profile,
    /// The tool.
    pub tool: Tool,
    /// Its friction; `None`: it is smooth.
    pub friction: Option<Friction>,
    /// Estimated contact half width of each asperity at the peak (one entry for a flat body under a tool).
    pub half_widths: Vec<f64>,
    /// Estimated depth of the peak of the first loading.
    pub depth: f64,
    /// Contact pressure per penetration at that depth.
    pub penalty: f64,
    /// The mesh.
    pub mesh: Mesh,
    /// The facts of the body beside its mesh and its metal.
    pub specimen: Specimen,
    /// The discretisation used.
    pub numbers: Discretisation,
    /// The end of the first loading.
    pub goal: Goal,
    /// True where the tool then retreats to zero force.
    pub unload: bool,
    /// Number of times that it then returns to the goal and retreats again.
    pub reloads: usize,
    /// Rules of the path.
    pub rules: Rules,
    /// The surface that earlier loads left, as far as estimates need it.
    pub formed: Option<Formed>,
}

impl Problem {
    /// Its body out of contact: stress-free, or as earlier loads left it. Its mesh is analysed unless it is
    /// one of `analyses`.
    ///
    /// # Errors
    /// An element of the mesh that is inside out.
    pub fn equilibrium(&self, analyses: &Analyses) -> Result<Equilibrium<'_>, Failure> {
        let contact = ToolContact { tool: self.tool.clone(), penalty: self.penalty, friction: self.friction };
        let fixed = |node: usize| self.specimen.held[node];
        let body = Body::new(analyses, &self.mesh, self.symmetry, self.metal.clone(), fixed, Some(contact))?;
        match &self.specimen.earlier {
            None => Equilibrium::new(body),
            Some(left) => {
                let (body, state) = State::of_unloaded(body, left);
                Equilibrium::from_state(body, state)
            }
        }
    }

    /// E* of the contact: that of the body, with an elastic tool in series.
    pub fn reduced_modulus(&self) -> f64 {
        let (body, tool) = (self.metal.elastic.reduced_modulus(), self.rules.compliance.tool);
        if tool > 0.0 { (body.recip() + tool).recip() } else { body }
    }

    /// Contact pressure per penetration at `travel`: the penetration is the same share of every depth from
    /// which errors count, so that early contact is as good as late.
    pub fn penalty_at(&self, travel: f64) -> f64 {
        let depth = travel.max(LEAST_COUNTED_DEPTH * self.depth);
        let formed = self.formed.as_ref();
        let pressure = |depth| expected_pressure(formed, &self.metal, &self.profile, &self.tool, depth);
        self.penalty * pressure(depth) / pressure(self.depth) * (self.depth / depth)
    }

    /// Travel less the depth at the peak, to be expected before the first increment shows it: the
    /// penetration, less what tool and machine give way.
    pub fn expected_penetration(&self) -> f64 {
        match self.goal {
            // what tool and machine give way is no travel
            Goal::Depth(depth) if !self.rules.compliance.is_none() => {
                self.depth - depth + 0.9 * self.numbers.penetration * self.depth
            }
            Goal::Depth(depth) => 0.9 * self.numbers.penetration * depth,
            _ => 0.9 * self.numbers.penetration * self.depth,
        }
    }
}

/// Fixed displacement components of each node: both at the base, that across at the axis and at symmetric
/// sides.
pub fn held_nodes(mesh: &Mesh, symmetry: Symmetry, lateral: Lateral) -> Vec<[bool; 2]> {
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    let mut hold = |edges: &[asperity_mesh::Edge], components: [bool; 2]| {
        for &edge in edges {
            let (corners, middle) = mesh.edge_nodes(edge);
            for node in corners.into_iter().chain(middle) {
                for i in 0..2 {
                    held[node as usize][i] |= components[i];
                }
            }
        }
    };
    hold(&mesh.sides.base, [true, true]);
    if symmetry == Symmetry::Axisymmetric || lateral == Lateral::Symmetric {
        hold(&mesh.sides.axis, [true, false]);
    }
    if lateral == Lateral::Symmetric {
        hold(&mesh.sides.outer, [true, false]);
    }
    if symmetry == Symmetry::Axisymmetric {
        // the axis stays on the axis, whether or not a file names it as a side
        let [[_, reach], _] = mesh.extent();
        for (held, x) in held.iter_mut().zip(&mesh.nodes) {
            held[0] |= x[0] <= 1e-12 * reach;
        }
    }
    held
}
