//! From a force to the depth that it will need: coarse crushes to growing or shrinking depths until one
//! passes the force.
//!
//! The mesh is fine where the contact will be, so a run that is driven by a force must know its depth
//! beforehand. A formula is off by a factor of two between elastic and plastic asperities and by six on
//! elastic ridges, whose depth depends on the whole body; a coarse crush takes some hundredths of a second
//! and is off by a few percent.

use crate::load_history::ready;
use crate::load_path::Path;
use crate::record::curve::Curve;
use crate::scene::{Accuracy, Loading, Numerics, Scene, SceneError, Substrate, Symmetry, Target, Tool};
use crate::setup::compliance::Compliance;
use crate::setup::contact_estimate::expected_depth;
use crate::setup::deformed_surface::Formed;
use crate::setup::discretisation::Discretisation;
use crate::setup::prepare::{Expected, bodies, metal};
use crate::setup::problem::Problem;
use crate::setup::units::Units;
use crate::simulate::simulate;
use asperity_material::units::Length;
use asperity_mesh::Mesh;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::energy::ContactSums;
use std::ops::ControlFlow;

/// Elements across the contact and load steps of a coarse crush.
const COARSE_ELEMENTS: usize = 6;
const COARSE_STEPS: usize = 12;

/// Factor by which a coarse crush is made finer where one breaks off.
const FINER: usize = 3;

/// Points of a curve, the first one included, from which nothing is extrapolated.
const FEWEST_POINTS: usize = 3;

/// Crushes after which the last answer is taken.
const MOST_CRUSHES: usize = 6;

/// A crush that goes further than this many times the depth of the force has too few elements in contact
/// there.
const LARGEST_DEPTH_RATIO: f64 = 2.0;

/// Depth of a crush over the expected one, so that the force is passed and not just missed.
const PASSED_DEPTH_RATIO: f64 = 1.1;

/// Estimates of `scene`, which is valid: the depth of its peak is the one that it asks for, or else the one
/// at which it carries its force, at most the deepest that its tool can go. `mesh` (in metres) holds the size
/// of the body where plane strain asks for one. Earlier loads are computed coarsely, for the surface that
/// they leave. Lengths are in `units`.
///
/// # Errors
/// Bodies that make no sense, an earlier load that cannot be removed: path and reason.
pub fn expect(
    scene: &Scene,
    mesh: Option<&Mesh>,
    units: Units,
    analyses: &Analyses,
) -> Result<Expected, SceneError> {
    let earlier = scene.earlier_loads().iter().map(|load| &load.tool);
    let centred = earlier.chain([&scene.tool]).any(Tool::is_curved);
    let mut expected = Expected { centred, ..Expected::default() };
    for index in 0..scene.earlier_loads().len() {
        let within = |e: SceneError| SceneError { path: format!("initial.load[{index}].{}", e.path), ..e };
        let load = with_body_of(&scene.at_load(index), mesh);
        expected.expect_peak(target_depth(&load, mesh, &expected, (units, analyses)).map_err(within)?);
        let formed = formed(&load, &expected, (units, analyses)).ok_or_else(|| {
            let message = "cannot be unloaded from its depth: ask for less";
            within(SceneError { path: "loading".into(), message: message.into() })
        })?;
        let mut earlier = std::mem::take(&mut expected.earlier);
        earlier.push(expected);
        expected = Expected { formed: Some(formed), earlier, centred, ..Expected::default() };
    }
    expected.expect_peak(target_depth(scene, mesh, &expected, (units, analyses))?);
    Ok(expected)
}

impl Expected {
    fn expect_peak(&mut self, peak: Peak) {
        (self.depth, self.is_guessed) = (peak.depth, peak.is_guessed);
    }
}

/// Units and analyses, which all coarse crushes of a search share.
type Shared<'a> = (Units, &'a Analyses);

/// An estimate of the depth of a peak.
struct Peak {
    depth: f64,
    /// True where no coarse crush has carried the force there.
    is_guessed: bool,
}

/// The peak of `scene` after the loads that are `expected` before it.
fn target_depth(
    scene: &Scene,
    mesh: Option<&Mesh>,
    expected: &Expected,
    shared: Shared<'_>,
) -> Result<Peak, SceneError> {
    let (units, _) = shared;
    match scene.loading.target()? {
        Target::Depth(depth) if gives_way(scene) => {
            let asked = depth / units.length;
            let depth = depth_of_body(&with_body_of(scene, mesh), asked, expected, shared);
            Ok(Peak { depth, is_guessed: false })
        }
        Target::Depth(depth) => Ok(Peak { depth: depth / units.length, is_guessed: false }),
        Target::Force(force) => {
            let (profile, tool) = bodies(scene, expected.centred, units.length)?;
            let length = Units::of_scene(scene)?.length / units.length;
            let force = force / units.force;
            let guess = expected_depth(&metal(scene), scene.symmetry, &profile, &tool, force, length);
            Ok(depth_of(&with_body_of(scene, mesh), force, guess, expected, shared))
        }
    }
}

/// The surface that `scene` leaves, from a coarse crush; `None` where it cannot be unloaded.
fn formed(scene: &Scene, expected: &Expected, shared: Shared<'_>) -> Option<Formed> {
    let problem = coarse_problem(scene, expected, (shared, 1))?;
    let problem = Problem { unload: true, reloads: 0, ..problem };
    let simulation = simulate(&problem, shared.1, 0, &mut |_| ControlFlow::Continue(())).ok()?;
    let state = simulation.path.model.state();
    let nodes = state.edges.iter().flat_map(|edge| edge.nodes).map(|node| state.position[node as usize]);
    let reached = state.points.states.iter().map(|point| point.yield_stress);
    let hardest = if problem.metal.hardening.is_some() { reached.fold(0.0, f64::max) } else { 0.0 };
    simulation.stopped.is_none().then(|| Formed::new(nodes.collect(), hardest))
}

/// `scene` with the size of the body that `mesh` (m) holds, where plane strain asks for one.
fn with_body_of(scene: &Scene, mesh: Option<&Mesh>) -> Scene {
    let mut scene = scene.clone();
    if let (Some(mesh), Symmetry::PlaneStrain) = (mesh, scene.symmetry) {
        let [width, depth] = mesh.extent().map(|[low, high]| high - low);
        scene.substrate = Some(Substrate { radius: Some(Length(0.5 * width)), depth: Some(Length(depth)) });
    }
    scene
}

/// Depth at which `scene` carries `force`, from the first guess `guess`, and whether a coarse crush has
/// carried it.
///
/// A finer crush is tried where a coarse one breaks off before it carries the force; where that does too,
/// the depth is extrapolated from what it reached.
fn depth_of(scene: &Scene, force: f64, guess: f64, expected: &Expected, shared: Shared<'_>) -> Peak {
    let deepest = scene.deepest() / shared.0.length;
    let mut depth = guess.min(deepest);
    let mut fineness = 1;
    for _ in 0..MOST_CRUSHES {
        let force_of = |_: &Problem, contact: &ContactSums| contact.force;
        let reached = coarse(scene, &to_depth(expected, depth), (shared, fineness), force_of);
        let Some(curve) = reached.filter(|points| points.len() > FEWEST_POINTS).map(Curve::new) else {
            if fineness == FINER {
                break;
            }
            fineness = FINER;
            continue;
        };
        let end = curve.end();
        match curve.depth_of(force) {
            Some(found) if LARGEST_DEPTH_RATIO * found >= end => {
                return Peak { depth: found, is_guessed: false };
            }
            Some(found) => depth = PASSED_DEPTH_RATIO * found,
            None => {
                let exponent = (curve.value(end) / curve.value(0.5 * end)).log2().clamp(0.7, 4.0);
                let growth = (force / curve.value(end)).powf(1.0 / exponent);
                let broke_off = end < 0.999 * depth;
                if growth.is_finite() {
                    depth = (PASSED_DEPTH_RATIO * growth * end).min(deepest);
                }
                if !growth.is_finite() || end >= 0.999 * deepest || broke_off && fineness == FINER {
                    break;
                }
                fineness = if broke_off { FINER } else { fineness };
            }
        }
    }
    Peak { depth, is_guessed: true }
}

/// True where tool or machine are elastic.
fn gives_way(scene: &Scene) -> bool {
    scene.tool.youngs_modulus.is_some() || scene.tool.machine_compliance.is_some()
}

/// Depth of the body where it is `asked` with what tool and machine give way.
fn depth_of_body(scene: &Scene, asked: f64, expected: &Expected, shared: Shared<'_>) -> f64 {
    let mut depth = asked;
    for _ in 0..MOST_CRUSHES {
        let total = coarse(scene, &to_depth(expected, depth), (shared, 1), |problem, contact| {
            Compliance::new(scene, &problem.units).deflection(contact.force, contact.area)
        });
        let Some(found) = total.and_then(|way| body_depth(&way, asked)) else { break };
        let fine = found * LARGEST_DEPTH_RATIO >= depth;
        depth = found;
        if fine {
            break;
        }
    }
    depth
}

/// Depth at which it makes `asked` together with the way over it, linear between points.
fn body_depth(way: &[[f64; 2]], asked: f64) -> Option<f64> {
    let sum = |p: &[f64; 2]| p[0] + p[1];
    let after = way.iter().position(|p| sum(p) >= asked)?;
    let (from, to) = (way.get(after.checked_sub(1)?)?, way.get(after)?);
    Some(from[0] + (to[0] - from[0]) * (asked - sum(from)) / (sum(to) - sum(from)))
}

/// The same with its peak at `depth`.
fn to_depth(expected: &Expected, depth: f64) -> Expected {
    Expected { depth, ..expected.clone() }
}

/// A coarse crush of `scene` to its expected depth, so many times `finer` than the coarsest, ready to go,
/// after coarse earlier loads. Tool and machine are stiff.
fn coarse_problem(
    scene: &Scene,
    expected: &Expected,
    (shared, finer): (Shared<'_>, usize),
) -> Option<Problem> {
    let numerics = Numerics {
        elements_in_contact: Some(finer * COARSE_ELEMENTS),
        steps: Some(finer * COARSE_STEPS),
        ..Numerics::default()
    };
    let depth = Some(Length(expected.depth * shared.0.length));
    let loading = Loading { depth, force: None, unload: false, reloads: 0 };
    let probe = Scene {
        accuracy: Accuracy::Draft,
        numerics,
        loading,
        mesh: None,
        tool: scene.tool.rigid(),
        ..scene.clone()
    };
    probe.validate().ok()?;
    ready(&probe, Discretisation::new(&probe), None, expected, shared).ok()
}

/// Depth and what `of` makes of the contact in the increments of a coarse crush to the expected depth, from 0
/// on; as far as it goes.
fn coarse(
    scene: &Scene,
    expected: &Expected,
    (shared, finer): (Shared<'_>, usize),
    of: impl Fn(&Problem, &ContactSums) -> f64,
) -> Option<Vec<[f64; 2]>> {
    let problem = coarse_problem(scene, expected, (shared, finer))?;
    let mut points = vec![[0.0; 2]];
    // a path that stops early has a curve too
    let _ = Path::new(&problem, shared.1).ok()?.load(&mut |_, increment| {
        points.push([increment.depth, of(&problem, &increment.contact)]);
        true
    });
    Some(points)
}
