//! The material: elastic constants, hardening laws and tables, the representative stress σ_r(ε_r), and physical units.
//!
//! This crate is the only place of the workspace that knows a σ(ε). It has no opinion on units inside: all
//! stresses of one call must be in the same unit, strains and exponents are pure numbers.
//!
//! ```
//! use asperity_material::{Hardening, HardeningLaw};
//!
//! // σ_r of a steel at the representative strain of a cone of 10 degrees, MPa: 300 (1 + 700 · 0.13 tan 10°)^0.3
//! let steel =
//!     Hardening { law: HardeningLaw::Hollomon, yield_stress: 300.0, exponent: 0.3, youngs_modulus: 210e3 };
//! let stress = steel.representative_stress(0.13 * 10f64.to_radians().tan());
//! assert!((stress - 702.435).abs() < 1e-3);
//! ```

pub mod cone_atlas;
mod curve_file;
mod elastic;
mod flow_curve;
mod hardening;
mod hardening_curve;
mod hardening_table;
pub mod range;
mod voce;

pub use curve_file::{CurveFile, CurveFileError};
pub use elastic::Elastic;
pub use flow_curve::{FlowCurve, OwnLaw, refuse_custom, write_custom};
pub use hardening::{Hardening, HardeningLaw, HardeningPoint};
pub use hardening_curve::{HardeningCurve, HardeningMode, StressMeasure};
pub use hardening_table::{HardeningTable, LARGEST_TABLE, TableError};
pub use voce::Voce;

/// Quantities with units, which stresses and lengths are written in.
pub use asperity_formats::units;
