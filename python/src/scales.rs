//! The scales of a surface.

use crate::error::raised;
use crate::press::{Map, scenes_of};
use crate::table::{of_json, of_rows};
use crate::work;
use asperity::output::Directory;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

/// The scales of a surface.
#[pyclass(module = "asperity", frozen)]
#[derive(Debug)]
pub struct Scales {
    inner: asperity::Scales,
}

/// Presses a surface at every scale; more maps are repeated measurements of it.
#[pyfunction]
#[pyo3(signature = (maps, threads=0, out=None, progress=None))]
pub fn scales(
    py: Python<'_>,
    maps: Vec<Map<'_>>,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Scales> {
    let scenes = scenes_of(maps)?;
    let result = work::run(py, threads, progress, |tell| {
        asperity::scales::scales(&scenes, &mut |reached| {
            tell(
                reached.share,
                reached.news.map_or(String::new(), |p| format!("waves from {:.4} um", p * 1e6)),
            )
        })
    })?;
    let scales = Scales { inner: result.map_err(raised)? };
    out.map_or(Ok(()), |folder| scales.save(&folder))?;
    Ok(scales)
}

impl Scales {
    fn save(&self, folder: &Path) -> PyResult<()> {
        let mut folder = Directory::create(folder).map_err(raised)?;
        self.inner.write(&mut folder).map_err(raised)
    }
}

#[pymethods]
impl Scales {
    fn table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        of_rows(py, &self.inner.rows)
    }

    fn slopes<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        of_rows(py, &self.inner.slopes)
    }

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_json(py, &self.inner.json().map_err(raised)?)
    }

    fn text(&self) -> String {
        self.inner.text()
    }

    fn report(&self) -> PyResult<String> {
        self.inner.report().map_err(raised)
    }

    fn write(&self, folder: PathBuf) -> PyResult<()> {
        self.save(&folder)
    }
}
