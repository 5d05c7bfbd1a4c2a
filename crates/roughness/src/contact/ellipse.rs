//! The ellipse that stands for an island.

use crate::surface::cells::Moments;

/// The ellipse that stands for an island: π a b is its area, its axes follow from the second moments (eq.
/// (14)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Major and minor semi-axes a ≥ b, in metres.
    pub semi_axes: [f64; 2],
    /// Direction of the major axis: (cos, sin) of its angle to x.
    pub direction: [f64; 2],
    /// Centre of gravity from node (0, 0), in metres; beyond the edge where a periodic island goes on there.
    pub centre: [f64; 2],
}

/// Below this ratio of semi-axes the second moments are rounding noise.
const MIN_AXES_RATIO: f64 = 1e-6;

impl Ellipse {
    /// From the moments of the island about `origin`, in pixels of size `pixel`; None where they span no
    /// ellipse.
    pub(crate) fn from_moments(m: &Moments, origin: [f64; 2], pixel: [f64; 2]) -> Option<Ellipse> {
        let (x, y) = (m.x / m.area, m.y / m.area);
        let xx = (m.xx / m.area - x * x) * pixel[0] * pixel[0];
        let xy = (m.xy / m.area - x * y) * pixel[0] * pixel[1];
        let yy = (m.yy / m.area - y * y) * pixel[1] * pixel[1];
        // eigenvalues of the covariance; for an ellipse they are a²/4 and b²/4
        let (half_sum, half_difference) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        let spread = half_difference.hypot(xy);
        let (large, small) = (half_sum + spread, half_sum - spread);
        if !(small > large * MIN_AXES_RATIO * MIN_AXES_RATIO && large.is_finite()) {
            return None;
        }
        let area = m.area * pixel[0] * pixel[1];
        let aspect = (large / small).sqrt().sqrt(); // √(a/b)
        let radius = (area / std::f64::consts::PI).sqrt();
        let angle = 0.5 * xy.atan2(half_difference);
        Some(Ellipse {
            semi_axes: [radius * aspect, radius / aspect],
            direction: [angle.cos(), angle.sin()],
            centre: [(origin[0] + x) * pixel[0], (origin[1] + y) * pixel[1]],
        })
    }

    /// Squared elliptic radius of a point (m, from node (0, 0)): 1 on the ellipse.
    pub fn radius_squared(&self, x: f64, y: f64) -> f64 {
        let (u, v) = (x - self.centre[0], y - self.centre[1]);
        let along = (u * self.direction[0] + v * self.direction[1]) / self.semi_axes[0];
        let across = (v * self.direction[0] - u * self.direction[1]) / self.semi_axes[1];
        along * along + across * across
    }
}
