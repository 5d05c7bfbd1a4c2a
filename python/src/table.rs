//! Rows of the files as arrays by the names of their columns, JSON as dictionaries.

use crate::error::raised;
use asperity::Error;
use asperity::output::write_csv;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use serde_json::Value;
use std::fmt::Display;

/// Columns that count.
const COUNTS: [&str; 10] = [
    "increment",
    "newton_iterations",
    "increments",
    "asperity",
    "asperities",
    "cycle",
    "peak_increment",
    "end_increment",
    "dofs",
    "yielded",
];

fn unfinished(error: impl Display) -> PyErr {
    raised(Error::Unfinished(error.to_string()))
}

/// A CSV file as a dictionary of arrays: numbers as float64 with NaN for empty cells, counts as int64, the rest as text.
pub fn of_csv<'py>(py: Python<'py>, text: &[u8]) -> PyResult<Bound<'py, PyDict>> {
    let mut table = csv::Reader::from_reader(text);
    let names: Vec<String> = table.headers().map_err(unfinished)?.iter().map(str::to_string).collect();
    let rows: Vec<csv::StringRecord> = table.records().collect::<Result<_, _>>().map_err(unfinished)?;
    let columns = PyDict::new(py);
    for (i, name) in names.iter().enumerate() {
        let cells = || rows.iter().map(move |row| &row[i]);
        let number = |cell: &str| if cell.is_empty() { Some(f64::NAN) } else { cell.parse().ok() };
        let counts: Option<Vec<i64>> = cells().map(|cell| cell.parse().ok()).collect();
        let numbers: Option<Vec<f64>> = cells().map(number).collect();
        match (counts.filter(|_| COUNTS.contains(&name.as_str())), numbers) {
            (Some(counts), _) => columns.set_item(name, PyArray1::from_vec(py, counts))?,
            (None, Some(numbers)) => columns.set_item(name, PyArray1::from_vec(py, numbers))?,
            (None, None) => columns.set_item(name, cells().collect::<Vec<&str>>())?,
        }
    }
    Ok(columns)
}

/// Rows as a dictionary of arrays.
pub fn of_rows<'py, T: Serialize>(py: Python<'py>, rows: &[T]) -> PyResult<Bound<'py, PyDict>> {
    let mut text = Vec::new();
    write_csv(&mut text, rows).map_err(unfinished)?;
    of_csv(py, &text)
}

/// A value as Python has it.
pub fn of_json<'py>(py: Python<'py>, text: &str) -> PyResult<Bound<'py, PyAny>> {
    py.import("json")?.call_method1("loads", (text,))
}

/// A value of Python as JSON; tables are dictionaries, arrays of numpy are lists.
pub fn to_json(value: &Bound<'_, PyAny>) -> PyResult<Value> {
    let text: String =
        value.py().import("asperity._results")?.call_method1("as_json", (value,))?.extract()?;
    serde_json::from_str(&text).map_err(unfinished)
}

/// Numbers as an array of so many columns.
pub fn matrix<'py>(py: Python<'py>, values: Vec<f64>, columns: usize) -> PyResult<Bound<'py, PyAny>> {
    let rows = values.len() / columns.max(1);
    Ok(PyArray1::from_vec(py, values).reshape([rows, columns])?.into_any())
}
