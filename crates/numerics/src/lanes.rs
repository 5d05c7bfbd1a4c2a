//! Numbers that a formula is written for once: one `f64`, or four of them side by side, which the compiler
//! puts into the vector registers of whatever processor it compiles for. The bits are the same on all: no
//! product is fused with a sum.
//!
//! ```
//! use asperity_numerics::lanes::{Lanes, Real};
//!
//! fn hypotenuse<T: Real>(a: T, b: T) -> T {
//!     (a * a + b * b).sqrt()
//! }
//! assert_eq!(hypotenuse(3.0, 4.0), 5.0);
//! let four = hypotenuse(Lanes([3.0, 5.0, 8.0, 7.0]), Lanes([4.0, 12.0, 15.0, 24.0]));
//! assert_eq!(four, Lanes([5.0, 13.0, 17.0, 25.0]));
//! ```

use std::ops::{Add, AddAssign, BitAnd, Div, Mul, Neg, Sub, SubAssign};

/// Real numbers, one or several, with what the formulas of a material point need. Several never look at one
/// another: each lane has the bits it would have alone.
pub trait Real:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + AddAssign
    + SubAssign
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The answer to a comparison, lane by lane.
    type Mask: Copy + BitAnd<Output = Self::Mask>;
    /// The number of its lanes.
    const LANES: usize;
    /// The numbers `of(lane)`.
    fn each(of: impl FnMut(usize) -> f64) -> Self;
    /// The number in `lane`.
    fn lane(self, lane: usize) -> f64;
    /// The same number in every lane.
    #[inline(always)]
    fn splat(x: f64) -> Self {
        Self::each(|_| x)
    }
    /// √x.
    fn sqrt(self) -> Self;
    /// ln(1 + x) for x > -1, with full digits for small x.
    fn ln_1p(self) -> Self;
    /// eˣ - 1 for |x| < 700, with full digits for small x.
    fn exp_m1(self) -> Self;
    /// x to the power `n` for x ≥ ½, good to n ln x units of the last place.
    fn powf(self, n: f64) -> Self;
    /// x > y; false where one is not a number.
    fn is_above(self, y: Self) -> Self::Mask;
    /// `yes` where `mask` holds, else `no`.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// The mask of these truths.
    fn mask(of: impl FnMut(usize) -> bool) -> Self::Mask;
    /// True where `mask` holds in `lane`.
    fn holds(mask: Self::Mask, lane: usize) -> bool;
    /// True where `mask` holds in some lane.
    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        (0..Self::LANES).any(|lane| Self::holds(mask, lane))
    }
    /// True where `mask` holds in every lane.
    #[inline(always)]
    fn all(mask: Self::Mask) -> bool {
        (0..Self::LANES).all(|lane| Self::holds(mask, lane))
    }
    /// The larger of two.
    #[inline(always)]
    fn max(self, y: Self) -> Self {
        Self::select(self.is_above(y), self, y)
    }
    /// The absolute value.
    #[inline(always)]
    fn abs(self) -> Self {
        self.max(-self)
    }
}

impl Real for f64 {
    type Mask = bool;
    const LANES: usize = 1;
    #[inline(always)]
    fn each(mut of: impl FnMut(usize) -> f64) -> f64 {
        of(0)
    }
    #[inline(always)]
    fn lane(self, _: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> f64 {
        self.sqrt()
    }
    #[inline(always)]
    fn ln_1p(self) -> f64 {
        self.ln_1p()
    }
    #[inline(always)]
    fn exp_m1(self) -> f64 {
        self.exp_m1()
    }
    #[inline(always)]
    fn powf(self, n: f64) -> f64 {
        self.powf(n)
    }
    #[inline(always)]
    fn is_above(self, y: f64) -> bool {
        self > y
    }
    #[inline(always)]
    fn select(mask: bool, yes: f64, no: f64) -> f64 {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn mask(mut of: impl FnMut(usize) -> bool) -> bool {
        of(0)
    }
    #[inline(always)]
    fn holds(mask: bool, _: usize) -> bool {
        mask
    }
}

/// The array of an expression in the lane's index. (`array::map` is not always inlined.)
macro_rules! four {
    ($i:ident => $of:expr) => {
        [
            {
                let $i = 0;
                $of
            },
            {
                let $i = 1;
                $of
            },
            {
                let $i = 2;
                $of
            },
            {
                let $i = 3;
                $of
            },
        ]
    };
}

/// Four numbers side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(32))]
pub struct Lanes(
    /// The numbers.
    pub [f64; 4],
);

/// Four truths side by side, all bits of each set or none: what a comparison of vectors gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(32))]
pub struct Mask([u64; 4]);

impl Lanes {
    /// The sum of the numbers of each of four.
    #[inline(always)]
    pub fn sums(of: [Lanes; 4]) -> Lanes {
        let [first, second, third, fourth] = four!(lane => Lanes(four!(i => of[i].0[lane])));
        (first + second) + (third + fourth)
    }
}

/// All bits if `truth`.
#[inline(always)]
fn bits(truth: bool) -> u64 {
    if truth { u64::MAX } else { 0 }
}

impl BitAnd for Mask {
    type Output = Mask;
    #[inline(always)]
    fn bitand(self, other: Mask) -> Mask {
        Mask(four!(i => self.0[i] & other.0[i]))
    }
}

macro_rules! operator {
    ($($name:ident $function:ident $sign:tt),*) => { $(
        impl $name for Lanes {
            type Output = Lanes;
            #[inline(always)]
            fn $function(self, y: Lanes) -> Lanes {
                let (x, y) = (self.0, y.0);
                Lanes([x[0] $sign y[0], x[1] $sign y[1], x[2] $sign y[2], x[3] $sign y[3]])
            }
        }
        impl $name<f64> for Lanes {
            type Output = Lanes;
            #[inline(always)]
            fn $function(self, y: f64) -> Lanes {
                let x = self.0;
                Lanes([x[0] $sign y, x[1] $sign y, x[2] $sign y, x[3] $sign y])
            }
        }
    )* };
}
operator!(Add add +, Sub sub -, Mul mul *, Div div /);

impl Neg for Lanes {
    type Output = Lanes;
    #[inline(always)]
    fn neg(self) -> Lanes {
        Lanes(four!(i => -self.0[i]))
    }
}

impl AddAssign for Lanes {
    #[inline(always)]
    fn add_assign(&mut self, y: Lanes) {
        *self = *self + y;
    }
}

impl SubAssign for Lanes {
    #[inline(always)]
    fn sub_assign(&mut self, y: Lanes) {
        *self = *self - y;
    }
}

/// ln 2 in two parts, the first with so few digits that its product with an exponent is exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// 2⁵²: its last bits hold an integer.
const TWO_52: f64 = 4_503_599_627_370_496.0;

/// Bits of √½, of 1 and of the fraction of a number.
const HALF_ROOT: u64 = 0x3fe6_a09e_667f_3bcd;
const ONE_BITS: u64 = 0x3ff0_0000_0000_0000;
const FRACTION_BITS: u64 = 0x000f_ffff_ffff_ffff;

/// (ln(1 + f) - f + ½f²)/s in s² with s = f/(2 + f), least largest error for 1 + f in [√½, √2] (fdlibm,
/// e_log.c).
const LOGARITHM: [f64; 7] = [
    6.666_666_666_666_735e-1,
    3.999_999_999_940_942e-1,
    2.857_142_874_366_239e-1,
    2.222_219_843_214_978_4e-1,
    1.818_357_216_161_805e-1,
    1.531_383_769_920_937_3e-1,
    1.479_819_860_511_658_6e-1,
];

/// 1/2!, 1/3!, … 1/13!.
const EXPONENTIAL: [f64; 12] = [
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// 2⁵² + 2⁵¹: added to a number it leaves the nearest integer in the last bits.
const ROUNDS: f64 = 6_755_399_441_055_744.0;

/// c₀ + c₁ x + c₂ x² + …
#[inline(always)]
fn horner<const N: usize>(coefficients: &[f64; N], x: Lanes) -> Lanes {
    let mut sum = Lanes::splat(coefficients[N - 1]);
    for i in (0..N - 1).rev() {
        sum = sum * x + coefficients[i];
    }
    sum
}

impl Real for Lanes {
    type Mask = Mask;
    const LANES: usize = 4;
    #[inline(always)]
    fn each(mut of: impl FnMut(usize) -> f64) -> Lanes {
        Lanes(four!(i => of(i)))
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.0[lane]
    }
    #[inline(always)]
    fn sqrt(self) -> Lanes {
        Lanes(four!(i => self.0[i].sqrt()))
    }
    /// 1 + x = 2ᵏ (1 + f) with 1 + f in [√½, √2]; what the sum 1 + x rounds away is put back (fdlibm,
    /// s_log1p.c).
    #[inline(always)]
    fn ln_1p(self) -> Lanes {
        let sum = self + 1.0;
        let shifted = four!(i => sum.0[i].to_bits().wrapping_add(ONE_BITS - HALF_ROOT));
        let k = Lanes(four!(i => f64::from_bits((shifted[i] >> 52) | TWO_52.to_bits()))) - (TWO_52 + 1023.0);
        let reduced =
            Lanes(four!(i => f64::from_bits((shifted[i] & FRACTION_BITS).wrapping_add(HALF_ROOT)))) - 1.0;
        let near = Mask(four!(i => bits(k.0[i] == 0.0)));
        let f = Lanes::select(near, self, reduced);
        let lost = Lanes::select(near, Lanes::splat(0.0), (self - (sum - 1.0)) / sum);
        let s = f / (f + 2.0);
        let z = s * s;
        let series = horner(&LOGARITHM, z) * z;
        let half_square = f * f * 0.5;
        k * LN_2[0] - ((half_square - (s * (half_square + series) + (k * LN_2[1] + lost))) - f)
    }
    /// x = k ln 2 + r with |r| ≤ ½ ln 2: eˣ - 1 = 2ᵏ (eʳ - 1) + (2ᵏ - 1).
    #[inline(always)]
    fn exp_m1(self) -> Lanes {
        let rounded = self * std::f64::consts::LOG2_E + ROUNDS;
        let k = rounded - ROUNDS;
        let r = (self - k * LN_2[0]) - k * LN_2[1];
        let series = horner(&EXPONENTIAL, r);
        let power = Lanes(four!(i => f64::from_bits(rounded.0[i].to_bits().wrapping_add(1023) << 52)));
        power * (r + r * r * series) + (power - 1.0)
    }
    #[inline(always)]
    fn powf(self, n: f64) -> Lanes {
        ((self - 1.0).ln_1p() * n).exp_m1() + 1.0
    }
    #[inline(always)]
    fn is_above(self, y: Lanes) -> Mask {
        Mask(four!(i => bits(self.0[i] > y.0[i])))
    }
    #[inline(always)]
    fn select(mask: Mask, yes: Lanes, no: Lanes) -> Lanes {
        Lanes(four!(i => f64::from_bits(
            (yes.0[i].to_bits() & mask.0[i]) | (no.0[i].to_bits() & !mask.0[i])
        )))
    }
    #[inline(always)]
    fn mask(mut of: impl FnMut(usize) -> bool) -> Mask {
        Mask(four!(i => bits(of(i))))
    }
    #[inline(always)]
    fn holds(mask: Mask, lane: usize) -> bool {
        mask.0[lane] != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of either sign, from 1e-18 to 1e2 in size.
    fn numbers() -> impl Iterator<Item = f64> {
        (-1800..200).flat_map(|i| [10f64.powf(0.01 * f64::from(i)), -(10f64.powf(0.01 * f64::from(i)))])
    }

    fn compare(own: impl Fn(Lanes) -> Lanes, library: impl Fn(f64) -> f64, x: f64, units: f64) {
        let four = own(Lanes([x, 0.5, x, 0.25]));
        assert!((four.0[0] - library(x)).abs() <= units * f64::EPSILON * library(x).abs(), "{x:e}");
        // a lane has the bits it would have alone
        assert_eq!((four.0[0], own(Lanes([0.5; 4])).0[2]), (four.0[2], four.0[1]), "{x:e}");
    }

    /// Against the library of the language, itself good to one unit in the last place.
    #[test]
    fn logarithm_and_exponential_keep_their_digits_from_tiny_to_large() {
        for x in numbers() {
            if x > -1.0 {
                compare(Lanes::ln_1p, f64::ln_1p, x, 2.0);
            }
            compare(Lanes::exp_m1, f64::exp_m1, x, 2.0);
        }
        for close_to_one in [1e-3, 1e-9, 1e-15] {
            compare(Lanes::ln_1p, f64::ln_1p, close_to_one - 1.0, 2.0);
        }
        assert_eq!(Lanes::splat(0.0).ln_1p().0, [0.0; 4]);
        assert_eq!(Lanes::splat(0.0).exp_m1().0, [0.0; 4]);
    }

    #[test]
    fn powers_are_good_to_the_units_that_their_logarithm_loses() {
        for x in numbers().filter(|x| *x >= 0.5) {
            for n in [0.0, 0.01, 0.3, 0.99, 2.5] {
                compare(|x| x.powf(n), |x| x.powf(n), x, 4.0 + 2.0 * n * x.ln().abs());
            }
        }
    }
}
