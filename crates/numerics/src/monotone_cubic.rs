//! Smooth curves through points that rise, without a bend that the points do not have.
//!
//! Source: F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238: a piece of a cubic Hermite curve
//! rises if neither of its slopes is more than three times that of its chord.

/// Slopes so many times the chord's keep a piece rising.
const STEEPEST: f64 = 3.0;

/// A cubic Hermite curve through points of rising x and y.
#[derive(Clone, Debug, PartialEq)]
pub struct MonotoneCubic {
    nodes: Vec<[f64; 3]>,
}

impl MonotoneCubic {
    /// Through nodes (x, y, dy/dx), x rising and y not falling, their slopes lowered where the curve would
    /// not rise; None of fewer than two.
    ///
    /// ```
    /// use asperity_numerics::monotone_cubic::MonotoneCubic;
    /// let square = MonotoneCubic::with_slopes(vec![[0.0, 0.0, 0.0], [1.0, 1.0, 2.0]]).unwrap();
    /// assert_eq!(square.value_and_slope(0.5), [0.25, 1.0]);
    /// ```
    pub fn with_slopes(mut nodes: Vec<[f64; 3]>) -> Option<MonotoneCubic> {
        if nodes.len() < 2 {
            return None;
        }
        for i in 1..nodes.len() {
            let chord = chord(&nodes[i - 1..=i]);
            for k in [i - 1, i] {
                nodes[k][2] = nodes[k][2].min(STEEPEST * chord);
            }
        }
        Some(MonotoneCubic { nodes })
    }

    /// Through points (x, y), with the slopes of the parabolas through three neighbours, at the ends of the
    /// first and the last three; else as [`MonotoneCubic::with_slopes`].
    pub fn through_points(points: &[[f64; 2]]) -> Option<MonotoneCubic> {
        let node = |i: usize| {
            let first = i.saturating_sub(1).min(points.len().saturating_sub(3));
            let [x, y] = points[i];
            let slope = match points[first..].get(..3) {
                Some(three) => slope_of_parabola(three, x),
                None => chord(points),
            };
            [x, y, slope.max(0.0)]
        };
        MonotoneCubic::with_slopes((0..points.len()).map(node).collect())
    }

    /// Its nodes (x, y, dy/dx).
    pub fn nodes(&self) -> &[[f64; 3]] {
        &self.nodes
    }

    /// y and dy/dx at `x`; beyond the ends that of the cubic which ends there.
    pub fn value_and_slope(&self, x: f64) -> [f64; 2] {
        let i = self.nodes.partition_point(|node| node[0] <= x).clamp(1, self.nodes.len() - 1);
        let (a, b) = (self.nodes[i - 1], self.nodes[i]);
        let width = b[0] - a[0];
        let t = (x - a[0]) / width;
        let (m, n) = (a[2] * width, b[2] * width);
        let rise = b[1] - a[1];
        let (c, d) = (3.0 * rise - 2.0 * m - n, m + n - 2.0 * rise);
        [a[1] + t * (m + t * (c + t * d)), (m + t * (2.0 * c + 3.0 * t * d)) / width]
    }
}

/// The slope of the line between the first two of `points`; 0 of one.
fn chord<const N: usize>(points: &[[f64; N]]) -> f64 {
    match points {
        [a, b, ..] => (b[1] - a[1]) / (b[0] - a[0]),
        _ => 0.0,
    }
}

/// The slope at `x` of the parabola through three points.
fn slope_of_parabola(three: &[[f64; 2]], x: f64) -> f64 {
    let (first, second) = (chord(&three[..2]), chord(&three[1..]));
    let bend = (second - first) / (three[2][0] - three[0][0]);
    first + bend * (2.0 * x - three[0][0] - three[1][0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Claims: the curve goes through its points, is a parabola where they lie on one, and rises where they
    /// do, on either side of a step. Tolerance: rounding.
    #[test]
    fn a_parabola_is_met_and_a_step_is_not_overshot() {
        let parabola: Vec<[f64; 2]> = [1.0, 1.5, 2.5, 3.0, 4.5].map(|x: f64| [x, x * x]).to_vec();
        let curve = MonotoneCubic::through_points(&parabola).unwrap();
        for i in 0..=70 {
            let x = 1.0 + 0.05 * f64::from(i);
            let [y, slope] = curve.value_and_slope(x);
            assert!((y - x * x).abs() < 1e-12 && (slope - 2.0 * x).abs() < 1e-12, "{x}: {y} {slope}");
        }
        let step = [[0.0, 0.0], [1.0, 0.01], [2.0, 0.02], [3.0, 5.0], [4.0, 5.01], [5.0, 5.02]];
        let curve = MonotoneCubic::through_points(&step).unwrap();
        let values: Vec<f64> = (0..=500).map(|i| curve.value_and_slope(0.01 * f64::from(i))[0]).collect();
        assert!(values.windows(2).all(|two| two[1] >= two[0]));
        assert!(step.iter().all(|[x, y]| (curve.value_and_slope(*x)[0] - y).abs() < 1e-12));
        assert_eq!(MonotoneCubic::through_points(&step[..1]), None);
        assert_eq!(
            MonotoneCubic::through_points(&[[0.0, 1.0], [2.0, 5.0]]).unwrap().value_and_slope(1.0),
            [3.0, 2.0]
        );
    }
}
