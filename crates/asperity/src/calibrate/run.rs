//! The cases of a sweep that its journal does not hold yet, solved.

use crate::error::Error;
use crate::output::open_journal;
use asperity_calibration::row::{CaseRow, Row};
use asperity_calibration::run::{definition, run, shard};
use asperity_calibration::sweep::Sweep;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// How a sweep is run; its results do not depend on it.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Threads, 0: all cores.
    pub threads: usize,
    /// Solve only part k of n (k from 1).
    pub part: Option<(usize, usize)>,
    /// File that keeps finished cases: a run that was stopped resumes from it.
    pub journal: Option<PathBuf>,
    /// Slope in degrees that collapse.svg shows; the largest where there is none.
    pub shown_slope_deg: Option<f64>,
}

/// How far a sweep has come.
#[derive(Clone, Debug, PartialEq)]
pub struct Progress {
    /// Cases that are done.
    pub done: usize,
    /// Cases in all.
    pub cases: usize,
    /// The case that has just been solved; none at the beginning, when `done` counts those of the journal.
    pub row: Option<CaseRow>,
}

/// Asked after every case; `false` ends the run.
pub(super) type Observer<'a> = dyn FnMut(&Progress) -> bool + Send + 'a;

/// The rows of a sweep, in the order of its grid.
pub(super) struct Solved {
    pub rows: Vec<Row>,
    /// Whether the observer ended the run before all cases were done.
    pub stopped: bool,
}

/// Why no further case is begun.
enum Stop {
    Observer,
    Disk(std::io::Error),
}

/// Solves the cases that the journal does not hold yet.
pub(super) fn solve(sweep: &Sweep, options: &Options, observer: &mut Observer) -> Result<Solved, Error> {
    let all = sweep.cases();
    let cases = options.part.map_or_else(|| all.clone(), |(k, n)| shard(&all, k, n));
    let (journal, lines) = open_journal(options.journal.as_deref(), &definition(sweep, &cases))?;
    let found = Row::of_cases(&cases, lines.iter().filter_map(|line| CaseRow::of_line(line)));
    let done = found.len();
    if !observer(&Progress { done, cases: cases.len(), row: None }) {
        return Ok(Solved { rows: found, stopped: true });
    }
    let finished = found.clone();
    let state = Mutex::new((journal, observer, finished));
    let told = |row: &Row| {
        let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
        let (journal, observer, finished) = &mut *state;
        let record = CaseRow::from(row);
        if let Some(journal) = journal {
            journal.append(&record.line()).map_err(Stop::Disk)?;
        }
        finished.push(row.clone());
        let progress = Progress { done: finished.len(), cases: cases.len(), row: Some(record) };
        if observer(&progress) { Ok(()) } else { Err(Stop::Observer) }
    };
    let outcome = run(&cases, sweep.accuracy, found, options.threads, told);
    match outcome {
        Ok(rows) => Ok(Solved { rows, stopped: false }),
        Err(Stop::Observer) => {
            let (_, _, finished) = state.into_inner().unwrap_or_else(PoisonError::into_inner);
            Ok(Solved { rows: Row::of_cases(&cases, finished.iter().map(CaseRow::from)), stopped: true })
        }
        Err(Stop::Disk(e)) => {
            let path = options.journal.clone().unwrap_or_default();
            Err(Error::Unfinished(format!(
                "cannot write the journal {}: {e}; it keeps every finished case, and the same command resumes from it",
                path.display()
            )))
        }
    }
}
