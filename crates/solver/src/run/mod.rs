//! A run: the problem made of a scene or a cone, the load path, what is recorded, the error estimate.

pub mod discretisation;

pub mod a_priori;

pub mod schedule;

pub mod problem;

pub mod prepare;

pub mod cone;

pub mod tool_stiffness;

pub mod equilibrium;

pub mod load_path;

pub mod record;

pub mod curve;

pub mod depth_for_force;

pub mod oliver_pharr;

pub mod error_estimate;

mod recorder;

pub mod crush;
