//! The pieces of an edge along which the penetration of a tool is smooth.
//!
//! An outline has places where its curvature jumps: where the arc of a tip meets the flank, where arcs of a
//! measured outline meet, at the apex of a sharp tool. The penetration of a point jumps in its second
//! derivative where the foot of the point passes such a place K, that is on the normal of the outline there,
//! ```text
//! (r - r_K) + s_K (z - z_K) = 0,    s_K the slope of the outline at K.
//! ```
//! Along an edge the position is a parabola in ξ, so the places follow from a quadratic. Pressure and slope
//! are continuous there: a division that moves adds nothing to the derivative of an integral over the pieces.

use crate::contact::tool::{Kink, Tool};
use asperity_mesh::outline::quadratic_roots;

/// Places in an edge at most; more are left out, whatever they part is smooth to a good approximation.
const MOST_PLACES: usize = 8;

/// Places ξ in (-1, 1) that divide an edge, from left to right.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    xi: [f64; MOST_PLACES],
    count: usize,
}

impl Places {
    /// Those at which the foot of the points of an edge passes a kink of `tool`, whose lowest point is at
    /// height `tip`. The edge has its nodes at `x`, and at ξ the `point`, a parabola in ξ.
    pub fn of_edge(x: &[[f64; 2]], point: impl Fn(f64) -> [f64; 2], tool: &Tool, tip: f64) -> Places {
        let radii = x.iter().map(|x| x[0]);
        let (low, high) = radii.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), r| (a.min(r), b.max(r)));
        let mut places = Places { xi: [0.0; MOST_PLACES], count: 0 };
        tool.kinks_near([low, high], &mut |kink| places.add(&point, tip, kink));
        places.xi[..places.count].sort_by(f64::total_cmp);
        places
    }

    /// Those at which the foot passes `kink`, on either side of the axis.
    fn add(&mut self, point: &impl Fn(f64) -> [f64; 2], tip: f64, kink: Kink) {
        let sides: &[f64] = if kink.radius == 0.0 { &[1.0] } else { &[1.0, -1.0] };
        for side in sides {
            let value = |xi: f64| {
                let [r, z] = point(xi);
                side * r - kink.radius + kink.slope * (z - tip - kink.rise)
            };
            let (left, middle, right) = (value(-1.0), value(0.0), value(1.0));
            let (a, b) = (0.5 * (left + right) - middle, 0.5 * (right - left));
            for xi in quadratic_roots(a, b, middle).into_iter().flatten() {
                let on_side = side * point(xi)[0] >= 0.0;
                if xi > -1.0 && xi < 1.0 && on_side && self.count < MOST_PLACES {
                    self.xi[self.count] = xi;
                    self.count += 1;
                }
            }
        }
    }

    /// The places, from left to right.
    pub fn as_slice(&self) -> &[f64] {
        &self.xi[..self.count]
    }

    /// The pieces of `[start, end]` between them.
    pub fn pieces_of(&self, [start, end]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
        let places = self.as_slice();
        let inside = move |xi: &f64| *xi > start && *xi < end;
        let mut from = start;
        places.iter().copied().filter(inside).chain(std::iter::once(end)).map(move |to| {
            let piece = [from, to];
            from = to;
            piece
        })
    }
}
