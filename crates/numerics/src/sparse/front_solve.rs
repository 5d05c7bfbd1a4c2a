//! Solves with the columns of one front.
//!
//! Symbols and storage: see `front`. Every product is fused with its sum where the processor can.

use crate::sparse::front::{TILE, fma};
use crate::sparse::front_size::{Number, Size};
use pulp::{Arch, Simd, WithSimd};

/// Rows that are taken at once.
const SOLVE_ROWS: usize = 8;

/// Solves with the columns of a front: `local` holds the right-hand side in its rows.
struct Solve<'a, T> {
    size: Size,
    panel: &'a [T],
    local: &'a mut [T],
}

/// y ← L⁻¹ y, with what that takes from the rows below.
struct Forward<'a, T>(Solve<'a, T>);

/// y ← L⁻ᵀ y in the rows of pivots, from the rows below.
struct Backward<'a, T>(Solve<'a, T>);

impl<'a, T: Number> Solve<'a, T> {
    /// The columns of the N pivots from `start` on, from the row `from` on.
    #[inline(always)]
    fn columns<const N: usize>(&self, start: usize, from: usize) -> [&'a [T]; N] {
        let column = self.size.panel_column();
        let mut out = [self.panel; N];
        for (p, out) in out.iter_mut().enumerate() {
            *out = &self.panel[(start + p) * column + from..(start + p + 1) * column];
        }
        out
    }
}

/// Rows from `row` on that come before the next [`SOLVE_ROWS`] rows.
const fn before_tiles(row: usize) -> usize {
    row.next_multiple_of(SOLVE_ROWS) - row
}

/// [`SOLVE_ROWS`] numbers from `row` on.
#[inline(always)]
fn some_rows<T: Number>(of: &[T], row: usize) -> [T; SOLVE_ROWS] {
    of[row..].first_chunk().copied().unwrap_or_default()
}

impl<T: Number> Forward<'_, T> {
    /// The N pivots from `start` on.
    #[inline(always)]
    fn block<const N: usize, const FUSED: bool>(&mut self, start: usize) {
        let end = start + N;
        let own = self.0.columns::<N>(start, start);
        let columns = self.0.columns::<N>(start, end);
        let (pivots, below) = self.0.local[start..].split_at_mut(N);
        let mut y = [T::default(); N];
        y.copy_from_slice(pivots);
        for j in 0..N {
            for i in 0..N {
                if i > j {
                    y[i] = fma::<FUSED, T>(-own[j][i], y[j], y[i]);
                }
            }
        }
        pivots.copy_from_slice(&y);
        let first = before_tiles(end).min(below.len());
        for row in 0..first {
            for j in 0..N {
                below[row] = fma::<FUSED, T>(-columns[j][row], y[j], below[row]);
            }
        }
        for row in (first..below.len()).step_by(SOLVE_ROWS) {
            let mut c = some_rows(below, row);
            for j in 0..N {
                let l = some_rows(columns[j], row);
                for i in 0..SOLVE_ROWS {
                    c[i] = fma::<FUSED, T>(-l[i], y[j], c[i]);
                }
            }
            below[row..row + SOLVE_ROWS].copy_from_slice(&c);
        }
    }

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        for start in (0..self.0.size.pivots).step_by(TILE) {
            self.next_block::<FUSED>(start);
        }
    }
}

impl<T: Number> Backward<'_, T> {
    /// The N pivots from `start` on.
    #[inline(always)]
    fn block<const N: usize, const FUSED: bool>(&mut self, start: usize) {
        let end = start + N;
        let own = self.0.columns::<N>(start, start);
        let columns = self.0.columns::<N>(start, end);
        let (pivots, below) = self.0.local[start..].split_at_mut(N);
        let mut sums = [[T::default(); SOLVE_ROWS]; N];
        let first = before_tiles(end).min(below.len());
        for row in 0..first {
            for j in 0..N {
                sums[j][0] = fma::<FUSED, T>(columns[j][row], below[row], sums[j][0]);
            }
        }
        for row in (first..below.len()).step_by(SOLVE_ROWS) {
            let y = some_rows(below, row);
            for j in 0..N {
                let l = some_rows(columns[j], row);
                for i in 0..SOLVE_ROWS {
                    sums[j][i] = fma::<FUSED, T>(l[i], y[i], sums[j][i]);
                }
            }
        }
        let mut y = [T::default(); N];
        y.copy_from_slice(pivots);
        for j in (0..N).rev() {
            let [a, b, c, d, e, f, g, h] = sums[j];
            y[j] -= ((a + b) + (c + d)) + ((e + f) + (g + h));
            for i in 0..N {
                if i > j {
                    y[j] = fma::<FUSED, T>(-own[j][i], y[i], y[j]);
                }
            }
        }
        pivots.copy_from_slice(&y);
    }

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        for start in (0..self.0.size.pivots).step_by(TILE).rev() {
            self.next_block::<FUSED>(start);
        }
    }
}

macro_rules! dispatched {
    ($what:ident) => {
        impl<T: Number> $what<'_, T> {
            /// The block of pivots from `start` on, as many as a tile has columns or are left.
            #[inline(always)]
            fn next_block<const FUSED: bool>(&mut self, start: usize) {
                match self.0.size.pivots - start {
                    1 => self.block::<1, FUSED>(start),
                    2 => self.block::<2, FUSED>(start),
                    3 => self.block::<3, FUSED>(start),
                    _ => self.block::<TILE, FUSED>(start),
                }
            }
        }

        impl<T: Number> WithSimd for $what<'_, T> {
            type Output = ();

            #[inline(always)]
            fn with_simd<S: Simd>(self, _: S) {
                if S::IS_SCALAR { self.run::<false>() } else { self.run::<true>() }
            }
        }
    };
}

dispatched!(Forward);
dispatched!(Backward);

/// y ← L⁻¹ y: `local` has the rows of the panel.
pub fn solve_forward<T: Number>(arch: Arch, size: Size, panel: &[T], local: &mut [T]) {
    arch.dispatch(Forward(Solve { size, panel, local }));
}

/// y ← L⁻ᵀ y: `local` has the rows of the panel, those below the pivots are known.
pub fn solve_backward<T: Number>(arch: Arch, size: Size, panel: &[T], local: &mut [T]) {
    arch.dispatch(Backward(Solve { size, panel, local }));
}
