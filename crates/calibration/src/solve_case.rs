//! One case of a sweep from its cone to its row.

use crate::case::Case;
use crate::loading_curvature;
use crate::row::Row;
use crate::sweep::Sweep;
use asperity_simulation::scene::Accuracy;
use asperity_solver::body::analysis::Analyses;
use std::time::Instant;

/// Solves one case; a case that fails is a row too. The cases of a sweep share `analyses` of their meshes:
/// see [`Analyses`].
pub fn solve(case: &Case, accuracy: Accuracy, analyses: &Analyses) -> Row {
    let clock = Instant::now();
    let outcome =
        loading_curvature::solve(case, &case.discretisation(accuracy), analyses).map_err(|e| e.to_string());
    Row { case: *case, outcome, wall_s: clock.elapsed().as_secs_f64() }
}

/// All that the rows of `cases` depend on: the sweep, the discretisation of every case, and the program.
pub fn definition(sweep: &Sweep, cases: &[Case]) -> String {
    let resolutions: Vec<_> = cases.iter().map(|c| c.discretisation(sweep.accuracy)).collect();
    format!("{} {sweep:?} {resolutions:?}", env!("CARGO_PKG_VERSION"))
}
