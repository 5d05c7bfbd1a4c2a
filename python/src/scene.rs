//! Scenes: built in code, read from TOML, changed key by key.

use crate::error::{raised, wrong};
use crate::table::{of_json, to_json};
use asperity::input::toml_file::to_toml;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A text, or the file at a path.
enum Source {
    Text(String),
    File(PathBuf),
}

/// A string with a line break or an equals sign is a text, unless a file has that name.
fn source(path_or_text: &Bound<'_, PyAny>) -> PyResult<Source> {
    if let Ok(text) = path_or_text.extract::<String>() {
        let is_text = text.contains(['\n', '=']) && !Path::new(&text).is_file();
        return Ok(if is_text { Source::Text(text) } else { Source::File(text.into()) });
    }
    Ok(Source::File(path_or_text.extract()?))
}

/// Tables of Python as TOML.
pub fn toml_of(tables: Option<&Bound<'_, PyDict>>) -> PyResult<String> {
    let tables = tables.map_or(Ok(Value::Object(Default::default())), |tables| to_json(tables.as_any()))?;
    to_toml(&tables).map_err(wrong)
}

/// Overrides `key=value` as the library takes them.
pub fn overrides(set: Option<&Bound<'_, PyDict>>) -> PyResult<Vec<String>> {
    let Some(set) = set else { return Ok(Vec::new()) };
    let Value::Object(table) = to_json(set.as_any())? else { return Ok(Vec::new()) };
    let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_string);
    Ok(table.iter().map(|(key, value)| format!("{key}={}", text(value))).collect())
}

fn read<T>(
    path_or_text: &Bound<'_, PyAny>,
    parse: impl Fn(&str) -> PyResult<T>,
    read: impl Fn(&Path) -> PyResult<T>,
) -> PyResult<T> {
    match source(path_or_text)? {
        Source::Text(text) => parse(&text),
        Source::File(path) => read(&path),
    }
}

/// A scene of `crush`: what is crushed, by what, how far.
///
/// Build it from tables, `Scene(symmetry="axisymmetric", material={...}, asperity=[{...}], tool={...}, loading={...})`, or read it
/// with `Scene.from_toml`. Quantities are strings with units, such as "5 um"; files are relative to the scene's.
#[pyclass(module = "asperity", frozen)]
#[derive(Debug)]
pub struct Scene {
    pub inner: asperity::Scene,
}

#[pymethods]
impl Scene {
    #[new]
    #[pyo3(signature = (**tables))]
    fn new(tables: Option<&Bound<'_, PyDict>>) -> PyResult<Scene> {
        let text = toml_of(tables)?;
        asperity::Scene::from_toml(&text, Path::new("")).map(|inner| Scene { inner }).map_err(raised)
    }

    /// Reads a scene: a path, or the text of a TOML file.
    #[staticmethod]
    fn from_toml(path_or_text: &Bound<'_, PyAny>) -> PyResult<Scene> {
        let inner = read(
            path_or_text,
            |text| asperity::Scene::from_toml(text, Path::new("")).map_err(raised),
            |path| asperity::Scene::read(path, &[]).map_err(raised),
        )?;
        Ok(Scene { inner })
    }

    /// The scene with another value at `key`, such as `scene.set("loading.depth", "2 um")`; this one stays as it is.
    fn set(&self, key: &str, value: &Bound<'_, PyAny>) -> PyResult<Scene> {
        let table = PyDict::new(value.py());
        table.set_item(key, value)?;
        let inner = self.inner.with(&overrides(Some(&table))?).map_err(raised)?;
        Ok(Scene { inner })
    }

    /// The scene as the text of a TOML file, in SI units.
    fn to_toml(&self) -> PyResult<String> {
        self.inner.to_toml().map_err(raised)
    }

    /// The tables of the scene, in SI units.
    #[getter]
    fn tables<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let text = serde_json::to_string(self.inner.tables()).map_err(|e| wrong(e.to_string()))?;
        of_json(py, &text)
    }

    /// Name of its file; "scene" where there is none.
    #[getter]
    fn name(&self) -> String {
        self.inner.name()
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("Scene.from_toml('''\n{}''')", self.to_toml()?))
    }

    fn __eq__(&self, other: &Scene) -> bool {
        self.inner.tables() == other.inner.tables()
    }
}

/// A scene of `press`: a surface, its material, its load.
///
/// Build it from tables, `RoughScene(closure="all", surface={...}, material={...}, load={...})`, or read it with
/// `RoughScene.from_toml`.
#[pyclass(module = "asperity", frozen)]
#[derive(Debug)]
pub struct RoughScene {
    pub inner: asperity::RoughScene,
}

#[pymethods]
impl RoughScene {
    #[new]
    #[pyo3(signature = (**tables))]
    fn new(tables: Option<&Bound<'_, PyDict>>) -> PyResult<RoughScene> {
        let inner = asperity::RoughScene::from_toml(&toml_of(tables)?, Path::new("")).map_err(raised)?;
        Ok(RoughScene { inner })
    }

    /// Reads a scene: a path, or the text of a TOML file.
    #[staticmethod]
    fn from_toml(path_or_text: &Bound<'_, PyAny>) -> PyResult<RoughScene> {
        let inner = read(
            path_or_text,
            |text| asperity::RoughScene::from_toml(text, Path::new("")).map_err(raised),
            |path| asperity::RoughScene::read(path, &[]).map_err(raised),
        )?;
        Ok(RoughScene { inner })
    }

    /// The scene with another value at `key`, such as `scene.set("load.pressure", "50 MPa")`; this one stays as it is.
    fn set(&self, key: &str, value: &Bound<'_, PyAny>) -> PyResult<RoughScene> {
        let table = PyDict::new(value.py());
        table.set_item(key, value)?;
        let inner = self.inner.with(&overrides(Some(&table))?).map_err(raised)?;
        Ok(RoughScene { inner })
    }

    /// The scene as the text of a TOML file, in SI units; heights in memory are not in it.
    fn to_toml(&self) -> PyResult<String> {
        to_toml(self.inner.tables()).map_err(wrong)
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("RoughScene.from_toml('''\n{}''')", self.to_toml()?))
    }
}
