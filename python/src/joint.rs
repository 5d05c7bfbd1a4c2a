//! The law of a joint.

use crate::error::raised;
use crate::press::{Map, scenes_of};
use crate::table::{of_json, of_rows};
use crate::work;
use asperity::output::Directory;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

/// The law of a joint.
#[pyclass(module = "asperity", frozen)]
#[derive(Debug)]
pub struct Joint {
    inner: asperity::Joint,
}

/// Presses maps of one surface from first touch to their largest load and back.
#[pyfunction]
#[pyo3(signature = (maps, threads=0, out=None, progress=None))]
pub fn joint(
    py: Python<'_>,
    maps: Vec<Map<'_>>,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Joint> {
    let scenes = scenes_of(maps)?;
    let result = work::run(py, threads, progress, |tell| {
        asperity::joint::joint(&scenes, &mut |reached| {
            tell(reached.share, reached.news.map_or(String::new(), |p| format!("{:.4} MPa", p * 1e-6)))
        })
    })?;
    let joint = Joint { inner: result.map_err(raised)? };
    out.map_or(Ok(()), |folder| joint.save(&folder))?;
    Ok(joint)
}

impl Joint {
    fn save(&self, folder: &Path) -> PyResult<()> {
        let mut folder = Directory::create(folder).map_err(raised)?;
        self.inner.write(&mut folder).map_err(raised)
    }
}

#[pymethods]
impl Joint {
    fn table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        of_rows(py, &self.inner.rows)
    }

    fn law<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        of_rows(py, &self.inner.summary.law)
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
