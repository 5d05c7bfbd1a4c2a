//! Sentences for values outside of their ranges.

use super::SceneError;
use asperity_material::units::Length;

/// Nothing, or what is wrong.
pub(super) type Check = Result<(), SceneError>;

/// An error at a path.
pub(super) fn error(path: impl Into<String>, message: impl Into<String>) -> SceneError {
    SceneError::new(path, message.into())
}

/// A length as a person writes it: "20 um".
pub(crate) fn length(metres: f64) -> String {
    let unit = match metres.abs() {
        v if v == 0.0 || (1e-6..1e-3).contains(&v) => "um",
        v if v < 1e-6 => "nm",
        v if v < 1.0 => "mm",
        _ => "m",
    };
    let value = Length(metres).in_unit(unit);
    let digits = value.abs().log10().floor().clamp(-6.0, 6.0) as i32;
    let rounded = format!("{value:.*}", (5 - digits).clamp(0, 9) as usize);
    let rounded =
        if rounded.contains('.') { rounded.trim_end_matches('0').trim_end_matches('.') } else { &rounded };
    format!("{rounded} {unit}")
}

/// A number in `range`, both ends included, or an error naming both.
pub(super) fn check_range(path: &str, what: &str, value: f64, low: f64, high: f64, way_out: &str) -> Check {
    if (low..=high).contains(&value) {
        return Ok(());
    }
    Err(error(path, format!("{what} must be from {low} to {high}, not {value}: {way_out}")))
}

/// A finite length above zero, or an error.
pub(super) fn positive(path: &str, what: &str, value: Length) -> Check {
    if value.0 > 0.0 && value.0.is_finite() {
        return Ok(());
    }
    Err(error(path, format!("{what} must be finite and above 0, not {}", length(value.0))))
}

/// A finite length of at least zero, or an error.
pub(super) fn not_negative(path: &str, what: &str, value: Option<Length>) -> Check {
    match value {
        Some(v) if !(v.0 >= 0.0 && v.0.is_finite()) => Err(error(
            path,
            format!(
                "{what} must be finite and at least 0, not {}: leave it out for a sharp corner",
                length(v.0)
            ),
        )),
        _ => Ok(()),
    }
}

/// A slope in degrees strictly between flat and upright, or an error.
pub(super) fn slope(path: &str, degrees: Option<f64>) -> Check {
    angle(path, "the slope", degrees, "it is the angle between flank and base plane")
}

/// The angle between flank and axis of a cone, or an error.
pub(super) fn half_apex(path: &str, degrees: Option<f64>) -> Check {
    angle(path, "half the apex angle", degrees, "it is the angle between flank and axis")
}

fn angle(path: &str, what: &str, degrees: Option<f64>, meaning: &str) -> Check {
    match degrees {
        Some(d) if !(d > 0.0 && d < 90.0) => {
            Err(error(path, format!("{what} must be above 0 and below 90 degrees, not {d}: {meaning}")))
        }
        _ => Ok(()),
    }
}

/// Puts the table in front of the keys of an error.
pub(super) fn inside(table: &str, error: SceneError) -> SceneError {
    let path = if error.path.is_empty() { table.to_string() } else { format!("{table}.{}", error.path) };
    SceneError { path, ..error }
}
