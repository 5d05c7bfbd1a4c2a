//! The sweep file, and the parts of a sweep joined.

use super::calibration::Calibration;
use crate::error::{Error, InputError};
use crate::input::toml_file::TomlFile;
use asperity_calibration::row::{CaseRow, Row};
use asperity_calibration::sweep::Sweep;
use std::collections::HashMap;
use std::fmt::Display;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Reads the sweep file at `path` (without one the sweep of 480 cases) and applies overrides `key.path=value` in
/// their order.
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
    let mut sweep: Option<Sweep> = None;
    let mut found: Vec<CaseRow> = Vec::new();
    for part in parts {
        let of_part: Sweep =
            serde_json::from_reader(open(part, "sweep.json")?).map_err(|e| wrong(part, "sweep.json", e))?;
        if sweep.as_ref().is_some_and(|s| *s != of_part) {
            return Err(wrong(part, "sweep.json", "is another sweep than that of the parts before").into());
        }
        sweep = Some(of_part);
        let rows = CaseRow::read(open(part, "cases.csv")?).map_err(|e| wrong(part, "cases.csv", e))?;
        found.extend(rows);
    }
    let Some(sweep) = sweep else { return Err(InputError::new("no parts were given").into()) };
    let cases = sweep.cases();
    let rows: HashMap<String, Row> =
        Row::of_cases(&cases, found).into_iter().map(|row| (Row::key(&row.case), row)).collect();
    let missing: Vec<String> = cases.iter().map(Row::key).filter(|key| !rows.contains_key(key)).collect();
    if let Some(first) = missing.first() {
        let message = format!(
            "{} of {} cases are in none of the parts; the first is {first}",
            missing.len(),
            cases.len()
        );
        return Err(InputError::new(message).help("give the folders of all parts").into());
    }
    let rows = cases.iter().filter_map(|case| rows.get(&Row::key(case)).cloned()).collect();
    Ok(Calibration::of(&sweep, rows, start.elapsed().as_secs_f64(), shown_slope_deg))
}

fn wrong(part: &Path, file: &str, why: impl Display) -> InputError {
    InputError::new(format!("{}: {why}", part.join(file).display()))
        .help("give the folders that `asperity calibrate --shard K/N` has written")
}

fn open(part: &Path, file: &str) -> Result<File, InputError> {
    File::open(part.join(file)).map_err(|e| wrong(part, file, format!("cannot be read: {e}")))
}
