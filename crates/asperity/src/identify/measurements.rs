//! The measurements of a fit, read from their files.

use super::material_checks::{KeyError, key_error};
use crate::error::InputError;
use crate::input::RELATIVE_PATH_NOTE;
use crate::input::table_file::understood;
use crate::input::toml_file::TomlFile;
use asperity_formats::indentation;
use asperity_formats::memory::read_file;
use asperity_formats::text::{Series, TextError, decode};
use asperity_identification::experiment::Data;
use asperity_identification::fit_file::{Features, FitCurve, FitFile};
use asperity_identification::measured_curve::Measured;

/// What is told of the files of a fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Said {
    /// What was understood of each.
    pub understood: Vec<String>,
    /// Remarks.
    pub notes: Vec<String>,
}

/// Bytes of the largest file of curves: a day of an instrument.
const LARGEST_CURVE_FILE: u64 = 256 << 20;

/// The data of measurement `i`, one or several tests, each with its name and deepest depth.
pub(super) fn measurements(
    file: &TomlFile<FitFile>,
    i: usize,
    curve: &FitCurve,
    said: &mut Said,
) -> Result<Vec<(String, Data, f64)>, InputError> {
    let at = |key: &str, message: &str| file.error_at(&format!("curve[{i}]{key}"), message);
    let name = format!("curve {}", i + 1);
    match (&curve.file, &curve.features) {
        (Some(_), Some(_)) => Err(at(".features", "does not go with `file`: remove one of the two")),
        (None, None) => Err(at(
            "",
            "holds nothing measured: give file = \"curve.csv\" or features = { loading_curvature = \"27 GPa\" }",
        )),
        (None, Some(f)) => {
            let (data, depth) = features(f).map_err(|(key, m)| at(&format!(".features{key}"), &m))?;
            Ok(vec![(name, data, depth)])
        }
        (Some(path), None) => {
            let path = file.resolve(path);
            let shown = path.display().to_string();
            let bytes = read_file(&path, LARGEST_CURVE_FILE, "the limit of a file of curves")
                .map_err(|e| at(".file", &format!("{shown}: cannot be read: {e}; {RELATIVE_PATH_NOTE}")))?;
            let (text, encoding) =
                decode(&bytes).map_err(|e| at(".file", &format!("{shown} {}", e.message)))?;
            let columns = curve.columns.as_ref().map(|c| [Some(c.depth.as_str()), Some(c.force.as_str())]);
            let table = indentation::read(&text, columns.unwrap_or_default(), curve.missing_value)
                .map_err(|error| table_error(file, i, &shown, &text, error))?;
            said.understood.push(understood(&name, &encoding, &table.understood));
            chosen(table.series, curve.test)
                .map_err(|m| at(".test", &m))?
                .into_iter()
                .map(|(Series { label, rows, .. }, many)| {
                    let name = if many { format!("{name}: test {label}") } else { name.clone() };
                    let measured = Measured::new(&rows)
                        .map_err(|m| at(".file", &format!("{shown}, test {label} {m}")))?;
                    said.notes.extend(measured.notes.iter().map(|note| format!("{name}: {note}")));
                    let depth = measured.peak[0];
                    Ok((name, Data::Curve(measured), depth))
                })
                .collect()
        }
    }
}

/// Features and the depth that they belong to; 1 where none is given.
fn features(f: &Features) -> Result<(Data, f64), KeyError> {
    let positive = [
        ("loading_curvature", f.loading_curvature.map(|v| v.0)),
        ("unloading_slope", f.unloading_slope.map(|v| v.0)),
        ("plastic_work_ratio", f.plastic_work_ratio),
        ("max_depth", f.max_depth.map(|v| v.0)),
    ];
    for (key, value) in positive {
        let most = if key == "plastic_work_ratio" { 1.0 } else { f64::INFINITY };
        if let Some(v) = value.filter(|v| !(*v > 0.0 && *v < most)) {
            let message = format!("must be above 0 (a work ratio also below 1), not {v} in SI units");
            return Err(key_error(&format!(".{key}"), message));
        }
    }
    if positive[..3].iter().all(|(_, value)| value.is_none()) {
        return Err(key_error(
            "",
            "holds no number of a curve: give loading_curvature, unloading_slope or plastic_work_ratio",
        ));
    }
    let data = Data::Features {
        loading_curvature: positive[0].1,
        unloading_slope: positive[1].1,
        plastic_work_ratio: positive[2].1,
    };
    Ok((data, f.max_depth.map_or(1.0, |d| d.0)))
}

/// The error of a table that cannot be read, at its line of `text`, the file `shown` of measurement `i`.
fn table_error(file: &TomlFile<FitFile>, i: usize, shown: &str, text: &str, error: TextError) -> InputError {
    let error = match error.line {
        Some(line) => {
            let start = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
            InputError::new(error.message).pointing_at(shown, text, start..text.len())
        }
        None => file.error_at(&format!("curve[{i}].file"), &format!("{shown} {}", error.message)),
    };
    if Features::are_named_in(text) { error.help(Features::FEATURES_PLACE) } else { error }
}

/// Tests, each with whether the file holds several.
type Chosen = Vec<(Series<2>, bool)>;

fn chosen(tests: Vec<Series<2>>, wanted: Option<usize>) -> Result<Chosen, String> {
    let count = tests.len();
    match wanted {
        None => Ok(tests.into_iter().map(|test| (test, count > 1)).collect()),
        Some(k) if (1..=count).contains(&k) => {
            Ok(tests.into_iter().skip(k - 1).take(1).map(|test| (test, false)).collect())
        }
        Some(k) => Err(format!(
            "there is no test {k} in the file, which has {count}: give a number from 1 to {count}"
        )),
    }
}
