//! Projected gradients with steps after Barzilai and Borwein, for contacts where most of the metal flows.

use super::convolution::Way;
use crate::half_space::float::{CHUNK, Real, total};
use crate::half_space::grid_level::{Hold, Level, MISSING_HEIGHT, Search, is_free};
use rayon::prelude::*;

/// The error is looked at when the residual has come down by this: it takes a convolution.
const LOOK_FACTOR: f64 = 0.7;
/// Passes of the search for the shift of a projection.
const PASSES: usize = 100;
/// Relative error of the load after a projection.
const LOAD_TOLERANCE: f64 = 1e-12;

/// Lowers the proven error of `start` to `tolerance`, at most `iterations` times; the best pressure that
/// was met.
///
/// p pressure, u = A p - h lift, P the projection on the bounds and, where it is held, on the load: one shift
/// for all nodes, which is the plane. Each iteration: p := P(p - α u) with α = s·s/s·y or s·y/y·y in turn
/// (Barzilai and Borwein 1988; Dai and Fletcher 2005), s and y the last changes of p and u. One convolution
/// each, and no set of free nodes to choose.
pub(super) fn projected_gradient<T: Real>(
    level: &mut Level<T>,
    hold: Hold,
    start: Vec<T>,
    tolerance: f64,
    iterations: usize,
) -> Search<T> {
    let n = start.len();
    let mut p = start;
    let [mut u, mut p_old, mut u_old] = [(); 3].map(|()| vec![T::zero(); n]);
    let mut alpha = first_step(level);
    let mut best: Option<Search<T>> = None;
    let mut looked = f64::INFINITY;
    for iteration in 0..=iterations {
        level.lift(&p, &mut u);
        if iteration > 0 {
            let [ss, sy, yy] = changes([&p, &p_old], [&u, &u_old]);
            if sy > 0.0 {
                alpha = if iteration % 2 == 0 { ss / sy } else { sy / yy };
            }
        }
        let (next, plane) = projected(level, hold, &p, &u, alpha);
        let residual = level.residual([&p, &u], plane, &level.near_contact([&p, &u], plane));
        if !residual.is_finite() {
            break;
        }
        if residual <= LOOK_FACTOR * looked || iteration == iterations {
            looked = residual;
            let error = proven(level, hold, [&p, &u], plane);
            if best.as_ref().is_none_or(|b| error < b.error) {
                best = Some(Search { pressure: p.clone(), lift: u.clone(), plane, error });
            }
            if error <= tolerance {
                break;
            }
        }
        p_old = std::mem::replace(&mut p, next);
        std::mem::swap(&mut u, &mut u_old);
    }
    best.unwrap_or(Search { pressure: p, lift: u, plane: 0.0, error: f64::INFINITY })
}

/// The proven error of a pressure, by a convolution.
pub(super) fn proven<T: Real>(level: &mut Level<T>, hold: Hold, [p, u]: [&[T]; 2], plane: f64) -> f64 {
    let (at, bounds) = (T::nearest(plane), level.bounds());
    let near = level.near_contact([p, u], plane);
    let freed = near.those(|i| is_free(p[i], u[i] + at, bounds));
    let [mut wrong, mut stiff] = [(); 2].map(|()| vec![T::zero(); p.len()]);
    freed.set(&mut wrong, |i, _| u[i] + at);
    level.apply(Way::Stiffness, &wrong, &mut stiff);
    let sums = freed.sums(|i| [wrong[i].wide() * stiff[i].wide(), wrong[i].wide()]);
    level.error(hold, sums, [p, u], &near)
}

/// A step that suits the longest waves: half the stiffness of the wave as long as the grid.
fn first_step<T: Real>(level: &Level<T>) -> f64 {
    std::f64::consts::PI / (level.heights.len() as f64).sqrt()
}

/// s·s, s·y, y·y of the changes of pressure and lift.
fn changes<T: Real>(p: [&[T]; 2], u: [&[T]; 2]) -> [f64; 3] {
    let parts: Vec<[f64; 3]> = p[0]
        .par_chunks(CHUNK)
        .zip(p[1].par_chunks(CHUNK))
        .zip(u[0].par_chunks(CHUNK).zip(u[1].par_chunks(CHUNK)))
        .map(|((p, p_old), (u, u_old))| {
            let mut sum = [0.0; 3];
            for ((p, p_old), (u, u_old)) in p.iter().zip(p_old).zip(u.iter().zip(u_old)) {
                let (s, y) = ((*p - *p_old).wide(), (*u - *u_old).wide());
                sum[0] += s * s;
                sum[1] += s * y;
                sum[2] += y * y;
            }
            sum
        })
        .collect();
    total(&parts)
}

/// P(p - α u), and the height of the plane that the shift stands for.
fn projected<T: Real>(level: &Level<T>, hold: Hold, p: &[T], u: &[T], alpha: f64) -> (Vec<T>, f64) {
    let (step, hole) = (T::nearest(alpha), T::nearest(MISSING_HEIGHT));
    let mut free = vec![T::zero(); p.len()];
    free.par_chunks_mut(CHUNK)
        .zip(p.par_chunks(CHUNK).zip(u.par_chunks(CHUNK)))
        .zip(level.heights.par_chunks(CHUNK))
        .for_each(|((free, (p, u)), h)| {
            for ((free, (p, u)), h) in free.iter_mut().zip(p.iter().zip(u)).zip(h) {
                *free = if *h <= hole { hole } else { *p - step * *u };
            }
        });
    let shift = match hold {
        Hold::Plane(plane) => -alpha * plane,
        Hold::Pressure(mean) => shift(level, &free, mean * p.len() as f64),
    };
    let (by, [bottom, top]) = (T::nearest(shift), level.bounds());
    free.par_iter_mut().for_each(|v| *v = (*v + by).max(bottom).min(top));
    (free, -shift / alpha)
}

/// The shift after which the pressures `values`, cut at their bounds and counted from 0, sum to `target`:
/// Newton's method kept in its bracket.
fn shift<T: Real>(level: &Level<T>, values: &[T], target: f64) -> f64 {
    let limit = level.limit;
    // the load at a shift, and how many nodes change it
    let carried = |shift: f64| {
        let parts: Vec<[f64; 2]> = values
            .par_chunks(CHUNK)
            .map(|part| {
                part.iter().fold([0.0, 0.0], |[sum, n], v| {
                    let v = level.full(*v) + shift;
                    if v <= 0.0 {
                        [sum, n]
                    } else if v >= limit {
                        [sum + limit, n]
                    } else {
                        [sum + v, n + 1.0]
                    }
                })
            })
            .collect();
        total(&parts)
    };
    let mean = target / values.len() as f64;
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let (mut at, mut stride) = (0.0, mean);
    for _ in 0..PASSES {
        let [sum, n] = carried(at);
        if (sum - target).abs() <= LOAD_TOLERANCE * target {
            break;
        }
        if sum < target {
            low = at
        } else {
            high = at
        }
        let newton = if n > 0.0 { at + (target - sum) / n } else { f64::NAN };
        at = if newton > low && newton < high {
            newton
        } else if low.is_finite() && high.is_finite() {
            0.5 * (low + high)
        } else {
            stride *= 2.0;
            if sum < target { at + stride } else { at - stride }
        };
    }
    at
}
