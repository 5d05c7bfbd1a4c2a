//! Projected conjugate gradients (Polonsky and Keer 1999), preconditioned on the nodes that are free to change.

use super::convolution::Way;
use super::level::{Hold, Level, Search, is_free};
use super::real::{CHUNK, Real, total};
use rayon::prelude::*;

/// Iterations without a better residual after which the search ends.
const STALLED: usize = 12;

/// Lowers the residual of `start` to `tolerance`, at most `iterations` times.
///
/// p pressure, u = A p - h lift, d plane, g = u + d gap; the working set W are the nodes between the bounds or pushed from
/// them. Each iteration: r = g on W; z = P F⁻¹ (|q|/2) F P r with P the projection on W (and on zero sum, where the load is
/// held); t = z + β t with β = max(0, z·(r - r_old)/(z_old·r_old)) (Polak and Ribière); p := p - (r·t/t·At) t, cut at the
/// bounds and scaled to the load.
pub(super) fn conjugate_gradients<T: Real>(
    level: &mut Level<T>,
    hold: Hold,
    start: Vec<T>,
    tolerance: f64,
    iterations: usize,
) -> Search<T> {
    let n = start.len();
    let top = level.top();
    let zero_sum = matches!(hold, Hold::Pressure(_));
    let mut p = start;
    let [mut u, mut r, mut z, mut t] = [(); 4].map(|()| vec![T::zero(); n]);
    let (mut last, mut product) = (None, 0.0);
    let mut best = f64::INFINITY;
    let mut since = 0;
    let mut iteration = 0;
    loop {
        level.lift(&p, &mut u);
        let d = level.plane(hold, &p, &u, last);
        last = Some(d);
        let residual = level.residual(&p, &u, d);
        since = if residual < 0.9 * best { 0 } else { since + 1 };
        best = best.min(residual);
        if residual <= tolerance || iteration == iterations || since > STALLED || !residual.is_finite() {
            return Search { pressure: p, lift: u, plane: d, residual };
        }
        iteration += 1;
        // u becomes the new residual on W, r stays the old one until z is known
        let at = T::of(d);
        u.par_chunks_mut(CHUNK).zip(p.par_chunks(CHUNK)).for_each(|(u, p)| {
            for (u, p) in u.iter_mut().zip(p) {
                let gap = *u + at;
                *u = if is_free(*p, gap, top) { gap } else { T::zero() };
            }
        });
        level.apply(Way::Stiffness, &u, &mut z);
        let shift = if zero_sum { mean_on(&z, &u) } else { T::zero() };
        let parts: Vec<[f64; 2]> = z
            .par_chunks_mut(CHUNK)
            .zip(u.par_chunks(CHUNK))
            .zip(r.par_chunks(CHUNK))
            .map(|((z, u), r)| {
                let mut sum = [0.0; 2];
                for ((z, u), r) in z.iter_mut().zip(u).zip(r) {
                    *z = if *u != T::zero() { *z - shift } else { T::zero() };
                    sum[0] += z.wide() * u.wide();
                    sum[1] += z.wide() * r.wide();
                }
                sum
            })
            .collect();
        let [now, before] = total(&parts);
        let beta = if product > 0.0 { ((now - before) / product).max(0.0) } else { 0.0 };
        product = now;
        std::mem::swap(&mut r, &mut u);
        let by = T::of(beta);
        t.par_chunks_mut(CHUNK).zip(z.par_chunks(CHUNK)).zip(r.par_chunks(CHUNK)).for_each(|((t, z), r)| {
            for ((t, z), r) in t.iter_mut().zip(z).zip(r) {
                *t = if *r != T::zero() { *z + by * *t } else { T::zero() };
            }
        });
        if zero_sum {
            let shift = mean_on(&t, &r);
            t.par_chunks_mut(CHUNK).zip(r.par_chunks(CHUNK)).for_each(|(t, r)| {
                t.iter_mut().zip(r).filter(|(_, r)| **r != T::zero()).for_each(|(t, _)| *t = *t - shift);
            });
        }
        level.apply(Way::Compliance, &t, &mut z);
        let parts: Vec<[f64; 2]> = t
            .par_chunks(CHUNK)
            .zip(z.par_chunks(CHUNK))
            .zip(r.par_chunks(CHUNK))
            .map(|((t, z), r)| {
                t.iter().zip(z).zip(r).fold([0.0, 0.0], |[along, work], ((t, z), r)| {
                    [along + r.wide() * t.wide(), work + t.wide() * z.wide()]
                })
            })
            .collect();
        let [along, work] = total(&parts);
        if work <= 0.0 || along <= 0.0 {
            product = 0.0;
            t.fill(T::zero());
            if work <= 0.0 {
                since += 10;
                continue;
            }
        }
        let step = T::of(along / work);
        p.par_chunks_mut(CHUNK).zip(t.par_chunks(CHUNK)).for_each(|(p, t)| {
            p.iter_mut().zip(t).for_each(|(p, t)| *p = (*p - step * *t).max(T::zero()).min(top));
        });
        if let Hold::Pressure(wanted) = hold {
            level.rescale(&mut p, wanted);
        }
    }
}

/// Mean of `values` over the nodes where `on` is not 0.
fn mean_on<T: Real>(values: &[T], on: &[T]) -> T {
    let parts: Vec<[f64; 2]> = values
        .par_chunks(CHUNK)
        .zip(on.par_chunks(CHUNK))
        .map(|(values, on)| {
            values
                .iter()
                .zip(on)
                .filter(|(_, on)| **on != T::zero())
                .fold([0.0, 0.0], |[sum, n], (v, _)| [sum + v.wide(), n + 1.0])
        })
        .collect();
    let [sum, n] = total(&parts);
    if n > 0.0 { T::of(sum / n) } else { T::zero() }
}
