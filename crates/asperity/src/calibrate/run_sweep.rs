//! The cases of a sweep that its journal does not hold yet, solved.

use crate::batch::{self, Batch, Shard};
use crate::error::Error;
use crate::progress::{Observer, Progress};
use asperity_calibration::case::Case;
use asperity_calibration::row::{CaseRow, Row};
use asperity_calibration::solve_case::{definition, solve as solve_case};
use asperity_calibration::sweep::Sweep;
use asperity_solver::body::analysis::Analyses;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The way a sweep is run; its results do not depend on it.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Threads, 0: all cores.
    pub threads: usize,
    /// Solve only a part of the cases.
    pub part: Option<Shard>,
    /// File that keeps finished cases: a run that was stopped resumes from it.
    pub journal: Option<PathBuf>,
    /// Slope in degrees that collapse.svg shows; the largest where there is none.
    pub shown_slope_deg: Option<f64>,
}

/// The rows of a sweep, in the order of its grid.
pub struct Solved {
    /// One row a case that was solved.
    pub rows: Vec<Row>,
    /// True where the observer ended the run before all cases were done.
    pub stopped: bool,
}

/// A row as the journal has it: a line of cases.csv.
#[derive(Clone, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
struct Kept(CaseRow);

impl From<Kept> for String {
    fn from(kept: Kept) -> String {
        kept.0.line()
    }
}

impl TryFrom<String> for Kept {
    type Error = String;

    fn try_from(line: String) -> Result<Kept, String> {
        CaseRow::of_line(&line).map(Kept).ok_or_else(|| format!("no row: {line}"))
    }
}

/// Solves the cases that the journal does not hold yet.
pub fn solve(
    sweep: &Sweep,
    options: &Options,
    observer: &mut Observer<'_, CaseRow>,
) -> Result<Solved, Error> {
    let all = sweep.cases();
    let cases: Vec<Case> = Shard::case_numbers(options.part, all.len()).map(|i| all[i]).collect();
    // its meshes are of few topologies
    let analyses = Analyses::for_threads(batch::thread_count(options.threads));
    let batch = Batch {
        definition: &definition(sweep, &cases),
        cases: &cases,
        key: &Row::key,
        solve: &|case: &Case, _: &dyn Fn() -> bool| {
            Some(Kept(CaseRow::from(&solve_case(case, sweep.accuracy, &analyses))))
        },
        threads: options.threads,
        journal: options.journal.as_deref(),
    };
    let finished = batch::run(&batch, &mut |reached: &Progress<'_, Kept>| {
        observer(&reached.telling(reached.news.map(|kept| &kept.0)))
    })?;
    let rows = Row::of_cases(&cases, finished.rows.into_iter().map(|(_, kept)| kept.0));
    Ok(Solved { rows, stopped: finished.stopped })
}
