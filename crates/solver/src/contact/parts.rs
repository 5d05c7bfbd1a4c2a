//! The parts of an edge that touch.

/// Parts of an edge, as intervals of its coordinate ξ in [-1, 1]: its middle, or both its ends.
pub type Parts = [Option<[f64; 2]>; 2];

/// No part at all.
pub const NOTHING: Parts = [None, None];

/// The whole edge.
pub const WHOLE: Parts = [Some([-1.0, 1.0]), None];
