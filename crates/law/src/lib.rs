//! The metal: elastic constants, hardening laws, the representative stress σ_r(ε_r), and physical units.
//!
//! This crate is the only place of the workspace that knows a σ(ε). It has no opinion on units inside: all
//! stresses of one call must be in the same unit, strains and exponents are pure numbers.

mod elastic;
mod hardening;
pub mod units;

pub use elastic::Elastic;
pub use hardening::{Flow, Hardening, HardeningLaw};
