//! Points at which an outline has a corner: parabolas through its neighbours on either side meet there at an
//! angle that neither the scatter nor their own curvature explains.

use super::bands::Bands;

/// Points taken on either side, in turn: few find a corner near another, many one in scatter.
const WINDOWS: [usize; 8] = [3, 4, 6, 8, 12, 16, 24, 32];

/// Standard errors by which the angle must exceed 0.
const SIGNIFICANT_ERRORS: f64 = 6.0;

/// Least turn of a corner over the turn of a smooth curve over one point.
const CORNER_TURN_RATIO: f64 = 3.0;

/// Share of what a corner moves over one point that the parabolas may miss.
const MISSED_SHARE: f64 = 0.02;

/// Jumps of slope below this are none.
const MIN_SLOPE_JUMP: f64 = 0.005;

/// A parabola a + b t + c t² through points on one side of a place, t counted from there.
struct Side {
    value: f64,
    slope: f64,
    bend: f64,
    /// Variances of value and slope over that of the scatter.
    variance: [f64; 2],
    /// Sum of the squares of what it misses, and how many points it has beyond its three numbers.
    missed: f64,
    spare: f64,
}

impl Side {
    fn new(points: &[[f64; 2]], place: f64) -> Option<Side> {
        let reach = points.iter().fold(0.0, |m: f64, p| m.max((p[0] - place).abs()));
        let row = |x: f64| {
            let t = (x - place) / reach;
            [(0, 1.0), (1, t), (2, t * t)]
        };
        let normal = |unit: Option<usize>| {
            let mut bands = Bands::new(3);
            for p in points {
                bands.add(&row(p[0]), if unit.is_some() { 0.0 } else { p[1] }, 1.0);
            }
            if let Some(i) = unit {
                bands.load(i);
            }
            bands.solve()
        };
        let (c, first, second) = (normal(None)?, normal(Some(0))?, normal(Some(1))?);
        let at = |x: f64| row(x).iter().map(|(i, a)| a * c[*i]).sum::<f64>();
        Some(Side {
            value: c[0],
            slope: c[1] / reach,
            bend: c[2] / (reach * reach),
            variance: [first[0], second[1] / (reach * reach)],
            missed: points.iter().map(|p| (p[1] - at(p[0])).powi(2)).sum(),
            spare: points.len() as f64 - 3.0,
        })
    }
}

/// The number of standard errors by which the angle at point `i` exceeds 0, if it is a corner as `window`
/// points on either side see it.
fn corner(points: &[[f64; 2]], i: usize, window: usize, scatter: f64, least: f64) -> Option<f64> {
    let (from, to) = (i.checked_sub(window)?, i + window);
    if to >= points.len() {
        return None;
    }
    let place = points[i][0];
    let (left, right) = (Side::new(&points[from..=i], place)?, Side::new(&points[i..=to], place)?);
    let jump = (right.slope - left.slope).abs();
    let error = scatter * (left.variance[1] + right.variance[1]).sqrt();
    let spacing = (place - points[i - 1][0]).max(points[i + 1][0] - place);
    let missed = ((left.missed + right.missed) / (left.spare + right.spare)).sqrt();
    let turn = 2.0 * (left.bend.abs() + right.bend.abs()) * spacing;
    let apart = (right.value - left.value).abs();
    let meets = scatter * SIGNIFICANT_ERRORS * (left.variance[0] + right.variance[0]).sqrt();
    let holds = jump > least
        && jump > SIGNIFICANT_ERRORS * error
        && jump > CORNER_TURN_RATIO * turn
        && missed <= (1.5 * scatter).max(MISSED_SHARE * jump * spacing)
        && apart <= meets.max(5.0 * MISSED_SHARE * jump * spacing);
    holds.then(|| jump / error)
}

/// Indices of the corners of `points`, in order; `scatter` is that of their heights (above 0), `steepness`
/// what a slope of 1 is in their units.
pub fn corners(points: &[[f64; 2]], scatter: f64, steepness: f64) -> Vec<usize> {
    let least = MIN_SLOPE_JUMP / steepness;
    let best = |i: usize| {
        WINDOWS
            .iter()
            .filter_map(|&w| corner(points, i, w, scatter, least).map(|sure| (sure, i, w)))
            .max_by(|a, b| a.0.total_cmp(&b.0))
    };
    let mut found: Vec<(f64, usize, usize)> = (0..points.len()).filter_map(best).collect();
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut taken: Vec<(usize, usize)> = Vec::new();
    for (_, i, window) in found {
        // a neighbour of a corner sees it too
        if taken.iter().all(|&(j, w)| i.abs_diff(j) > w.max(window)) {
            taken.push((i, window));
        }
    }
    let mut corners: Vec<usize> = taken.into_iter().map(|(i, _)| i).collect();
    corners.sort_unstable();
    corners
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(count: usize, f: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        (0..=count).map(|i| i as f64 / count as f64).map(|x| [x, f(x)]).collect()
    }

    #[test]
    fn a_corner_is_found_and_a_round_tip_is_none() {
        let roof = points(60, |x| 0.3 * (x - 0.5).abs());
        assert_eq!(corners(&roof, 1e-6, 1.0), [30]);
        let ball = points(60, |x| (1.0 - (x - 0.5).powi(2)).sqrt());
        assert_eq!(corners(&ball, 1e-6, 1.0), [0; 0]);
        // cone with a round tip, of which the tip is four points wide on either side
        let tip = points(60, |x| {
            let d = (x - 0.5).abs();
            if d < 1.0 / 15.0 { 0.5 * d * d * 15.0 * 0.3 } else { 0.3 * (d - 1.0 / 30.0) }
        });
        assert_eq!(corners(&tip, 1e-6, 1.0), [0; 0]);
    }
}
