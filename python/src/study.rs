//! A scene over any of its keys.

use crate::error::{raised, wrong};
use crate::press::with_heights;
use crate::scene::{RoughScene, Scene, overrides};
use crate::table::{of_csv, to_json};
use crate::work;
use asperity::batch::{Options, Shard};
use asperity::output::Directory;
use asperity::study::{Plan, SampleTable, Subject, Vary};
use numpy::PyReadonlyArray2;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::PathBuf;

/// Results, times, the picture, the text for a person.
type Studied<'py> = (Bound<'py, PyDict>, Bound<'py, PyDict>, Option<String>, String);

/// The scene that is varied, of either kind, with the same changes in all runs.
fn subject(
    scene: &Bound<'_, PyAny>,
    heights: Option<PyReadonlyArray2<'_, f64>>,
    pixel_size_um: Option<[f64; 2]>,
    set: &[String],
) -> PyResult<Subject> {
    if let Ok(scene) = scene.extract::<PyRef<'_, Scene>>() {
        let scene = scene.inner.with(set).map_err(raised)?;
        return Ok(Subject::Crush(Box::new(scene)));
    }
    if let Ok(scene) = scene.extract::<PyRef<'_, RoughScene>>() {
        let scene = with_heights(&scene, heights, pixel_size_um)?.with(set).map_err(raised)?;
        return Ok(Subject::Rough(Box::new(scene)));
    }
    Subject::read(&scene.extract::<PathBuf>()?, set).map_err(raised)
}

/// Runs a scene over the values of its keys.
#[pyfunction]
#[pyo3(signature = (
    scene, vary, sample, set=None, heights=None, pixel_size_um=None, curves=false, show=None, shard=None, threads=0, out=None,
    progress=None
))]
#[allow(clippy::too_many_arguments, reason = "they have names in Python")]
pub fn study<'py>(
    py: Python<'py>,
    scene: &Bound<'py, PyAny>,
    vary: &Bound<'py, PyDict>,
    sample: &Bound<'py, PyDict>,
    set: Option<&Bound<'py, PyDict>>,
    heights: Option<PyReadonlyArray2<'py, f64>>,
    pixel_size_um: Option<[f64; 2]>,
    curves: bool,
    show: Option<&str>,
    shard: Option<&str>,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Studied<'py>> {
    let subject = subject(scene, heights, pixel_size_um, &overrides(set)?)?;
    let varied = vary
        .iter()
        .map(|(key, values)| Vary::new(&key.extract::<String>()?, &to_json(&values)?).map_err(raised));
    let varied = varied.collect::<PyResult<Vec<Vary>>>()?;
    let sample: SampleTable =
        serde_json::from_value::<SampleTable>(to_json(sample)?).map_err(|e| wrong(format!("sample: {e}")))?;
    let mut plan = Plan::new(subject, varied, sample.sample().map_err(raised)?).map_err(raised)?;
    if curves {
        plan = plan.with_curves();
    }
    if let Some(column) = show {
        plan = plan.showing(column);
    }
    let part: Option<Shard> =
        shard.map(str::parse).transpose().map_err(|e: String| wrong(format!("shard: {e}")))?;
    if let Some(folder) = &out {
        Directory::create(folder).map_err(raised)?;
    }
    let options = Options { threads, part, folder: out.clone() };
    let result = work::run(py, 0, progress, |tell| {
        asperity::study(&plan, &options, &mut |reached| {
            tell(reached.share, format!("run {} of {}", reached.done, reached.all))
        })
    })?;
    let done = result.map_err(raised)?;
    let results = of_csv(py, done.results_csv().map_err(raised)?.as_bytes())?;
    let times = of_csv(py, done.times_csv().map_err(raised)?.as_bytes())?;
    let picture = done.svg().map_err(raised)?;
    if let Some(folder) = out {
        done.write(&mut Directory::create(&folder).map_err(raised)?).map_err(raised)?;
    }
    Ok((results, times, picture, done.text()))
}
