//! Interpolation between points of rising x, and the correlation of places.

/// Correlation of two places a distance `apart` of each other, alike over `length`.
pub fn alike(apart: f64, length: f64) -> f64 {
    (-0.5 * (apart / length).powi(2)).exp()
}

/// Linear between `points` of rising x, and on beyond their ends.
pub fn linear_between(points: &[[f64; 2]], x: f64) -> f64 {
    let Some(last) = points.len().checked_sub(2) else { return points.first().map_or(f64::NAN, |p| p[1]) };
    let k = points[1..=last].iter().take_while(|p| p[0] <= x).count();
    let ([x0, y0], [x1, y1]) = (points[k], points[k + 1]);
    if x1 == x0 { y0 } else { y0 + (x - x0) / (x1 - x0) * (y1 - y0) }
}

/// A cubic through the four of `points` of rising x around `x`; linear where there are fewer, and beyond
/// their ends.
pub fn smooth(points: &[[f64; 2]], x: f64) -> f64 {
    let count = points.len();
    let beyond = |p: &[f64; 2], sign: f64| sign * (x - p[0]) > 0.0;
    if count < 4 || beyond(&points[count - 1], 1.0) || beyond(&points[0], -1.0) {
        return linear_between(points, x);
    }
    let k = points.iter().take_while(|p| p[0] <= x).count();
    let four = &points[k.saturating_sub(2).min(count - 4)..][..4];
    let weight = |i: usize| {
        let others = (0..4).filter(|&j| j != i);
        others.map(|j| (x - four[j][0]) / (four[i][0] - four[j][0])).product::<f64>()
    };
    (0..4).map(|i| weight(i) * four[i][1]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cubic_is_met_between_points_and_left_along_a_line() {
        let cubic = |x: f64| 1.0 + x * (0.5 + x * (0.3 - 0.2 * x));
        let points = [-1.0, -0.4, 0.1, 0.5, 1.2, 2.0].map(|x| [x, cubic(x)]);
        for x in [-1.0, -0.7, 0.0, 0.3, 0.8, 1.9, 2.0] {
            assert!((smooth(&points, x) - cubic(x)).abs() < 1e-12, "{x}");
        }
        assert_eq!(smooth(&points, 3.0), linear_between(&points, 3.0));
        assert_eq!(smooth(&points[..1], 3.0), points[0][1]);
    }

    #[test]
    fn values_between_points_and_beyond_them_lie_on_straight_lines() {
        let points = [[0.0, 0.0], [1.0, 2.0], [3.0, 3.0]];
        let at = |x| linear_between(&points, x);
        assert_eq!([at(0.5), at(1.0), at(2.0), at(4.0), at(-1.0)], [1.0, 2.0, 2.5, 3.5, -2.0]);
        assert_eq!(linear_between(&points[..1], 7.0), 0.0);
    }
}
