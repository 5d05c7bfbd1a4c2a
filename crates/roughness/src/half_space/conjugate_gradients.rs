//! Projected conjugate gradients (Polonsky and Keer 1999), preconditioned on the nodes that are free to
//! change.

use super::convolution::Way;
use super::nodes::Nodes;
use crate::half_space::float::Real;
use crate::half_space::grid_level::{Hold, Level, Search, is_free};

/// Iterations without a better error after which the search ends.
const STALLED_ITERATIONS: usize = 12;

/// Lowers the proven error of `start` to `tolerance`, at most `iterations` times. `lift` is that of `start`
/// where it is known.
///
/// p pressure, u = A p - h lift, d plane, g = u + d gap; the working set W are the nodes between the bounds
/// or pushed from them. Each iteration: r = g on W; z = P F⁻¹ (|q|/2) F P r with P the projection on W (and
/// on zero sum, where the load is held); t = z + β t with β = max(0, z·(r - r_old)/(z_old·r_old)) (Polak and
/// Ribière); p := p - (r·t/t·At) t, cut at the bounds and scaled to the load.
pub(super) fn conjugate_gradients<T: Real>(
    level: &mut Level<T>,
    hold: Hold,
    start: Vec<T>,
    lift: Option<Vec<T>>,
    tolerance: f64,
    iterations: usize,
) -> Search<T> {
    let n = start.len();
    let bounds @ [bottom, top] = level.bounds();
    let zero_sum = matches!(hold, Hold::Pressure(_));
    let mut p = start;
    // r, its last one, and t are 0 beside the nodes that are free, or were
    let [mut r, mut r_old, mut z, mut t] = [(); 4].map(|()| vec![T::zero(); n]);
    let mut known = lift.is_some();
    let mut u = lift.unwrap_or_else(|| vec![T::zero(); n]);
    let mut touching = Nodes::select(n, |i| p[i] > bottom);
    let mut free = Nodes::select(0, |_| false);
    let (mut last, mut product) = (None, 0.0);
    let mut best = f64::INFINITY;
    let mut since = 0;
    let mut iteration = 0;
    loop {
        if !std::mem::take(&mut known) {
            level.lift(&p, &mut u);
        }
        let (d, near) = level.plane(hold, [&p, &u], &touching, last);
        last = Some(d);
        let at = T::nearest(d);
        // of a gap of 0 nothing is to be changed
        let freed = near.those(|i| (u[i] + at != T::zero()) & is_free(p[i], u[i] + at, bounds));
        std::mem::swap(&mut r, &mut r_old);
        freed.set(&mut r, |i, _| u[i] + at);
        level.apply(Way::Stiffness, &r, &mut z);
        // of the nodes: their number, and sums of t, z, r, r_old, z r and z r_old
        let [nodes, of_t, of_z, of_r, of_old, z_r, z_old] = freed.sums(|i| {
            let [t, z, r, old] = [t[i], z[i], r[i], r_old[i]].map(T::wide);
            [1.0, t, z, r, old, z * r, z * old]
        });
        let error = level.error(hold, [z_r, of_r], [&p, &u], &touching);
        since = if error < 0.9 * best { 0 } else { since + 1 };
        best = best.min(error);
        if error <= tolerance || iteration == iterations || since > STALLED_ITERATIONS || !error.is_finite() {
            return Search { pressure: p, lift: u, plane: d, error };
        }
        iteration += 1;
        let mean = |sum: f64| if zero_sum && nodes > 0.0 { sum / nodes } else { 0.0 };
        let now = z_r - mean(of_z) * of_r;
        let beta =
            if product > 0.0 { ((now - (z_old - mean(of_z) * of_old)) / product).max(0.0) } else { 0.0 };
        product = now;
        free.set_both(&mut r_old, &mut t, |i, [_, t]| {
            [T::zero(), if r[i] == T::zero() { T::zero() } else { t }]
        });
        free = freed;
        let [by, even] = [beta, mean(of_z) + beta * mean(of_t)].map(T::nearest);
        free.set(&mut t, |i, t| z[i] - even + by * t);
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
        let load;
        (touching, [load]) = near.those_with_sums(|i| match p[i] > bottom {
            true => (true, [level.full(p[i])]),
            false => (false, [0.0]),
        });
        if let Hold::Pressure(wanted) = hold {
            touching = level.rescale_on(touching, load, &mut p, wanted);
        }
    }
}
