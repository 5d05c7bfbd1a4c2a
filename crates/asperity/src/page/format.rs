//! Numbers for people.

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
    digits(value, 4)
}

/// Two significant digits or so, as an error deserves.
pub fn rounded(value: f64) -> String {
    digits(value, 2)
}

/// Four significant digits, or a dash where there is none.
pub fn shown(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(|| "–".into(), significant)
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
    format!("{} ± {}", significant(s.mean), digits(s.deviation, 2))
}

/// A mean and its standard deviation to `digits` after the point, or a dash.
pub fn spread(value: Option<Spread>, digits: usize) -> String {
    let Some(s) = value else { return "–".into() };
    let deviation = format!("{:.digits$}", s.deviation);
    let seen = !deviation.trim_matches(['0', '.']).is_empty();
    if seen { format!("{:.digits$} ± {deviation}", s.mean) } else { format!("{:.digits$}", s.mean) }
}

fn digits(value: f64, count: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    if value.abs() < 1e-6 {
        return format!("{value:.*e}", (count - 1).max(0) as usize);
    }
    let decimals = (count - 1 - value.abs().log10().floor() as i32).clamp(0, 9) as usize;
    format!("{value:.decimals$}")
}
