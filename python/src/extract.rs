//! The asperities of a map, and the closures held against finite elements.

use crate::error::{raised, wrong};
use crate::press::with_heights;
use crate::scene::RoughScene;
use crate::table::{of_csv, of_json, of_rows};
use crate::work;
use asperity::batch::Options;
use asperity::extract::{Extraction, LineAt, Parts};
use asperity::output::Directory;
use asperity::{Closure, Length, extract as take};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;
use std::str::FromStr;

/// Asperities, summary, the comparison where there is one, the texts for a person.
type Taken<'py> = (Bound<'py, PyDict>, Bound<'py, PyAny>, Option<Bound<'py, PyDict>>, String);

/// Parts to be taken.
#[derive(Debug, FromPyObject)]
#[pyo3(from_item_all)]
struct Wanted {
    separation: Option<String>,
    share: Option<f64>,
    hills: Option<f64>,
    plane_of: Option<String>,
    depth: Option<String>,
    profiles: usize,
    lines: Vec<String>,
    accuracy: String,
}

/// A value that its text says, or the name of the argument that is wrong.
fn parsed<T: FromStr>(name: &str, text: &str) -> PyResult<T>
where
    T::Err: std::fmt::Display,
{
    text.parse().map_err(|e: T::Err| wrong(format!("{name}: {e}")))
}

impl Wanted {
    fn extraction(&self) -> PyResult<Extraction> {
        let length = |name: &str, text: &Option<String>| -> PyResult<Option<Length>> {
            text.as_deref().map(|text| parsed(name, text)).transpose()
        };
        let closure = self.plane_of.as_deref().map(|name| parsed::<Closure>("plane_of", name)).transpose()?;
        let parts = [
            length("separation", &self.separation)?.map(Parts::Separation),
            self.share.map(Parts::Share),
            self.hills.map(Parts::Hills),
            closure.map(|closure| Parts::Load(Some(closure))),
        ];
        let mut given = parts.into_iter().flatten();
        let parts = given.next().unwrap_or(Extraction::default().parts);
        if given.next().is_some() {
            return Err(wrong("separation, share, hills and plane_of exclude each other: give one of them"));
        }
        Ok(Extraction {
            parts,
            depth: length("depth", &self.depth)?,
            bodies: self.profiles,
            lines: self.lines.iter().map(|line| parsed::<LineAt>("lines", line)).collect::<PyResult<_>>()?,
            accuracy: parsed("accuracy", &self.accuracy)?,
        })
    }
}

/// Takes the asperities of a map into `folder`, and crushes the `count` highest.
#[pyfunction]
#[pyo3(signature = (scene, heights, pixel_size_um, wanted, count, threads, folder, progress=None))]
#[allow(clippy::too_many_arguments, reason = "they have names in Python")]
pub fn extract<'py>(
    py: Python<'py>,
    scene: &RoughScene,
    heights: Option<PyReadonlyArray2<'py, f64>>,
    pixel_size_um: Option<[f64; 2]>,
    wanted: &Bound<'py, PyAny>,
    count: usize,
    threads: usize,
    folder: PathBuf,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Taken<'py>> {
    let scene = with_heights(scene, heights, pixel_size_um)?;
    let wanted = wanted.extract::<Wanted>()?.extraction()?;
    let result = work::run(py, threads, progress, |tell| {
        let found = take(&scene, &wanted)?;
        found.check_count(count)?;
        let mut sink = Directory::create(&folder)?;
        found.write(&mut sink)?;
        if count == 0 {
            return Ok((found, None));
        }
        let options = Options { threads, part: None, folder: Some(folder.clone()) };
        let compared = found.crush(&scene, count, &options, &mut |reached| {
            tell(reached.share, format!("asperity {} of {}", reached.done, reached.all))
        })?;
        compared.write(&mut sink)?;
        Ok((found, Some(compared)))
    })?;
    let (found, compared) = result.map_err(|e: asperity::Error| raised(e))?;
    let summary = serde_json::to_string(&found.summary()).map_err(|e| wrong(e.to_string()))?;
    let mut text = found.text();
    let rows = match &compared {
        Some(compared) => {
            text += &compared.text();
            let rows = std::fs::read(folder.join("compared.csv")).map_err(|e| wrong(e.to_string()))?;
            Some(of_csv(py, &rows)?)
        }
        None => None,
    };
    Ok((of_rows(py, &found.table)?, of_json(py, &summary)?, rows, text))
}
