//! The sweep of cones and its fit.

use crate::error::raised;
use crate::scene::toml_of;
use crate::table::{of_json, of_rows};
use crate::work;
use asperity::Sweep;
use asperity::calibrate::Options;
use asperity::input::toml_file::TomlFile;
use asperity::output::Directory;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

/// Rows, fit, the text of coefficient.toml, the text for a person, the report.
type Calibrated<'py> = (Bound<'py, PyDict>, Bound<'py, PyAny>, Option<String>, String, String);

/// Crushes the cones of a sweep and fits them.
#[pyfunction]
#[pyo3(signature = (tables=None, threads=0, out=None, progress=None))]
pub fn calibrate<'py>(
    py: Python<'py>,
    tables: Option<&Bound<'py, PyDict>>,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Calibrated<'py>> {
    let text = format!("# a sweep\n{}", toml_of(tables)?);
    let file: TomlFile<Sweep> = TomlFile::parse(Path::new("sweep"), text, &[]).map_err(raised)?;
    file.value.validate().map_err(|e| raised(file.error_at(&e.path, &e.message)))?;
    let options = Options { threads, ..Options::default() };
    let result = work::run(py, 0, progress, |tell| {
        asperity::calibrate(&file.value, &options, &mut |reached| {
            tell(reached.share, format!("case {} of {}", reached.done, reached.all))
        })
    })?;
    let done = result.map_err(raised)?;
    if let Some(folder) = out {
        done.write(&mut Directory::create(&folder).map_err(raised)?).map_err(raised)?;
    }
    let coefficient = done.coefficient.as_ref().and_then(|c| c.to_toml().ok());
    let fit = of_json(py, &done.json().map_err(raised)?)?;
    Ok((of_rows(py, &done.cases)?, fit, coefficient, done.text(), done.report().map_err(raised)?))
}
