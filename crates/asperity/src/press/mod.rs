//! The contact of a rough surface with a rigid plane.

pub mod files;
pub mod run;
pub mod table1;
