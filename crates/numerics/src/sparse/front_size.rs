//! Size of a front, the way its columns are filled up, and the numbers in them.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, SubAssign};

/// Numbers of factors, in single or in double precision.
pub trait Number:
    faer::traits::ComplexField
    + Copy
    + Default
    + PartialOrd
    + Send
    + Sync
    + Neg<Output = Self>
    + Add<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// The nearest number to `x`.
    fn nearest(x: f64) -> Self;
    /// The number in double precision.
    fn double(self) -> f64;
    /// self · b + c in one operation.
    fn fused(self, b: Self, c: Self) -> Self;
    /// False of an overflow and of what is no number.
    fn is_a_number(self) -> bool;
}

macro_rules! number {
    ($float:ident) => {
        impl Number for $float {
            #[inline(always)]
            fn nearest(x: f64) -> Self {
                x as $float
            }
            #[inline(always)]
            fn double(self) -> f64 {
                f64::from(self)
            }
            #[inline(always)]
            fn fused(self, b: Self, c: Self) -> Self {
                self.mul_add(b, c)
            }
            #[inline(always)]
            fn is_a_number(self) -> bool {
                self.is_finite()
            }
        }
    };
}

number!(f32);
number!(f64);

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
