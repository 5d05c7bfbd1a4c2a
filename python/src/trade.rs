//! The price of accuracy on a scene.

use crate::error::raised;
use crate::scene::Scene;
use crate::table::of_rows;
use crate::work;
use asperity::output::Directory;
use asperity::trade::Options;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// Runs a scene at many settings: rows, relative uncertainty of the converged force, the text for a person.
#[pyfunction]
#[pyo3(signature = (scene, combinations=30, threads=0, out=None, progress=None))]
pub fn trade<'py>(
    py: Python<'py>,
    scene: &Scene,
    combinations: usize,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(Bound<'py, PyDict>, Option<f64>, String)> {
    let tables = scene.inner.tables();
    let result = work::run(py, threads, progress, |tell| {
        let options = Options { combinations, ..Options::default() };
        asperity::trade::trade(tables, &options, &mut |reached| {
            tell(reached.share, format!("{} settings", reached.done))
        })
    })?;
    let done = result.map_err(raised)?;
    if let Some(folder) = out {
        done.write(&mut Directory::create(&folder).map_err(raised)?).map_err(raised)?;
    }
    Ok((of_rows(py, &done.rows)?, done.converged_to, done.text()))
}
