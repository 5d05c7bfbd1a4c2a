//! The two quadrilaterals and what they share.

pub mod kernel;

pub mod quad4;
pub mod quad8;
