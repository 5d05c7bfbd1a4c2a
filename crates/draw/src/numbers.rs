//! Numbers as texts have them.

use asperity_material::units::rounded as to_digits;

/// Mean and standard deviation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spread {
    /// Mean.
    pub mean: f64,
    /// Standard deviation of the sample; 0 of one value.
    pub deviation: f64,
}

/// Four significant digits or so.
pub fn significant(value: f64) -> String {
    with_digits(value, 4)
}

/// Two significant digits or so, as an error deserves.
pub fn rounded(value: f64) -> String {
    with_digits(value, 2)
}

/// Four significant digits, or a dash where there is none.
pub fn shown(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "–".into(), significant)
}

/// Four decimals, and four significant digits of what is smaller than 1.
pub fn four_decimals(value: f64) -> String {
    if value.abs() < 1.0 && value != 0.0 { significant(value) } else { format!("{value:.4}") }
}

/// Seven digits: more than any instrument has, and none of rounding.
pub fn digits(value: f64) -> String {
    to_digits(value, 7).to_string()
}

/// Values in one line.
pub fn listed(values: &[f64], text: impl Fn(f64) -> String) -> String {
    values.iter().map(|v| text(*v)).collect::<Vec<_>>().join(", ")
}

/// A mean and its standard deviation, where that can be seen beside the mean.
pub fn with_deviation(s: Spread) -> String {
    if s.deviation < 1e-4 * s.mean.abs() {
        return significant(s.mean);
    }
    format!("{} ± {}", significant(s.mean), with_digits(s.deviation, 2))
}

/// A value with its error: two digits of the error, and of the value those that it leaves. Without an error
/// that is known, the value alone.
pub fn with_error(value: f64, error: f64) -> String {
    if !(error > 0.0 && error.is_finite()) {
        return significant(value);
    }
    format!("{value:.*} ± {}", decimals(error, 2), rounded(error))
}

/// A mean and its standard deviation to `digits` after the point, or a dash.
pub fn spread(value: Option<Spread>, digits: usize) -> String {
    let Some(s) = value else { return "–".into() };
    let deviation = format!("{:.digits$}", s.deviation);
    let seen = !deviation.trim_matches(['0', '.']).is_empty();
    if seen { format!("{:.digits$} ± {deviation}", s.mean) } else { format!("{:.digits$}", s.mean) }
}

/// So many significant digits or so.
pub fn with_digits(value: f64, count: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if value.abs() < 1e-6 {
        return format!("{value:.*e}", (count - 1).max(0) as usize);
    }
    format!("{value:.*}", decimals(value.abs(), count))
}

/// Digits after the point with which the positive `value` has `count` digits, at most 9.
pub fn decimals(value: f64, count: i32) -> usize {
    (count - 1 - value.log10().floor() as i32).clamp(0, 9) as usize
}

/// A number as tables have it, in the shortest digits that read back to the same bits: `5.0`, `5e-5`, nothing
/// for what is not finite.
pub fn shortest(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { String::new() }
}

/// A value, or nothing.
pub fn if_any<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_has_no_digit_that_its_error_denies() {
        let shown = [(15.625, 12.637), (1280.3, 107.0), (5.5561, 0.0605), (-0.4, 0.0), (2.0, f64::NAN)];
        let shown = shown.map(|(value, error)| with_error(value, error));
        assert_eq!(shown, ["16 ± 13", "1280 ± 107", "5.556 ± 0.060", "-0.4000", "2.000"]);
    }

    #[test]
    fn small_numbers_keep_four_digits() {
        let shown = [5.45981, 0.71874, 0.00166, 4.2e-5, 0.0].map(four_decimals);
        assert_eq!(shown, ["5.4598", "0.7187", "0.001660", "0.00004200", "0.0000"]);
    }
}
