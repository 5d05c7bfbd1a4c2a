//! The point of an outline nearest to another point.

use super::{Outline, Parabola};

/// Newton steps after which the bracket alone goes on.
const MOST_STEPS: usize = 60;

/// The nearest point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Its place.
    pub x: f64,
    /// Drop there.
    pub drop: f64,
    /// Slope of the curve there; 0 at a kink.
    pub slope: f64,
    /// Second derivative there; 0 beyond the ends.
    pub bend: f64,
    /// True where it is a kink, whose distance is that of a point.
    pub corner: bool,
}

impl Outline {
    /// The foot of the point (`x`, `drop`) near to it: down the gradient of the distance from the foot
    /// straight above or below. Exact; the nearest of all where the point lies within the least radius of
    /// curvature of the curve.
    ///
    /// On a mirrored curve for points with `x` ≥ 0, whose feet lie there too; before a sharp tip its flank
    /// goes on.
    pub fn foot(&self, x: f64, drop: f64) -> Foot {
        // half the derivative of the squared distance along the curve
        let along = |arc: &Parabola, s: f64| (s - x) + (arc.drop_at(s) - drop) * arc.slope_at(s);
        let start = x.clamp(self.arcs[0].x, self.end);
        let mut index = self.index(start);
        if along(&self.arcs[index], start) < 0.0 {
            loop {
                let end = self.end_of(index);
                if along(&self.arcs[index], end) >= 0.0 {
                    return self.on_arc(index, x, drop);
                }
                let Some(next) = self.arcs.get(index + 1) else { return self.foot_beyond(end, x, drop) };
                if along(next, end) > 0.0 {
                    return corner(end, next.drop);
                }
                index += 1;
            }
        }
        loop {
            let from = self.arcs[index].x;
            if along(&self.arcs[index], from) <= 0.0 {
                return self.on_arc(index, x, drop);
            }
            let Some(before) = index.checked_sub(1) else { return self.foot_beyond(from, x, drop) };
            if along(&self.arcs[before], from) < 0.0 {
                return corner(from, self.arcs[index].drop);
            }
            index = before;
        }
    }

    /// The foot on the straight line that leads on from an end.
    fn foot_beyond(&self, end: f64, x: f64, drop: f64) -> Foot {
        let [z, slope] = self.drop_and_slope(end);
        let t = ((x - end) + slope * (drop - z)) / (1.0 + slope * slope);
        Foot { x: end + t, drop: z + slope * t, slope, bend: 0.0, corner: false }
    }

    /// The foot on the arc `index`, on which it lies: the root of a cubic, by Newton's method between two
    /// bounds.
    fn on_arc(&self, index: usize, x: f64, drop: f64) -> Foot {
        let arc = &self.arcs[index];
        let (mut low, mut high) = (arc.x, self.end_of(index));
        let mut s = x.clamp(low, high);
        for _ in 0..MOST_STEPS {
            let (gap, slope) = (arc.drop_at(s) - drop, arc.slope_at(s));
            let value = (s - x) + gap * slope;
            if value < 0.0 {
                low = s;
            } else {
                high = s;
            }
            let newton = s - value / (1.0 + slope * slope + 2.0 * arc.bend * gap);
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if value == 0.0 || (next - s).abs() <= 1e-16 * (high.abs() + low.abs()) {
                break;
            }
            s = next;
        }
        Foot { x: s, drop: arc.drop_at(s), slope: arc.slope_at(s), bend: 2.0 * arc.bend, corner: false }
    }
}

/// The foot of a point that faces a kink.
fn corner(x: f64, drop: f64) -> Foot {
    Foot { x, drop, slope: 0.0, bend: 0.0, corner: true }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola, a kink at 2, a straight end.
    fn curve() -> Outline {
        let arcs = vec![
            Parabola { x: 0.0, drop: 0.0, slope: 0.0, bend: 0.05 },
            Parabola { x: 2.0, drop: 0.2, slope: 0.5, bend: 0.02 },
        ];
        Outline::new(arcs, 5.0, true).unwrap()
    }

    #[test]
    fn the_way_to_the_foot_is_normal_to_the_curve_and_the_shortest() {
        let curve = curve();
        for [x, z] in [[0.0, 0.3], [0.7, 0.1], [1.0, -0.4], [2.1, 0.0], [3.0, 0.9], [4.9, 2.2], [8.0, 3.0]] {
            let foot = curve.foot(x, z);
            let far = |s: f64| (s - x).hypot(curve.depth_at(s) - z);
            let found = far(foot.x);
            let best = (0..=9000).map(|i| far(i as f64 * 1e-3)).fold(f64::INFINITY, f64::min);
            assert!(found <= best + 1e-12, "{x} {z}: {found} {best}");
            let along = (foot.x - x) + (foot.drop - z) * foot.slope;
            assert!(foot.corner || along.abs() < 1e-13, "{x} {z}: {along}");
        }
        assert!(curve.foot(2.07, 0.0).corner);
    }
}
