//! A sweep over its cases: one thread a case, every finished case told at once, rows in the order of the grid.

use crate::case::Case;
use crate::loading_curvature;
use crate::row::Row;
use crate::sweep::Sweep;
use asperity_solver::scene::Accuracy;
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// Solves one case; a case that fails is a row too.
pub fn solve(case: &Case, accuracy: Accuracy) -> Row {
    let clock = Instant::now();
    let outcome = loading_curvature::solve(case, &case.discretisation(accuracy)).map_err(|e| e.to_string());
    Row { case: *case, outcome, wall_s: clock.elapsed().as_secs_f64() }
}

/// All that the rows of `cases` depend on: the sweep, the discretisation of every case, and the program.
pub fn definition(sweep: &Sweep, cases: &[Case]) -> String {
    let resolutions: Vec<_> = cases.iter().map(|c| c.discretisation(sweep.accuracy)).collect();
    format!("{} {sweep:?} {resolutions:?}", env!("CARGO_PKG_VERSION"))
}

/// The part `k` of `of` (k from 1): every `of`-th case, so that the parts take about equally long.
pub fn shard(cases: &[Case], k: usize, of: usize) -> Vec<Case> {
    cases.iter().skip(k - 1).step_by(of).copied().collect()
}

/// Solves all `cases` that are not in `done` and returns the rows of all in their order. Cases that are equal in every
/// dimensionless group are solved once.
///
/// `finished` is called with each new row, from the thread that solved it, on `threads` threads (0: all cores).
///
/// # Errors
/// The first error of `finished`: no further case is begun then.
pub fn run<E: Send>(
    cases: &[Case],
    accuracy: Accuracy,
    done: Vec<Row>,
    threads: usize,
    finished: impl Fn(&Row) -> Result<(), E> + Sync,
) -> Result<Vec<Row>, E> {
    let mut rows: HashMap<String, Row> = done.into_iter().map(|row| (Row::key(&row.case), row)).collect();
    let mut seen = HashSet::new();
    let open: Vec<&Case> = cases
        .iter()
        .filter(|case| !rows.contains_key(&Row::key(case)) && seen.insert(Row::key(case)))
        .collect();
    let stop = AtomicBool::new(false);
    let work = || {
        open.par_iter()
            .with_max_len(1)
            .map(|case| {
                if stop.load(Ordering::Relaxed) {
                    return Ok(None);
                }
                let row = solve(case, accuracy);
                finished(&row).map(|()| Some(row)).inspect_err(|_| stop.store(true, Ordering::Relaxed))
            })
            .collect::<Vec<Result<Option<Row>, E>>>()
    };
    let outcomes = match rayon::ThreadPoolBuilder::new().num_threads(threads).build() {
        Ok(pool) => pool.install(work),
        // no threads of our own to be had: those of the process
        Err(_) => work(),
    };
    for outcome in outcomes {
        if let Some(row) = outcome? {
            rows.insert(Row::key(&row.case), row);
        }
    }
    Ok(cases
        .iter()
        .filter_map(|case| rows.get(&Row::key(case)).map(|row| Row { case: *case, ..row.clone() }))
        .collect())
}
