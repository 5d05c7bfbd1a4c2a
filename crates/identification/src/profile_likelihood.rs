//! Intervals by the profile likelihood: how far a number may go while the others give way, until the sum of
//! squares has grown by 3.84 (95 % of one unknown). Bounds end an interval (Raue et al., Bioinformatics 25
//! (2009) 1923).

use crate::levenberg_marquardt::{Function, Minimum, ResidualFunction, Residuals, chi2, minimise};

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

impl Interval {
    /// The interval between two ends.
    pub fn from_ends(ends: &[End; 2]) -> Interval {
        Interval { ends: [ends[0].place, ends[1].place], bounded: [ends[0].bounded, ends[1].bounded] }
    }
}

/// An end of an interval.
#[derive(Clone, Debug)]
pub struct End {
    /// Its place in the coordinate of the number.
    pub place: f64,
    /// True where it is a bound, not what the measurements say.
    pub bounded: bool,
    /// The point there, or just within, the other coordinates at their best.
    pub point: Vec<f64>,
}

/// Problem of a profile: the residuals within their bounds, and the lowest sum of squares of all, from which
/// it grows.
pub struct Profile<'a> {
    /// The residuals.
    pub residuals: &'a Residuals<'a>,
    /// Bounds of the coordinates.
    pub bounds: &'a [[f64; 2]],
    /// The lowest sum of squares.
    pub lowest: f64,
}

impl Profile<'_> {
    /// The ends of the interval of coordinate `i`. Where the sum of squares has several valleys, their
    /// `minima` all count, the best one first, and the interval reaches from the first end to the last. By
    /// the curvature at the minimum, coordinate
    /// `i` has the size `deviation`, and the others move `along` as it moves by one.
    pub fn ends_of_coordinate(
        &self,
        minima: &[Minimum],
        i: usize,
        deviation: f64,
        along: &[f64],
    ) -> [End; 2] {
        let held_at = |x: f64, from: &[f64]| {
            let mut held = self.bounds.to_vec();
            held[i] = [x, x];
            let by = x - from[i];
            let tilted: Vec<f64> = from.iter().zip(along).map(|(y, slope)| y + by * slope).collect();
            let starts = [tilted.as_slice(), from].map(|start| {
                let mut start = start.to_vec();
                start[i] = x;
                start
            });
            let first = minimise(self.residuals, &starts[0], &held);
            // a wall may be that of the start alone
            if first.chi2 - self.lowest <= GROWTH {
                return first;
            }
            let second = minimise(self.residuals, &starts[1], &held);
            if second.chi2 < first.chi2 { second } else { first }
        };
        let end = |from: &Minimum, side: usize| {
            let limit = self.bounds[i][side];
            one_side(&held_at, from, self.lowest, from.point[i], limit, deviation)
        };
        hull(minima, |minimum| minimum.point[i], end)
    }

    /// The interval of a number that is a function of the coordinates, over the valleys of all `minima`.
    pub fn of_number(
        &self,
        minima: &[Minimum],
        number: &(dyn Fn(&[f64]) -> Option<f64> + Sync),
        deviation: f64,
    ) -> Option<Interval> {
        let held_at = |x: f64, from: &[f64]| {
            let held = Conditioned { residuals: self.residuals, number, goal: x };
            let point = minimise(&held, from, self.bounds).point;
            // a number that the bounds do not let come so far is as good as beyond
            let met = number(&point).is_some_and(|y| (y - x).abs() < 1e-3 * (1.0 + deviation));
            let chi2 = if met { chi2(self.residuals, &point) } else { f64::INFINITY };
            Minimum { point, chi2 }
        };
        if minima.is_empty() || minima.iter().any(|m| number(&m.point).is_none()) {
            return None;
        }
        let far = 40.0;
        let value = |minimum: &Minimum| number(&minimum.point).unwrap_or(f64::NAN);
        let end = |from: &Minimum, side: usize| {
            let here = value(from);
            let limit = here + [-far, far][side];
            one_side(&held_at, from, self.lowest, here, limit, deviation)
        };
        Some(Interval::from_ends(&hull(minima, value, end)))
    }
}

/// Residuals under the condition that a number has a value.
struct Conditioned<'a> {
    residuals: &'a Residuals<'a>,
    number: &'a (dyn Fn(&[f64]) -> Option<f64> + Sync),
    goal: f64,
}

impl Conditioned<'_> {
    fn with_the_condition(&self, mut all: Vec<f64>, point: &[f64]) -> Option<Vec<f64>> {
        all.push(CONDITION_WEIGHT * ((self.number)(point)? - self.goal));
        Some(all)
    }
}

impl ResidualFunction for Conditioned<'_> {
    fn residuals(&self, point: &[f64]) -> Option<Vec<f64>> {
        self.with_the_condition(self.residuals.residuals(point)?, point)
    }

    fn about(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
        let residuals = self.residuals.about(point)?;
        Some(Box::new(move |at| self.with_the_condition(residuals(at)?, at)))
    }

    fn first_order(&self, point: &[f64]) -> Option<Box<Function<'_>>> {
        let residuals = self.residuals.first_order(point)?;
        Some(Box::new(move |at| self.with_the_condition(residuals(at)?, at)))
    }
}

/// The first and the last end of the intervals about `minima`, of which there is one at least; one that lies
/// within what was found is not gone from again.
fn hull(
    minima: &[Minimum],
    value: impl Fn(&Minimum) -> f64,
    end: impl Fn(&Minimum, usize) -> End,
) -> [End; 2] {
    let (best, others) = (&minima[0], &minima[1..]);
    let mut ends = [0, 1].map(|side| end(best, side));
    for other in others {
        if value(other) < ends[0].place {
            ends[0] = end(other, 0);
        }
        if value(other) > ends[1].place {
            ends[1] = end(other, 1);
        }
    }
    ends
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
) -> End {
    let room = limit - here;
    if room.abs() < 1e-12 {
        return End { place: limit, bounded: true, point: from.point.clone() };
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
            return End { place: limit, bounded: true, point };
        }
        step *= 1.4;
    }
    let Some(mut outer) = outer else { return End { place: inner.0, bounded: true, point } };
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
    End { place: inner.0 + share.clamp(0.0, 1.0) * (outer.0 - inner.0), bounded: false, point }
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
        let bounds = [[-2.0, 2.0], [-0.05, 2.0]];
        let within = |i: usize| {
            let profile = Profile { residuals: &residuals, bounds: &bounds[i..=i], lowest: 0.0 };
            Interval::from_ends(&profile.ends_of_coordinate(std::slice::from_ref(&best), 0, 0.1, &[1.0]))
        };
        let free = within(0);
        assert!((free.ends[0] - (1.0 - 0.196_f64).ln()).abs() < 2e-3, "{free:?}");
        assert!((free.ends[1] - (1.0 + 0.196_f64).ln()).abs() < 2e-3 && free.bounded == [false; 2]);
        let tight = within(1);
        assert!(tight.ends[0] == -0.05 && tight.bounded == [true, false]);
    }

    /// Of two unknowns whose sum alone is measured, the sum has an interval and each of them ends at its
    /// bounds.
    #[test]
    fn a_number_that_is_seen_is_told_from_one_that_is_not() {
        let residuals = |p: &[f64]| Some(vec![(p[0] + p[1]) / 0.1]);
        let best = Minimum { point: vec![0.0, 0.0], chi2: 0.0 };
        let bounds = [[-1.0, 1.0], [-1.0, 1.0]];
        let profile = Profile { residuals: &residuals, bounds: &bounds, lowest: 0.0 };
        let sum = profile.of_number(std::slice::from_ref(&best), &|p| Some(p[0] + p[1]), 0.1).unwrap();
        assert!((sum.ends[1] - 0.196).abs() < 2e-3 && (sum.ends[0] + 0.196).abs() < 2e-3, "{sum:?}");
        let one = Interval::from_ends(&profile.ends_of_coordinate(&[best], 0, 0.1, &[1.0, -1.0]));
        assert_eq!((one.ends, one.bounded), ([-1.0, 1.0], [true, true]));
    }

    /// x² measured as 1 ± 0.1: from the minimum at 1 alone the one at -1 is out of reach.
    #[test]
    fn an_interval_reaches_over_every_valley_that_the_measurements_allow() {
        let residuals = |p: &[f64]| Some(vec![(p[0] * p[0] - 1.0) / 0.1]);
        let [best, other] = [1.0, -1.0].map(|x| Minimum { point: vec![x], chi2: 0.0 });
        let [near, far] = [0.804_f64, 1.196].map(f64::sqrt);
        let profile = Profile { residuals: &residuals, bounds: &[[-3.0, 3.0]], lowest: 0.0 };
        let across =
            |minima: &[Minimum]| Interval::from_ends(&profile.ends_of_coordinate(minima, 0, 0.05, &[1.0]));
        let alone = across(std::slice::from_ref(&best));
        assert!((alone.ends[0] - near).abs() < 2e-3 && (alone.ends[1] - far).abs() < 2e-3, "{alone:?}");
        let both = across(&[best, other]);
        assert!((both.ends[0] + far).abs() < 2e-3 && (both.ends[1] - far).abs() < 2e-3, "{both:?}");
    }
}
