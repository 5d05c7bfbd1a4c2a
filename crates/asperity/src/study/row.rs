//! One run of a study, and the two tables of all of them.

use crate::crush::peak_memory;
use crate::error::Error;
use crate::results::numbers::if_any;
use indexmap::{IndexMap, IndexSet};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::HashSet;

/// Results by the name of their column: numbers and truth values.
pub type Columns = IndexMap<String, Value>;

/// The outcome of one run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Outcome {
    pub results: Columns,
    pub status: String,
    pub wall_s: f64,
    pub peak_memory_mb: Option<f64>,
    /// Text of its curve, then the name of the file that holds it.
    pub curve: Option<String>,
}

impl Outcome {
    pub fn new(results: Columns, status: String) -> Outcome {
        let status = status.replace(['\n', '\r'], " ");
        let peak_memory_mb = peak_memory().map(|bytes| bytes / 1e6);
        Outcome { results, status, wall_s: 0.0, peak_memory_mb, curve: None }
    }
}

/// One run of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// The varied keys' values, as the scene has them.
    pub values: Vec<String>,
    /// Every number of the run's summary; null is what it was not asked for or did not reach.
    pub results: Columns,
    /// `ok`, or why it has no result or not the whole one.
    pub status: String,
    /// Seconds that it took.
    pub wall_s: f64,
    /// Largest resident memory of the process until its end, MB of 10⁶ bytes.
    pub peak_memory_mb: Option<f64>,
    /// File of its curve, relative to the results, where curves are kept.
    pub curve: Option<String>,
}

impl Run {
    pub(super) fn new(values: Vec<String>, outcome: Outcome) -> Run {
        let Outcome { results, status, wall_s, peak_memory_mb, curve } = outcome;
        Run { values, results, status, wall_s, peak_memory_mb, curve }
    }

    /// True where the run reached its end.
    pub fn ok(&self) -> bool {
        self.status == "ok"
    }

    /// A result as a number.
    pub fn number(&self, column: &str) -> Option<f64> {
        self.results.get(column)?.as_f64()
    }
}

/// Values that differ from machine to machine and stand in times.csv, and those that are no result.
const LEFT_OUT: [&str; 4] = ["wall_s", "peak_memory_MB", "scene", "definitions"];

/// Every number of a summary by its name, those of its tables behind their names and a point.
pub(super) fn flat<T: Serialize>(summary: &T) -> Result<Columns, Error> {
    let mut columns = Columns::new();
    let entries = json(summary)?;
    for (name, value) in entries.into_iter().filter(|(name, _)| !LEFT_OUT.contains(&name.as_str())) {
        gather(&name, value, &mut columns);
    }
    Ok(columns)
}

/// The scalars of anything that is written as JSON.
fn json<T: Serialize>(value: &T) -> Result<IndexMap<String, Value>, Error> {
    let text = serde_json::to_string(value).map_err(|e| Error::Unfinished(e.to_string()))?;
    serde_json::from_str(&text).map_err(|e| Error::Unfinished(e.to_string()))
}

fn gather(name: &str, value: Value, columns: &mut Columns) {
    match value {
        // a number that is not known keeps its column
        Value::Number(_) | Value::Bool(_) | Value::Null => {
            columns.insert(name.into(), value);
        }
        Value::Object(table) => {
            table.into_iter().for_each(|(key, value)| gather(&format!("{name}.{key}"), value, columns));
        }
        _ => {}
    }
}

/// The columns that any of the runs has, in the order in which they appear.
pub(super) fn columns(runs: &[Run]) -> IndexSet<&str> {
    let mut columns: IndexSet<&str> =
        runs.iter().flat_map(|run| run.results.keys().map(String::as_str)).collect();
    // a table that some runs lack has columns of its own in the others
    let tables: HashSet<&str> = columns.iter().filter_map(|name| Some(name.rsplit_once('.')?.0)).collect();
    columns.retain(|name| !tables.contains(name));
    columns
}

/// The text of `results.csv`, the same bytes from the command and from Python.
pub(super) fn results(keys: &[String], runs: &[Run]) -> csv::Result<String> {
    let columns = columns(runs);
    let curves = runs.iter().any(|run| run.curve.is_some());
    let last = |status: &str, curve: &str| {
        [status, curve].into_iter().take(1 + usize::from(curves)).map(str::to_string).collect::<Vec<_>>()
    };
    let head = keys.iter().cloned().chain(columns.iter().map(|name| name.to_string()));
    let rows = runs.iter().map(|run| {
        let results =
            columns.iter().map(|name| if_any(run.results.get(*name).filter(|value| !value.is_null())));
        let last = last(&run.status, run.curve.as_deref().unwrap_or_default());
        run.values.iter().cloned().chain(results).chain(last).collect()
    });
    table(head.chain(last("status", "curve")).collect(), rows)
}

/// The text of `times.csv`.
pub(super) fn times(keys: &[String], runs: &[Run]) -> csv::Result<String> {
    let head = keys.iter().cloned().chain(["wall_s", "peak_memory_MB"].map(str::to_string));
    let rows = runs.iter().map(|run| {
        let memory = if_any(run.peak_memory_mb);
        run.values.iter().cloned().chain([run.wall_s.to_string(), memory]).collect()
    });
    table(head.collect(), rows)
}

fn table(head: Vec<String>, rows: impl Iterator<Item = Vec<String>>) -> csv::Result<String> {
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(&head)?;
    for row in rows {
        table.write_record(&row)?;
    }
    let bytes = table.into_inner().map_err(|e| e.into_error())?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}
