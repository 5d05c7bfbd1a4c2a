//! Projected conjugate gradients (Polonsky and Keer 1999), preconditioned on the nodes that are free to
//! change.

use super::convolution::Way;
use super::nodes::Nodes;
use crate::half_space::float::Real;
use crate::half_space::grid_level::{Hold, Level, Search, is_free};

/// Iterations without a better error after which the search ends.
const STALLED_ITERATIONS: usize = 12;

/// Lowers the proven error of `start` to `tolerance`, at most `iterations` times.
///
/// p pressure, u = A p - h lift, d plane, g = u + d gap; the working set W are the nodes between the bounds
/// or pushed from them. Each iteration: r = g on W; z = P F⁻¹ (|q|/2) F P r with P the projection on W (and
/// on zero sum, where the load is held); t = z + β t with β = max(0, z·(r - r_old)/(z_old·r_old)) (Polak and
/// Ribière); p := p - (r·t/t·At) t, cut at the bounds and scaled to the load.
pub(super) fn conjugate_gradients<T: Real>(
    level: &mut Level<T>,
    hold: Hold,
    start: Vec<T>,
    tolerance: f64,
    iterations: usize,
) -> Search<T> {
    let n = start.len();
    let bounds @ [bottom, top] = level.bounds();
    let zero_sum = matches!(hold, Hold::Pressure(_));
    let mut p = start;
    // r, its last one, and t are 0 beside the nodes that are free, or were
    let [mut u, mut r, mut r_old, mut z, mut t] = [(); 5].map(|()| vec![T::zero(); n]);
    let mut touching = Nodes::select(n, |i| p[i] > bottom);
    let mut free = Nodes::select(0, |_| false);
    let (mut last, mut product) = (None, 0.0);
    let mut best = f64::INFINITY;
    let mut since = 0;
    let mut iteration = 0;
    loop {
        level.lift(&p, &mut u);
        let (d, near) = level.plane(hold, [&p, &u], &touching, last);
        last = Some(d);
        let at = T::nearest(d);
        // of a gap of 0 nothing is to be changed
        let freed = near.those(|i| u[i] + at != T::zero() && is_free(p[i], u[i] + at, bounds));
        std::mem::swap(&mut r, &mut r_old);
        freed.set(&mut r, |i, _| u[i] + at);
        level.apply(Way::Stiffness, &r, &mut z);
        let error = level.error(hold, [&r, &z], &freed, [&p, &u]);
        since = if error < 0.9 * best { 0 } else { since + 1 };
        best = best.min(error);
        if error <= tolerance || iteration == iterations || since > STALLED_ITERATIONS || !error.is_finite() {
            return Search { pressure: p, lift: u, plane: d, error };
        }
        iteration += 1;
        let shift = if zero_sum { mean(&freed, &z) } else { T::zero() };
        freed.set(&mut z, |_, z| z - shift);
        let [now, before] = freed.sums(|i| [z[i].wide() * r[i].wide(), z[i].wide() * r_old[i].wide()]);
        let beta = if product > 0.0 { ((now - before) / product).max(0.0) } else { 0.0 };
        product = now;
        free.set(&mut r_old, |_, _| T::zero());
        free.set(&mut t, |i, t| if r[i] != T::zero() { t } else { T::zero() });
        free = freed;
        let by = T::nearest(beta);
        free.set(&mut t, |i, t| z[i] + by * t);
        if zero_sum {
            let shift = mean(&free, &t);
            free.set(&mut t, |_, t| t - shift);
        }
        level.apply(Way::Compliance, &t, &mut z);
        let [along, work] = free.sums(|i| [r[i].wide() * t[i].wide(), t[i].wide() * z[i].wide()]);
        if work <= 0.0 || along <= 0.0 {
            product = 0.0;
            free.set(&mut t, |_, _| T::zero());
            if work <= 0.0 {
                since += 10;
                continue;
            }
        }
        let step = T::nearest(along / work);
        free.set(&mut p, |i, p| (p - step * t[i]).max(bottom).min(top));
        touching = near.those(|i| p[i] > bottom);
        if let Hold::Pressure(wanted) = hold {
            touching = level.rescale_on(touching, &mut p, wanted);
        }
    }
}

/// Mean of `values` over the nodes.
fn mean<T: Real>(nodes: &Nodes, values: &[T]) -> T {
    let [sum, n] = nodes.sums(|i| [values[i].wide(), 1.0]);
    if n > 0.0 { T::nearest(sum / n) } else { T::zero() }
}
