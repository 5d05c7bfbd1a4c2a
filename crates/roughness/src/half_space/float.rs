//! The two number types of the solver, and sums over maps that are the same for any number of threads.

use rayon::prelude::*;
use std::ops::Range;

/// Numbers that one task takes: fixed, so that sums come out the same for any number of threads.
pub(super) const CHUNK: usize = 1 << 14;

/// `f32` for the fast stage, `f64` for the last digits.
pub(crate) trait Real:
    realfft::FftNum + num_traits::Float + num_traits::NumAssignOps + Default + 'static
{
    /// Nearest number of this type.
    fn nearest(value: f64) -> Self;
    /// The same as `f64`.
    fn wide(self) -> f64;
}

impl Real for f32 {
    fn nearest(value: f64) -> f32 {
        value as f32
    }

    fn wide(self) -> f64 {
        f64::from(self)
    }
}

impl Real for f64 {
    fn nearest(value: f64) -> f64 {
        value
    }

    fn wide(self) -> f64 {
        self
    }
}

/// Sums of the parts, in their order.
pub(super) fn total<const K: usize>(parts: &[[f64; K]]) -> [f64; K] {
    let mut sum = [0.0; K];
    for part in parts {
        sum.iter_mut().zip(part).for_each(|(a, b)| *a += b);
    }
    sum
}

/// Sums over 0..n, `of` giving those of a range.
pub(super) fn sums<const K: usize>(n: usize, of: impl Fn(Range<usize>) -> [f64; K] + Sync) -> [f64; K] {
    let part = |k: usize| of(k * CHUNK..((k + 1) * CHUNK).min(n));
    let parts: Vec<[f64; K]> = (0..n.div_ceil(CHUNK)).into_par_iter().map(part).collect();
    total(&parts)
}
