//! From a scene to what the solver computes with: unit of length, profile, tool, mesh, penalty.
//!
//! Inside the solver E = 1 and lengths are in units of the scene's own: the depth, or for a force the probed depth.

use crate::contact::tool::Tool;
use crate::point::kinematics::Symmetry;
use crate::point::material::Metal;
use crate::run::a_priori::{self, expected_depth, expected_pressure};
use crate::run::depth_for_force::depth_of;
use crate::run::discretisation::Discretisation;
use crate::scene::{AsperityForm, ElementChoice, Lateral, Scene, SceneError, Substrate, Target, ToolForm};
use asperity_law::Elastic;
use asperity_law::units::Length;
use asperity_mesh::build::{Contact, Plan, build};
use asperity_mesh::grading::Grading;
use asperity_mesh::profile::{Asperity, Profile, Shape};
use asperity_mesh::{ElementKind, Mesh};

/// A scene made ready, dimensionless.
#[derive(Clone, Debug)]
pub struct Problem {
    /// Length of 1, m.
    pub length: f64,
    /// Stress of 1 (Young's modulus), Pa.
    pub modulus: f64,
    /// Axisymmetric or plane strain.
    pub symmetry: Symmetry,
    /// The metal, E = 1.
    pub metal: Metal,
    /// The surface before the crush.
    pub profile: Profile,
    /// The tool.
    pub tool: Tool,
    /// Estimated depth of the peak.
    pub depth: f64,
    /// Estimated contact half width of each asperity at the peak (one entry for a flat body under a tool).
    pub half_widths: Vec<f64>,
    /// Contact pressure per penetration.
    pub penalty: f64,
    /// The mesh.
    pub mesh: Mesh,
    /// Nodes on the held bottom, on the axis (left side) and on the lateral side.
    pub held: Vec<[bool; 2]>,
    /// The discretisation used.
    pub numbers: Discretisation,
}

/// How far a run that is driven by a force may go beyond the depth that was probed for it.
pub const PROBED: f64 = 1.3;

/// Prepares `scene`, which is valid; `mesh` replaces the mesh that would be built (in metres).
///
/// # Errors
/// A scene that cannot be meshed: path and reason.
pub fn prepare(scene: &Scene, mesh: Option<Mesh>) -> Result<Problem, SceneError> {
    let numbers = Discretisation::new(scene);
    let elastic = scene.material.elastic();
    let modulus = elastic.youngs_modulus;
    let symmetry = match scene.symmetry {
        crate::scene::Symmetry::Axisymmetric => Symmetry::Axisymmetric,
        crate::scene::Symmetry::PlaneStrain => Symmetry::PlaneStrain,
    };
    let metal = Metal {
        elastic: Elastic { youngs_modulus: 1.0, ..elastic },
        hardening: scene.material.hardening().map(|curve| curve.over(modulus)),
        kinematic_share: scene.material.moving_share(),
    };
    let tool_form = scene.tool.form().map_err(|e| within("tool", e))?;
    let outlines = outlines(scene)?;
    let (length, target) = match scene.loading.target().map_err(|e| within("loading", e))? {
        Target::Depth(depth) => (depth, None),
        Target::Force(force) => {
            let guess = expected_depth(
                &metal,
                modulus,
                symmetry,
                &Profile { asperities: outlines.clone() },
                &tool_over(tool_form, 1.0),
                force,
            );
            (depth_of(&with_body_of(scene, mesh.as_ref()), force, guess), Some(force))
        }
    };
    let scaled: Vec<Asperity> = outlines.iter().map(|a| scale(a, length)).collect();
    let profile = Profile { asperities: scaled };
    let tool = tool_over(tool_form, length);
    // a force is only probed for its depth: mesh somewhat further than that
    let depth = 1.0;
    let reach = if target.is_some() { PROBED } else { 1.0 };
    let half_widths = a_priori::half_widths(&profile, &tool, reach * depth);
    let penalty = expected_pressure(&metal, &profile, &tool, depth) / (numbers.penetration * depth);
    let mesh = match mesh {
        Some(mut mesh) => {
            for node in &mut mesh.nodes {
                *node = node.map(|x| x / length);
            }
            mesh
        }
        None => {
            let from = a_priori::resolved_from(&profile, &tool, depth, reach * depth);
            build_mesh(scene, &numbers, symmetry, &profile, &half_widths, from, length)?
        }
    };
    let held = held_nodes(&mesh, symmetry, scene.lateral);
    Ok(Problem {
        length,
        modulus,
        symmetry,
        metal,
        profile,
        tool,
        depth,
        half_widths,
        penalty,
        mesh,
        held,
        numbers,
    })
}

/// `scene` with the size of the body that `mesh` (m) holds, where plane strain asks for one.
fn with_body_of(scene: &Scene, mesh: Option<&Mesh>) -> Scene {
    let mut scene = scene.clone();
    if let (Some(mesh), crate::scene::Symmetry::PlaneStrain) = (mesh, scene.symmetry) {
        let [width, depth] = mesh.extent().map(|[low, high]| high - low);
        scene.substrate = Some(Substrate { radius: Some(Length(0.5 * width)), depth: Some(Length(depth)) });
    }
    scene
}

fn within(table: &str, error: SceneError) -> SceneError {
    let path = if error.path.is_empty() { table.to_string() } else { format!("{table}.{}", error.path) };
    SceneError { path, message: error.message }
}

/// The asperities side by side, in metres.
fn outlines(scene: &Scene) -> Result<Vec<Asperity>, SceneError> {
    let mut outlines = Vec::new();
    let plane = scene.symmetry == crate::scene::Symmetry::PlaneStrain;
    let curved = !matches!(scene.tool.form(), Ok(ToolForm::Plane));
    let mut edge = 0.0; // where the next asperity may begin
    for (index, asperity) in scene.asperity.iter().enumerate() {
        let form = asperity.form().map_err(|e| within(&format!("asperity[{index}]"), e))?;
        let (shape, valley_radius) = match form {
            AsperityForm::Cone { slope, tip_radius, valley_radius, .. } => {
                (Shape::Cone { tan_slope: slope.tan(), tip_radius }, valley_radius)
            }
            AsperityForm::Sphere { radius, .. } => (Shape::Sphere { radius }, 0.0),
        };
        let half = form.base_radius();
        // a curved tool comes down at 0: over the first summit
        let at_zero = index == 0 && (!plane || curved);
        let centre = if at_zero { 0.0 } else { edge + half };
        outlines.push(Asperity { shape, height: form.height(), centre, valley_radius });
        edge = centre + half + asperity.spacing.map_or(0.0, |s| s.0);
    }
    Ok(outlines)
}

/// The tool of a scene, lengths over `length` (m).
fn tool_over(form: ToolForm, length: f64) -> Tool {
    match form {
        ToolForm::Plane => Tool::Plane,
        ToolForm::Cone { slope, tip_radius } => {
            Tool::Cone { tan_slope: slope.tan(), tip_radius: tip_radius / length }
        }
        ToolForm::Sphere { radius } => Tool::Sphere { radius: radius / length },
    }
}

fn scale(a: &Asperity, length: f64) -> Asperity {
    let shape = match a.shape {
        Shape::Cone { tan_slope, tip_radius } => Shape::Cone { tan_slope, tip_radius: tip_radius / length },
        Shape::Sphere { radius } => Shape::Sphere { radius: radius / length },
    };
    Asperity {
        shape,
        height: a.height / length,
        centre: a.centre / length,
        valley_radius: a.valley_radius / length,
    }
}

fn widest(half_widths: &[f64]) -> f64 {
    half_widths.iter().fold(0.0, |m: f64, w| m.max(*w))
}

/// Half width of the core over that from which a contact is to be resolved: an elastic contact is 0.7 times as wide as expected
/// (see `expected`), and the columns of the core are wide.
const CORE: f64 = 0.7;

/// Growth of the shells far from the contact, as a share of the distance.
const FAR_GROWTH: f64 = 0.4;

/// Size of an automatic substrate: so many radii of the loaded region, which is the contact of a single asperity and
/// the whole row of several, whose forces add up far away.
pub fn automatic_size(numbers: &Discretisation, profile: &Profile, half_widths: &[f64]) -> f64 {
    let touched = profile.asperities.iter().zip(half_widths).filter(|(_, w)| **w > 0.0);
    let loaded = touched.map(|(a, w)| a.centre + w).fold(widest(half_widths), f64::max);
    numbers.domain * loaded
}

/// The mesh of the scene, lengths over `length`; contacts are resolved from the share `resolved_from` of their half widths on.
fn build_mesh(
    scene: &Scene,
    numbers: &Discretisation,
    symmetry: Symmetry,
    profile: &Profile,
    half_widths: &[f64],
    resolved_from: f64,
    length: f64,
) -> Result<Mesh, SceneError> {
    let kind = match numbers.element {
        ElementChoice::Q8r => ElementKind::Quad8,
        ElementChoice::Q4 => ElementKind::Quad4,
    };
    check_valleys(profile, length)?;
    let widest = widest(half_widths);
    let end_gap = scene.end_gap() / length;
    let right = profile.asperities.last().map_or(0.0, |a| a.centre + a.half_width(a.height)) + end_gap;
    let row = match symmetry {
        Symmetry::Axisymmetric => [0.0, right],
        Symmetry::PlaneStrain if profile.asperities.is_empty() => [-10.0 * widest, 10.0 * widest],
        Symmetry::PlaneStrain => {
            [profile.asperities.first().map_or(0.0, |a| a.centre - a.half_width(a.height)) - end_gap, right]
        }
    };
    let automatic = automatic_size(numbers, profile, half_widths).max(3.0 * (row[1] - row[0]));
    let substrate = scene.substrate.as_ref();
    let size_of = |given: Option<asperity_law::units::Length>| given.map_or(automatic, |l| l.0 / length);
    let depth = profile.height() + size_of(substrate.and_then(|s| s.depth));
    let radius = size_of(substrate.and_then(|s| s.radius));
    let width = match symmetry {
        _ if scene.has_repeated_asperities() => row,
        Symmetry::Axisymmetric => [0.0, radius],
        Symmetry::PlaneStrain => {
            let middle = 0.5 * (row[0] + row[1]);
            [middle - radius, middle + radius]
        }
    };
    if width[0] > row[0] || width[1] < row[1] {
        return Err(SceneError {
            path: "substrate.radius".into(),
            message: format!(
                "{:.6e} m does not reach beyond the asperities, which need {:.6e} m: enlarge it",
                radius * length,
                match symmetry {
                    Symmetry::Axisymmetric => row[1],
                    Symmetry::PlaneStrain => 0.5 * (row[1] - row[0]),
                } * length
            ),
        });
    }
    // sizes over the distance from a centre, so that the contact radius holds the wanted number of elements
    let start = CORE * resolved_from;
    let grading = Grading {
        fineness: (1.0 - start.ln()) / numbers.elements_in_contact as f64,
        start,
        fine: 1.6,
        far: FAR_GROWTH,
    };
    let contacts: Vec<Contact> = if profile.asperities.is_empty() {
        vec![Contact { centre: 0.0, half_width: widest, foot: 10.0 * widest, slope: 0.0 }]
    } else {
        let contact = |(a, w): (&Asperity, &f64)| Contact {
            centre: a.centre,
            half_width: *w,
            foot: a.half_width(a.height),
            slope: steepest(a),
        };
        profile.asperities.iter().zip(half_widths).map(contact).collect()
    };
    if contacts.iter().all(|c| c.half_width <= 0.0) {
        return Err(SceneError {
            path: "loading.depth".into(),
            message: "no asperity is touched at the full depth: raise the depth".into(),
        });
    }
    Ok(build(&Plan { profile: profile.clone(), contacts, row, width, depth, grading, kind }))
}

/// Steepest slope that a mesh under the asperity must follow: that at the foot of a cap.
fn steepest(asperity: &Asperity) -> f64 {
    match asperity.shape {
        Shape::Cone { tan_slope, .. } => tan_slope,
        Shape::Sphere { radius } => asperity.half_width(asperity.height) / (radius - asperity.height),
    }
}

/// Fillets must leave a part of both their sides straight.
fn check_valleys(profile: &Profile, length: f64) -> Result<(), SceneError> {
    for (index, asperity) in profile.asperities.iter().enumerate() {
        let Some([own, beyond]) = profile.valley_reach(index) else { continue };
        let foot = asperity.half_width(asperity.height);
        let next = profile.asperities.get(index + 1);
        let room = next.map_or(f64::INFINITY, |b| {
            let gap = b.centre - b.half_width(b.height) - asperity.centre - foot;
            if gap > 1e-9 * foot { gap } else { b.half_width(b.height) - b.cap_radius() }
        });
        if own > foot - asperity.cap_radius() || beyond > room {
            let largest = asperity.valley_radius * ((foot - asperity.cap_radius()) / own).min(room / beyond);
            return Err(SceneError {
                path: format!("asperity[{index}].valley_radius"),
                message: format!(
                    "{:.6e} m leaves no straight flank: it may be at most {:.6e} m here",
                    asperity.valley_radius * length,
                    largest * length
                ),
            });
        }
    }
    Ok(())
}

/// Which displacement components of each node are held: both at the base, that across at the axis and at symmetric sides.
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
