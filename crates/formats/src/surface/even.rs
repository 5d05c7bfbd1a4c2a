//! Evenly spaced places, exact or rounded to the digits they were printed with.

/// Largest distance of a place from its line, as a share of a step: that of many printed digits.
pub(super) const SCATTER: f64 = 1e-2;
/// Numbers from which rounded ones are known to be even.
const LEAST_ROUNDED: usize = 8;
/// Digits beyond which numbers were not rounded for print.
const MOST_DIGITS: i32 = 7;

/// The distance of evenly spaced places.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Step {
    /// Distance, above 0.
    pub length: f64,
    /// Share of it that the rounding of the places leaves open.
    pub error: f64,
}

impl Step {
    /// The step of numbers on a straight line; of eight or more, also where they lie on it but for the
    /// rounding of their last digit.
    pub fn new(places: &[f64]) -> Option<Step> {
        if !places.iter().all(|place| place.is_finite()) {
            return None;
        }
        let exact = slope(places, SCATTER).map(|slope| Step { length: slope.abs(), error: 0.0 });
        exact.or_else(|| rounded(places))
    }
}

/// The slope of numbers on a straight line, to a share `scatter` of a step; some may be missing.
pub(super) fn slope(line: &[f64], scatter: f64) -> Option<f64> {
    let there = || line.iter().enumerate().filter(|(_, z)| z.is_finite()).map(|(i, z)| (i as f64, *z));
    let (first, last) = (there().next()?, there().next_back()?);
    let slope = (last.1 - first.1) / (last.0 - first.0);
    let near = |(i, z): (f64, f64)| (z - first.1 - (i - first.0) * slope).abs() <= scatter * slope.abs();
    (slope != 0.0 && slope.is_finite() && there().all(near)).then_some(slope)
}

/// The unit of the last digit of printed numbers: the largest power of ten of which all are multiples.
pub(super) fn last_digit(numbers: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    let largest = numbers.clone().fold(0.0f64, |largest, x| largest.max(x.abs()));
    if !(largest.is_normal() && largest < f64::MAX / 10.0) {
        return None;
    }
    let leading = largest.log10().floor() as i32;
    let is_multiple = |unit: f64| numbers.clone().all(|x| (x / unit - (x / unit).round()).abs() < 1e-6);
    (0..MOST_DIGITS).map(|digits| 10.0f64.powi(leading - digits)).find(|unit| is_multiple(*unit))
}

/// The step of places that rise or fall without end and lie within half a unit of their last digit of a
/// straight line: the middle of the slopes that such lines can have.
fn rounded(places: &[f64]) -> Option<Step> {
    let (first, last) = (*places.first()?, *places.last()?);
    let sign = (last - first).signum();
    if places.len() < LEAST_ROUNDED || !places.windows(2).all(|two| sign * (two[1] - two[0]) > 0.0) {
        return None;
    }
    let unit = last_digit(places.iter().copied())?;
    // the distance of the lowest and the highest parallel line that hold all places: convex in the slope
    let spread = |slope: f64| {
        let over = |(i, place): (usize, &f64)| place - slope * i as f64;
        let ends = |(low, high): (f64, f64), x: f64| (low.min(x), high.max(x));
        let (low, high) = places.iter().enumerate().map(over).fold((f64::MAX, f64::MIN), ends);
        high - low
    };
    let allowed = unit * (1.0 + 1e-6);
    let (middle, reach) = ((last - first) / (places.len() - 1) as f64, unit / (places.len() - 1) as f64);
    let (mut low, mut high) = (middle - 2.0 * reach, middle + 2.0 * reach);
    const HALVINGS: usize = 60;
    for _ in 0..HALVINGS {
        let [a, b] = [low + (high - low) / 3.0, high - (high - low) / 3.0];
        if spread(a) < spread(b) { high = b } else { low = a }
    }
    let best = 0.5 * (low + high);
    let end = |mut outside: f64| {
        let mut inside = best;
        for _ in 0..HALVINGS {
            let half = 0.5 * (inside + outside);
            if spread(half) <= allowed { inside = half } else { outside = half }
        }
        inside
    };
    let [low, high] = [end(best - 2.0 * reach), end(best + 2.0 * reach)];
    let step = 0.5 * (low + high);
    let is_even = spread(best) <= allowed && unit <= step.abs();
    is_even.then(|| Step { length: step.abs(), error: 0.5 * (high - low) / step.abs() })
}
