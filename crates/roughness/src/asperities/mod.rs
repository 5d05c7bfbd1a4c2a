//! The asperities of a map: islands above a plane, or the hills of ISO 25178-2; and what of one goes into a
//! model of it.
//!
//! A segmentation gives every node the number of its asperity, one pass over the nodes gives the summits, one
//! over the cells of hills their areas. A [`RadialProfile`] turns the neighbourhood of a summit into a body
//! of revolution, [`line()`] takes a row of the map as the surface of a body of constant section.
//!
//! Sources: ISO 25178-2 (hills, pruning), Wolf 1991 (the tree of summits and saddles), Scott 2004 (its use on
//! surfaces).

/// The number of a node that belongs to no asperity.
const NO_ASPERITY: u32 = u32::MAX;

mod hills;

mod gather;
mod tip;

mod find;

mod line;
mod profile;

pub use find::{Asperity, FindError, Segmentation, find};
pub use line::{Direction, LineError, SurfaceLine, line};
pub use profile::{ProfileError, RadialProfile};
pub use tip::Tip;

#[cfg(test)]
mod tests;
