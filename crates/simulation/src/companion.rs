//! The run beside a run that reveals its errors, with numbers half as good.

use crate::load_history::ready;
use crate::load_path::Stop;
use crate::record::outcome::{Outcome, Watcher};
use crate::scene::{Scene, Target};
use crate::setup::discretisation::Discretisation;
use crate::setup::prepare::Expected;
use crate::setup::problem::{Goal, Problem};
use crate::setup::units::Units;
use crate::simulate::{CrushError, simulate};
use asperity_mesh::Mesh;
use asperity_solver::body::analysis::Analyses;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// The problem of the companion of a run of `scene` with `numbers`. An imported mesh, which cannot be made
/// coarser, gives its nodes to the `other` element. `None` if it does not even begin.
pub(super) fn companion(
    scene: &Scene,
    numbers: Discretisation,
    other: Option<Mesh>,
    expected: &Expected,
    shared: (Units, &Analyses),
) -> Option<Problem> {
    let problem = ready(scene, numbers.coarser(), other, expected, shared).ok()?;
    Some(Problem { reloads: 0, ..problem })
}

/// The outcome of `main`, a run of `scene`, and that of its `companion` as far as the two can be compared.
/// A run that ended early, or was looking for a force, is compared as far as it came; one that the user
/// ended is not.
///
/// # Errors
/// Those of `main`.
pub(super) fn run_beside(
    companion: Option<Problem>,
    target: Target,
    analyses: &Analyses,
    mut main: impl FnMut() -> Result<Outcome, CrushError>,
) -> Result<(Outcome, Option<Outcome>), CrushError> {
    let asks_for_depth = matches!(target, Target::Depth(_));
    let (outcome, ahead) = match companion.as_ref().filter(|_| asks_for_depth) {
        Some(companion) => run_both(&mut main, companion, analyses)?,
        None => (main()?, None),
    };
    let compared = match (ahead, outcome.stopped.as_ref().map(|stopped| stopped.reason)) {
        (_, Some(Stop::Interrupted)) => None,
        (Some(ahead), None) => Some(ahead),
        _ => companion.and_then(|mut companion| {
            companion.goal = Goal::Depth(outcome.summary.peak_depth / companion.units.length);
            companion.unload &= outcome.summary.residual_depth.is_some();
            unobserved(&companion, analyses, &|| true)
        }),
    };
    Ok((outcome, compared))
}

/// Outcome of `problem`, as long as `goes_on`; `None` if it does not begin.
fn unobserved(problem: &Problem, analyses: &Analyses, goes_on: &dyn Fn() -> bool) -> Option<Outcome> {
    let observer: &mut Watcher<'_> =
        &mut |_| if goes_on() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
    simulate(problem, analyses, 0, observer).ok().map(|simulation| simulation.outcome(observer))
}

/// Runs `main` and its `companion`, on two threads where there are two. The bits do not depend on that.
fn run_both(
    main: &mut dyn FnMut() -> Result<Outcome, CrushError>,
    companion: &Problem,
    analyses: &Analyses,
) -> Result<(Outcome, Option<Outcome>), CrushError> {
    let ended = AtomicBool::new(false);
    let mut ahead = None;
    let mut main = || {
        let outcome = main();
        ended.store(!matches!(&outcome, Ok(Outcome { stopped: None, .. })), Ordering::Relaxed);
        outcome
    };
    let mut follow = || ahead = unobserved(companion, analyses, &|| !ended.load(Ordering::Relaxed));
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
