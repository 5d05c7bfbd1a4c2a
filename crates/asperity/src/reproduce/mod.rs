//! The figures and tables of the paper, computed and judged.
//!
//! Parts of the work (`plan`) run side by side, each into a folder of its own with a stamp that says it is done (`part`);
//! the report reads those folders (`results_reader`), judges the paper's claims (`claims`) and shows its figures
//! (`figures`, `report`).

mod paper;

pub mod plan;

mod profile;

pub mod part;

mod results_reader;

pub mod claims;
mod figures;
pub mod report;

mod run;

pub use run::{Options, Planned, Progress, Reproduction, reproduce};
