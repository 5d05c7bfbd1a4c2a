//! One crush from a scene to its records: the entry point of the solver.

use crate::algebra::newton::{KEEP, Settings};
use crate::body::discrete_body::{Body, ToolContact};
use crate::body::fields::Fields;
use crate::run::equilibrium::{Counters, Equilibrium};
use crate::run::load_path::{Goal, Path, Stop, schedule};
use crate::run::problem::{PROBED, prepare};
use crate::run::record::{AsperityRow, CurveRow, CycleRow, GapRow, IslandRow, Phase, Summary};
use crate::scene::{ContactMethod, Scene, SceneError, Target};
use asperity_mesh::Mesh;
use std::ops::ControlFlow;

mod recorder;
use recorder::Recorder;

/// What an observer is told, in SI units.
pub enum Event<'a> {
    /// An increment converged.
    Increment {
        /// Its row of the curve.
        row: &'a CurveRow,
        /// Increments that the whole run will have, as far as is known.
        planned: usize,
    },
    /// Fields of the increment of the last row.
    Fields(&'a FieldFrame),
}

/// Fields of one increment, SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct FieldFrame {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// The mesh before the crush, m.
    pub mesh: Mesh,
    /// The fields.
    pub fields: Fields,
}

/// A run that ended before its target.
#[derive(Clone, Debug, PartialEq)]
pub struct Stopped {
    /// Why.
    pub reason: Stop,
    /// Depth of the last converged increment, m.
    pub depth: f64,
    /// Whether the tool was advancing or retreating.
    pub phase: Phase,
}

/// What a run leaves, complete or not.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The curve, from first touch.
    pub rows: Vec<CurveRow>,
    /// The share of each asperity in each increment; empty for a single one.
    pub asperities: Vec<AsperityRow>,
    /// The gaps between contacts in each increment.
    pub gaps: Vec<GapRow>,
    /// The loading and the reloads, each with its unloading, as far as they are complete.
    pub cycles: Vec<CycleRow>,
    /// What never yielded among the asperities, at the peak; empty for an elastic body.
    pub elastic_islands: Vec<IslandRow>,
    /// The summary.
    pub summary: Summary,
    /// `None` if the run reached its end.
    pub stopped: Option<Stopped>,
    /// Where the work went.
    pub counters: Counters,
}

/// Why a run could not begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CrushError {
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An element of the mesh is inside out.
    #[error("the mesh has an element that is inside out or degenerate")]
    Mesh,
}

/// Runs `scene`. `mesh` (in metres) replaces the mesh that would be built.
///
/// The observer hears of every increment, and of fields every `output.every` increments and at the peak and the end
/// (if `output.every` is not 0); it ends the run by breaking.
///
/// # Errors
/// Only if the run cannot begin: what stops it later is in the outcome, with all that was reached.
pub fn run(
    scene: &Scene,
    mesh: Option<Mesh>,
    observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
) -> Result<Outcome, CrushError> {
    scene.validate()?;
    let problem = prepare(scene, mesh)?;
    let contact = ToolContact { tool: problem.tool, penalty: problem.penalty };
    let model = Body::new(
        &problem.mesh,
        problem.symmetry,
        problem.metal.clone(),
        |node| problem.held[node],
        Some(contact),
    )
    .and_then(Equilibrium::new)
    .map_err(|_| CrushError::Mesh)?;
    let settings = Settings { tolerance: problem.numbers.newton_tolerance, max_iterations: 40, keep: KEEP };
    let mut path = Path::new(model, settings, problem.numbers.contact == ContactMethod::Augmented);
    let mut recorder = Recorder::new(scene, &problem, path.model.body().dofs.count);
    let goal = match scene.loading.target()? {
        Target::Depth(depth) => Goal::Depth(depth / problem.length),
        Target::Force(force) => Goal::Force {
            force: force / recorder.force_unit(),
            expected_depth: problem.depth,
            limit: (PROBED * problem.depth).min(scene.deepest() / problem.length),
        },
    };
    let numbers = problem.numbers;
    let expected = if numbers.contact == ContactMethod::Augmented {
        0.0
    } else {
        0.9 * numbers.penetration * problem.depth
    };
    let mut stopped = path
        .load(goal, &schedule(numbers.steps, numbers.geometric_from), expected, &mut |model, increment| {
            recorder.record(model, increment, observer)
        })
        .err();
    recorder.peak_reached(&goal, observer, &path.model, stopped.is_none());
    if stopped.is_none() {
        stopped =
            unload_and_reload(scene, &goal, numbers.unload_steps, &mut path, &mut recorder, observer).err();
    }
    Ok(recorder.finish(&path, stopped, observer))
}

/// What comes after the peak: the stiffness there, and unloading and reloading as often as the scene asks.
fn unload_and_reload(
    scene: &Scene,
    goal: &Goal,
    steps: usize,
    path: &mut Path<'_>,
    recorder: &mut Recorder<'_>,
    observer: &mut dyn FnMut(&Event<'_>) -> ControlFlow<()>,
) -> Result<(), Stop> {
    let unload = scene.loading.unload;
    for cycle in 0..=scene.loading.reloads {
        if cycle > 0 {
            path.reload(*goal, &mut |model, increment| recorder.record(model, increment, observer))?;
        }
        let peak = recorder.increments();
        let stiffness = match path.model.unloading_stiffness() {
            Ok(stiffness) => stiffness,
            Err(_) if unload => return Err(Stop::NoEquilibrium),
            Err(_) => return Ok(()),
        };
        recorder.note_stiffness(stiffness.depth);
        if unload {
            path.unload(stiffness, steps, &mut |model, increment| {
                recorder.record(model, increment, observer)
            })?;
            recorder.note_turn(peak);
        }
    }
    Ok(())
}
