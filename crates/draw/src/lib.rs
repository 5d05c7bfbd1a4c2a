#![doc = include_str!("../README.md")]

pub mod numbers;

pub mod palette;
pub mod scale;

pub mod encode;
pub mod frame;

pub mod axis;
pub mod chart;
pub mod field_plot;
pub mod rough_map;
pub mod scale_charts;

/// Lengths are drawn in micrometres, m.
pub const MICROMETRE: f64 = 1e-6;
/// Stresses are drawn in megapascals, Pa.
pub const MEGAPASCAL: f64 = 1e6;
