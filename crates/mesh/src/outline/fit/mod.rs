//! From points that an instrument measured to an outline: smoothed as far as they scatter, with as few arcs
//! as hold them, its corners kept.

use super::bridge::{bridge, bulges};
use super::kinks::corners;
use super::residuals::{scatter, stretches_too_far};
use super::spline::{Break, fit as nearest};
use super::{Outline, Parabola, deepest_dent};

/// Part of the section that the points cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Span {
    /// Half of a symmetric section, from the axis outward.
    Half,
    /// A whole section, from left to right.
    Whole,
}

/// An outline with what it leaves of its points. Any unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// The curve: drop from the highest point of the fit, at its place among the points.
    pub outline: Outline,
    /// Height of its highest point as the points count it.
    pub summit: f64,
    /// Standard deviation of the heights about the curve that was allowed for.
    pub tolerance: f64,
    /// Greatest distance of a point from the curve.
    pub farthest: f64,
    /// Places of the corners.
    pub corners: Vec<f64>,
}

/// The reason why points are no outline.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{message}")]
pub struct FitError {
    /// Index of the point; `None`: all of them.
    pub point: Option<usize>,
    /// The fault and a way out.
    pub message: String,
}

/// Least tolerance over the height of the outline.
const MIN_TOLERANCE: f64 = 1e-6;

/// Most points of an outline.
pub const MOST_POINTS: usize = 20_000;

/// Rounds of division: each may halve every arc.
const MOST_ROUNDS: usize = 24;

/// Points from which neighbours tell how far heights scatter; fewer are drawn by hand, and meant as they
/// stand.
const SCATTERED_POINTS: usize = 20;

/// Largest distance of the first point from the axis, in spacings of the points.
const FIRST_POINT_SPACINGS: f64 = 1.5;

/// The outline through `points` (place, height), whose heights scatter by `tolerance` (standard deviation);
/// `None`: as far as neighbouring points tell.
///
/// # Errors
/// Fewer than two points or too many, a value that is not finite, places that do not grow, a half that does
/// not begin at the axis, no height.
pub fn fit(points: &[[f64; 2]], span: Span, tolerance: Option<f64>) -> Result<Fit, FitError> {
    check(points, span)?;
    let [low, high] = range(points.iter().map(|p| p[1]));
    let (left, width, height) = match span {
        Span::Half => (0.0, points[points.len() - 1][0], high - low),
        Span::Whole => (points[0][0], points[points.len() - 1][0] - points[0][0], high - low),
    };
    let unit: Vec<[f64; 2]> = points.iter().map(|p| [(p[0] - left) / width, (p[1] - low) / height]).collect();
    let whole = unfolded(&unit, span);
    let told = || if points.len() < SCATTERED_POINTS { 0.0 } else { scatter(&whole) };
    let tolerance = tolerance.map_or_else(told, |t| t / height).max(MIN_TOLERANCE);
    let skipped = whole.len() - unit.len();
    let found = corners(&whole, tolerance, height / width);
    let kinks: Vec<usize> = found.iter().filter_map(|i| i.checked_sub(skipped)).collect();
    let tip = span == Span::Half && kinks.contains(&0);
    let level = span == Span::Half && !tip;
    let arcs = smoothed(&unit, &kinks, level, tolerance)?;
    let farthest = farthest(&unit, &arcs).0 * height;
    let physical = |a: &Parabola| Parabola {
        x: left + a.x * width,
        drop: -a.drop * height,
        slope: -a.slope * height / width,
        bend: -a.bend * height / (width * width),
    };
    let curve = Outline::new(arcs.iter().map(physical).collect(), left + width, span == Span::Half);
    let curve = curve.ok_or_else(|| FitError {
        point: None,
        message: "lie too close together to be told apart: give points further apart".into(),
    })?;
    let top = curve.summit()[1];
    Ok(Fit {
        outline: curve.seen_from(0.0, top),
        summit: low - top,
        tolerance: tolerance * height,
        farthest,
        corners: kinks.iter().map(|&i| if i == 0 && tip { 0.0 } else { points[i][0] }).collect(),
    })
}

/// The arcs that stand for `points`, both over the size of the outline.
fn smoothed(
    points: &[[f64; 2]],
    kinks: &[usize],
    level: bool,
    scatter: f64,
) -> Result<Vec<Parabola>, FitError> {
    let most = MAX_DISTANCE.max(MISSED_TOLERANCES * scatter);
    let bulging = bulges(points, level);
    let mut missed = 0;
    for fewest in MIN_ARC_SPACINGS {
        let arcs = Points { points, kinks, level, scatter, fewest }.arcs();
        let Some(arcs) = arcs.filter(|arcs| !(bulging && dented(arcs))) else { continue };
        let (distance, point) = farthest(points, &arcs);
        missed = point;
        if distance <= COARSE_DISTANCE.max(MISSED_TOLERANCES * scatter) || (fewest == 1 && distance <= most) {
            return Ok(arcs);
        }
    }
    if bulging {
        return Ok(bridge(points, kinks, level));
    }
    Err(FitError {
        point: Some(missed),
        message: "lies off the smooth curve through its neighbours: measure more points where the outline turns, leave out an outlier, or smooth it away with a greater `tolerance`"
            .into(),
    })
}

/// True where arcs through points that bulge outward are dented.
fn dented(arcs: &[Parabola]) -> bool {
    let upside_down = |a: &Parabola| Parabola { drop: -a.drop, slope: -a.slope, bend: -a.bend, ..*a };
    let outline = Outline::new(arcs.iter().map(upside_down).collect(), 1.0, false);
    outline.is_none_or(|outline| deepest_dent(&outline).depth > DENT_DEPTH)
}

/// The greatest distance of a point from arcs, and its index.
fn farthest(points: &[[f64; 2]], arcs: &[Parabola]) -> (f64, usize) {
    let distance = |p: &[f64; 2]| (p[1] - value(arcs, p[0])).abs();
    let all = points.iter().map(distance).zip(0..);
    all.fold((0.0, 0), |far, next| if next.0 > far.0 { next } else { far })
}

/// True where the points can be an outline.
fn check(points: &[[f64; 2]], span: Span) -> Result<(), FitError> {
    let at = |point: usize, message: String| FitError { point: Some(point), message };
    let all = |message: String| FitError { point: None, message };
    if points.len() < 2 || points.len() > MOST_POINTS {
        return Err(all(format!(
            "must be from 2 to {MOST_POINTS} points, not {}: {}",
            points.len(),
            if points.len() < 2 { "give the whole outline" } else { "thin them out, or cut a part out" }
        )));
    }
    if let Some(i) = points.iter().position(|p| !(p[0].is_finite() && p[1].is_finite())) {
        return Err(at(i, "must be finite numbers: leave out points that were not measured".into()));
    }
    if let Some(i) = (1..points.len()).find(|&i| points[i][0] <= points[i - 1][0]) {
        return Err(at(
            i,
            "must lie further out than the point before it: sort the points; an outline that overhangs or stands upright cannot be meshed, cut it off or average over it"
                .into(),
        ));
    }
    if span == Span::Half {
        let (first, spacing) = (points[0][0], points[1][0] - points[0][0]);
        if first < 0.0 {
            return Err(at(0, "lies on the other side of the axis: a body of revolution takes half of a section, from 0 outward".into()));
        }
        if first > FIRST_POINT_SPACINGS * spacing {
            return Err(at(
                0,
                "must be on the axis, at 0: what lies inside is not known; count the places from the axis"
                    .into(),
            ));
        }
    }
    let [low, high] = range(points.iter().map(|p| p[1]));
    let width = points[points.len() - 1][0] - points[0][0];
    if !(high - low > 1e-9 * width && (high - low).is_finite()) {
        return Err(all("have all the same height: an outline rises or falls".into()));
    }
    Ok(())
}

fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
}

/// Both halves of a symmetric section, with a point on its axis; a whole one as it is.
fn unfolded(points: &[[f64; 2]], span: Span) -> Vec<[f64; 2]> {
    if span == Span::Whole {
        return points.to_vec();
    }
    let beside = if points[0][0] == 0.0 { &points[1..] } else { points };
    let image = beside.iter().rev().map(|p| [-p[0], p[1]]);
    image.chain(points.iter().copied()).collect()
}

/// Points to be smoothed: heights over places of 0 to 1, with what is known of them.
struct Points<'a> {
    points: &'a [[f64; 2]],
    kinks: &'a [usize],
    /// True where the slope at the left end is 0.
    level: bool,
    scatter: f64,
    /// Spacings of points on an arc, at least.
    fewest: usize,
}

/// Arcs between stops, what they leave of the points and the sum of its squares.
struct Trial {
    arcs: Vec<Parabola>,
    residuals: Vec<f64>,
    squares: f64,
}

impl Points<'_> {
    fn trial(&self, stops: &[usize]) -> Option<Trial> {
        let place = |point: usize| if point == 0 && self.level { 0.0 } else { self.points[point][0] };
        let stop = |&point: &usize| Break { x: place(point), point, kink: self.kinks.contains(&point) };
        let breaks: Vec<Break> = stops.iter().map(stop).collect();
        let arcs = nearest(self.points, &breaks, self.level)?;
        let residuals: Vec<f64> = self.points.iter().map(|p| p[1] - value(&arcs, p[0])).collect();
        let squares = residuals.iter().map(|r| r * r).sum();
        Some(Trial { arcs, residuals, squares })
    }

    /// The fewest arcs found that leave nothing but scatter.
    fn arcs(&self) -> Option<Vec<Parabola>> {
        let mut stops = self.divided()?;
        let work = stops.len() * self.points.len();
        for _ in 0..PASSES {
            if work > MOST_WORK {
                break;
            }
            self.move_stops(&mut stops);
            self.drop_stops(&mut stops);
        }
        self.trial(&stops).map(|trial| trial.arcs)
    }

    /// Stops from halving arcs until they miss no more than scatter, or have no points left to be halved.
    fn divided(&self) -> Option<Vec<usize>> {
        let last = self.points.len() - 1;
        let mut stops: Vec<usize> = self.kinks.iter().copied().filter(|i| (1..last).contains(i)).collect();
        stops.insert(0, 0);
        stops.push(last);
        for _ in 0..MOST_ROUNDS {
            let residuals = self.trial(&stops)?.residuals;
            let far = stretches_too_far(&residuals, self.scatter);
            let mut halves: Vec<usize> =
                far.iter().filter_map(|s| division(&stops, *s, self.fewest)).collect();
            halves.sort_unstable();
            halves.dedup();
            if halves.is_empty() {
                break;
            }
            stops.extend(halves);
            stops.sort_unstable();
        }
        Some(stops)
    }

    /// Moves each stop that is no kink to where less is left, in steps that are halved.
    fn move_stops(&self, stops: &mut [usize]) {
        let Some(mut best) = self.trial(stops).map(|t| t.squares) else { return };
        for i in 1..stops.len() - 1 {
            let (low, high) = (stops[i - 1] + self.fewest, stops[i + 1] - self.fewest);
            let mut step = (stops[i + 1] - stops[i - 1]) / 4;
            while step > 0 && !self.kinks.contains(&stops[i]) {
                let from = stops[i];
                for to in [from.saturating_sub(step), from + step] {
                    if !(low..=high).contains(&to) {
                        continue;
                    }
                    let before = std::mem::replace(&mut stops[i], to);
                    match self.trial(stops) {
                        Some(trial) if trial.squares < best => best = trial.squares,
                        _ => stops[i] = before,
                    }
                }
                if stops[i] == from {
                    step /= 2;
                }
            }
        }
    }

    /// Takes out stops without which nothing but scatter is left either.
    fn drop_stops(&self, stops: &mut Vec<usize>) {
        let mut i = 1;
        while i + 1 < stops.len() {
            let stop = stops.remove(i);
            let without = self.trial(stops).filter(|_| !self.kinks.contains(&stop));
            let enough = without.is_some_and(|t| stretches_too_far(&t.residuals, self.scatter).is_empty());
            if !enough {
                stops.insert(i, stop);
                i += 1;
            }
        }
    }
}

/// Spacings of points on an arc, at least: with two a curve does not swing between its points. Points too far
/// apart for that may have an arc each.
const MIN_ARC_SPACINGS: [usize; 2] = [2, 1];

/// Distance of a point from the curve over the height of the outline from which points count as too far
/// apart, and the most that may be left; or so many tolerances.
const COARSE_DISTANCE: f64 = 1e-3;
const MAX_DISTANCE: f64 = 0.01;
const MISSED_TOLERANCES: f64 = 6.0;

/// Dent over the height of the outline that is rounding.
const DENT_DEPTH: f64 = 1e-5;

/// Times that stops are moved and dropped, and the number of stops times points up to which that is done.
const PASSES: usize = 2;
const MOST_WORK: usize = 100_000;

/// The places at which to divide the arc that holds the middle of a stretch, or the longest that shares
/// points with it; at least two spacings are left on either side.
fn division(stops: &[usize], [from, to]: [usize; 2], fewest: usize) -> Option<usize> {
    let middle = (from + to) / 2;
    let arcs = || stops.windows(2).map(|p| [p[0], p[1]]).filter(|[a, b]| b - a >= 2 * fewest);
    let halved = |[a, b]: [usize; 2]| (a + b) / 2;
    arcs()
        .find(|[a, b]| (*a..*b).contains(&middle))
        .or_else(|| arcs().filter(|[a, b]| *a <= to && *b >= from).max_by_key(|[a, b]| b - a))
        .map(halved)
}

/// Height of arcs at `x`.
fn value(arcs: &[Parabola], x: f64) -> f64 {
    arcs[arcs.partition_point(|a| a.x <= x).saturating_sub(1)].drop_at(x)
}

#[cfg(test)]
mod tests;
