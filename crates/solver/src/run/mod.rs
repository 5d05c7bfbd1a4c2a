//! A run: the problem made of a scene or a cone, the load path, what is recorded, the error estimate.

pub mod discretisation;

#[doc(hidden)]
pub mod a_priori;

mod lowering;

#[doc(hidden)]
pub mod schedule;

pub mod units;

pub mod problem;

pub mod prepare;

pub mod cone;

#[doc(hidden)]
pub mod tool_stiffness;

#[doc(hidden)]
pub mod equilibrium;

pub mod load_path;

pub mod record;

pub mod curve;

pub mod depth_for_force;

pub mod oliver_pharr;

pub mod errors;

mod ripple;

mod recorder;

pub mod journal;

pub mod simulate;

mod earlier;

#[doc(hidden)]
pub mod formed;

pub mod compliance;
pub mod crush;
