//! The record of a run: its rows and summary in SI, read off the converged increments and freed of the ripple
//! of the mesh.

pub mod rows;

pub mod curve;

mod mesh_ripple;

pub mod oliver_pharr;

pub(crate) mod outcome;

mod way_out;

pub(crate) mod recorder;
