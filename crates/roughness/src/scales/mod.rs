//! Scales of a surface: its slopes and its contact as ever finer waves are let in, and which of the answers
//! have stopped changing.
//!
//! A smooth filter leaves the waves above a cut-off (`cutoffs`); of each such surface the slopes
//! (`slopes`), the contact by the half-space (`contact`) and the regimes of its patches (`regimes`) are
//! found. The power spectrum has a Hurst exponent, a roll-off and an end (`self_affine`), says how the slope
//! goes on below the pixel (`slope_power`), and what a tip can follow (`trust`). All of it together is
//! `follow`; from the values of a quantity and from the growth of the slope follows its verdict
//! (`quantities`, `verdict`). Persson's theory stands beside (`persson`).
//!
//! Sources: ISO 16610-61 (Gaussian filter), Jacobs, Junge and Pastewka 2017 (spectra), Sanner et al. 2022
//! (parameters by scale), Whittle 1953 (likelihood of a spectrum), Persson 2001 (diffusion of pressures).

mod cutoffs;

mod slope_power;
mod slopes;

mod self_affine;
mod trust;

mod contact;
mod numbers;
mod persson;
mod regimes;

mod follow;

mod quantities;
mod verdict;

mod sentence;

pub use contact::press_scale;
pub use cutoffs::{PIXELS_PER_WAVE, Scale, cutoffs};
pub use follow::{Scales, ScalesError, Task};
pub use numbers::{By, Numbers, Step};
pub use persson::{PerssonArea, persson};
pub use quantities::{Judged, Quantity};
pub use regimes::{RegimeSlopes, Shares};
pub use self_affine::{Interval, SelfAffine};
pub use slope_power::{Growth, SlopePower};
pub use slopes::{QUANTILES, Slopes};
pub use trust::trusted;
pub use verdict::{Class, Verdict};

#[cfg(test)]
mod tests;
