//! Axes with round numbers, even or logarithmic.

use super::scale;
use plotters::coord::ranged1d::{KeyPointHint, Ranged, ValueFormatter};
use std::ops::RangeInclusive;

/// Most steps of an axis: the numbers of more would touch.
const STEPS: f64 = 6.0;
/// Most numbers of a logarithmic axis that are written beside the powers of ten.
const RUNGS: i64 = 8;
/// Powers of ten that are written out on a logarithmic axis.
const WRITTEN_POWERS: RangeInclusive<i32> = -3..=4;
/// Share of a step by which a value may pass the end of an axis: what no eye sees adds no step.
const CLOSE: f64 = 1e-3;

/// An axis with round numbers at its ticks, written with just the digits that they need.
#[derive(Clone)]
pub struct Axis {
    /// Lower end; of a logarithmic axis its decimal logarithm.
    pub low: f64,
    /// Upper end, likewise.
    pub high: f64,
    ticks: Ticks,
}

#[derive(Clone, Copy)]
enum Ticks {
    /// Multiples of a step.
    Even(f64),
    /// Powers of ten, every so many.
    Powers(f64),
    /// 1, 2 and 5 times each power of ten, from one [`rung`] to another.
    Rungs(i64, i64),
}

impl Axis {
    /// Covers `values` and 0 with about six steps.
    pub fn covering(values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = values.fold((0.0_f64, 0.0_f64), |(l, h), v| (l.min(v), h.max(v)));
        let span = if high > low { high - low } else { 1.0 };
        let step = scale::round_step(span, STEPS);
        let low = if low < 0.0 { (low / step + CLOSE).floor() * step } else { 0.0 };
        let high = ((high / step - CLOSE).ceil() * step).max(low + step);
        Axis { low, high, ticks: Ticks::Even(step) }
    }

    /// From one of `ends` to the other, with about six steps.
    pub fn spanning([low, high]: [f64; 2]) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        Axis { low, high, ticks: Ticks::Even(scale::round_step(high - low, STEPS)) }
    }

    /// Covers decimal logarithms. The ends are 1, 2 or 5 times a power of ten; where these numbers are few,
    /// all of them are written, else powers of ten.
    pub fn logarithmic(logarithms: impl Iterator<Item = f64>) -> Self {
        let ends = logarithms.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        let (low, high) = if ends.0 > ends.1 { (0.0, 1.0) } else { ends };
        let near = |logarithm: f64| (3.0 * logarithm) as i64;
        let first = (near(low) - 3..).take_while(|i| rung(*i) <= low + CLOSE).last().unwrap_or(near(low));
        let last = (near(high) - 3..).find(|i| rung(*i) >= high - CLOSE).unwrap_or(near(high));
        let last = last.max(first + 1);
        let (low, high) = (rung(first), rung(last));
        let every = ((high - low) / STEPS).ceil().max(1.0);
        let ticks = if last - first < RUNGS { Ticks::Rungs(first, last) } else { Ticks::Powers(every) };
        Axis { low, high, ticks }
    }
}

/// The logarithm of 1, 2 or 5 times a power of ten: 0 for 1, 1 for 2, 2 for 5, 3 for 10.
fn rung(i: i64) -> f64 {
    i.div_euclid(3) as f64 + [1.0_f64, 2.0, 5.0][i.rem_euclid(3) as usize].log10()
}

impl Ranged for Axis {
    type FormatOption = plotters::coord::ranged1d::NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, limit: (i32, i32)) -> i32 {
        let share = (value - self.low) / (self.high - self.low);
        limit.0 + (f64::from(limit.1 - limit.0) * share).round() as i32
    }

    fn key_points<Hint: KeyPointHint>(&self, _: Hint) -> Vec<f64> {
        match self.ticks {
            Ticks::Even(step) | Ticks::Powers(step) => scale::multiples(self.low, self.high, step),
            Ticks::Rungs(first, last) => (first..=last).map(rung).collect(),
        }
    }

    fn range(&self) -> std::ops::Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Axis {
    fn format_ext(&self, value: &f64) -> String {
        if let Ticks::Even(step) = self.ticks {
            return scale::label(*value, step);
        }
        let power = (value + CLOSE).floor() as i32;
        let leading = 10f64.powf(value - f64::from(power)).round();
        if !WRITTEN_POWERS.contains(&power) {
            return format!("{leading}e{power}");
        }
        let decimals = (-power).max(0) as usize;
        format!("{:.decimals$}", leading * 10f64.powi(power))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use plotters::coord::ranged1d::BoldPoints;

    /// The numbers of the logarithmic axis over `values`.
    fn written(values: &[f64]) -> Vec<String> {
        let axis = Axis::logarithmic(values.iter().map(|v| v.log10()));
        axis.key_points(BoldPoints(10)).iter().map(|v| axis.format_ext(v)).collect()
    }

    #[test]
    fn a_logarithmic_axis_ends_close_to_its_values_and_writes_round_numbers() {
        assert_eq!(written(&[0.5, 1.0, 2.0, 30.0]), ["0.5", "1", "2", "5", "10", "20", "50"]);
        assert_eq!(written(&[0.013, 0.017]), ["0.01", "0.02"]);
        assert_eq!(written(&[7.0]), ["5", "10"]);
        assert_eq!(written(&[2.0]), ["2", "5"]);
        assert_eq!(written(&[3e-6, 4e-6, 2e-5]), ["2e-6", "5e-6", "1e-5", "2e-5"]);
        assert_eq!(written(&[0.02, 40.0]), ["0.1", "1", "10"]);
        assert_eq!(written(&[1e-12, 1.0]), ["1e-12", "1e-10", "1e-8", "1e-6", "1e-4", "0.01", "1"]);
        assert_eq!(written(&[]), ["1", "2", "5", "10"]);
    }
}
