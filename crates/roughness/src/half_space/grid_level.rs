//! The contact on one grid: what is known, what is looked for, and how far a pressure is from it.

use super::convolution::{Convolution, Way};
use super::nodes::Nodes;
use crate::half_space::float::{CHUNK, Real, sums, total};
use rayon::prelude::*;

/// Height of a point that was not measured, in units of the range: no plane reaches it.
pub(super) const MISSING_HEIGHT: f64 = -1e6;

/// Plane held at a height, or pushed by a mean pressure over all nodes of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// Mean pressure.
    Pressure(f64),
    /// Height of the plane.
    Plane(f64),
}

/// A grid with its heights; E* and a pixel are 1, so that a pressure is a slope.
///
/// Pressures are counted from `base`, all of them: 0, or near full contact the mean pressure, which would
/// else take the digits of what varies about it.
pub(super) struct Level<T: Real> {
    /// Heights in units of the range of heights, row by row; a missing one is [`MISSING_HEIGHT`].
    pub heights: Vec<T>,
    /// Largest pressure, counted from 0; infinite where the half-space is elastic.
    pub limit: f64,
    /// Pressure from which those of the level are counted; above 0 on periodic grids without holes alone,
    /// where an even pressure displaces nothing. A number of both types.
    pub base: f64,
    /// Root mean square height, the unit of gaps in the residual.
    pub rms: f64,
    /// The half-space.
    pub space: Convolution<T>,
    /// Convolutions done.
    pub convolutions: usize,
}

/// A pressure with the gaps that it leaves.
pub(super) struct Search<T> {
    /// Pressure on each node, counted from the base of its level.
    pub pressure: Vec<T>,
    /// Displacement minus height; plus `plane` it is the gap.
    pub lift: Vec<T>,
    /// Height of the plane.
    pub plane: f64,
    /// Proven relative error of the pressures in the norm of the energy.
    pub error: f64,
}

/// True where a node may change its pressure: between the bounds `bottom` and `top`, or pushed away from its
/// bound by the gap.
#[inline]
pub(super) fn is_free<T: Real>(pressure: T, gap: T, [bottom, top]: [T; 2]) -> bool {
    if pressure <= bottom { gap < T::zero() } else { pressure < top || gap > T::zero() }
}

impl<T: Real> Level<T> {
    /// The least and the largest pressure as the level counts them.
    pub fn bounds(&self) -> [T; 2] {
        let top = if self.limit.is_finite() { T::nearest(self.limit - self.base) } else { T::infinity() };
        [T::nearest(-self.base), top]
    }

    /// A pressure of the level counted from 0.
    #[inline]
    pub fn full(&self, pressure: T) -> f64 {
        pressure.wide() + self.base
    }

    /// `output` = compliance or stiffness of `input`.
    pub fn apply(&mut self, way: Way, input: &[T], output: &mut [T]) {
        self.convolutions += 1;
        self.space.apply(way, input, output);
    }

    /// `lift` of a pressure.
    pub fn lift(&mut self, pressure: &[T], lift: &mut [T]) {
        self.convolutions += 1;
        self.space.apply_less(Way::Compliance, pressure, &self.heights, lift);
    }

    /// The height of the plane that `hold` leaves (where a pressure is given, that with a mean gap of 0 over
    /// the nodes that are free to change), and the nodes that it touches or overlaps. `touching` are those
    /// under pressure.
    pub fn plane(
        &self,
        hold: Hold,
        [pressure, lift]: [&[T]; 2],
        touching: &Nodes,
        last: Option<f64>,
    ) -> (f64, Nodes) {
        let bounds @ [bottom, top] = self.bounds();
        if let Hold::Plane(plane) = hold {
            return (plane, self.near_contact([pressure, lift], plane));
        }
        let mean = |[sum, n]: [f64; 2]| (n > 0.0).then(|| -sum / n);
        let term = |i: usize, counts: bool| if counts { [lift[i].wide(), 1.0] } else { [0.0; 2] };
        let first = mean(touching.sums(|i| term(i, pressure[i] < top)))
            .or(last)
            .or_else(|| mean(touching.sums(|i| term(i, true))))
            .unwrap_or(0.0);
        let at = T::nearest(first);
        let (near, sums) = Nodes::select_with_sums(pressure.len(), |i| {
            let (p, gap) = (pressure[i], lift[i] + at);
            ((p > bottom) | (gap < T::zero()), term(i, is_free(p, gap, bounds)))
        });
        let plane = mean(sums).unwrap_or(first);
        // a lower plane overlaps more
        let near = if plane < first { self.near_contact([pressure, lift], plane) } else { near };
        (plane, near)
    }

    /// The nodes under pressure, and those that overlap the plane at a height.
    pub fn near_contact(&self, [pressure, lift]: [&[T]; 2], plane: f64) -> Nodes {
        let (at, [bottom, _]) = (T::nearest(plane), self.bounds());
        Nodes::select(pressure.len(), |i| (pressure[i] > bottom) | (lift[i] + at < T::zero()))
    }

    /// The distance of pressure and gap from complementarity, over the load times the rms height: gap under
    /// pressure, overlap without it, and overlap that a pressure below the limit would have to push away.
    /// `near` holds all nodes under pressure or overlapping the plane.
    pub fn residual(&self, [pressure, lift]: [&[T]; 2], plane: f64, near: &Nodes) -> f64 {
        let ([bottom, top], at) = (self.bounds(), T::nearest(plane));
        let [load, touching, overlapping] = near.sums(|i| {
            let flag = |holds: bool| if holds { 1.0 } else { 0.0 };
            [self.full(pressure[i]), flag(pressure[i] > bottom), flag(lift[i] + at < T::zero())]
        });
        if load <= 0.0 {
            // without pressure any overlap is all wrong
            return if overlapping > 0.0 { 1.0 } else { 0.0 };
        }
        let typical = load / touching;
        let [wrong] = near.sums(|i| {
            let (p, gap) = (pressure[i], (lift[i] + at).wide());
            [if gap > 0.0 {
                self.full(p) * gap
            } else if p < top {
                // a pressure that is next to nothing pushes nothing away
                self.full(p).max(typical) * -gap
            } else {
                0.0
            }]
        });
        wrong / (load * self.rms)
    }

    /// The proven relative error √(δ·Kδ / p·Sp) of a pressure, of which `product` is δ·Kδ and `sum` the sum
    /// of δ: on the nodes that may change their pressure δ is the gap with its sign turned, and 0 elsewhere.
    ///
    /// With w = gap + δ the pressure is the exact contact of the heights less δ, so that for the true
    /// pressure p* (p - p*)·w ≤ 0 and (p - p*)·w* ≥ 0: |p - p*|²_S ≤ -δ·(p - p*) ≤ |δ|_K |p - p*|_S. Where
    /// the load is held p - p* has no mean, and that of δ does not count.
    pub fn error(
        &self,
        hold: Hold,
        [product, sum]: [f64; 2],
        [pressure, lift]: [&[T]; 2],
        touching: &Nodes,
    ) -> f64 {
        let even = match hold {
            Hold::Pressure(_) => sum * sum / pressure.len() as f64 * self.space.even_stiffness(),
            Hold::Plane(_) => 0.0,
        };
        let heights = &self.heights;
        // displacements of a periodic surface sum to 0, so that pressures may be counted from 0
        let [work] = touching.sums(|i| [self.full(pressure[i]) * (lift[i] + heights[i]).wide()]);
        let bound = (product - even).max(0.0);
        if bound == 0.0 {
            0.0
        } else if work > 0.0 {
            (bound / work).sqrt()
        } else {
            // overlap without any pressure is all wrong
            1.0
        }
    }

    /// `pressure` brought to the mean pressure wanted without leaving its bounds: scaled, and where a limit
    /// cuts that, shifted on the nodes in contact.
    pub fn rescale(&self, pressure: &mut [T], wanted: f64) {
        let nodes = pressure.len() as f64;
        let (target, [_, top]) = (wanted * nodes, self.bounds());
        for _ in 0..60 {
            // capped scaling: what is below the limit takes the rest of the load
            let parts: Vec<[f64; 2]> = pressure
                .par_chunks(CHUNK)
                .map(|part| {
                    part.iter().fold([0.0, 0.0], |[below, full], p| {
                        if *p >= top { [below, full + self.limit] } else { [below + self.full(*p), full] }
                    })
                })
                .collect();
            let [below, full] = total(&parts);
            if (below + full - target).abs() <= 1e-12 * target {
                return;
            }
            let (factor, all) = if below > 0.0 && target > full {
                ((target - full) / below, false)
            } else if target < full + below {
                (target / (full + below), true)
            } else {
                self.spread(pressure, target - full);
                continue;
            };
            // of a factor near 1 its difference from 1 has the digits
            let (more, base) = (T::nearest(factor - 1.0), T::nearest(self.base));
            pressure.par_chunks_mut(CHUNK).for_each(|part| {
                for p in part.iter_mut().filter(|p| all || **p < top) {
                    *p = (*p + more * (*p + base)).min(top);
                }
            });
            if factor <= 1.0 || self.limit.is_infinite() {
                return;
            }
        }
    }

    /// The same where all pressure is on the nodes `touching`, which carry `load`; those on which it is then.
    pub fn rescale_on(&self, touching: Nodes, load: f64, pressure: &mut [T], wanted: f64) -> Nodes {
        let [bottom, _] = self.bounds();
        if load > 0.0 && self.limit.is_infinite() {
            let more = T::nearest(wanted * pressure.len() as f64 / load - 1.0);
            let base = T::nearest(self.base);
            touching.set(pressure, |_, p| p + more * (p + base));
            return touching;
        }
        self.rescale(pressure, wanted);
        Nodes::select(pressure.len(), |i| pressure[i] > bottom)
    }

    /// Adds `missing` load, evenly on the nodes without any pressure: those under pressure are all at the
    /// limit.
    fn spread(&self, pressure: &mut [T], missing: f64) {
        let hole = T::nearest(MISSING_HEIGHT);
        let [bottom, top] = self.bounds();
        let idle = |p: T, h: T| p <= bottom && h > hole;
        let [n] = sums(pressure.len(), |range| {
            let pairs = pressure[range.clone()].iter().zip(&self.heights[range]);
            [pairs.filter(|(p, h)| idle(**p, **h)).count() as f64]
        });
        let share = if n > 0.0 { T::nearest(missing / n - self.base).min(top) } else { bottom };
        pressure
            .par_iter_mut()
            .zip(&self.heights)
            .filter(|(p, h)| idle(**p, **h))
            .for_each(|(p, _)| *p = share);
    }
}
