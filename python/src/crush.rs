//! One scene crushed.

use crate::error::{raised, wrong};
use crate::scene::Scene;
use crate::table::{matrix, of_csv, of_json};
use crate::work;
use asperity::columns::{Described, Unit, write_rows};
use asperity::crush::Sketch;
use asperity::mesh::FieldArray;
use asperity::output::Directory;
use asperity::tables::Symmetry;
use asperity::units::MICROMETRE;
use numpy::PyArray1;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde::Serialize;
use std::path::{Path, PathBuf};

/// The result of a crush.
#[pyclass(module = "asperity", frozen)]
#[derive(Debug)]
pub struct Crush {
    inner: asperity::Crush,
}

/// Crushes a scene; an exception that ends the run has what was reached as `partial`.
#[pyfunction]
#[pyo3(signature = (scene, accuracy=None, threads=0, out=None, progress=None))]
pub fn crush(
    py: Python<'_>,
    scene: &Scene,
    accuracy: Option<&str>,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Crush> {
    let changed =
        accuracy.map(|level| scene.inner.with(&[format!("accuracy={level}")])).transpose().map_err(raised)?;
    let scene = changed.as_ref().unwrap_or(&scene.inner);
    let symmetry = scene.tables().symmetry;
    let (result, raised_meanwhile) = work::run_to_end(py, threads, progress, |tell| {
        asperity::crush(scene, &mut |reached| {
            let [depth, force] = reached.news.map_or([0.0; 2], |news| {
                [news.row.depth / MICROMETRE, news.row.force / Unit::Force.value(symmetry)]
            });
            tell(reached.share, format!("{depth:.4} um, {force:.4} N"))
        })
    })?;
    let inner = result.map_err(raised)?;
    let crush = Crush { inner };
    let written = out.map_or(Ok(()), |folder| crush.write(&folder));
    let Some(error) = raised_meanwhile else { return written.map(|()| crush) };
    error.value(py).setattr("partial", Py::new(py, crush)?)?;
    Err(error)
}

impl Crush {
    fn symmetry(&self) -> Symmetry {
        self.inner.summary.scene.symmetry
    }

    fn rows<'py, T: Described + Serialize>(
        &self,
        py: Python<'py>,
        rows: &[T],
    ) -> PyResult<Bound<'py, PyDict>> {
        if rows.is_empty() {
            return Ok(PyDict::new(py));
        }
        let mut text = Vec::new();
        write_rows(&mut text, rows, self.symmetry()).map_err(|e| wrong(e.to_string()))?;
        of_csv(py, &text)
    }

    fn write(&self, folder: &Path) -> PyResult<()> {
        let mut folder = Directory::create(folder).map_err(raised)?;
        self.inner.write(&mut folder).map_err(raised)
    }
}

fn arrays<'py>(py: Python<'py>, arrays: &[FieldArray]) -> PyResult<Bound<'py, PyDict>> {
    let found = PyDict::new(py);
    for array in arrays {
        match array.components {
            1 => found.set_item(&array.name, PyArray1::from_slice(py, &array.values))?,
            n => found.set_item(&array.name, matrix(py, array.values.clone(), n)?)?,
        }
    }
    Ok(found)
}

#[pymethods]
impl Crush {
    #[pyo3(name = "curve")]
    fn curve_table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.rows(py, &self.inner.curve)
    }

    fn asperities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.rows(py, &self.inner.asperities)
    }

    fn gaps<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.rows(py, &self.inner.gaps)
    }

    fn cycles<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        self.rows(py, &self.inner.cycles)
    }

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_json(py, &self.inner.summary.to_json().map_err(raised)?)
    }

    fn warnings(&self) -> Vec<String> {
        self.inner.summary.warnings()
    }

    fn frames(&self) -> usize {
        self.inner.frames.len()
    }

    /// Increment, phase, nodes in µm, cells, arrays over nodes, arrays over cells, the surface.
    #[allow(clippy::type_complexity, reason = "taken apart at once by the class in Python")]
    fn frame<'py>(
        &self,
        py: Python<'py>,
        i: usize,
    ) -> PyResult<(
        usize,
        &'static str,
        Bound<'py, PyAny>,
        Bound<'py, PyAny>,
        Bound<'py, PyDict>,
        Bound<'py, PyDict>,
        Bound<'py, PyDict>,
    )> {
        let frame = self.inner.frames.get(i).ok_or_else(|| wrong(format!("there are no fields {i}")))?;
        let mesh = &frame.mesh;
        let nodes = mesh.nodes.iter().flatten().map(|x| x / MICROMETRE).collect();
        let cells = mesh.cells.iter().map(|node| f64::from(*node)).collect();
        Ok((
            frame.increment,
            if frame.phase.advances() { "load" } else { "unload" },
            matrix(py, nodes, 2)?,
            matrix(py, cells, mesh.kind.nodes())?,
            arrays(py, &frame.nodes)?,
            arrays(py, &frame.cells)?,
            self.rows(py, &frame.surface)?,
        ))
    }

    fn plot_svg(&self) -> PyResult<String> {
        asperity::crush::titled_plot(&self.inner.summary, &self.inner.curve).map_err(wrong)
    }

    fn section_svg(&self) -> PyResult<Option<String>> {
        self.inner.section(&Sketch::PEAK).map_err(raised)
    }

    fn text(&self) -> String {
        self.inner.summary.overview()
    }

    fn report(&self) -> PyResult<String> {
        self.inner.report().map_err(raised)
    }

    #[pyo3(name = "write")]
    fn write_files(&self, folder: PathBuf) -> PyResult<()> {
        self.write(&folder)
    }
}
