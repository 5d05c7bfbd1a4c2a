//! The quadratic spline nearest to points in the sense of least squares, tangent everywhere but at its kinks.

use super::Parabola;
use super::bands::Bands;

/// A point at which one arc ends and the next begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Break {
    /// Its place.
    pub x: f64,
    /// Index of the point there.
    pub point: usize,
    /// True where the slope may jump there.
    pub kink: bool,
}

/// Weight of the bend of an arc beside the points, so that an arc without points in it is straight.
const STIFFNESS: f64 = 1e-10;

/// Knots of the spline: ends three times, kinks twice.
fn knots(breaks: &[Break]) -> Vec<f64> {
    let last = breaks.len() - 1;
    let times = |i: usize, b: &Break| if i == 0 || i == last { 3 } else { 1 + usize::from(b.kink) };
    breaks.iter().enumerate().flat_map(|(i, b)| std::iter::repeat_n(b.x, times(i, b))).collect()
}

/// Values at `x` of the three basis functions over the knot span `k`, the first of which is number k - 2.
fn basis(t: &[f64], k: usize, x: f64) -> [f64; 3] {
    let w = |i: usize, p: usize| (x - t[i]) / (t[i + p] - t[i]);
    let (a, b, c) = (w(k, 1), w(k - 1, 2), w(k, 2));
    [(1.0 - a) * (1.0 - b), (1.0 - a) * b + a * (1.0 - c), a * c]
}

/// Derivatives of the spline at both ends of the span `k` as rows of its three coefficients.
fn slopes(t: &[f64], k: usize) -> [[f64; 3]; 2] {
    let (left, right) = (2.0 / (t[k + 1] - t[k - 1]), 2.0 / (t[k + 2] - t[k]));
    [[-left, left, 0.0], [0.0, -right, right]]
}

/// The arcs between `breaks` nearest to `points` (height over place); `level`: the slope at the left end is
/// 0. `None` where the points do not determine them.
pub fn fit(points: &[[f64; 2]], breaks: &[Break], level: bool) -> Option<Vec<Parabola>> {
    let t = knots(breaks);
    let shift = usize::from(level);
    let unknown = |i: usize| i.max(shift) - shift;
    let mut bands = Bands::new(t.len() - 3 - shift);
    let spans: Vec<usize> = (2..t.len() - 3).filter(|&k| t[k] < t[k + 1]).collect();
    let row = |k: usize, entries: [f64; 3]| [0, 1, 2].map(|i| (unknown(k - 2 + i), entries[i]));
    for (span, pair) in spans.iter().zip(breaks.windows(2)) {
        let end = if pair[1].point + 1 == points.len() { points.len() } else { pair[1].point };
        for p in &points[pair[0].point..end] {
            bands.add(&row(*span, basis(&t, *span, p[0])), p[1], 1.0);
        }
    }
    let stiffness = STIFFNESS * bands.scale();
    for &k in &spans {
        let [from, to] = slopes(&t, k);
        let bend = [0, 1, 2].map(|i| (to[i] - from[i]) * (t[k + 1] - t[k]));
        bands.add(&row(k, bend), 0.0, stiffness);
    }
    let c = bands.solve()?;
    let arc = |&k: &usize| {
        let near = [0, 1, 2].map(|i| c[unknown(k - 2 + i)]);
        let sum = |row: [f64; 3]| row.iter().zip(near).map(|(a, c)| a * c).sum::<f64>();
        let [from, to] = slopes(&t, k).map(sum);
        let bend = 0.5 * (to - from) / (t[k + 1] - t[k]);
        Parabola { x: t[k], drop: sum(basis(&t, k, t[k])), slope: from, bend }
    };
    Some(spans.iter().map(arc).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_curve_of_arcs_comes_back_with_its_kink() {
        let truth = |x: f64| {
            if x < 2.0 {
                0.25 * x * x
            } else if x < 3.0 {
                1.0 + (x - 2.0)
            } else {
                2.0 - 0.5 * (x - 3.0)
            }
        };
        let points: Vec<[f64; 2]> =
            (0..=50).map(|i| [0.1 * f64::from(i), truth(0.1 * f64::from(i))]).collect();
        let at = |point: usize, kink| Break { x: points[point][0], point, kink };
        let breaks = [at(0, false), at(20, false), at(30, true), at(50, false)];
        let arcs = fit(&points, &breaks, true).unwrap();
        let expected = [[0.0, 0.0, 0.25], [1.0, 1.0, 0.0], [2.0, -0.5, 0.0]];
        for (arc, [drop, slope, bend]) in arcs.iter().zip(expected) {
            assert!((arc.drop - drop).abs() < 1e-8 && (arc.slope - slope).abs() < 1e-7, "{arc:?}");
            assert!((arc.bend - bend).abs() < 1e-7, "{arc:?}");
        }
    }
}
