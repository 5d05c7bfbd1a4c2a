//! The measurements of a fit, read from their files.

use super::material_checks::{KeyError, key_error};
use crate::error::InputError;
use crate::input::RELATIVE_PATH_NOTE;
use crate::input::table_file::understood;
use crate::input::toml_file::TomlFile;
use asperity_formats::indentation;
use asperity_formats::memory::read_file;
use asperity_formats::text::{Series, TextError, decode};
use asperity_identification::experiment::{Data, ImprintNumbers};
use asperity_identification::fit_file::{Features, FitCurve, FitFile, FitShape};
use asperity_identification::imprint::{Imprint, StatedNoise};
use asperity_identification::imprint_file::{self, Reading};
use asperity_identification::measured_curve::Measured;
use asperity_identification::response::Geometry;

/// Sentences on the files of a fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Said {
    /// Interpretation of each file.
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
            let (names, missing) = (curve.column_names(), curve.missing_value);
            let table = indentation::read_as(&text, names, missing, curve.decimal)
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
        ("pile_up_height", f.pile_up_height.map(|v| v.0)),
        ("residual_depth", f.residual_depth.map(|v| v.0)),
        ("rim_radius", f.rim_radius.map(|v| v.0)),
    ];
    for (key, value) in positive {
        let most = if key == "plastic_work_ratio" { 1.0 } else { f64::INFINITY };
        if let Some(v) = value.filter(|v| !(*v > 0.0 && *v < most)) {
            let message = format!("must be above 0 (a work ratio also below 1), not {v} in SI units");
            return Err(key_error(&format!(".{key}"), message));
        }
    }
    let measured = positive.iter().filter(|(key, _)| *key != "max_depth");
    if measured.clone().all(|(_, value)| value.is_none()) {
        return Err(key_error(
            "",
            "holds no number of a curve or an imprint: give loading_curvature, unloading_slope, plastic_work_ratio, pile_up_height, residual_depth or rim_radius",
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

/// The imprint beside a measurement of `depth` with a tool of `geometry`: its file, or its numbers; `None`
/// where none is given.
pub(super) fn imprint(
    file: &TomlFile<FitFile>,
    curve: &FitCurve,
    geometry: &Geometry,
    depth: f64,
    said: &mut Said,
    name: &str,
) -> Result<Option<Data>, KeyError> {
    let numbers = curve.features.map_or(ImprintNumbers::default(), |f| ImprintNumbers {
        pile_up_height: f.pile_up_height.map(|v| v.0),
        residual_depth: f.residual_depth.map(|v| v.0),
        rim_radius: f.rim_radius.map(|v| v.0),
    });
    let has_numbers = numbers != ImprintNumbers::default();
    let key = if curve.imprint.is_some() { "imprint" } else { "features" };
    if !has_numbers && curve.imprint.is_none() {
        return Ok(None);
    }
    if matches!(curve.tool.shape, FitShape::Berkovich | FitShape::Vickers) {
        return Err(key_error(
            key,
            "of a pyramid is not compared: the mean around it is not the pile-up of a cone, which is computed; give the imprint of a cone or a ball, or the curve alone",
        ));
    }
    if depth == 1.0 {
        return Err(key_error(
            key,
            "needs the depth that left it: give features = { max_depth = \"2 um\", … }, or the curve in a file",
        ));
    }
    let radius = geometry
        .plain_radius(depth)
        .filter(|r| *r > 0.0)
        .ok_or_else(|| key_error(key, "belongs to a cone or a ball that indents a flat body: remove it"))?;
    let Some(given) = &curve.imprint else { return Ok(Some(Data::ImprintNumbers(numbers))) };
    if has_numbers {
        return Err(key_error("features", "and `imprint` both describe the imprint: remove one of the two"));
    }
    let table = given.table();
    let path = file.resolve(&table.file);
    let shown = path.display().to_string();
    let error = |reason: String| key_error(key, format!("{shown} {reason}"));
    let bytes = read_file(&path, LARGEST_CURVE_FILE, "the limit of a file of an imprint")
        .map_err(|e| error(format!("cannot be read: {e}; {RELATIVE_PATH_NOTE}")))?;
    let reading = Reading {
        pixel: table.pixel_size.map(|size| size.metres()),
        height_unit: table.height_unit.as_deref(),
        is_down: table.z_down,
    };
    let text = decode(&bytes).ok();
    let text = text.as_ref().map(|(text, encoding)| (&**text, &**encoding));
    let read = imprint_file::read(&path, text, radius, reading).map_err(error)?;
    let line = format!("{name}, imprint: {}", read.understood);
    let stated = StatedNoise {
        noise: table.noise.map(|l| l.0),
        correlation_length: table.correlation_length.map(|l| l.0),
    };
    let imprint = Imprint::new((&read.points, &read.rings), radius, depth, stated).map_err(error)?;
    said.understood.push(line);
    said.notes.extend(imprint.notes.iter().map(|note| format!("{name}: {note}")));
    Ok(Some(Data::Imprint(imprint)))
}
