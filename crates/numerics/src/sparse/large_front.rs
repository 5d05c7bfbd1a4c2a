//! Elimination in fronts so large that products in cache blocks and several threads pay. The blocks do not
//! depend on the number of threads: neither do the bits.

use crate::sparse::front_size::{Number, Size, padded};
use faer::linalg::matmul::matmul;
use faer::{Accum, MatMut, MatRef, Par};

/// Rows and columns of the largest block of a product.
const BLOCK: usize = 192;

/// Operations of an update from which it is computed here.
const LARGE_UPDATE_OPERATIONS: usize = 4_000_000;

/// True where the update of a front is large.
pub fn is_large(size: Size) -> bool {
    size.pivots * size.below * size.below > LARGE_UPDATE_OPERATIONS
}

/// C ← C − L Wᵀ by blocks, or − L Wᵀ where C is to be replaced.
fn subtract<T: Number>(c: MatMut<'_, T>, l: MatRef<'_, T>, w: MatRef<'_, T>, how: Accum) {
    let (rows, columns) = (c.nrows(), c.ncols());
    if rows > BLOCK && rows >= columns {
        let half = (rows / 2).next_multiple_of(8);
        let (top, bottom) = c.split_at_row_mut(half);
        let (l_top, l_bottom) = l.split_at_row(half);
        rayon::join(|| subtract(top, l_top, w, how), || subtract(bottom, l_bottom, w, how));
    } else if columns > BLOCK {
        let half = (columns / 2).next_multiple_of(8);
        let (left, right) = c.split_at_col_mut(half);
        let (w_left, w_right) = w.split_at_row(half);
        rayon::join(|| subtract(left, l, w_left, how), || subtract(right, l, w_right, how));
    } else {
        matmul(c, how, l, w.transpose(), T::nearest(-1.0), Par::Seq);
    }
}

/// C ← − L Wᵀ in the lower triangle of a square C; some entries above it change as well.
fn lower_product<T: Number>(c: MatMut<'_, T>, l: MatRef<'_, T>, w: MatRef<'_, T>) {
    let size = c.nrows();
    if size <= BLOCK {
        return subtract(c, l, w, Accum::Replace);
    }
    let half = (size / 2).next_multiple_of(8);
    let (top_left, _, bottom_left, bottom_right) = c.split_at_mut(half, half);
    let (l_top, l_bottom) = l.split_at_row(half);
    let (w_top, w_bottom) = w.split_at_row(half);
    rayon::join(
        || {
            rayon::join(
                || lower_product(top_left, l_top, w_top),
                || subtract(bottom_left, l_bottom, w_top, Accum::Replace),
            )
        },
        || lower_product(bottom_right, l_bottom, w_bottom),
    );
}

/// The share of the pivots in the update of a front: U ← − L Wᵀ. `panel` holds L, `scaled` W.
pub fn update_of_pivots<T: Number>(size: Size, panel: &[T], scaled: &[T], update: &mut [T]) {
    let Size { pivots, below } = size;
    let (column, stride) = (size.panel_column(), padded(below));
    let view = |from| MatRef::from_column_major_slice_with_stride(from, column, pivots, column);
    let (l, w) = (view(panel), view(&scaled[..panel.len()]));
    let update = MatMut::from_column_major_slice_with_stride_mut(update, below, below, stride);
    lower_product(update, l.subrows(pivots, below), w.subrows(pivots, below));
}

/// Takes what the pivots before `start` leave from columns `start..end` of the panel.
pub fn take_from_panel<T: Number>(size: Size, start: usize, end: usize, panel: &mut [T], scaled: &[T]) {
    let column = size.panel_column();
    let (done, rest) = panel.split_at_mut(start * column);
    let view = |from| MatRef::from_column_major_slice_with_stride(from, column, start, column);
    let (l, w) = (view(&*done), view(&scaled[..start * column]));
    let rest = MatMut::from_column_major_slice_with_stride_mut(rest, column, end - start, column);
    let rows = column - start;
    subtract(
        rest.subrows_mut(start, rows),
        l.subrows(start, rows),
        w.subrows(start, end - start),
        Accum::Add,
    );
}
