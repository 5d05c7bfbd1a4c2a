//! The metal from measured curves.

use crate::error::raised;
use crate::scene::{overrides, toml_of};
use crate::table::{of_csv, of_json};
use crate::work;
use asperity::Fit;
use asperity::output::Directory;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::path::{Path, PathBuf};

/// fit.json, posterior.csv, the pictures (curve, stress-strain, objective), the text for a person, the report.
type Identified<'py> = (Bound<'py, PyAny>, Bound<'py, PyDict>, [Option<String>; 3], String, String);

/// Finds the metal of a fit: tables, or the path of a file.
#[pyfunction]
#[pyo3(signature = (fit, set=None, threads=0, out=None, progress=None))]
pub fn identify<'py>(
    py: Python<'py>,
    fit: &Bound<'py, PyAny>,
    set: Option<&Bound<'py, PyDict>>,
    threads: usize,
    out: Option<PathBuf>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Identified<'py>> {
    let fit = match fit.cast::<PyDict>() {
        Ok(tables) => Fit::from_toml(&toml_of(Some(tables))?, Path::new("")),
        Err(_) => Fit::read(&fit.extract::<PathBuf>()?, &overrides(set)?),
    };
    let fit = fit.map_err(raised)?;
    let result = work::run(py, threads, progress, |tell| {
        asperity::identify(fit, &mut |share, text| tell(share, text.to_string()))
    })?;
    let found = result.map_err(raised)?;
    if let Some(folder) = out {
        found.write(&mut Directory::create(&folder).map_err(raised)?).map_err(raised)?;
    }
    let json = of_json(py, &found.to_json().map_err(raised)?)?;
    let samples = of_csv(py, found.posterior_csv().as_bytes())?;
    let pictures = [
        Some(found.curve_svg().map_err(raised)?),
        Some(found.stress_strain_svg().map_err(raised)?),
        found.objective_svg().map_err(raised)?,
    ];
    Ok((json, samples, pictures, found.overview(), found.report().map_err(raised)?))
}
