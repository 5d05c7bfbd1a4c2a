//! A measured outline: parabolic arcs that meet tangentially, except where the file has a kink.
//!
//! ```text
//!        summit                 The curve hangs from its highest point: `depth_at(x)` is how far it lies below it at
//!   x ----0---- x               the distance x. A tool is the same curve upside down. Beyond its ends it goes
//!      __/ \__                  straight on.
//!   __/       \__   drop
//! ```
//! Each arc is z + s t + b t² in the distance t from its left end, so a gap, a normal and a curvature are
//! exact for it.

use std::sync::Arc;

mod bands;
mod bridge;
mod distance;
mod fit;
mod hull;
mod kinks;
mod residuals;
mod spline;

pub use distance::Foot;
pub use fit::{Fit, FitError, Span, fit};
pub use hull::{Dent, deepest_dent};

/// One arc: drop, slope and half the second derivative at its left end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parabola {
    /// Left end.
    pub x: f64,
    /// Drop there.
    pub drop: f64,
    /// Its derivative there.
    pub slope: f64,
    /// Half its second derivative.
    pub bend: f64,
}

impl Parabola {
    /// Drop at `x`.
    fn drop_at(&self, x: f64) -> f64 {
        let t = x - self.x;
        self.drop + t * (self.slope + t * self.bend)
    }

    /// Derivative of the drop at `x`.
    fn slope_at(&self, x: f64) -> f64 {
        self.slope + 2.0 * self.bend * (x - self.x)
    }
}

/// A curve of arcs from left to right. Any unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    arcs: Vec<Parabola>,
    /// Right end of the last arc.
    end: f64,
    /// True where the left half is the mirror image of the right one, which alone is stored.
    mirrored: bool,
}

impl Outline {
    /// Of `arcs` up to `end`; `mirrored`: they begin at 0 and the left side is their image. `None` without an
    /// arc, or where they are not in order.
    pub fn new(arcs: Vec<Parabola>, end: f64, mirrored: bool) -> Option<Outline> {
        let first = arcs.first()?;
        let ordered = arcs.windows(2).all(|a| a[0].x < a[1].x) && arcs.last()?.x < end;
        (ordered && (!mirrored || first.x == 0.0)).then_some(Outline { arcs, end, mirrored })
    }

    /// Left and right end.
    pub fn ends(&self) -> [f64; 2] {
        let left = if self.mirrored { -self.end } else { self.arcs.first().map_or(0.0, |a| a.x) };
        [left, self.end]
    }

    /// Number of arcs.
    pub fn arc_count(&self) -> usize {
        self.arcs.len()
    }

    /// Index of the arc at `x`, of the first or last one beyond the ends.
    fn index(&self, x: f64) -> usize {
        self.arcs.partition_point(|a| a.x <= x).saturating_sub(1)
    }

    /// Right end of the arc `index`.
    fn end_of(&self, index: usize) -> f64 {
        self.arcs.get(index + 1).map_or(self.end, |next| next.x)
    }

    /// The place on the stored half and the sign of the slope there.
    fn folded(&self, x: f64) -> (f64, f64) {
        if self.mirrored && x < 0.0 { (-x, -1.0) } else { (x, 1.0) }
    }

    /// Drop and its first derivative at `x`; straight on beyond the ends. At a kink those of its right side.
    pub fn drop_and_slope(&self, x: f64) -> [f64; 2] {
        let (x, sign) = self.folded(x);
        let arc = &self.arcs[self.index(x)];
        let inside = x.clamp(self.arcs[0].x, self.end);
        let slope = arc.slope_at(inside);
        [arc.drop_at(inside) + slope * (x - inside), sign * slope]
    }

    /// Drop at `x`.
    pub fn depth_at(&self, x: f64) -> f64 {
        self.drop_and_slope(x)[0]
    }

    /// Distances from 0, left and right, beyond which the curve lies deeper than `depth` for good; infinite
    /// where it never does.
    pub fn widths(&self, depth: f64) -> [f64; 2] {
        let right = self.last_above(depth);
        if self.mirrored { [right, right] } else { [self.reversed().last_above(depth), right] }
    }

    /// The last place, from 0 on, where the drop is at most `depth`.
    fn last_above(&self, depth: f64) -> f64 {
        let [bottom, slope] = self.drop_and_slope(self.end);
        if bottom <= depth {
            return if slope > 0.0 { self.end + (depth - bottom) / slope } else { f64::INFINITY };
        }
        let first = self.index(0.0);
        for index in (first..self.arcs.len()).rev() {
            let from = if index == first { self.arcs[index].x.max(0.0) } else { self.arcs[index].x };
            if let Some(x) = self.arcs[index].last_above(depth, from, self.end_of(index)) {
                return x;
            }
        }
        0.0
    }

    /// The image in the vertical axis.
    #[must_use]
    pub fn reversed(&self) -> Outline {
        if self.mirrored {
            return self.clone();
        }
        let image = |(i, arc): (usize, &Parabola)| {
            let end = self.end_of(i);
            Parabola { x: -end, drop: arc.drop_at(end), slope: -arc.slope_at(end), bend: arc.bend }
        };
        let arcs = self.arcs.iter().enumerate().rev().map(image).collect();
        Outline { arcs, end: -self.arcs[0].x, mirrored: false }
    }

    /// Every length times `factor`.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Outline {
        let scale = |a: &Parabola| Parabola {
            x: a.x * factor,
            drop: a.drop * factor,
            slope: a.slope,
            bend: a.bend / factor,
        };
        Outline { arcs: self.arcs.iter().map(scale).collect(), end: self.end * factor, ..*self }
    }

    /// The curve seen from the point (`x`, `drop`) of it: that point becomes the origin.
    #[must_use]
    pub fn seen_from(&self, x: f64, drop: f64) -> Outline {
        let shift = |a: &Parabola| Parabola { x: a.x - x, drop: a.drop - drop, ..*a };
        Outline { arcs: self.arcs.iter().map(shift).collect(), end: self.end - x, ..*self }
    }

    /// The part between two places inside the ends; both sides of it are stored.
    #[must_use]
    pub fn part_between(&self, from: f64, to: f64) -> Outline {
        let mut arcs: Vec<Parabola> = Vec::new();
        for (i, arc) in self.arcs.iter().enumerate() {
            let (left, right) = (arc.x.max(from), self.end_of(i).min(to));
            if left < right {
                arcs.push(Parabola {
                    x: left,
                    drop: arc.drop_at(left),
                    slope: arc.slope_at(left),
                    bend: arc.bend,
                });
            }
        }
        if arcs.is_empty() { self.clone() } else { Outline { arcs, end: to, mirrored: false } }
    }

    /// The curve with its right end at `x`, which lies before it.
    #[must_use]
    pub fn cut(&self, x: f64) -> Outline {
        let arcs: Vec<Parabola> = self.arcs.iter().filter(|a| a.x < x).copied().collect();
        if arcs.is_empty() { self.clone() } else { Outline { arcs, end: x.min(self.end), ..*self } }
    }

    /// The curve with a straight arc that leads on from its right end to the drop `depth`, at the slope of
    /// the end or the mean slope of its right side, whichever is steeper; as it is where it is as deep.
    #[must_use]
    pub fn down_to(&self, depth: f64) -> Outline {
        let [drop, slope] = self.drop_and_slope(self.end);
        let slope = slope.max(drop / self.end);
        // not a splinter for a rounded depth
        if drop >= (1.0 - 1e-6) * depth || !(slope > 0.0 && slope.is_finite()) {
            return self.clone();
        }
        let mut arcs = self.arcs.clone();
        arcs.push(Parabola { x: self.end, drop, slope, bend: 0.0 });
        Outline { arcs, end: self.end + (depth - drop) / slope, ..*self }
    }

    /// The highest point: place and drop.
    pub fn summit(&self) -> [f64; 2] {
        self.extremes()
            .into_iter()
            .fold([0.0, f64::INFINITY], |best, p| if p[1] < best[1] { p } else { best })
    }

    /// The greatest drop.
    pub fn lowest(&self) -> f64 {
        self.extremes().into_iter().fold(f64::NEG_INFINITY, |most, p| most.max(p[1]))
    }

    /// Places between these ends where two arcs meet: x, drop and slope of the one that begins there.
    pub fn joints_between(&self, [from, to]: [f64; 2]) -> impl Iterator<Item = [f64; 3]> {
        let first = self.arcs.partition_point(|arc| arc.x < from).max(1);
        let joints = self.arcs.get(first..).unwrap_or_default().iter();
        joints.take_while(move |arc| arc.x <= to).map(|arc| [arc.x, arc.drop, arc.slope])
    }

    /// Ends of arcs and the places between them where the curve is level, from left to right (of a mirrored
    /// one those of the right half), each with its drop.
    pub fn extremes(&self) -> Vec<[f64; 2]> {
        let mut places = Vec::new();
        for (i, arc) in self.arcs.iter().enumerate() {
            places.push([arc.x, arc.drop]);
            let level = arc.x - 0.5 * arc.slope / arc.bend;
            if level > arc.x && level < self.end_of(i) {
                places.push([level, arc.drop_at(level)]);
            }
        }
        places.push([self.end, self.depth_at(self.end)]);
        places
    }

    /// Greatest absolute slope.
    pub fn steepest(&self) -> f64 {
        let ends = |(i, a): (usize, &Parabola)| a.slope.abs().max(a.slope_at(self.end_of(i)).abs());
        self.arcs.iter().enumerate().map(ends).fold(0.0, f64::max)
    }

    /// Places where the slope jumps by more than `angle`, or the curvature by more than half of its greatest
    /// value, from left to right.
    pub fn kinks(&self, angle: f64) -> Vec<f64> {
        let sharpest = self.arcs.iter().fold(0.0, |m: f64, a| m.max(a.bend.abs()));
        let turns = |i: usize| {
            let (before, after) = (&self.arcs[i - 1], &self.arcs[i]);
            (after.slope - before.slope_at(after.x)).abs() > angle
                || (after.bend - before.bend).abs() > 0.5 * sharpest
        };
        let mut kinks: Vec<f64> =
            (1..self.arcs.len()).filter(|&i| turns(i)).map(|i| self.arcs[i].x).collect();
        if self.mirrored {
            let left: Vec<f64> = kinks.iter().rev().map(|x| -x).collect();
            let tip = (2.0 * self.arcs[0].slope).abs() > angle;
            kinks = left.into_iter().chain(tip.then_some(0.0)).chain(kinks).collect();
        }
        kinks
    }

    /// The curve to be shared.
    pub fn shared(self) -> Arc<Outline> {
        Arc::new(self)
    }
}

impl Parabola {
    /// The last place in `[from, to]` where the drop is at most `depth`.
    fn last_above(&self, depth: f64, from: f64, to: f64) -> Option<f64> {
        if self.drop_at(to) <= depth {
            return Some(to);
        }
        let (c, s, b) = (self.drop_at(from) - depth, self.slope_at(from), self.bend);
        let length = to - from;
        let root = quadratic_roots(b, s, c).into_iter().flatten().filter(|t| (0.0..=length).contains(t));
        let last = root.fold(f64::NEG_INFINITY, f64::max);
        if last.is_finite() { Some(from + last) } else { (c <= 0.0).then_some(from) }
    }
}

/// Real roots of c + bt + at², without cancellation.
pub fn quadratic_roots(a: f64, b: f64, c: f64) -> [Option<f64>; 2] {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 {
        return [None, None];
    }
    let q = -0.5 * (b + discriminant.sqrt().copysign(b));
    let finite = |x: f64| Some(x).filter(|x| x.is_finite());
    [finite(q / a), finite(c / q)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola of curvature 0.1 to x = 2, then straight on to 6.
    fn rounded() -> Outline {
        let arcs = vec![
            Parabola { x: 0.0, drop: 0.0, slope: 0.0, bend: 0.05 },
            Parabola { x: 2.0, drop: 0.2, slope: 0.2, bend: 0.0 },
        ];
        Outline::new(arcs, 6.0, true).unwrap()
    }

    #[test]
    fn drops_widths_and_slopes_belong_to_each_other() {
        let curve = rounded();
        for x in [0.3, 1.9, 2.5, 7.0] {
            let drop = curve.depth_at(x);
            assert!((curve.widths(drop)[0] - x).abs() < 1e-14);
            assert_eq!(curve.depth_at(-x), drop);
            let slope = (curve.depth_at(x + 1e-6) - curve.depth_at(x - 1e-6)) / 2e-6;
            assert!(
                (curve.drop_and_slope(x)[1] - slope).abs() < 1e-9
                    && (curve.drop_and_slope(-x)[1] + slope).abs() < 1e-9
            );
        }
        assert_eq!(curve.kinks(0.01), [-2.0, 2.0]);
        assert_eq!((curve.steepest(), curve.lowest(), curve.ends()), (0.2, 1.0, [-6.0, 6.0]));
    }

    #[test]
    fn a_part_seen_from_its_own_summit_is_the_same_curve() {
        let part = rounded().part_between(1.0, 5.0).seen_from(1.0, 0.05);
        assert_eq!(part.ends(), [0.0, 4.0]);
        assert!((part.depth_at(3.0) - (rounded().depth_at(4.0) - 0.05)).abs() < 1e-15);
        let image = part.reversed();
        for x in [0.0, 0.5, 1.0, 3.9, 5.0] {
            assert!((image.depth_at(-x) - part.depth_at(x)).abs() < 1e-15, "{x}");
        }
        // the end slope of 0.2 from a drop of 0.75 at 4
        assert!((part.down_to(0.95).ends()[1] - 5.0).abs() < 1e-12 && part.cut(2.0).ends() == [0.0, 2.0]);
        assert!((part.scaled(2.0).depth_at(6.0) - 2.0 * part.depth_at(3.0)).abs() < 1e-15);
    }
}
