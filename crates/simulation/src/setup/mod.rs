//! The problem made of a scene: units, numbers of the accuracy, the contact that is expected, the mesh, the
//! schedule.

pub mod units;

pub mod discretisation;

pub mod compliance;

#[doc(hidden)]
pub mod contact_estimate;

mod neighbours;

#[doc(hidden)]
pub mod deformed_surface;

#[doc(hidden)]
pub mod schedule;

pub mod problem;

pub mod cone;

pub mod prepare;
