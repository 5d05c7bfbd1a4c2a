//! The content of a deck, made of a scene.

use super::outline::outline;
use asperity_material::{PlasticTable, StressMeasure, curve_table};
use asperity_mesh::{Edge, Mesh, Section};
use asperity_simulation::scene::{Lateral, Scene, SceneError, Target};
use asperity_simulation::setup::problem::Problem;
use asperity_simulation::setup::schedule::{UNLOADING_EXPONENT, unloading};
use asperity_solver::contact::slip::Friction;
use asperity_solver::point::kinematics::Symmetry;

/// SI value of the deck's unit of length, 1 µm: nodes are numbers near 1, which the tolerances of such codes
/// expect.
const LENGTH: f64 = 1e-6;
/// SI value of the deck's unit of stress, 1 MPa; forces are then in µN and energies in pJ.
const STRESS: f64 = 1e6;

/// Radius of the hole along the axis over the size of the first element of the surface: CalculiX finds no
/// contact on faces that collapse onto the axis, which costs 0.5 to 1.7 % of the force; the hole costs 1e-6.
const HOLE: f64 = 1e-3;

/// Edges of the surface closer to the tool than this many depths may touch it.
const REACH: f64 = 2.0;

/// Points of hardening: CalculiX holds 200 for a material.
const POINTS: usize = 200;

/// Error of a table of hardening, relative to its stress, above which a deck warns.
const COARSE: f64 = 0.01;

/// The program that a deck is written for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reader {
    /// CalculiX.
    CalculiX,
    /// Abaqus/Standard as it is.
    Abaqus,
}

/// Everything that a deck says, in µm and MPa.
pub struct Deck {
    /// The program that reads it.
    pub(crate) reader: Reader,
    /// Name of the scene.
    pub(crate) name: String,
    /// The body, its axis opened to a hole.
    pub(crate) mesh: Mesh,
    /// Idealisation.
    pub(crate) section: Section,
    /// Young's modulus (MPa) and Poisson's ratio.
    pub(crate) elastic: [f64; 2],
    /// Hardening, unless the body is elastic.
    pub(crate) table: Option<PlasticTable>,
    /// The stress that it holds.
    pub(crate) stress_measure: StressMeasure,
    /// Share of the hardening that moves the yield surface.
    pub(crate) moving_share: f64,
    /// Contact pressure per penetration, MPa/µm.
    pub(crate) penalty: f64,
    /// Friction of the tool, its penalty the same; `None`: it is smooth.
    pub(crate) friction: Option<Friction>,
    /// Penetration for which the penalty is made, as a share of the depth.
    pub(crate) penetration: f64,
    /// True where the lateral sides are held sideways.
    pub(crate) symmetric: bool,
    /// Edges that may touch the tool.
    pub(crate) contact: Vec<Edge>,
    /// Lower outline of the tool where it first touches, from left to right, µm.
    pub(crate) outline: Vec<[f64; 2]>,
    /// The way of the tool: down, and back and down again as often as the scene asks.
    pub(crate) phases: Vec<Phase>,
    /// Depth of the peak, µm.
    pub(crate) depth: f64,
}

/// A part of the way of the tool in one direction.
pub(crate) struct Phase {
    /// Its name.
    pub(crate) name: String,
    /// Travels of the tool at the end of each increment, µm; back, the last one has left the body.
    pub(crate) travels: Vec<f64>,
}

impl Deck {
    /// The deck of `problem`, which was prepared from `scene`, called `name` in its heading.
    ///
    /// # Errors
    /// A scene that such a deck cannot express, with its key.
    pub fn new(name: &str, scene: &Scene, problem: &Problem, reader: Reader) -> Result<Deck, SceneError> {
        if let Target::Force(_) = scene.loading.target()? {
            return Err(error(
                "loading.force",
                "a deck moves its tool by given depths: write depth = \"...\" instead, for example the peak_depth_um that \
                 `asperity crush` gives for this force",
            ));
        }
        check(scene, reader)?;
        let um = problem.units.length / LENGTH;
        let section = match problem.symmetry {
            Symmetry::Axisymmetric => Section::Axisymmetric,
            Symmetry::PlaneStrain => Section::PlaneStrain,
        };
        let drop = |x: f64| problem.tool.mirrored().map_or(0.0, |a| a.drop(x));
        let contact = touching(&problem.mesh, &drop, problem.depth);
        let hole = match section {
            Section::Axisymmetric if reader == Reader::CalculiX => {
                HOLE * first_width(&problem.mesh, &contact)
            }
            Section::Axisymmetric => 0.0,
            Section::PlaneStrain => 0.0,
        };
        // depth counts from the summit of the scene, of which the mesh may cut off the tip
        let lowest = first_touch(&problem.mesh, &drop) + problem.specimen.cut_off;
        let ends =
            span(&problem.mesh, &contact, problem.depth, (section == Section::Axisymmetric).then_some(hole));
        let outline = outline(&problem.tool, ends);
        let hardening = scene.material.hardening();
        Ok(Deck {
            reader,
            name: name.to_string(),
            mesh: opened(&problem.mesh, section, hole).scaled(um),
            section,
            elastic: [problem.units.stress / STRESS, problem.metal.elastic.poissons_ratio],
            stress_measure: scene.material.stress_measure,
            moving_share: scene.material.moving_share(),
            table: hardening.map(|curve| curve_table(&curve, STRESS, POINTS)),
            penalty: problem.penalty * problem.units.stress / STRESS / um,
            friction: problem.friction,
            penetration: problem.numbers.penetration,
            symmetric: scene.lateral == Lateral::Symmetric,
            contact,
            outline: outline.into_iter().map(|[x, z]| [um * x, um * (z + lowest)]).collect(),
            phases: phases(scene, problem, um),
            depth: um * problem.depth,
        })
    }

    /// Simplifications of the deck against the scene, a sentence each.
    pub fn warnings(&self) -> Vec<String> {
        let coarse = self.table.as_ref().filter(|table| table.error > COARSE);
        let message = coarse.map(|table| {
            format!(
                "the {} points of hardening that CalculiX holds miss the law by up to {:.1} % of its stress: \
                 it bends too sharply for them, most of all just after first yield; take a law or a table with fewer bends",
                table.points.len(),
                100.0 * table.error
            )
        });
        message.into_iter().collect()
    }
}

/// Refuses materials and loadings that a deck cannot express.
fn check(scene: &Scene, reader: Reader) -> Result<(), SceneError> {
    let material = &scene.material;
    let points = material.hardening_table.as_ref().map_or(0, Vec::len);
    if material.moving_share() > 0.0 && reader == Reader::Abaqus {
        let message = "Abaqus moves its yield surface along a straight line or by back stresses that are fitted to a curve, neither of which \
                       is this law: leave hardening_mode out, or write the deck for CalculiX (--format inp)";
        return Err(error("material.hardening_mode", message));
    }
    if points > POINTS {
        let message =
            format!("CalculiX holds {POINTS} points of hardening, not {points}: thin the table out");
        return Err(error("material.hardening_table", message));
    }
    if scene.tool.youngs_modulus.is_some() || scene.tool.machine_compliance.is_some() {
        let message = "a deck has a rigid tool on a stiff machine: leave youngs_modulus, poissons_ratio and machine_compliance out";
        return Err(error("tool", message));
    }
    if scene.initial.is_some() {
        return Err(error("initial", "a deck starts from a virgin body: leave earlier loads out"));
    }
    Ok(())
}

fn error(path: &str, message: impl Into<String>) -> SceneError {
    SceneError { path: path.into(), message: message.into() }
}

/// Height of the lowest point of the tool when it first touches the body; `drop` is the rise of its outline.
fn first_touch(mesh: &Mesh, drop: &impl Fn(f64) -> f64) -> f64 {
    let nodes = mesh.sides.surface.iter().flat_map(|&edge| ends(mesh, edge));
    nodes.map(|[x, z]| z - drop(x)).fold(f64::NEG_INFINITY, f64::max)
}

/// The corners of an edge.
fn ends(mesh: &Mesh, edge: Edge) -> [[f64; 2]; 2] {
    mesh.edge_nodes(edge).0.map(|node| mesh.nodes[node as usize])
}

/// The edges of the surface that the tool may meet on its way to `depth`.
fn touching(mesh: &Mesh, drop: &impl Fn(f64) -> f64, depth: f64) -> Vec<Edge> {
    let lowest = first_touch(mesh, drop);
    let gap = |[x, z]: [f64; 2]| lowest + drop(x) - z;
    let near = |edge: &Edge| ends(mesh, *edge).into_iter().any(|point| gap(point) <= REACH * depth);
    mesh.sides.surface.iter().copied().filter(near).collect()
}

/// Width of the edge nearest to the axis.
fn first_width(mesh: &Mesh, edges: &[Edge]) -> f64 {
    let left = |[a, b]: &[[f64; 2]; 2]| a[0].min(b[0]);
    let first = edges.iter().map(|&edge| ends(mesh, edge)).min_by(|a, b| left(a).total_cmp(&left(b)));
    first.map_or(0.0, |[a, b]| (a[0] - b[0]).abs())
}

/// From where to where the tool must reach: beyond the edges by what metal may be squeezed out. `axis`: where
/// it begins in a body of revolution.
fn span(mesh: &Mesh, edges: &[Edge], depth: f64, axis: Option<f64>) -> [f64; 2] {
    let xs = || edges.iter().flat_map(|&edge| ends(mesh, edge)).map(|[x, _]| x);
    let (low, high) = (xs().fold(f64::INFINITY, f64::min), xs().fold(f64::NEG_INFINITY, f64::max));
    let margin = REACH * depth + 0.1 * (high - low);
    [axis.unwrap_or(low - margin), high + margin]
}

/// The mesh with the nodes of its axis at the radius `hole`.
fn opened(mesh: &Mesh, section: Section, hole: f64) -> Mesh {
    let mut mesh = mesh.clone();
    if section == Section::Axisymmetric {
        for edge in mesh.sides.axis.clone() {
            let (corners, middle) = mesh.edge_nodes(edge);
            for node in corners.into_iter().chain(middle) {
                mesh.nodes[node as usize][0] = hole;
            }
        }
    }
    mesh
}

/// The way of the tool, `um` micrometres to the unit of `problem`: the depths of the scene's own schedule and
/// the penetration to be expected; back until nothing touches, and along the same depths down again.
fn phases(scene: &Scene, problem: &Problem, um: f64) -> Vec<Phase> {
    let (depth, penetration) = (problem.depth, problem.numbers.penetration * problem.depth);
    let peak = depth + penetration;
    let phase = |name: String, travels: Vec<f64>| Phase {
        name,
        travels: travels.into_iter().map(|travel| um * travel).collect(),
    };
    let load = problem.numbers.schedule().into_iter().map(|share| share * depth + penetration).collect();
    let mut phases = vec![phase("LOADING".into(), load)];
    if !scene.loading.unload {
        return phases;
    }
    let way = unloading(peak, recovery(problem, penetration), problem.numbers.unload_steps, 0.0);
    let back: Vec<f64> = way.chain([-0.1 * depth]).collect();
    let again: Vec<f64> = back.iter().rev().skip(1).copied().chain([peak]).collect();
    for cycle in 0..=problem.reloads {
        let number = |name: &str| if problem.reloads > 0 { format!("{name}-{cycle}") } else { name.into() };
        if cycle > 0 {
            phases.push(phase(number("RELOADING"), again.clone()));
        }
        phases.push(phase(number("UNLOADING"), back.clone()));
    }
    phases
}

/// Estimated way from the peak to the end of contact, in the unit of `problem`: F ∝ (1 - u/u₀)^1.25 with the
/// slope of a punch, 2E* a, at the peak: u₀ = 1.25 p A/(2E* a). Under a row of rings their sum on a punch as
/// wide as the row is added. Only the steps are chosen by it.
fn recovery(problem: &Problem, penetration: f64) -> f64 {
    let modulus = problem.metal.elastic.reduced_modulus();
    let pressure = problem.penalty * penetration;
    let punch = |area: f64, radius: f64| pressure * area / (2.0 * modulus * radius);
    let touched = || {
        let centres = problem.profile.asperities.iter().map(|a| a.centre).chain(std::iter::once(0.0));
        centres.zip(&problem.half_widths).filter(|(_, w)| **w > 0.0)
    };
    let widest = touched().fold(0.0, |m: f64, (_, w)| m.max(*w));
    let row = touched().fold(widest, |m, (centre, w)| m.max(centre + w));
    let local = punch(std::f64::consts::PI * widest * widest, widest);
    let rings: f64 = touched().map(|(centre, w)| 4.0 * std::f64::consts::PI * centre * w).sum();
    let bulk = if problem.symmetry == Symmetry::Axisymmetric { punch(rings, row) } else { 0.0 };
    UNLOADING_EXPONENT * (local + bulk + penetration)
}
