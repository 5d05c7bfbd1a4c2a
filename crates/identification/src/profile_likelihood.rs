//! Intervals by the profile likelihood: how far a number may go while the others give way, until the sum of
//! squares has grown by 3.84 (95 % of one unknown). Bounds end an interval (Raue et al., Bioinformatics 25
//! (2009) 1923).

use crate::levenberg_marquardt::{Minimum, Residuals, chi2, minimise};

/// Growth of the sum of squares at the end of a 95 % interval of one number.
pub const GROWTH: f64 = 3.841;
/// Steps outward until the growth is exceeded, and steps inward to its place.
const STEPS: [usize; 2] = [14, 7];
/// Weight of a condition beside residuals in standard deviations.
const CONDITION_WEIGHT: f64 = 1e4;

/// An interval with its ends in the coordinate of the number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Its ends.
    pub ends: [f64; 2],
    /// True where each of them is a bound, not what the measurements say.
    pub bounded: [bool; 2],
}

/// The interval of coordinate `i`; `deviation` is its size by the curvature at the minimum. Where the sum of
/// squares has several valleys, minima in the `others` count too: the interval reaches from the first end to
/// the last.
pub fn of_coordinate(
    residuals: &Residuals<'_>,
    best: &Minimum,
    others: &[Minimum],
    bounds: &[[f64; 2]],
    i: usize,
    deviation: f64,
) -> Interval {
    let at = |x: f64, from: &[f64]| {
        let mut held = bounds.to_vec();
        held[i] = [x, x];
        let mut start = from.to_vec();
        start[i] = x;
        minimise(residuals, &start, &held)
    };
    let end = |from: &Minimum, side: usize| {
        one_side(&at, from, best.chi2, from.point[i], bounds[i][side], deviation)
    };
    let mut ends = [0, 1].map(|side| end(best, side));
    for other in others {
        if other.point[i] < ends[0].0 {
            ends[0] = end(other, 0);
        }
        if other.point[i] > ends[1].0 {
            ends[1] = end(other, 1);
        }
    }
    Interval { ends: ends.map(|e| e.0), bounded: ends.map(|e| e.1) }
}

/// The interval of a number that is a function of the coordinates.
pub fn of_number(
    residuals: &Residuals<'_>,
    best: &Minimum,
    bounds: &[[f64; 2]],
    number: &(dyn Fn(&[f64]) -> Option<f64> + Sync),
    deviation: f64,
) -> Option<Interval> {
    let here = number(&best.point)?;
    let at = |x: f64, from: &[f64]| {
        let held = |point: &[f64]| {
            let mut all = residuals(point)?;
            all.push(CONDITION_WEIGHT * (number(point)? - x));
            Some(all)
        };
        let point = minimise(&held, from, bounds).point;
        // a number that the bounds do not let come so far is as good as beyond
        let met = number(&point).is_some_and(|y| (y - x).abs() < 1e-3 * (1.0 + deviation));
        let chi2 = if met { chi2(residuals, &point) } else { f64::INFINITY };
        Minimum { point, chi2 }
    };
    let far = 40.0;
    let ends = [-far, far].map(|side| one_side(&at, best, best.chi2, here, here + side, deviation));
    Some(Interval { ends: ends.map(|e| e.0), bounded: ends.map(|e| e.1) })
}

/// The end of the interval from `here`, where the minimum `from` lies, toward `limit`, and whether it is
/// that. The sum of squares grows from `lowest`.
fn one_side(
    at: &dyn Fn(f64, &[f64]) -> Minimum,
    from: &Minimum,
    lowest: f64,
    here: f64,
    limit: f64,
    deviation: f64,
) -> (f64, bool) {
    let room = limit - here;
    if room.abs() < 1e-12 {
        return (limit, true);
    }
    // the root of the growth is nearly a straight line
    let root = |minimum: &Minimum| (minimum.chi2 - lowest).max(0.0).sqrt();
    let goal = GROWTH.sqrt();
    let mut inner = (here, root(from));
    let mut point = from.point.clone();
    let mut step = deviation.max(1e-6 * room.abs()).min(room.abs()).copysign(room);
    let mut outer = None;
    for _ in 0..STEPS[0] {
        let next = here + (inner.0 - here + step).abs().min(room.abs()).copysign(room);
        let minimum = at(next, &point);
        let grown = root(&minimum);
        if grown > goal {
            outer = Some((next, grown));
            break;
        }
        (inner, point) = ((next, grown), minimum.point);
        if next == limit {
            return (limit, true);
        }
        step *= 1.4;
    }
    let Some(mut outer) = outer else { return (inner.0, true) };
    for _ in 0..STEPS[1] {
        if (outer.0 - inner.0).abs() < 0.01 * deviation {
            break;
        }
        let share = if outer.1.is_finite() { (goal - inner.1) / (outer.1 - inner.1) } else { 0.5 };
        let next = inner.0 + share.clamp(0.1, 0.9) * (outer.0 - inner.0);
        let minimum = at(next, &point);
        let grown = root(&minimum);
        if grown > goal {
            outer = (next, grown);
        } else {
            (inner, point) = ((next, grown), minimum.point);
        }
    }
    let share = if outer.1.is_finite() { (goal - inner.1) / (outer.1 - inner.1) } else { 0.5 };
    (inner.0 + share.clamp(0.0, 1.0) * (outer.0 - inner.0), false)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// y = exp(x) measured as 1 with a deviation of 0.1: the interval of x is ln(1 ± 0.196), which is not
    /// symmetric.
    #[test]
    fn an_interval_follows_the_curve_and_ends_at_a_bound() {
        let residuals = |p: &[f64]| Some(vec![(p[0].exp() - 1.0) / 0.1]);
        let best = Minimum { point: vec![0.0], chi2: 0.0 };
        let free = of_coordinate(&residuals, &best, &[], &[[-2.0, 2.0]], 0, 0.1);
        assert!((free.ends[0] - (1.0 - 0.196_f64).ln()).abs() < 2e-3, "{free:?}");
        assert!((free.ends[1] - (1.0 + 0.196_f64).ln()).abs() < 2e-3 && free.bounded == [false; 2]);
        let tight = of_coordinate(&residuals, &best, &[], &[[-0.05, 2.0]], 0, 0.1);
        assert!(tight.ends[0] == -0.05 && tight.bounded == [true, false]);
    }

    /// Of two unknowns whose sum alone is measured, the sum has an interval and each of them ends at its
    /// bounds.
    #[test]
    fn a_number_that_is_seen_is_told_from_one_that_is_not() {
        let residuals = |p: &[f64]| Some(vec![(p[0] + p[1]) / 0.1]);
        let best = Minimum { point: vec![0.0, 0.0], chi2: 0.0 };
        let bounds = [[-1.0, 1.0], [-1.0, 1.0]];
        let sum = of_number(&residuals, &best, &bounds, &|p| Some(p[0] + p[1]), 0.1).unwrap();
        assert!((sum.ends[1] - 0.196).abs() < 2e-3 && (sum.ends[0] + 0.196).abs() < 2e-3, "{sum:?}");
        let one = of_coordinate(&residuals, &best, &[], &bounds, 0, 0.1);
        assert_eq!((one.ends, one.bounded), ([-1.0, 1.0], [true, true]));
    }

    /// x² measured as 1 ± 0.1: from the minimum at 1 alone the one at -1 is out of reach.
    #[test]
    fn an_interval_reaches_over_every_valley_that_the_measurements_allow() {
        let residuals = |p: &[f64]| Some(vec![(p[0] * p[0] - 1.0) / 0.1]);
        let [best, other] = [1.0, -1.0].map(|x| Minimum { point: vec![x], chi2: 0.0 });
        let [near, far] = [0.804_f64, 1.196].map(f64::sqrt);
        let alone = of_coordinate(&residuals, &best, &[], &[[-3.0, 3.0]], 0, 0.05);
        assert!((alone.ends[0] - near).abs() < 2e-3 && (alone.ends[1] - far).abs() < 2e-3, "{alone:?}");
        let both = of_coordinate(&residuals, &best, &[other], &[[-3.0, 3.0]], 0, 0.05);
        assert!((both.ends[0] + far).abs() < 2e-3 && (both.ends[1] - far).abs() < 2e-3, "{both:?}");
    }
}
