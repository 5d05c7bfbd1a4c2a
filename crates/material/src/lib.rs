#![doc = include_str!("../README.md")]

pub mod cone_atlas;
mod curve_file;
mod elastic;
mod flow_curve;
mod hardening;
mod hardening_curve;
mod hardening_table;
mod material_card;
mod plastic_table;
pub mod range;
mod total_strain;
mod voce;

pub use curve_file::CurveFile;
pub use elastic::Elastic;
pub use flow_curve::{FlowCurve, OwnLaw, refuse_custom, write_custom};
pub use hardening::{Hardening, HardeningLaw, HardeningPoint};
pub use hardening_curve::{HardeningCurve, HardeningMode, StressMeasure};
pub use hardening_table::{HardeningTable, LARGEST_TABLE, TableError};
pub use plastic_table::{PlasticTable, curve_table};
pub use voce::Voce;

/// Quantities with units, which stresses and lengths are written in.
pub use asperity_formats::units;
