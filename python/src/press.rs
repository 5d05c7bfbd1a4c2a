//! A rough surface pressed.

use crate::error::{raised, wrong};
use crate::scene::RoughScene;
use crate::table::{matrix, of_json, of_rows};
use crate::work;
use asperity::output::Directory;
use asperity::rough::ClosureContact;
use asperity::units::MICROMETRE;
use numpy::{PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

/// The result of a press.
#[pyclass(module = "asperity", frozen)]
#[derive(Debug)]
pub struct Rough {
    inner: asperity::Rough,
}

/// Presses a plane on the surface of a scene, or on the heights (µm, row by row) with their pixel (µm).
#[pyfunction]
#[pyo3(signature = (scene, heights=None, pixel_size_um=None, threads=0, out=None, progress=None))]
pub fn press(
    py: Python<'_>,
    scene: &RoughScene,
    heights: Option<PyReadonlyArray2<'_, f64>>,
    pixel_size_um: Option<[f64; 2]>,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Rough> {
    let scene = with_heights(scene, heights, pixel_size_um)?;
    let result = work::run(py, threads, progress, |tell| {
        asperity::press(&scene, &mut |reached| {
            tell(reached.share, reached.news.map_or("", |c| c.name()).to_string())
        })
    })?;
    let rough = Rough { inner: result.map_err(raised)? };
    out.map_or(Ok(()), |folder| rough.write(&folder))?;
    Ok(rough)
}

/// The scene with these heights, if there are any.
pub fn with_heights(
    scene: &RoughScene,
    heights: Option<PyReadonlyArray2<'_, f64>>,
    pixel_size_um: Option<[f64; 2]>,
) -> PyResult<asperity::RoughScene> {
    let inner = scene.inner.with(&[]).map_err(raised)?;
    let Some(heights) = heights else { return Ok(inner) };
    let pixel = pixel_size_um
        .ok_or_else(|| wrong("pixel_size_um is missing: the distance of the heights along x and y"))?;
    let metres = heights.as_array().iter().map(|z| z * MICROMETRE).collect();
    Ok(inner.with_heights(heights.shape()[1], pixel.map(|p| p * MICROMETRE), metres))
}

/// A scene, its heights in µm where they are in memory, and their pixel in µm.
pub type Map<'py> = (PyRef<'py, RoughScene>, Option<PyReadonlyArray2<'py, f64>>, Option<[f64; 2]>);

/// The scenes of several maps of one surface.
pub fn scenes_of(maps: Vec<Map<'_>>) -> PyResult<Vec<asperity::RoughScene>> {
    maps.into_iter().map(|(scene, heights, pixel)| with_heights(&scene, heights, pixel)).collect()
}

impl Rough {
    fn contact(&self, closure: Option<&str>) -> PyResult<&ClosureContact> {
        let contacts = &self.inner.contacts;
        let found = match closure {
            Some(name) => contacts.iter().find(|one| one.name() == name),
            None => contacts.first(),
        };
        let names: Vec<&str> = contacts.iter().map(ClosureContact::name).collect();
        found.ok_or_else(|| {
            let asked = closure.unwrap_or("any closure");
            wrong(format!("no contact by {asked} was computed; there are {}", names.join(", ")))
        })
    }

    fn write(&self, folder: &Path) -> PyResult<()> {
        let mut folder = Directory::create(folder).map_err(raised)?;
        self.inner.write(&mut folder).map_err(raised)
    }
}

#[pymethods]
impl Rough {
    fn table<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        of_rows(py, &self.inner.table)
    }

    fn load_curve<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        of_rows(py, &self.inner.load_curve)
    }

    fn summary<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        of_json(py, &self.inner.json().map_err(raised)?)
    }

    fn warnings(&self) -> Vec<String> {
        self.inner.summary.warnings.clone()
    }

    /// Pressure, share in contact, or regime, on the cells; on the nodes for a half-space.
    fn layer<'py>(&self, py: Python<'py>, closure: Option<&str>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let layers = self.inner.layers(self.contact(closure)?);
        let values = match name {
            "pressure" => layers.pressure,
            "contact" => layers.contact,
            _ => layers.regime,
        };
        matrix(py, values.into_iter().map(f64::from).collect(), layers.cells[0])
    }

    /// Distance of plane and surface at the nodes, µm, 0 in contact.
    fn gap<'py>(&self, py: Python<'py>, closure: Option<&str>) -> PyResult<Bound<'py, PyAny>> {
        let gap = self.inner.gap(self.contact(closure)?);
        matrix(py, gap.into_iter().map(|z| z / MICROMETRE).collect(), self.inner.surface.map.columns())
    }

    fn heights<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let map = &self.inner.surface.map;
        matrix(py, map.heights().iter().map(|z| z / MICROMETRE).collect(), map.columns())
    }

    fn text(&self) -> String {
        self.inner.text()
    }

    fn report(&self) -> PyResult<String> {
        self.inner.report().map_err(raised)
    }

    #[pyo3(name = "write")]
    fn write_files(&self, folder: PathBuf) -> PyResult<()> {
        self.write(&folder)
    }
}
