//! The contact on one grid: what is known, what is looked for, and how far a pressure is from it.

use super::convolution::{Convolution, Way};
use super::real::{CHUNK, Real, sums, total};
use rayon::prelude::*;

/// Height of a point that was not measured, in units of the range: no plane reaches it.
pub(super) const MISSING: f64 = -1e6;

/// Plane held at a height, or pushed by a mean pressure over all nodes of the grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Hold {
    /// Mean pressure.
    Pressure(f64),
    /// Height of the plane.
    Plane(f64),
}

/// A grid with its heights; E* and a pixel are 1, so that a pressure is a slope.
pub(super) struct Level<T: Real> {
    /// Heights in units of the range of heights, row by row; a missing one is [`MISSING`].
    pub heights: Vec<T>,
    /// Largest pressure; infinite where the half-space is elastic.
    pub limit: f64,
    /// Root mean square height, the unit of gaps in the residual.
    pub rms: f64,
    /// The half-space.
    pub space: Convolution<T>,
    /// Convolutions done.
    pub convolutions: usize,
}

/// A pressure with the gaps that it leaves.
pub(super) struct Search<T> {
    /// Pressure on each node.
    pub pressure: Vec<T>,
    /// Displacement minus height; plus `plane` it is the gap.
    pub lift: Vec<T>,
    /// Height of the plane.
    pub plane: f64,
    /// Residual of the complementarity conditions.
    pub residual: f64,
}

/// Whether a node may change its pressure: between the bounds, or pushed away from its bound by the gap.
#[inline]
pub(super) fn is_free<T: Real>(pressure: T, gap: T, limit: T) -> bool {
    if pressure <= T::zero() { gap < T::zero() } else { pressure < limit || gap > T::zero() }
}

impl<T: Real> Level<T> {
    /// The limit in the number type.
    pub fn top(&self) -> T {
        if self.limit.is_finite() { T::of(self.limit) } else { T::infinity() }
    }

    /// `output` = compliance or stiffness of `input`.
    pub fn apply(&mut self, way: Way, input: &[T], output: &mut [T]) {
        self.convolutions += 1;
        self.space.apply(way, input, output);
    }

    /// `lift` of a pressure.
    pub fn lift(&mut self, pressure: &[T], lift: &mut [T]) {
        self.apply(Way::Compliance, pressure, lift);
        let heights = &self.heights;
        lift.par_chunks_mut(CHUNK)
            .zip(heights.par_chunks(CHUNK))
            .for_each(|(lift, heights)| lift.iter_mut().zip(heights).for_each(|(u, h)| *u = *u - *h));
    }

    /// The height of the plane that `hold` leaves: where a pressure is given, that with a mean gap of 0 over the nodes
    /// that are free to change.
    pub fn plane(&self, hold: Hold, pressure: &[T], lift: &[T], last: Option<f64>) -> f64 {
        let top = self.top();
        let mean = |chosen: &(dyn Fn(T, T) -> bool + Sync)| {
            let [sum, n] = sums(pressure.len(), |range| {
                let (mut sum, mut n) = (0.0, 0.0);
                for (p, u) in pressure[range.clone()].iter().zip(&lift[range]) {
                    if chosen(*p, *u) {
                        (sum, n) = (sum + u.wide(), n + 1.0);
                    }
                }
                [sum, n]
            });
            (n > 0.0).then(|| -sum / n)
        };
        if let Hold::Plane(plane) = hold {
            return plane;
        }
        let first = mean(&|p, _| p > T::zero() && p < top)
            .or(last)
            .or_else(|| mean(&|p, _| p > T::zero()))
            .unwrap_or(0.0);
        let at = T::of(first);
        mean(&|p, u| is_free(p, u + at, top)).unwrap_or(first)
    }

    /// How far pressure and gap are from complementarity, over the load times the rms height: gap under pressure,
    /// overlap without it, and overlap that a pressure below the limit would have to push away.
    pub fn residual(&self, pressure: &[T], lift: &[T], plane: f64) -> f64 {
        let top = self.top();
        let [load, touching] = sums(pressure.len(), |range| {
            pressure[range].iter().fold([0.0, 0.0], |[load, n], p| {
                [load + p.wide(), n + if *p > T::zero() { 1.0 } else { 0.0 }]
            })
        });
        let at = T::of(plane);
        if load <= 0.0 {
            // without pressure any overlap is all wrong
            return if lift.par_iter().any(|u| *u + at < T::zero()) { 1.0 } else { 0.0 };
        }
        let typical = load / touching;
        let [wrong] = sums(pressure.len(), |range| {
            let mut wrong = 0.0;
            for (p, u) in pressure[range.clone()].iter().zip(&lift[range]) {
                let gap = (*u + at).wide();
                wrong += if gap > 0.0 {
                    p.wide() * gap
                } else if *p < top {
                    // a pressure that is next to nothing pushes nothing away
                    p.wide().max(typical) * -gap
                } else {
                    0.0
                };
            }
            [wrong]
        });
        wrong / (load * self.rms)
    }

    /// `pressure` brought to the mean pressure wanted without leaving its bounds: scaled, and where a limit cuts that, shifted
    /// on the nodes in contact.
    pub fn rescale(&self, pressure: &mut [T], wanted: f64) {
        let nodes = pressure.len() as f64;
        let (limit, target) = (self.limit, wanted * nodes);
        for _ in 0..60 {
            // capped scaling: what is below the limit takes the rest of the load
            let parts: Vec<[f64; 2]> = pressure
                .par_chunks(CHUNK)
                .map(|part| {
                    part.iter().fold([0.0, 0.0], |[below, full], p| {
                        let p = p.wide();
                        if p >= limit { [below, full + limit] } else { [below + p, full] }
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
            let (by, top) = (T::of(factor), self.top());
            pressure.par_chunks_mut(CHUNK).for_each(|part| {
                for p in part.iter_mut().filter(|p| all || **p < top) {
                    *p = (*p * by).min(top);
                }
            });
            if factor <= 1.0 || limit.is_infinite() {
                return;
            }
        }
    }

    /// Adds `missing` load, evenly on the nodes without any pressure: those under pressure are all at the limit.
    fn spread(&self, pressure: &mut [T], missing: f64) {
        let hole = T::of(MISSING);
        let idle = |p: T, h: T| p <= T::zero() && h > hole;
        let [n] = sums(pressure.len(), |range| {
            let pairs = pressure[range.clone()].iter().zip(&self.heights[range]);
            [pairs.filter(|(p, h)| idle(**p, **h)).count() as f64]
        });
        let share = if n > 0.0 { T::of(missing / n).min(self.top()) } else { T::zero() };
        pressure
            .par_iter_mut()
            .zip(&self.heights)
            .filter(|(p, h)| idle(**p, **h))
            .for_each(|(p, _)| *p = share);
    }
}
