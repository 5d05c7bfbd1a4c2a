//! A loading curve between its increments, without its ripple, and against another: how errors are measured.

use crate::record::rows::{CurveRow, Phase};
use crate::setup::discretisation::LEAST_COUNTED_DEPTH;
use asperity_numerics::least_squares::{powers, solve, value};

/// A quantity that grows with the depth while loading, force or contact area, in the unit it was given.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Depth and square root of the value at each increment: √F is nearly linear in h for a cone.
    points: Vec<[f64; 2]>,
}

impl Curve {
    /// A curve through points (depth, value) of growing depth; negative values are left out.
    pub fn new(points: impl IntoIterator<Item = [f64; 2]>) -> Curve {
        let points = points.into_iter().filter(|p| p[1] >= 0.0).map(|[h, v]| [h, v.sqrt()]).collect();
        Curve { points }
    }

    /// The force of the loading rows.
    pub fn force(rows: &[CurveRow]) -> Curve {
        Curve::new(rows.iter().filter(|r| r.phase == Phase::Load).map(|r| [r.depth, r.force]))
    }

    /// The last depth.
    pub fn end(&self) -> f64 {
        self.points.last().map_or(0.0, |p| p[0])
    }

    /// The value at `depth`: the cubic in √value through the four nearest increments, whose error is far
    /// below the curve's own. NaN outside the curve.
    pub fn value(&self, depth: f64) -> f64 {
        interpolated(&self.points, depth, |x| x).powi(2)
    }

    /// The logarithm of the value at `depth`: the cubic in the logarithms through the four nearest
    /// increments with a value, exact for powers of the depth however far the increments are apart. NaN
    /// outside the curve.
    pub fn logarithm_at(&self, depth: f64) -> f64 {
        let first = self.points.partition_point(|p| p[0] <= 0.0 || p[1] <= 0.0);
        2.0 * interpolated(&self.points[first..], depth, f64::ln)
    }

    /// The first depth at which the value is reached, linear in √value between increments; `None` if it never
    /// is.
    pub fn depth_of(&self, value: f64) -> Option<f64> {
        let root = value.sqrt();
        let after = self.points.iter().position(|p| p[1] >= root)?;
        let [h1, v1] = self.points[after];
        let [h0, v0] = if after > 0 { self.points[after - 1] } else { [0.0, 0.0] };
        Some(if v1 > v0 { h0 + (h1 - h0) * (root - v0) / (v1 - v0) } else { h1 })
    }

    /// The relative differences from `reference`, over depths of 0.2 to 1 of `peak`.
    pub fn differences(&self, reference: impl Fn(f64) -> f64, peak: f64) -> impl Iterator<Item = f64> {
        (0..=160).map(move |i| {
            let depth = peak * (LEAST_COUNTED_DEPTH + (1.0 - LEAST_COUNTED_DEPTH) * f64::from(i) / 160.0);
            self.value(depth) / reference(depth) - 1.0
        })
    }

    /// The largest of the [`differences`](Self::differences); NaN where either curve does not reach.
    pub fn worst_difference(&self, reference: impl Fn(f64) -> f64, peak: f64) -> f64 {
        let larger = |m: f64, d: f64| if d.is_nan() { d } else { m.max(d.abs()) };
        self.differences(reference, peak).fold(0.0, |m, d| if m.is_nan() { m } else { larger(m, d) })
    }

    /// The mean of the [`differences`](Self::differences): the remainder is bias, the ripple averages out.
    pub fn mean_difference(&self, reference: impl Fn(f64) -> f64, peak: f64) -> f64 {
        self.differences(reference, peak).sum::<f64>() / 161.0
    }

    /// Least squares over depths of 0.15 to 1 of `peak`, equally spaced in the logarithm.
    pub fn smooth(&self, peak: f64) -> Smooth {
        let from = 0.15_f64.ln();
        let row = |i: i32| {
            let x = from * (1.0 - f64::from(i) / 400.0);
            (powers(x), self.value(peak * x.exp()).ln(), 1.0)
        };
        let rows: Vec<([f64; CURVE_TERMS], f64, f64)> = (0..=400).map(row).collect();
        Smooth { peak, coefficients: solve(&rows).unwrap_or([f64::NAN; CURVE_TERMS]) }
    }
}

/// `scale(√value)` at `depth`, the cubic in `scale(depth)` through the four nearest of the `points`.
fn interpolated(points: &[[f64; 2]], depth: f64, scale: impl Fn(f64) -> f64) -> f64 {
    // 5 µm may be 5e-6 or 5 times 1e-6
    let end = points.last().map_or(0.0, |p| p[0]);
    let depth = if depth > end && depth <= end * (1.0 + 1e-9) { end } else { depth };
    let after = points.partition_point(|p| p[0] < depth);
    if points.len() < 4 || after == points.len() || depth < points[0][0] {
        return f64::NAN;
    }
    let first = after.saturating_sub(2).min(points.len() - 4);
    let near: [[f64; 2]; 4] = std::array::from_fn(|i| points[first + i].map(&scale));
    let x = scale(depth);
    let term = |(i, p): (usize, &[f64; 2])| {
        let others = near.iter().enumerate().filter(|(j, _)| *j != i);
        p[1] * others.map(|(_, q)| (x - q[0]) / (p[0] - q[0])).product::<f64>()
    };
    near.iter().enumerate().map(term).sum()
}

/// A smooth curve: the logarithm of the value as a polynomial of the fourth degree in ln(h/h_peak).
///
/// The force of a mesh ripples with the period of an element as the contact front crosses it; a cone under a
/// rounded tip has no such period, and its ln F is nearly straight. The fit averages the ripple over some ten
/// elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Smooth {
    peak: f64,
    coefficients: [f64; CURVE_TERMS],
}

const CURVE_TERMS: usize = 5;

impl Smooth {
    /// The value at `depth`.
    pub fn value(&self, depth: f64) -> f64 {
        let x = (depth / self.peak).ln();
        value(&self.coefficients, &powers(x)).exp()
    }

    /// The converged curve that two runs of different meshes tell: their geometric mean, in which what ripple
    /// the fits left averages out. Both hold the same peak.
    pub fn mean(a: &Smooth, b: &Smooth) -> Smooth {
        let coefficients = std::array::from_fn(|i| 0.5 * (a.coefficients[i] + b.coefficients[i]));
        Smooth { peak: a.peak, coefficients }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cone with a rounded tip as its force would be without a mesh: F = 0.2 (h + 0.1)², h in µm.
    fn force(h: f64) -> f64 {
        0.2 * (h * 1e6 + 0.1).powi(2)
    }

    #[test]
    fn interpolation_and_fit_return_the_curve() {
        let depths = (0..60).map(|i| 5e-6 * (f64::from(i) - 59.0).exp2().powf(0.1));
        let curve = Curve::new(depths.map(|h| [h, force(h)]));
        let fit = curve.smooth(5e-6);
        for h in [1e-6, 1.7e-6, 3.3e-6, 4.999e-6] {
            assert!((curve.value(h) / force(h) - 1.0).abs() < 1e-9);
            assert!((fit.value(h) / force(h) - 1.0).abs() < 1e-4);
            assert!((curve.logarithm_at(h) - force(h).ln()).abs() < 1e-6);
        }
        assert!(curve.value(6e-6).is_nan());
        assert!((curve.depth_of(force(3e-6)).unwrap() / 3e-6 - 1.0).abs() < 1e-9);
        assert!(curve.depth_of(0.1 * force(1e-9)).unwrap() < 1e-7 && curve.depth_of(force(6e-6)).is_none());
        // a hundredth more in the reference is 1/101 less here, everywhere
        let worst = curve.worst_difference(|h| 1.01 * force(h), 5e-6);
        assert!((worst - 1.0 / 101.0).abs() < 1e-9);
        assert!((curve.mean_difference(|h| 1.01 * force(h), 5e-6) + 1.0 / 101.0).abs() < 1e-9);
        assert!(curve.worst_difference(force, 6e-6).is_nan());
    }
}
