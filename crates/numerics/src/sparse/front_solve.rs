//! Solves with the columns of one front.
//!
//! Symbols and storage: see `front`. Every product is fused with its sum where the processor can.

use crate::sparse::front::{TILE, fma};
use crate::sparse::front_size::Size;
use pulp::{Arch, Simd, WithSimd};

/// Solves with the columns of a front: `local` holds the right-hand side in its rows.
struct Solve<'a> {
    size: Size,
    panel: &'a [f64],
    local: &'a mut [f64],
}

/// y ← L⁻¹ y, with what that takes from the rows below.
struct Forward<'a>(Solve<'a>);

/// y ← L⁻ᵀ y in the rows of pivots, from the rows below.
struct Backward<'a>(Solve<'a>);

impl<'a> Solve<'a> {
    /// The columns of the N pivots from `start` on, from the row `from` on.
    #[inline(always)]
    fn columns<const N: usize>(&self, start: usize, from: usize) -> [&'a [f64]; N] {
        let column = self.size.panel_column();
        let mut out = [self.panel; N];
        for (p, out) in out.iter_mut().enumerate() {
            *out = &self.panel[(start + p) * column + from..(start + p + 1) * column];
        }
        out
    }
}

/// Rows from `row` on that come before the next whole tile of [`TILE`] rows.
const fn before_tiles(row: usize) -> usize {
    row.next_multiple_of(TILE) - row
}

/// The tile of [`TILE`] numbers from `row` on.
#[inline(always)]
fn four(of: &[f64], row: usize) -> [f64; TILE] {
    of[row..].first_chunk().copied().unwrap_or_default()
}

impl Forward<'_> {
    /// The N pivots from `start` on.
    #[inline(always)]
    fn block<const N: usize, const FUSED: bool>(&mut self, start: usize) {
        let end = start + N;
        let own = self.0.columns::<N>(start, start);
        let columns = self.0.columns::<N>(start, end);
        let (pivots, below) = self.0.local[start..].split_at_mut(N);
        let mut y = [0.0; N];
        y.copy_from_slice(pivots);
        for j in 0..N {
            for i in 0..N {
                if i > j {
                    y[i] = fma::<FUSED>(-own[j][i], y[j], y[i]);
                }
            }
        }
        pivots.copy_from_slice(&y);
        let first = before_tiles(end).min(below.len());
        for row in 0..first {
            for j in 0..N {
                below[row] = fma::<FUSED>(-columns[j][row], y[j], below[row]);
            }
        }
        for row in (first..below.len()).step_by(TILE) {
            let mut c = four(below, row);
            for j in 0..N {
                let l = four(columns[j], row);
                for i in 0..TILE {
                    c[i] = fma::<FUSED>(-l[i], y[j], c[i]);
                }
            }
            below[row..row + TILE].copy_from_slice(&c);
        }
    }

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) {
        for start in (0..self.0.size.pivots).step_by(TILE) {
            self.next_block::<FUSED>(start);
        }
    }
}

impl Backward<'_> {
    /// The N pivots from `start` on.
    #[inline(always)]
    fn block<const N: usize, const FUSED: bool>(&mut self, start: usize) {
        let end = start + N;
        let own = self.0.columns::<N>(start, start);
        let columns = self.0.columns::<N>(start, end);
        let (pivots, below) = self.0.local[start..].split_at_mut(N);
        let mut sums = [[0.0; TILE]; N];
        let first = before_tiles(end).min(below.len());
        for row in 0..first {
            for j in 0..N {
                sums[j][0] = fma::<FUSED>(columns[j][row], below[row], sums[j][0]);
            }
        }
        for row in (first..below.len()).step_by(TILE) {
            let y = four(below, row);
            for j in 0..N {
                let l = four(columns[j], row);
                for i in 0..TILE {
                    sums[j][i] = fma::<FUSED>(l[i], y[i], sums[j][i]);
                }
            }
        }
        let mut y = [0.0; N];
        y.copy_from_slice(pivots);
        for j in (0..N).rev() {
            let [a, b, c, d] = sums[j];
            y[j] -= (a + b) + (c + d);
            for i in 0..N {
                if i > j {
                    y[j] = fma::<FUSED>(-own[j][i], y[i], y[j]);
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
        impl $what<'_> {
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

        impl WithSimd for $what<'_> {
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
pub fn solve_forward(arch: Arch, size: Size, panel: &[f64], local: &mut [f64]) {
    arch.dispatch(Forward(Solve { size, panel, local }));
}

/// y ← L⁻ᵀ y: `local` has the rows of the panel, those below the pivots are known.
pub fn solve_backward(arch: Arch, size: Size, panel: &[f64], local: &mut [f64]) {
    arch.dispatch(Backward(Solve { size, panel, local }));
}
