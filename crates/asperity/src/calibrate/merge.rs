//! The sweep file, and the parts of a sweep joined.

use super::calibration::Calibration;
use crate::batch::{self, all_found, not_a_part};
use crate::error::{Error, InputError};
use crate::input::toml_file::TomlFile;
use asperity_calibration::row::{CaseRow, Row};
use asperity_calibration::sweep::Sweep;
use std::collections::HashMap;
use std::fmt::Display;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Reads the sweep file at `path` (without one the sweep of 480 cases) and applies overrides `key.path=value`
/// in their order.
///
/// # Errors
/// A file that cannot be read or values that make no sense, pointing at the line.
pub fn read_sweep(path: Option<&Path>, overrides: &[String]) -> Result<Sweep, InputError> {
    let file: TomlFile<Sweep> = match path {
        Some(path) => TomlFile::read(path, overrides)?,
        None => TomlFile::parse(Path::new("default sweep"), "# all defaults\n".into(), overrides)?,
    };
    file.value.validate().map_err(|e| file.error_at(&e.path, &e.message))?;
    Ok(file.value)
}

/// Joins the folders of all parts of a sweep and fits them as one.
///
/// # Errors
/// Folders that hold no parts, parts of different sweeps, or cases that are in none of them.
pub fn merge(parts: &[PathBuf], shown_slope_deg: Option<f64>) -> Result<Calibration, Error> {
    let start = Instant::now();
    let wrong = |part: &Path, file: &str, why: &dyn Display| not_a_part("calibrate", part, file, why);
    let open = |part: &Path, file: &str| {
        File::open(part.join(file)).map_err(|e| wrong(part, file, &format!("cannot be read: {e}")))
    };
    let (sweep, found): (Sweep, Vec<CaseRow>) = batch::parts(parts, |part| {
        let sweep = serde_json::from_reader(open(part, "sweep.json")?);
        let rows = CaseRow::read(open(part, "cases.csv")?);
        Ok((
            sweep.map_err(|e| wrong(part, "sweep.json", &e))?,
            rows.map_err(|e| wrong(part, "cases.csv", &e))?,
        ))
    })?;
    let cases = sweep.cases();
    let rows: HashMap<String, Row> =
        Row::of_cases(&cases, found).into_iter().map(|row| (Row::key(&row.case), row)).collect();
    let keys: Vec<String> = cases.iter().map(Row::key).collect();
    all_found(&keys, &rows)?;
    let rows = keys.iter().filter_map(|key| rows.get(key).cloned()).collect();
    Ok(Calibration::fit(&sweep, rows, start.elapsed().as_secs_f64(), shown_slope_deg))
}
