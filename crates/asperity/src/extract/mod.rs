//! From a measured map to finite elements: the asperities of a map, the bodies that stand for them, ready
//! scenes, and the closures held against what crushing them gives.

mod settings;

mod bodies;

mod rows;
mod scenes;

mod take;

mod closures;
mod compare;

mod files;
mod picture;

pub use crate::extract::take::{Extracted, Summary, extract};
pub use bodies::{Body, Line};
pub use compare::{Compared, Comparison};
pub use rows::{AsperityRow, ComparedRow, FINITE_ELEMENTS};
pub use settings::{Extraction, LineAt, Parts};
