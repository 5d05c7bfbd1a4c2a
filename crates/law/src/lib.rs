//! The material: elastic constants, hardening laws and tables, the representative stress σ_r(ε_r), and physical units.
//!
//! This crate is the only place of the workspace that knows a σ(ε). It has no opinion on units inside: all
//! stresses of one call must be in the same unit, strains and exponents are pure numbers.

mod curve;
mod curve_file;
mod elastic;
mod hardening;
pub mod least_squares;
mod table;
pub mod units;

pub use curve::{HardeningCurve, HardeningMode};
pub use curve_file::{CurveFile, CurveFileError};
pub use elastic::Elastic;
pub use hardening::{Flow, Hardening, HardeningLaw};
pub use table::{HardeningTable, LARGEST_TABLE, TableError};
