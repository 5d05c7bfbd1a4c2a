//! Parts of results: rows and summaries as the files have them, units and numbers, and places of files.

pub mod columns;
pub(crate) mod crush_columns;
pub(crate) mod crush_summary;
pub mod output;
pub mod units;

pub use asperity_draw::numbers;
