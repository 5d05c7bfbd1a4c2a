//! Height maps: read or generated, levelled, filtered, with their roughness parameters.

pub(crate) mod height_map;

pub(crate) mod fft;
pub(crate) mod filter;
pub(crate) mod gaussian;
pub(crate) mod level;
pub(crate) mod outliers;

pub(crate) mod cells;
pub(crate) mod parameters;
pub(crate) mod spectrum;

pub(crate) mod generate;

pub(crate) mod prepared_surface;
mod tiles;
