#![doc = include_str!("../README.md")]
//!
//! Parts of the work (`plan`) run side by side, each on a core of its own, into a folder of its own with a
//! stamp that says it is done (`part`, `rough_part`); `pace` tells the work that remains. The report reads
//! those folders (`results_reader`), judges the paper's claims (`claims`) and shows its figures (`figures`,
//! `report`).

mod paper;

pub mod plan;

mod profile;

pub mod pace;
pub mod part;
mod rough_part;

mod results_reader;

pub mod table1;

pub mod sensitivity;
mod sensitivity_parts;

pub mod verdict;
pub mod zones;

pub mod claims;
mod figures;
pub mod paper_report;
mod rough_claims;

mod reproduction;

pub use crate::reproduction::{News, Options, Planned, Reproduction, reproduce};
pub use sensitivity::sensitivity;
