//! Stiffness of the interface: the change of load with the mean gap while the contact keeps its rim.

use super::cascade::Task;
use super::convolution::Way;
use crate::half_space::float::{Real, sums};
use crate::half_space::grid_level::Level;

/// Residual at which the search ends: the stiffness is its square better, 1e-4, while pixels change it by
/// percents.
const TOLERANCE: f64 = 1e-2;
/// Iterations at most.
const ITERATIONS: usize = 200;

/// Changes of the nominal pressure while a contact keeps its rim, in Pa/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stiffness {
    /// -dp/d(mean gap): of the roughness alone.
    pub gap: f64,
    /// -dp/d(plane): of a map that stands free the dent of the body is in it; of a periodic elastic one it is
    /// the same.
    pub plane: f64,
}

impl Stiffness {
    /// The same with its numbers times `factor`.
    pub(super) fn scaled(self, factor: f64) -> Stiffness {
        Stiffness { gap: self.gap * factor, plane: self.plane * factor }
    }
}

/// The stiffness by the mean pressure over all nodes, in the units of the solver; None without contact or
/// gap.
///
/// On the nodes in contact that are below the limit the displacement t → A t follows the plane, on the others
/// t is 0. The change of pressure of unit mean solves A t = const there, by preconditioned conjugate
/// gradients on a fixed set. The plane moves by that constant, and the gap by as much as surface beside the
/// contact does not follow.
pub(super) fn stiffness(task: &Task, pressure: &[f64]) -> Option<Stiffness> {
    let mut level: Level<f32> = task.level(0.0);
    let n = pressure.len();
    let inside: Vec<bool> = pressure.iter().map(|p| *p > 0.0 && *p < task.limit).collect();
    let open: Vec<bool> = pressure.iter().zip(&task.heights).map(|(p, h)| *p <= 0.0 && !h.is_nan()).collect();
    let count = inside.iter().filter(|i| **i).count() as f64;
    let gaps = open.iter().filter(|o| **o).count() as f64;
    if count == 0.0 || gaps == 0.0 {
        return None;
    }
    let measured = task.heights.iter().filter(|h| !h.is_nan()).count() as f64;
    let mean = |values: &[f32]| {
        let [sum] = sums(n, |range| {
            [values[range.clone()]
                .iter()
                .zip(&inside[range])
                .filter(|(_, i)| **i)
                .map(|(v, _)| v.wide())
                .sum()]
        });
        sum / count
    };
    let dot = |a: &[f32], b: &[f32]| {
        let [sum] =
            sums(n, |range| [a[range.clone()].iter().zip(&b[range]).map(|(a, b)| a.wide() * b.wide()).sum()]);
        sum
    };
    // of a displacement, what is not even on the contact: sums of what is added to the pressure stay 0
    let uneven = |values: &[f32], out: &mut [f32]| {
        let shift = mean(values);
        out.iter_mut()
            .zip(values)
            .zip(&inside)
            .for_each(|((o, v), i)| *o = if *i { (v.wide() - shift) as f32 } else { 0.0 });
    };
    let mut t: Vec<f32> = inside.iter().map(|i| if *i { (n as f64 / count) as f32 } else { 0.0 }).collect();
    // u: displacement of the change of pressure, even at first; r: what of it is uneven
    let [mut u, mut r, mut z, mut q] = [(); 4].map(|()| vec![0f32; n]);
    level.apply(Way::Compliance, &t, &mut u);
    t.fill(0.0);
    let (mut last, mut first) = (0.0, None);
    for _ in 0..ITERATIONS {
        uneven(&u, &mut r);
        level.apply(Way::Stiffness, &r, &mut q);
        uneven(&q, &mut z);
        let now = dot(&r, &z);
        if now <= TOLERANCE * TOLERANCE * *first.get_or_insert(now) {
            break;
        }
        let beta = if last > 0.0 { (now / last) as f32 } else { 0.0 };
        last = now;
        t.iter_mut().zip(&z).for_each(|(t, z)| *t = *z + beta * *t);
        level.apply(Way::Compliance, &t, &mut q);
        let work = dot(&t, &q);
        if work <= 0.0 {
            break;
        }
        let step = (now / work) as f32;
        u.iter_mut().zip(&q).for_each(|(u, q)| *u -= step * *q);
    }
    // the plane comes down by what the contact yields, the surface beside it by its own displacement
    let plane = mean(&u);
    let [beside] = sums(n, |range| {
        [u[range.clone()].iter().zip(&open[range]).filter(|(_, o)| **o).map(|(v, _)| plane - v.wide()).sum()]
    });
    // beside is the loss of gap per unit of mean pressure, summed over the open nodes
    let change = beside / measured;
    (change > 0.0 && plane > 0.0).then(|| Stiffness { gap: 1.0 / change, plane: 1.0 / plane })
}
