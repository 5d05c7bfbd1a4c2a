//! One crush from a scene to its records: the entry point of the solver.

use crate::depth_for_force::expect;
use crate::error_estimate::{Setting, extrapolate_and_bound, rescale_to_force};
use crate::load_history::ready;
use crate::load_path::Stop;
use crate::record::oliver_pharr::as_an_instrument;
use crate::scene::{Scene, Target};
use crate::setup::discretisation::Discretisation;
use crate::setup::prepare::Expected;
use crate::setup::problem::{Goal, Problem};
use crate::simulate::simulate;
use asperity_mesh::Mesh;
use asperity_solver::point::material::Metal;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

pub use crate::record::recorder::{Event, FieldFrame, Outcome, Stopped, Watcher};
pub use crate::simulate::CrushError;

/// Runs `scene`. `mesh` (in metres) replaces the mesh that would be built.
///
/// The observer hears of every increment, and of fields every `output.every` increments and at the peak and the end
/// (if `output.every` is not 0); it ends the run by breaking.
///
/// # Errors
/// Only if the run cannot begin: what stops it later is in the outcome, with all that was reached.
pub fn run(scene: &Scene, mesh: Option<Mesh>, observer: &mut Watcher<'_>) -> Result<Outcome, CrushError> {
    crush(scene, mesh, None, observer)
}

/// [`run`] of a metal that the keys of a scene cannot say: `metal` (E = 1, that of the scene is its unit) takes the place of the
/// scene's in the run and in its companion, while the mesh and the penalty are laid out for the scene's.
///
/// # Errors
/// As for [`run`].
pub fn run_of(scene: &Scene, metal: &Metal, observer: &mut Watcher<'_>) -> Result<Outcome, CrushError> {
    crush(scene, None, Some(metal), observer)
}

fn crush(
    scene: &Scene,
    mesh: Option<Mesh>,
    metal: Option<&Metal>,
    observer: &mut Watcher<'_>,
) -> Result<Outcome, CrushError> {
    scene.validate()?;
    let expected = expect(scene, mesh.as_ref())?;
    let other = mesh.as_ref().map(Mesh::with_other_element);
    let same_mesh = other.is_some();
    let numbers = Discretisation::new(scene);
    let of_metal = |problem: Problem| match metal {
        Some(metal) => Problem { metal: metal.clone(), ..problem },
        None => problem,
    };
    let problem = of_metal(ready(scene, numbers, mesh, &expected)?);
    let target = scene.loading.target()?;
    let companion = companion(scene, numbers, other, &expected).map(of_metal);
    let asks_for_depth = matches!(target, Target::Depth(_));
    let mut main = || simulate(&problem, scene.output.interval(), observer);
    let (mut outcome, ahead) = match companion.as_ref().filter(|_| asks_for_depth) {
        Some(companion) => simulate_both(&mut main, companion)?,
        None => (main()?, None),
    };
    let interrupted = outcome.stopped.as_ref().is_some_and(|s| s.reason == Stop::Interrupted);
    // what ended early, or was looking for a force, is compared as far as it came
    let compared = match (ahead, &outcome.stopped) {
        _ if interrupted => None,
        (Some(ahead), None) => Some(ahead),
        _ => companion.and_then(|mut companion| {
            companion.goal = Goal::Depth(outcome.summary.peak_depth / companion.units.length);
            companion.unload &= outcome.summary.residual_depth.is_some();
            simulate(&companion, 0, &mut |_| ControlFlow::Continue(())).ok()
        }),
    };
    if let Some(companion) = compared {
        let Discretisation { element, penetration, steps, .. } = numbers;
        let setting = Setting { symmetry: scene.symmetry, element, penetration, steps, same_mesh };
        extrapolate_and_bound(&mut outcome, &companion, setting);
    }
    if let (Target::Force(force), None) = (target, &outcome.stopped) {
        rescale_to_force(&mut outcome, force, scene.symmetry);
    }
    // of the force and the depth that are stated
    outcome.summary.oliver_pharr =
        as_an_instrument(&problem, scene.tool.area_function.as_ref(), &outcome.summary);
    Ok(outcome)
}

/// The run that reveals the errors of another: with numbers half as good. An imported mesh, which cannot be made coarser, gives its
/// nodes to the `other` element. `None` if it does not even begin.
fn companion(
    scene: &Scene,
    numbers: Discretisation,
    other: Option<Mesh>,
    expected: &Expected,
) -> Option<Problem> {
    let problem = ready(scene, numbers.coarser(), other, expected).ok()?;
    Some(Problem { reloads: 0, ..problem })
}

/// Runs `main` and its `companion`, on two threads where there are two. The bits do not depend on that.
fn simulate_both(
    main: &mut dyn FnMut() -> Result<Outcome, CrushError>,
    companion: &Problem,
) -> Result<(Outcome, Option<Outcome>), CrushError> {
    let ended = AtomicBool::new(false);
    let mut ahead = None;
    let mut main = || {
        let outcome = main();
        ended.store(!matches!(&outcome, Ok(Outcome { stopped: None, .. })), Ordering::Relaxed);
        outcome
    };
    let mut follow = || {
        let go_on =
            || if ended.load(Ordering::Relaxed) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        ahead = simulate(companion, 0, &mut |_| go_on()).ok();
    };
    let outcome = if rayon::current_num_threads() > 1 {
        rayon::in_place_scope(|scope| {
            scope.spawn(|_| follow());
            main()
        })?
    } else {
        let outcome = main()?;
        follow();
        outcome
    };
    Ok((outcome, ahead))
}
