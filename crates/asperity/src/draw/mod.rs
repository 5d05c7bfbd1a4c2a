//! Pictures: charts, sections of the deformed body, maps of rough surfaces, as SVG and as PNG.

pub mod palette;
pub mod scale;

pub mod encode;
pub mod frame;

pub mod chart;
pub mod field_plot;
pub mod rough_map;
