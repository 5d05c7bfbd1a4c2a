//! The dense algebra of one front: elimination of its pivots. (The solves with the columns that result:
//! `front_solve`.)
//!
//! A front is the dense symmetric matrix of the unknowns that meet when its pivots are eliminated. Its
//! *panel* holds the columns of the k pivots: k rows of pivots, then n rows below. Its *update* is what
//! elimination leaves of the n × n rest. Both are stored by columns, of which only the lower triangle counts;
//! the length of a column is a multiple of `LANES`, and the rows that fill it up are zero or never read.
//!
//! Symbols: F = L D Lᵀ with L of unit diagonal; W = L D.
//!
//! Every product is fused with its sum, on processors that can, whatever processor the program was built for:
//! the same bits.

use crate::sparse::front_size::{LANES, Number, Size, padded};
use crate::sparse::large_front::{is_large, take_from_panel, update_of_pivots};
use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;

/// Columns of a tile, and of the blocks in which pivots are eliminated.
pub(super) const TILE: usize = 4;

/// Pivots of a large front that are eliminated before a product takes them from the next ones.
const LARGE_BLOCK: usize = 64;

/// The pivots that are accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pivots {
    /// Positive ones: the matrix is positive definite, or the elimination stops.
    Positive,
    /// All but zero.
    Any,
}

/// a·b + c, in one operation if `FUSED`.
#[inline(always)]
pub(super) fn fma<const FUSED: bool, T: Number>(a: T, b: T, c: T) -> T {
    if FUSED { a.fused(b, c) } else { a * b + c }
}

/// Rows of a tile in the registers, column by column.
type Tile<T, const N: usize> = [[T; LANES]; N];

/// Rows `row..row + LANES` of the first N columns of `from`, which are `stride` apart.
#[inline(always)]
fn load<T: Number, const N: usize>(from: &[T], stride: usize, row: usize) -> Tile<T, N> {
    let mut c = [[T::default(); LANES]; N];
    for (j, c) in c.iter_mut().enumerate() {
        if let Some(from) = from[j * stride + row..].first_chunk() {
            *c = *from;
        }
    }
    c
}

/// The tile `c` back to where [`load`] takes it from.
#[inline(always)]
fn store<T: Number, const N: usize>(c: &Tile<T, N>, to: &mut [T], stride: usize, row: usize) {
    for (j, c) in c.iter().enumerate() {
        if let Some(to) = to[j * stride + row..].first_chunk_mut() {
            *to = *c;
        }
    }
}

/// C ← C − L Wᵀ over `depth` columns.
///
/// `l` starts at the first row of the tile in L, `w` at the row of W that is the first of its columns;
/// columns of both are `column` apart.
#[inline(always)]
fn take<T: Number, const N: usize, const FUSED: bool>(
    c: &mut Tile<T, N>,
    [l, w]: [&[T]; 2],
    column: usize,
    depth: usize,
) {
    for (l, w) in l.chunks(column).zip(w.chunks(column)).take(depth) {
        let (Some(l), Some(w)) = (l.first_chunk::<LANES>(), w.first_chunk::<N>()) else { break };
        for (c, &w) in c.iter_mut().zip(w) {
            for (c, &l) in c.iter_mut().zip(l) {
                *c = fma::<FUSED, T>(-l, w, *c);
            }
        }
    }
}

/// The tile of `panel` from `row` on, from which the product of the `depth` columns of L and W is taken.
#[inline(always)]
fn taken_from<T: Number, const N: usize, const FUSED: bool>(
    panel: &[T],
    column: usize,
    row: usize,
    [l, w]: [&[T]; 2],
    depth: usize,
) -> Tile<T, N> {
    let mut c = load::<T, N>(panel, column, row);
    take::<T, N, FUSED>(&mut c, [l.get(row..).unwrap_or_default(), w], column, depth);
    c
}

/// Columns of a matrix that become products.
struct Columns<'a, T> {
    /// The first of the columns.
    target: &'a mut [T],
    /// Their distance.
    stride: usize,
    /// Rows: tiles from the first on, to the last.
    rows: Range<usize>,
}

impl<T: Number> Columns<'_, T> {
    /// C ← − L Wᵀ, where rows of `l` are those of C, and the first `N` rows of `w` its columns.
    #[inline(always)]
    fn take_product<const N: usize, const FUSED: bool>(
        &mut self,
        [l, w]: [&[T]; 2],
        column: usize,
        depth: usize,
    ) {
        for row in self.rows.clone().step_by(LANES) {
            let mut c = [[T::default(); LANES]; N];
            take::<T, N, FUSED>(&mut c, [&l[row..], w], column, depth);
            store(&c, self.target, self.stride, row);
        }
    }

    /// [`Self::take_product`] for `count` columns, at most [`TILE`].
    #[inline(always)]
    fn take_product_of_some<const FUSED: bool>(
        &mut self,
        count: usize,
        lw: [&[T]; 2],
        column: usize,
        depth: usize,
    ) {
        match count {
            1 => self.take_product::<1, FUSED>(lw, column, depth),
            2 => self.take_product::<2, FUSED>(lw, column, depth),
            3 => self.take_product::<3, FUSED>(lw, column, depth),
            _ => self.take_product::<TILE, FUSED>(lw, column, depth),
        }
    }
}

/// Elimination of the pivots of a front.
struct Elimination<'a, T> {
    size: Size,
    panel: &'a mut [T],
    update: &'a mut [T],
    scaled: &'a mut [T],
    pivots: Pivots,
}

/// A block of N pivots: what the rows below it take from it.
struct Block<T, const N: usize> {
    /// Its part of W: the entry of column p in row j of the block at \[p\]\[j\].
    scaled: [[T; N]; N],
    /// 1/D.
    inverse: [T; N],
    /// Pivots below zero.
    negative: usize,
}

impl<T: Number, const N: usize> Block<T, N> {
    /// Eliminates the block: `a` is row by row its lower triangle, and becomes L with D on the diagonal.
    #[inline(always)]
    fn eliminate<const FUSED: bool>(a: &mut [[T; N]; N], pivots: Pivots) -> Option<Block<T, N>> {
        let mut block = Block { scaled: [[T::default(); N]; N], inverse: [T::default(); N], negative: 0 };
        for j in 0..N {
            for p in 0..N {
                for i in 0..N {
                    if p < j && i >= j {
                        a[i][j] = fma::<FUSED, T>(-block.scaled[p][j], a[i][p], a[i][j]);
                    }
                }
            }
            let pivot = a[j][j];
            let accepted = match pivots {
                Pivots::Positive => pivot > T::default(),
                Pivots::Any => pivot != T::default(),
            };
            if !(accepted && pivot.is_a_number()) {
                return None;
            }
            block.negative += usize::from(pivot < T::default());
            block.inverse[j] = T::nearest(1.0) / pivot;
            for i in 0..N {
                if i >= j {
                    block.scaled[j][i] = a[i][j];
                }
                if i > j {
                    a[i][j] *= block.inverse[j];
                }
            }
        }
        Some(block)
    }

    /// Rows below the block: W and L of the tile `c`.
    #[inline(always)]
    fn rows_below<const FUSED: bool>(&self, mut c: Tile<T, N>) -> [Tile<T, N>; 2] {
        let mut l = c;
        for j in 0..N {
            for p in 0..N {
                if p < j {
                    for i in 0..LANES {
                        c[j][i] = fma::<FUSED, T>(-self.scaled[p][j], l[p][i], c[j][i]);
                    }
                }
            }
            for i in 0..LANES {
                l[j][i] = c[j][i] * self.inverse[j];
            }
        }
        [c, l]
    }
}

impl<T: Number> Elimination<'_, T> {
    /// The N pivots from `start` on, from which those before `taken` have been taken. Negative ones are
    /// counted.
    #[inline(always)]
    fn block<const N: usize, const FUSED: bool>(&mut self, taken: usize, start: usize) -> Option<usize> {
        let (column, depth) = (self.size.panel_column(), start - taken);
        let (done, panel) = self.panel.split_at_mut(start * column);
        let (earlier, scaled) = self.scaled.split_at_mut(start * column);
        let (l, w) = (&done[taken * column..], earlier.get(taken * column + start..).unwrap_or_default());
        let first = start / LANES * LANES;
        // what stands above the diagonal in the first tile is never read
        let c = taken_from::<T, N, FUSED>(panel, column, first, [l, w], depth);
        store(&c, panel, column, first);
        let mut a = [[T::default(); N]; N];
        for i in 0..N {
            for j in 0..N {
                a[i][j] = panel[j * column + start + i];
            }
        }
        let block = Block::eliminate::<FUSED>(&mut a, self.pivots)?;
        let [below, lower] = block.rows_below::<FUSED>(c);
        store(&below, scaled, column, first);
        store(&lower, panel, column, first);
        for j in 0..N {
            for i in 0..N {
                if i >= j {
                    panel[j * column + start + i] = a[i][j];
                    scaled[j * column + start + i] = block.scaled[j][i];
                }
            }
        }
        for row in (first + LANES..column).step_by(LANES) {
            let c = taken_from::<T, N, FUSED>(panel, column, row, [l, w], depth);
            let [below, lower] = block.rows_below::<FUSED>(c);
            store(&below, scaled, column, row);
            store(&lower, panel, column, row);
        }
        Some(block.negative)
    }

    /// The pivots of `range`, from which those before `taken` have been taken.
    #[inline(always)]
    fn pivots<const FUSED: bool>(&mut self, taken: usize, range: Range<usize>) -> Option<usize> {
        let mut negative = 0;
        for start in range.clone().step_by(TILE) {
            negative += match range.end - start {
                1 => self.block::<1, FUSED>(taken, start)?,
                2 => self.block::<2, FUSED>(taken, start)?,
                3 => self.block::<3, FUSED>(taken, start)?,
                _ => self.block::<TILE, FUSED>(taken, start)?,
            };
        }
        Some(negative)
    }

    /// Makes the update: what the products of the pivots take away.
    #[inline(always)]
    fn rest<const FUSED: bool>(&mut self) {
        let Size { pivots, below } = self.size;
        let (column, stride) = (self.size.panel_column(), padded(below));
        let l = &self.panel[pivots.min(self.panel.len())..];
        for first in (0..below).step_by(TILE) {
            let rows = first / LANES * LANES..stride;
            let mut rest = Columns { target: &mut self.update[first * stride..], stride, rows };
            let w = &self.scaled[pivots + first..];
            rest.take_product_of_some::<FUSED>((below - first).min(TILE), [l, w], column, pivots);
        }
    }

    #[inline(always)]
    fn run<const FUSED: bool>(mut self) -> Option<usize> {
        let pivots = self.size.pivots;
        if !is_large(self.size) {
            let negative = self.pivots::<FUSED>(0, 0..pivots)?;
            self.rest::<FUSED>();
            return Some(negative);
        }
        let mut negative = 0;
        for start in (0..pivots).step_by(LARGE_BLOCK) {
            let end = pivots.min(start + LARGE_BLOCK);
            if start > 0 {
                take_from_panel(self.size, start, end, self.panel, self.scaled);
            }
            negative += self.pivots::<FUSED>(start, start..end)?;
        }
        update_of_pivots(self.size, self.panel, self.scaled, self.update);
        Some(negative)
    }
}

impl<T: Number> WithSimd for Elimination<'_, T> {
    type Output = Option<usize>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Option<usize> {
        if S::IS_SCALAR { self.run::<false>() } else { self.run::<true>() }
    }
}

/// Eliminates the pivots of a front: its panel becomes the columns of L with D on the diagonal, its update
/// what that adds to the rest, whatever it held. `scaled` is work space as large as the panel. Returns the
/// number of negative pivots, nothing where a pivot is not accepted.
pub fn eliminate<T: Number>(
    arch: Arch,
    size: Size,
    [panel, update, scaled]: [&mut [T]; 3],
    pivots: Pivots,
) -> Option<usize> {
    arch.dispatch(Elimination { size, panel, update, scaled, pivots })
}
