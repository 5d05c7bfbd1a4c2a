//! Points put on the regular grid that they scatter about.

use super::even::{Step, last_digit};
use super::measured::MOST_NODES;
use rayon::prelude::*;

/// Largest distance of a point from its node, as a share of the step.
const LARGEST_SCATTER: f64 = 0.05;
/// The same of points whose places were rounded to so few digits, where lines of the grid are absent.
const LARGEST_ROUNDING: f64 = 0.3;
/// Nodes over points up to which a grid with absent lines is believed whose places were rounded.
const MOST_NODES_OF_ROUNDED: f64 = 1.3;
/// Scatter below which nothing is said of it: that of printed digits.
const SEEN_SCATTER: f64 = 1e-3;

/// Heights on a grid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Placed {
    /// Nodes along x.
    pub columns: usize,
    /// Nodes along y.
    pub rows: usize,
    /// Distance of nodes.
    pub step: [f64; 2],
    /// Share of it that the rounding of the places leaves open.
    pub error: f64,
    /// Heights row by row, NaN where no point is.
    pub heights: Vec<f64>,
    /// Changes that were made to the points.
    pub note: Option<String>,
}

/// Equally spaced coordinates.
struct Axis {
    low: f64,
    step: f64,
    count: usize,
    /// Half a unit of the last digit of the places, as a share of the step.
    rounding: f64,
    /// The places of all nodes as they were printed, where rounding moved them.
    rounded: Option<(Vec<f64>, Step)>,
}

/// The map through points x, y, z.
///
/// # Errors
/// Points that lie on a line or do not form a grid; the reason for the user.
pub(super) fn onto_grid(points: &[[f64; 3]]) -> Result<Placed, String> {
    if !points.iter().all(|p| p[0].is_finite() && p[1].is_finite()) {
        return Err("x and y must be finite numbers: leave out points without a place".into());
    }
    let (x, y) = (Axis::from_points(points, 0)?, Axis::from_points(points, 1)?);
    let count = (x.count as u64).saturating_mul(y.count as u64);
    // a grid with most of its nodes absent is a cloud of points
    if count >= MOST_NODES || count > 8 * points.len() as u64 {
        let (n, [nx, ny]) = (points.len(), [x.count, y.count]);
        return Err(cloud(&format!("{n} points would make a grid of {nx} x {ny}")));
    }
    let mut heights = vec![f64::NAN; count as usize];
    let mut farthest = 0.0f64;
    for p in points {
        let ((i, far_x), (j, far_y)) = (x.node(p[0]), y.node(p[1]));
        farthest = farthest.max(far_x).max(far_y);
        let node = j * x.count + i;
        if !heights[node].is_nan() && heights[node] != p[2] {
            return Err(cloud(&format!("two heights at x = {}, y = {}", p[0], p[1])));
        }
        heights[node] = p[2];
    }
    let [round_x, round_y] = [x.rounding, y.rounding].map(|r| if r < LARGEST_ROUNDING { r } else { 0.0 });
    // a place may miss by its rounding and by that of the ends
    let is_full = count as f64 <= MOST_NODES_OF_ROUNDED * points.len() as f64;
    let limit = if is_full { (2.0 * round_x.max(round_y)).max(LARGEST_SCATTER) } else { LARGEST_SCATTER };
    if farthest > limit {
        return Err(cloud(&format!(
            "a point is {:.0} % of a step away from its node, more than {:.0} %",
            100.0 * farthest,
            100.0 * limit
        )));
    }
    let share = |rounding: f64, count: usize| 2.0 * rounding / (count - 1).max(1) as f64;
    let of_ends =
        if farthest > SEEN_SCATTER { share(round_x, x.count).max(share(round_y, y.count)) } else { 0.0 };
    let of_rounded = [&x, &y].into_iter().flat_map(|axis| &axis.rounded).map(|(_, step)| step.error);
    let error = of_rounded.fold(of_ends, f64::max);
    let why = if farthest > SEEN_SCATTER {
        Some(format!("the farthest by {:.1} % of a step", 100.0 * farthest))
    } else {
        (error > 0.0)
            .then(|| format!("their places rounded so that steps are known to {:.2} %", 100.0 * error))
    };
    let note = why.map(|why| format!("points put on a grid of {} x {}, {why}", x.count, y.count));
    Ok(Placed { columns: x.count, rows: y.count, step: [x.step, y.step], error, heights, note })
}

fn cloud(why: &str) -> String {
    format!("the points do not form a regular grid along x and y ({why}): resample them first")
}

impl Axis {
    fn from_points(points: &[[f64; 3]], axis: usize) -> Result<Axis, String> {
        let mut values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        values.par_sort_unstable_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (values.first(), values.last()) else {
            return Err("the file holds no points".into());
        };
        if low == high {
            return Err(
                "all points lie on one line: this is a profile, a map has at least 2 x 2 points".into()
            );
        }
        let lines = lines_of(&values).ok_or_else(|| {
            let name = if axis == 0 { "x" } else { "y" };
            cloud(&format!("their {name} scatter by more than {:.0} % of a step", 100.0 * LARGEST_SCATTER))
        })?;
        // rounded places step by two lengths in turn
        if let Some(even) = Step::new(&lines).filter(|even| even.error > 0.0) {
            let (low, step, count) = (lines[0], even.length, lines.len());
            return Ok(Axis { low, step, count, rounding: 0.0, rounded: Some((lines, even)) });
        }
        let step = lines.windows(2).map(|l| l[1] - l[0]).fold(f64::INFINITY, f64::min);
        // the whole length over the number of steps is more exact than one step; lines may be absent
        let length = lines[lines.len() - 1] - lines[0];
        let steps = steps_between(&lines, step);
        let step = length / steps as f64;
        let rounding = last_digit(lines.iter().copied()).map_or(0.0, |unit| 0.5 * unit / step);
        Ok(Axis { low: lines[0], step, count: steps + 1, rounding, rounded: None })
    }

    /// The nearest node and how far it is, as a share of the step.
    fn node(&self, value: f64) -> (usize, f64) {
        if let Some((lines, _)) = &self.rounded {
            let after = lines.partition_point(|line| *line < value).min(lines.len() - 1);
            let before = after.saturating_sub(1);
            let far = |node: usize| (lines[node] - value).abs() / self.step;
            let node = if far(before) < far(after) { before } else { after };
            return (node, far(node));
        }
        let place = (value - self.low) / self.step;
        let node = place.round().clamp(0.0, (self.count - 1) as f64);
        (node as usize, (place - node).abs())
    }
}

/// Number of steps from the first line to the last, counted from line to line.
fn steps_between(lines: &[f64], step: f64) -> usize {
    lines.windows(2).map(|l| ((l[1] - l[0]) / step).round().max(1.0) as usize).fold(0, usize::saturating_add)
}

/// Middle of each group of sorted values, where the groups are narrow against their distance.
fn lines_of(sorted: &[f64]) -> Option<Vec<f64>> {
    let gap = |i: usize| sorted[i] - sorted[i - 1];
    let mut limit = f64::INFINITY;
    // the widest gap may be several steps: halve it until the groups are narrow
    for _ in 0..64 {
        let widest = (1..sorted.len()).map(gap).filter(|g| *g <= limit).fold(0.0, f64::max);
        if widest <= 0.0 {
            return None;
        }
        limit = 0.5 * widest;
        let (mut lines, mut spread, mut start) = (Vec::new(), 0.0f64, 0);
        for end in 1..=sorted.len() {
            if end == sorted.len() || gap(end) > limit {
                spread = spread.max(sorted[end - 1] - sorted[start]);
                lines.push(0.5 * (sorted[end - 1] + sorted[start]));
                start = end;
            }
        }
        let step = lines.windows(2).map(|l| l[1] - l[0]).fold(f64::INFINITY, f64::min);
        if lines.len() > 1 && spread <= 2.0 * LARGEST_SCATTER * step {
            return Some(lines);
        }
    }
    None
}
