//! Dents of an outline, which bulge the wrong way: a tool presses with its convex side.

use super::Outline;

/// Samples of an arc.
const SAMPLES: usize = 8;

/// The place at which a curve lies deepest inside its convex hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dent {
    /// Its place.
    pub x: f64,
    /// Distance of the curve above the chord over the dent.
    pub depth: f64,
}

/// The deepest dent of the right side of `outline`, as a tool whose drop is the rise from its apex; its depth
/// is 0 where the curve is convex.
pub fn deepest_dent(outline: &Outline) -> Dent {
    let [_, end] = outline.ends();
    let mut points: Vec<[f64; 2]> = Vec::new();
    for index in 0..outline.arc_count() {
        let (from, to) = (outline.arcs[index].x, outline.end_of(index));
        points.extend((0..SAMPLES).map(|k| {
            let x = from + (to - from) * k as f64 / SAMPLES as f64;
            [x, outline.arcs[index].drop_at(x)]
        }));
    }
    points.push([end, outline.depth_at(end)]);
    let hull = lower_hull(&points);
    let mut deepest = Dent { x: 0.0, depth: 0.0 };
    for chord in hull.windows(2) {
        let [a, b] = [chord[0], chord[1]].map(|i| points[i]);
        for p in &points[chord[0]..chord[1]] {
            let depth = p[1] - a[1] - (b[1] - a[1]) * (p[0] - a[0]) / (b[0] - a[0]);
            if depth > deepest.depth {
                deepest = Dent { x: p[0], depth };
            }
        }
    }
    deepest
}

/// Indices of the points on the lower convex hull of points in order of x.
fn lower_hull(points: &[[f64; 2]]) -> Vec<usize> {
    let mut hull: Vec<usize> = Vec::new();
    for (i, p) in points.iter().enumerate() {
        while let [.., a, b] = hull[..] {
            let (u, v) = (points[a], points[b]);
            let turn = (v[0] - u[0]) * (p[1] - u[1]) - (v[1] - u[1]) * (p[0] - u[0]);
            if turn > 0.0 {
                break;
            }
            hull.pop();
        }
        hull.push(i);
    }
    hull
}

#[cfg(test)]
mod tests {
    use super::super::{Outline, Parabola};
    use super::*;

    #[test]
    fn a_bowl_has_no_dent_and_a_rim_has() {
        let arc = |x, drop, slope, bend| Parabola { x, drop, slope, bend };
        let bowl = Outline::new(vec![arc(0.0, 0.0, 0.0, 0.5), arc(1.0, 0.5, 1.0, 0.0)], 3.0, true).unwrap();
        assert!(deepest_dent(&bowl).depth < 1e-15);
        // rises to 0.5 at 1 and goes on at half the slope to 1.5 at 3: 0.25/1.5... above the chord from 0 to
        // the end
        let rim = Outline::new(vec![arc(0.0, 0.0, 1.0, 0.0), arc(1.0, 1.0, 0.25, 0.0)], 3.0, true).unwrap();
        let dent = deepest_dent(&rim);
        assert!((dent.x - 1.0).abs() < 1e-12 && (dent.depth - 0.5).abs() < 1e-12, "{dent:?}");
    }
}
