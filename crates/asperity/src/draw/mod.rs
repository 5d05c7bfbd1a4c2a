//! Pictures: charts, sections of the deformed body, maps of rough surfaces.

pub mod chart;
pub mod field_plot;
pub mod rough_map;
pub mod scale;

mod glyphs;
