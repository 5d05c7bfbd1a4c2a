//! From a scene to what the solver computes with: numbers of the accuracy level, unit of length, mesh, penalty.
//!
//! Inside the solver E = 1 and lengths are in units of the scene's own: the depth, or for a force the estimated depth.

use crate::kinematics::Symmetry;
use crate::material::Metal;
use crate::probe::depth_of;
use crate::scene::{
    Accuracy, AsperityForm, ContactMethod, ElementChoice, Lateral, Numerics, Scene, SceneError, Target,
    ToolForm,
};
use crate::tool::Tool;
use asperity_law::Elastic;
use asperity_mesh::build::{Contact, Grading, Plan, build};
use asperity_mesh::profile::{Asperity, Profile, Shape};
use asperity_mesh::{ElementKind, Mesh};

/// Every number of the discretisation, none left open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Discretisation {
    /// Which quadrilateral.
    pub element: ElementChoice,
    /// Elements across the contact radius at the peak.
    pub elements_in_contact: usize,
    /// Load steps to the peak.
    pub steps: usize,
    /// Depth at which geometric steps begin, as a share of the peak.
    pub geometric_from: f64,
    /// Steps back to zero force.
    pub unload_steps: usize,
    /// Penalty or augmented Lagrangian.
    pub contact: ContactMethod,
    /// Mean penetration over depth.
    pub penetration: f64,
    /// Relative residual at which Newton stops.
    pub newton_tolerance: f64,
    /// Size of an automatic substrate, in contact radii.
    pub domain: f64,
    /// The contact is resolved from this share of the peak's contact radius on.
    pub resolved_from: f64,
}

/// What an accuracy chooses for a quadratic element.
struct Choice {
    elements: usize,
    steps: usize,
    unload_steps: usize,
    tolerance: f64,
    domain: f64,
    penetration: f64,
}

/// The levels from coarse to fine: the promised error, and in the order of [`Choice`] the numbers that keep it.
const LEVELS: [(Accuracy, [f64; 6]); 3] = [
    (Accuracy::Draft, [10.0, 24.0, 6.0, 1e-3, 60.0, 0.004]),
    (Accuracy::Standard, [22.0, 112.0, 10.0, 1e-4, 100.0, 0.004]),
    (Accuracy::Reference, [60.0, 220.0, 40.0, 1e-6, 800.0, 0.001]),
];

impl Choice {
    /// Between two levels every number is a power of the promise, as every part of the error is a power of its number:
    /// each part then falls with the promise.
    fn of(promise: f64) -> Choice {
        let [coarse, middle, fine] = LEVELS;
        let ends = if promise > middle.0.promise() { [coarse, middle] } else { [middle, fine] };
        let [from, to] = ends.map(|(level, _)| level.promise());
        let share = ((promise / from).ln() / (to / from).ln()).clamp(0.0, 1.0);
        let [elements, steps, unload_steps, tolerance, domain, penetration] =
            std::array::from_fn(|i| ends[0].1[i].powf(1.0 - share) * ends[1].1[i].powf(share));
        let whole = |x: f64| x.round() as usize;
        let digits = |x: f64| format!("{x:.2e}").parse().unwrap_or(x);
        Choice {
            elements: whole(elements),
            steps: whole(steps),
            unload_steps: whole(unload_steps),
            tolerance: digits(tolerance),
            domain: digits(domain),
            penetration: digits(penetration),
        }
    }
}

impl Discretisation {
    /// What the accuracy of `scene` uses where its numerics are silent.
    pub fn new(scene: &Scene) -> Discretisation {
        let numerics = &scene.numerics;
        let Choice { elements, steps, unload_steps, tolerance, domain, penetration } =
            Choice::of(scene.accuracy.promise());
        // the correction of the depth takes off too much while an elastic contact grows, so the penetration is halved;
        // stiffer still, quadratic edges open gaps at the front of the contact
        let penetration = if !scene.material.yields() { 0.002 } else { penetration };
        let element = numerics.element.unwrap_or(ElementChoice::Q8r);
        // the work of ridges grows with h², that of a cone with h³: their early increments weigh more
        let ridges = scene.symmetry == crate::scene::Symmetry::PlaneStrain || scene.asperity.len() > 1;
        let (steps, geometric_from) = if ridges { (steps + steps / 3, 0.003) } else { (steps, 0.02) };
        // unloaded, contacts part one after the other, each with a kink in the curve
        let unload_steps = if ridges { 2 * unload_steps } else { unload_steps };
        // errors of step and mesh were made equal to the promise on metal of n 0.3 and grow as it hardens less
        let softness = softness(scene);
        let elements = (elements as f64 * softness.powf(0.8)).round() as usize;
        let steps = (steps as f64 * softness).round() as usize;
        // a linear element must be 8/3 times smaller than a quadratic one to be as exact
        let elements = if element == ElementChoice::Q4 { elements * 8 / 3 } else { elements };
        Discretisation {
            element,
            elements_in_contact: numerics.elements_in_contact.unwrap_or(elements),
            steps: numerics.steps.unwrap_or(steps),
            geometric_from,
            unload_steps,
            contact: numerics.contact.unwrap_or(ContactMethod::Penalty),
            penetration: numerics.penetration.unwrap_or(penetration),
            newton_tolerance: numerics.newton_tolerance.unwrap_or(tolerance),
            domain: numerics.domain.unwrap_or(domain),
            resolved_from: 0.2,
        }
    }

    /// What of it a scene can say.
    pub fn numerics(&self) -> Numerics {
        Numerics {
            element: Some(self.element),
            elements_in_contact: Some(self.elements_in_contact),
            steps: Some(self.steps),
            contact: Some(self.contact),
            penetration: Some(self.penetration),
            newton_tolerance: Some(self.newton_tolerance),
            domain: Some(self.domain),
        }
    }
}

/// (1 - n)/0.7 of metal that hardens less than n = 0.3, else 1: the error of the load step grows with its square and is
/// of second order in the step, the ripple of the mesh grows with it nearly and is of first order (see `estimate`).
fn softness(scene: &Scene) -> f64 {
    let modulus = scene.material.youngs_modulus.0;
    scene.material.hardening().map_or(1.0, |h| ((1.0 - h.exponent(modulus)) / 0.7).max(1.0))
}

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
            let guess = estimate_depth(&metal, modulus, symmetry, &outlines, &tool_form, force);
            (depth_of(scene, force, guess), Some(force))
        }
    };
    let scaled: Vec<Asperity> = outlines.iter().map(|a| scale(a, length)).collect();
    let profile = Profile { asperities: scaled };
    let tool = match tool_form {
        ToolForm::Plane => Tool::Plane,
        ToolForm::Cone { slope, tip_radius } => {
            Tool::Cone { tan_slope: slope.tan(), tip_radius: tip_radius / length }
        }
        ToolForm::Sphere { radius } => Tool::Sphere { radius: radius / length },
    };
    // a force is only probed for its depth: mesh somewhat further than that
    let depth = 1.0;
    let reach = if target.is_some() { PROBED } else { 1.0 };
    let half_widths = half_widths(&profile, &tool, reach * depth);
    let penalty = expected_pressure(&metal, &profile, &tool, depth) / (numbers.penetration * depth);
    let mesh = match mesh {
        Some(mut mesh) => {
            for node in &mut mesh.nodes {
                *node = node.map(|x| x / length);
            }
            mesh
        }
        None => build_mesh(scene, &numbers, symmetry, &profile, &half_widths, length)?,
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

fn within(table: &str, error: SceneError) -> SceneError {
    let path = if error.path.is_empty() { table.to_string() } else { format!("{table}.{}", error.path) };
    SceneError { path, message: error.message }
}

/// The asperities side by side, in metres.
fn outlines(scene: &Scene) -> Result<Vec<Asperity>, SceneError> {
    let mut outlines = Vec::new();
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
        let on_axis = index == 0 && scene.symmetry == crate::scene::Symmetry::Axisymmetric;
        let centre = if on_axis { 0.0 } else { edge + half };
        outlines.push(Asperity { shape, height: form.height(), centre, valley_radius });
        edge = centre + half + asperity.spacing.map_or(0.0, |s| s.0);
    }
    Ok(outlines)
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

/// The tool as an asperity of the same outline: the contact of the two is the same to first order in the slope.
/// `None` for a plane.
pub fn mirror(tool: &Tool) -> Option<Asperity> {
    let shape = match *tool {
        Tool::Plane => return None,
        Tool::Cone { tan_slope, tip_radius } => Shape::Cone { tan_slope, tip_radius },
        Tool::Sphere { radius } => Shape::Sphere { radius },
    };
    Some(Asperity { shape, height: f64::INFINITY, centre: 0.0, valley_radius: 0.0 })
}

/// Contact half width of a crushed asperity over the half width of the cut at the same depth: 0.64 (elastic cone,
/// 2/π) to 1.06 (perfectly plastic), 0.89 for the single asperity.
const SPREAD: f64 = 0.9;

/// Contact half widths at `depth` below the highest summit.
fn half_widths(profile: &Profile, tool: &Tool, depth: f64) -> Vec<f64> {
    if let Some(mirrored) = mirror(tool) {
        return vec![SPREAD * mirrored.half_width(depth)];
    }
    let top = profile.height();
    profile.asperities.iter().map(|a| SPREAD * a.half_width((depth - (top - a.height)).max(0.0))).collect()
}

/// Mean contact pressure to be expected at `depth`, in units of E: ½E* tan β of the elastic cone and 2.8 σ_r of full
/// plasticity (ε_r ≈ 0.1 tan β), joined harmonically. Only the penalty is scaled with it.
fn expected_pressure(metal: &Metal, profile: &Profile, tool: &Tool, depth: f64) -> f64 {
    let slopes = mirror(tool).into_iter().chain(profile.asperities.iter().copied()).map(|a| {
        let width = SPREAD * a.half_width(depth);
        match a.shape {
            Shape::Cone { tan_slope, tip_radius } if tip_radius > 0.0 => tan_slope.min(width / tip_radius),
            Shape::Cone { tan_slope, .. } => tan_slope,
            Shape::Sphere { radius } => width / radius,
        }
    });
    let slope = slopes.fold(0.0, f64::max);
    let elastic = 0.5 * metal.elastic.reduced_modulus() * slope;
    match &metal.hardening {
        None => elastic,
        Some(h) => 1.0 / (1.0 / elastic + 1.0 / (2.8 * h.representative_stress(0.1 * slope))),
    }
}

/// Depth (m) at which the expected pressure over the cut area carries `force` (N, or N/m in plane strain).
fn estimate_depth(
    metal: &Metal,
    modulus: f64,
    symmetry: Symmetry,
    outlines: &[Asperity],
    tool: &ToolForm,
    force: f64,
) -> f64 {
    let tool = match *tool {
        ToolForm::Plane => Tool::Plane,
        ToolForm::Cone { slope, tip_radius } => Tool::Cone { tan_slope: slope.tan(), tip_radius },
        ToolForm::Sphere { radius } => Tool::Sphere { radius },
    };
    let profile = Profile { asperities: outlines.to_vec() };
    let carried = |depth: f64| {
        let pressure = modulus * expected_pressure(metal, &profile, &tool, depth);
        let area: f64 = half_widths(&profile, &tool, depth)
            .iter()
            .zip(std::iter::once(0.0).chain(outlines.iter().skip(1).map(|a| a.centre)))
            .map(|(w, centre)| match symmetry {
                Symmetry::PlaneStrain => 2.0 * w,
                Symmetry::Axisymmetric if centre == 0.0 => std::f64::consts::PI * w * w,
                Symmetry::Axisymmetric => 4.0 * std::f64::consts::PI * centre * w,
            })
            .sum();
        pressure * area
    };
    // the carried force grows with the depth: bisection in the logarithm over any physical size
    let (mut low, mut high) = (1e-15_f64.ln(), 1e6_f64.ln());
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if carried(middle.exp()) < force {
            low = middle;
        } else {
            high = middle;
        }
    }
    (0.5 * (low + high)).exp()
}

/// Growth of the shells far from the contact, as a share of the distance.
const FAR_GROWTH: f64 = 0.4;

/// Size of an automatic substrate: so many radii of the loaded region, which is the contact of a single asperity and
/// the whole row of several, whose forces add up far away.
pub fn automatic_size(numbers: &Discretisation, profile: &Profile, half_widths: &[f64]) -> f64 {
    let widest = half_widths.iter().fold(0.0, |m: f64, w| m.max(*w));
    let touched = profile.asperities.iter().zip(half_widths).filter(|(_, w)| **w > 0.0);
    let loaded = touched.map(|(a, w)| a.centre + w).fold(widest, f64::max);
    numbers.domain * loaded
}

/// The mesh of the scene, lengths over `length`.
fn build_mesh(
    scene: &Scene,
    numbers: &Discretisation,
    symmetry: Symmetry,
    profile: &Profile,
    half_widths: &[f64],
    length: f64,
) -> Result<Mesh, SceneError> {
    let kind = match numbers.element {
        ElementChoice::Q8r => ElementKind::Quad8,
        ElementChoice::Q4 => ElementKind::Quad4,
    };
    check_valleys(profile, length)?;
    let widest = half_widths.iter().fold(0.0, |m: f64, w| m.max(*w));
    // the row of asperities, with the half gaps that a symmetric side leaves
    let end_gap = match (scene.lateral, scene.asperity.last()) {
        (Lateral::Symmetric, Some(last)) => 0.5 * last.spacing.map_or(0.0, |s| s.0) / length,
        _ => 0.0,
    };
    let right = profile.asperities.last().map_or(0.0, |a| a.centre + a.half_width(a.height)) + end_gap;
    let row = match symmetry {
        Symmetry::Axisymmetric => [0.0, right],
        Symmetry::PlaneStrain if profile.asperities.is_empty() => [-10.0 * widest, 10.0 * widest],
        Symmetry::PlaneStrain => [-end_gap, right],
    };
    let substrate = scene.substrate.as_ref();
    let automatic = automatic_size(numbers, profile, half_widths).max(3.0 * (row[1] - row[0]));
    let size_of = |given: Option<asperity_law::units::Length>| given.map_or(automatic, |l| l.0 / length);
    let depth = profile.height() + size_of(substrate.and_then(|s| s.depth));
    let radius = size_of(substrate.and_then(|s| s.radius));
    let width = match (scene.lateral, symmetry) {
        (Lateral::Symmetric, _) if !profile.asperities.is_empty() => row,
        (_, Symmetry::Axisymmetric) => [0.0, radius],
        (_, Symmetry::PlaneStrain) => {
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
    let start = numbers.resolved_from;
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

/// Base nodes held, axis nodes (and a symmetric lateral side) held sideways.
fn held_nodes(mesh: &Mesh, symmetry: Symmetry, lateral: Lateral) -> Vec<[bool; 2]> {
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
    held
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_smaller_error_is_promised_by_finer_numbers() {
        let mut before = Choice::of(0.05);
        assert_eq!((before.elements, before.steps, before.tolerance), (10, 24, 1e-3));
        for promise in [0.03, 0.02, 0.01, 0.007, 0.005, 0.003, 0.002] {
            let next = Choice::of(promise);
            assert!(next.elements > before.elements && next.steps > before.steps, "{promise}");
            assert!(next.tolerance < before.tolerance && next.domain > before.domain, "{promise}");
            assert!(next.unload_steps >= before.unload_steps && next.penetration <= before.penetration);
            before = next;
        }
        assert_eq!((before.elements, before.steps, before.domain), (60, 220, 800.0));
    }
}
