//! Size of a front, and the way its columns are filled up.

/// Numbers of the factors. Single precision halves memory and time of a factorisation; iterations whose
/// residuals are double take as many as with double factors, and
/// [`solve_refined`](super::cholesky::Factor::solve_refined) gives the digits where a solve itself is the
/// answer.
pub type Number = f32;

/// Rows of a tile; the length of a column is a multiple of it.
pub const LANES: usize = 16;

/// `length` rounded up to a multiple of [`LANES`].
pub const fn padded(length: usize) -> usize {
    length.next_multiple_of(LANES)
}

/// Sizes of a front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pivots, k.
    pub pivots: usize,
    /// Rows below them, n.
    pub below: usize,
}

impl Size {
    /// Length of a column of the panel: what is read in tiles below the pivots stays inside it.
    pub const fn panel_column(self) -> usize {
        padded(self.pivots + padded(self.below))
    }

    /// Numbers in the panel.
    pub const fn panel(self) -> usize {
        self.panel_column() * self.pivots
    }

    /// Numbers in the update.
    pub const fn update(self) -> usize {
        padded(self.below) * self.below
    }
}
