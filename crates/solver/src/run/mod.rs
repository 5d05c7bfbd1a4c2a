//! A run: the problem made of a scene, the load path, what is recorded, the error estimate.

pub mod discretisation;

pub mod a_priori;

pub mod problem;

pub mod tool_stiffness;

pub mod equilibrium;

pub mod load_path;

pub mod depth_for_force;

pub mod error_estimate;

pub mod crush;

pub mod record;

pub mod curve;

pub mod oliver_pharr;
