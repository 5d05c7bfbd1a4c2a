//! A problem from first touch to its end: loading, unloading, reloading, and what is recorded on the way.

use crate::load_path::{Path, Stop};
use crate::record::outcome::{Outcome, Watcher};
use crate::record::recorder::Recorder;
use crate::scene::SceneError;
use crate::setup::problem::Problem;
use asperity_solver::body::analysis::Analyses;

/// The reason why a run could not begin.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CrushError {
    /// The scene makes no sense.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// An element of the mesh is inside out.
    #[error(
        "the mesh has an element that is inside out or degenerate: give more numerics.elements_in_contact (12 or more), or a mesh of convex cells"
    )]
    Mesh,
}

/// A problem that was simulated, as far as it came.
pub struct Simulation<'p> {
    /// The path as it stands at its end.
    pub path: Path<'p>,
    /// The reason why it ended before its goal, if it did.
    pub stopped: Option<Stop>,
    recorder: Recorder<'p>,
}

/// Takes `problem` along its path: loads it to its goal, and unloads and reloads it as often as it asks. Its
/// mesh is analysed unless it is one of `analyses`.
///
/// The observer hears of every increment, and of fields every `interval` increments and at the peak and the
/// end (if that is not 0); it ends the run by breaking.
///
/// # Errors
/// Only if the run cannot begin: what stops it later is in the simulation, with all that was reached.
pub fn simulate<'p>(
    problem: &'p Problem,
    analyses: &Analyses,
    interval: usize,
    observer: &mut Watcher<'_>,
) -> Result<Simulation<'p>, CrushError> {
    let mut path = Path::new(problem, analyses).map_err(|_| CrushError::Mesh)?;
    let mut recorder = Recorder::new(problem, interval, path.model.body().analysis.dofs.count);
    recorder.draw_start(&path.model, observer);
    let mut stopped = path.load(&mut |model, increment| recorder.record(model, increment, observer)).err();
    recorder.peak_reached(observer, &path.model, stopped.is_none());
    if stopped.is_none() {
        stopped = unload_and_reload(problem, &mut path, &mut recorder, observer).err();
    }
    Ok(Simulation { path, stopped, recorder })
}

impl Simulation<'_> {
    /// The record of it; the observer hears of the fields of its end, if they are due.
    pub fn outcome(self, observer: &mut Watcher<'_>) -> Outcome {
        self.recorder.finish(&self.path, self.stopped, observer)
    }
}

/// The path after the peak: the stiffness there, and unloading and reloading as often as the problem asks.
fn unload_and_reload(
    problem: &Problem,
    path: &mut Path<'_>,
    recorder: &mut Recorder<'_>,
    observer: &mut Watcher<'_>,
) -> Result<(), Stop> {
    for cycle in 0..=problem.reloads {
        if cycle > 0 {
            path.reload(problem.goal, &mut |model, increment| recorder.record(model, increment, observer))?;
        }
        let peak = recorder.increments();
        let stiffness = match path.model.unloading_stiffness() {
            Ok(stiffness) => stiffness,
            Err(_) if problem.unload => return Err(Stop::NoEquilibrium),
            Err(_) => return Ok(()),
        };
        recorder.note_stiffness(problem.rules.whole_stiffness(stiffness.depth, path.area()));
        if problem.unload {
            path.unload(stiffness, problem.numbers.unload_steps, &mut |model, increment| {
                recorder.record(model, increment, observer)
            })?;
            recorder.note_turn(peak);
        }
    }
    Ok(())
}
