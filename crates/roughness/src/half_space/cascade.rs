//! From a coarse grid to the fine one, from `f32` to `f64`: each start is the answer of the one before.

use super::conjugate_gradients::conjugate_gradients;
use super::convolution::{Convolution, Way};
use super::projected_gradient::{projected_gradient, proven};
use crate::half_space::float::{Real, sums};
use crate::half_space::grid_level::{Hold, Level, MISSING_HEIGHT, Search};
use rayon::prelude::*;

/// A side of more nodes is halved for the coarser grid.
const COARSEST_SIDE: usize = 64;
/// Error of the coarse grids.
const COARSE_ERROR: f64 = 1e-3;
/// The least error that `f32` is asked for: it stagnates below.
const SINGLE_PRECISION_ERROR: f64 = 1e-6;
/// A tolerance so many times above what rounding leaves is proven in `f32` too.
const ROUNDED_PROOF: f64 = 4.0;
/// Iterations of one grid.
const ITERATIONS: usize = 400;

/// A grid with heights between 0 and 1, in units in which E* is 1 and the half-space has no length of its
/// own.
pub(super) struct Task {
    /// Nodes along x and y.
    pub nodes: [usize; 2],
    /// Sides of a pixel.
    pub sides: [f64; 2],
    /// True where the grid repeats; else the half-space is free around it.
    pub periodic: bool,
    /// Heights, row by row; NaN where nothing was measured.
    pub heights: Vec<f64>,
    /// Root mean square height about the mean.
    pub rms: f64,
    /// Largest pressure, infinite of an elastic half-space.
    pub limit: f64,
}

/// Projected gradients need so many times the iterations.
const PROJECTED_ITERATIONS_FACTOR: usize = 5;

/// An answer with the way to it.
#[derive(Clone, Debug)]
pub(super) struct Answer {
    /// Pressure on each node.
    pub pressure: Vec<f64>,
    /// Displacement minus height of each node.
    pub lift: Vec<f64>,
    /// Height of the plane.
    pub plane: f64,
    /// Residual of the complementarity conditions.
    pub residual: f64,
    /// Proven relative error of the pressures in the norm of the energy.
    pub error: f64,
    /// Convolutions on the finest grid.
    pub convolutions: usize,
}

impl Task {
    /// The grid in numbers of type `T`, with pressures counted from `base`.
    pub fn level<T: Real>(&self, base: f64) -> Level<T> {
        let missing = T::nearest(MISSING_HEIGHT);
        let converted = |h: &f64| if h.is_nan() { missing } else { T::nearest(*h) };
        Level {
            heights: self.heights.par_iter().map(converted).collect(),
            limit: self.limit,
            base,
            rms: self.rms,
            space: Convolution::new(self.nodes, self.sides, self.periodic),
            convolutions: 0,
        }
    }

    /// The grid with long sides halved, heights being means; `None` of a grid that is coarse.
    fn coarser(&self) -> Option<Task> {
        let nodes = self.nodes.map(|n| if n > COARSEST_SIDE { n.div_ceil(2) } else { n });
        if nodes == self.nodes {
            return None;
        }
        let sides = [0, 1].map(|k| self.sides[k] * self.nodes[k] as f64 / nodes[k] as f64);
        let range = |k: usize, i: usize| i * self.nodes[k] / nodes[k]..(i + 1) * self.nodes[k] / nodes[k];
        let mean = |i: usize| {
            let (x, y) = (i % nodes[0], i / nodes[0]);
            let (mut sum, mut n) = (0.0, 0.0);
            for row in range(1, y) {
                for h in &self.heights[row * self.nodes[0]..][range(0, x)] {
                    if !h.is_nan() {
                        (sum, n) = (sum + h, n + 1.0);
                    }
                }
            }
            if n > 0.0 { sum / n } else { f64::NAN }
        };
        let heights = (0..nodes[0] * nodes[1]).into_par_iter().map(mean).collect();
        Some(Task { nodes, sides, heights, ..*self })
    }

    /// Values of a coarser grid on the nodes of this one.
    fn prolonged(&self, nodes: [usize; 2], values: &[f32]) -> Vec<f32> {
        let [nx, ny] = self.nodes;
        let at = |i: usize| {
            let (x, y) = (i % nx * nodes[0] / nx, i / nx * nodes[1] / ny);
            // nothing to hold on to where nothing was measured
            if self.heights[i].is_nan() { 0.0 } else { values[y * nodes[0] + x] }
        };
        (0..nx * ny).into_par_iter().map(at).collect()
    }

    /// A pressure to start from, by the coarser grids.
    fn first_guess(&self, hold: Hold, base: f64) -> Vec<f32> {
        let Some(coarse) = self.coarser() else {
            return self.uniform(hold, base);
        };
        let start = coarse.first_guess(hold, base);
        let mut level = coarse.level::<f32>(base);
        let start = allowed(&level, hold, start);
        let found = search(&mut level, hold, start, None, COARSE_ERROR, ITERATIONS);
        self.prolonged(coarse.nodes, &found.pressure)
    }

    /// The same pressure everywhere.
    fn uniform(&self, hold: Hold, base: f64) -> Vec<f32> {
        let value = match hold {
            Hold::Pressure(p) => p - base,
            Hold::Plane(_) => 0.0,
        };
        self.heights.iter().map(|h| if h.is_nan() { 0.0 } else { value as f32 }).collect()
    }

    /// The error that `f32` leaves by rounding the displacements of a pressure, which is white noise on the
    /// nodes in contact: a free map sinks as a whole, and by far more than its heights where it is large or
    /// rough from pixel to pixel.
    fn rounding(&self, level: &Level<f32>, [pressure, lift]: [&[f32]; 2]) -> f64 {
        /// Mean of |q|/2 over the waves of a square grid.
        const MEAN_STIFFNESS: f64 = 1.2;
        let [bottom, _] = level.bounds();
        let [squares, measured, touching, work] = sums(lift.len(), |range| {
            range.filter(|i| !self.heights[*i].is_nan()).fold([0.0; 4], |mut sum, i| {
                let (u, p) = (lift[i].wide(), pressure[i].wide());
                sum[0] += u * u;
                sum[1] += 1.0;
                sum[2] += if pressure[i] > bottom { 1.0 } else { 0.0 };
                sum[3] += p * (u + self.heights[i]);
                sum
            })
        });
        let noise = f64::from(f32::EPSILON).powi(2) * squares / measured;
        if work > 0.0 { (MEAN_STIFFNESS * noise * touching / work).sqrt() } else { 0.0 }
    }

    /// The pressure that `hold` brings about, from `start` or from coarser grids, to `tolerance`: searched
    /// for in `f32`, proven in `f64`, and searched for in `f64` as far as that does not hold.
    pub fn solve(&self, hold: Hold, start: Option<&[f64]>, tolerance: f64) -> Answer {
        let (base, full) = match hold {
            Hold::Pressure(mean) if self.may_close(mean) => (f64::from(mean as f32), Some(self.closed(mean))),
            _ => (0.0, None),
        };
        if let Some(full) = full.filter(|full| self.bears(&full.pressure)) {
            return full;
        }
        let start = match start {
            Some(pressure) => pressure.par_iter().map(|p| (*p - base) as f32).collect(),
            None => self.first_guess(hold, base),
        };
        let mut level = self.level::<f32>(base);
        let start = allowed(&level, hold, start);
        let mut lift = vec![0.0; start.len()];
        level.lift(&start, &mut lift);
        let floor = self.rounding(&level, [&start, &lift]).max(SINGLE_PRECISION_ERROR);
        // what rounding leaves is beside what the search does
        let proves = tolerance >= ROUNDED_PROOF * floor;
        let wanted =
            if proves { (tolerance * tolerance - floor * floor).sqrt() } else { tolerance.max(floor) };
        let found = search(&mut level, hold, start, Some(lift), wanted, ITERATIONS);
        let single = level.convolutions;
        let start: Vec<f64> = found.pressure.par_iter().map(|p| f64::from(*p)).collect();
        if proves && found.error <= wanted {
            let near = level.near_contact([&found.pressure, &found.lift], found.plane);
            return Answer {
                residual: level.residual([&found.pressure, &found.lift], found.plane, &near),
                pressure: self.counted_from_zero(base, start),
                lift: found.lift.par_iter().map(|u| f64::from(*u)).collect(),
                plane: found.plane,
                error: found.error.hypot(floor),
                convolutions: single,
            };
        }
        drop((level, found));
        let mut level = self.level::<f64>(base);
        let start = allowed(&level, hold, start);
        let found = search(&mut level, hold, start, None, tolerance, ITERATIONS);
        let near = level.near_contact([&found.pressure, &found.lift], found.plane);
        Answer {
            residual: level.residual([&found.pressure, &found.lift], found.plane, &near),
            pressure: self.counted_from_zero(base, found.pressure),
            lift: found.lift,
            plane: found.plane,
            error: found.error,
            convolutions: single + level.convolutions,
        }
    }

    /// Pressures counted from 0 of those counted from `base`, those at a bound exactly there.
    fn counted_from_zero(&self, base: f64, mut pressure: Vec<f64>) -> Vec<f64> {
        if base > 0.0 {
            // the bound is that of either number type
            let low = -base;
            let [single, double] = [f64::from((self.limit - base) as f32), self.limit - base];
            let top = single.min(double);
            pressure.par_iter_mut().for_each(|p| {
                *p = if *p <= low {
                    0.0
                } else if *p >= top {
                    self.limit
                } else {
                    *p + base
                }
            });
        }
        pressure
    }

    /// True where a `mean` pressure might close every gap: of full contact the pressures vary by E* h'/2,
    /// root mean square, about their mean. Steps between neighbours give no more than the true slope h'.
    fn may_close(&self, mean: f64) -> bool {
        let [nx, ny] = self.nodes;
        let h = &self.heights;
        let [squares, missing] = sums(h.len(), |range| {
            range.fold([0.0, 0.0], |[squares, missing], i| {
                let (x, y) = (i % nx, i / nx);
                let right = h[y * nx + (x + 1) % nx] - h[i];
                let above = h[(y + 1) % ny * nx + x] - h[i];
                if h[i].is_nan() {
                    return [squares, missing + 1.0];
                }
                [squares + (right / self.sides[0]).powi(2) + (above / self.sides[1]).powi(2), missing]
            })
        });
        self.periodic && missing == 0.0 && mean >= 0.5 * (squares / h.len() as f64).sqrt()
    }

    /// Full contact under a `mean` pressure: p = P + F⁻¹(E* |q|/2 ĥ), whatever its bounds.
    fn closed(&self, mean: f64) -> Answer {
        let mut level = self.level::<f64>(mean);
        let [plane, _] = <[f64; 2]>::from(spread(&self.heights));
        let uneven: Vec<f64> = self.heights.par_iter().map(|h| h - plane).collect();
        let [mut pressure, mut lift] = [(); 2].map(|()| vec![0.0; uneven.len()]);
        level.apply(Way::Stiffness, &uneven, &mut pressure);
        level.lift(&pressure, &mut lift);
        let near = level.near_contact([&pressure, &lift], plane);
        let residual = level.residual([&pressure, &lift], plane, &near);
        let error = proven(&mut level, Hold::Pressure(mean), [&pressure, &lift], plane);
        pressure.par_iter_mut().for_each(|p| *p += mean);
        Answer { pressure, lift, plane, residual, error, convolutions: level.convolutions }
    }

    /// True where no pressure lies beyond its bounds.
    fn bears(&self, pressure: &[f64]) -> bool {
        pressure.par_iter().all(|p| *p > 0.0 && *p < self.limit)
    }
}

/// Conjugate gradients; where those stall in metal that flows, as they may where most of it does, projected
/// gradients.
fn search<T: Real>(
    level: &mut Level<T>,
    hold: Hold,
    start: Vec<T>,
    lift: Option<Vec<T>>,
    tolerance: f64,
    iterations: usize,
) -> Search<T> {
    let found = conjugate_gradients(level, hold, start, lift, tolerance, iterations);
    if found.error <= tolerance || !level.limit.is_finite() {
        return found;
    }
    let start = allowed(level, hold, found.pressure);
    projected_gradient(level, hold, start, tolerance, PROJECTED_ITERATIONS_FACTOR * iterations)
}

/// `start` within the bounds and with the load.
fn allowed<T: Real>(level: &Level<T>, hold: Hold, mut start: Vec<T>) -> Vec<T> {
    let [bottom, top] = level.bounds();
    start.par_iter_mut().for_each(|p| *p = p.max(bottom).min(top));
    if let Hold::Pressure(wanted) = hold {
        level.rescale(&mut start, wanted);
    }
    start
}

/// Mean and root mean square about it of what was measured.
pub(super) fn spread(heights: &[f64]) -> (f64, f64) {
    let [sum, n] = sums(heights.len(), |range| {
        heights[range].iter().filter(|h| !h.is_nan()).fold([0.0, 0.0], |[s, n], h| [s + h, n + 1.0])
    });
    let mean = sum / n;
    let [squares] = sums(heights.len(), |range| {
        [heights[range].iter().filter(|h| !h.is_nan()).map(|h| (h - mean) * (h - mean)).sum()]
    });
    (mean, (squares / n).sqrt())
}
