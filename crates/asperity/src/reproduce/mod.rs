//! The figures and tables of the paper, computed and judged.

pub mod claims;
pub mod evidence;
pub mod figures;
pub mod part;
pub mod plan;
pub mod report;
