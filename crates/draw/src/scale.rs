//! Round numbers for axes and colour bars.

/// The smallest of 1, 2, 2.5 and 5 times a power of ten that divides `span` into at most `most` steps.
pub fn round_step(span: f64, most: f64) -> f64 {
    let power = 10f64.powf((span / most).log10().floor());
    let step = [1.0, 2.0, 2.5, 5.0, 10.0].map(|m| m * power).into_iter().find(|s| span / s <= most);
    step.unwrap_or(10.0 * power)
}

/// Digits after the point that multiples of `step` need.
pub fn decimals(step: f64) -> usize {
    let whole = |d: &usize| {
        let scaled = step * 10f64.powi(*d as i32);
        (scaled - scaled.round()).abs() < 1e-6 * scaled
    };
    (0..12).find(whole).unwrap_or(12)
}

/// A multiple of `step` in just the digits that it needs.
pub fn label(value: f64, step: f64) -> String {
    // what is longer would reach into the name of the axis
    if !(1e-6..1e6).contains(&step) && value != 0.0 {
        let digits = decimals(value.abs() / 10f64.powf(value.abs().log10().floor())).min(3);
        return format!("{value:.digits$e}");
    }
    let text = format!("{value:.*}", decimals(step));
    if text.trim_start_matches(['-', '0', '.']).is_empty() { "0".into() } else { text }
}

/// The multiples of `step` from `low` to `high`.
pub fn multiples(low: f64, high: f64, step: f64) -> Vec<f64> {
    let (first, last) = ((low / step - 1e-9).ceil() as i64, (high / step + 1e-9).floor() as i64);
    (first..=last).map(|i| i as f64 * step).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_labels_short() {
        assert_eq!(round_step(1273.0, 7.0), 200.0);
        assert_eq!(round_step(0.9, 7.0), 0.2);
        assert_eq!(label(0.30000000000000004, 0.1), "0.3");
        assert_eq!(label(-0.0, 2.5), "0");
        assert_eq!((label(1.25e7, 2.5e6), label(1e7, 5e6)), ("1.25e7".into(), "1e7".into()));
        assert_eq!((label(3e-19, 1e-19), label(0.0, 1e-19)), ("3e-19".into(), "0".into()));
        assert_eq!(label(2.5, 2.5), "2.5");
        assert_eq!(multiples(-10.0, 5.0, 5.0), [-10.0, -5.0, 0.0, 5.0]);
    }
}
