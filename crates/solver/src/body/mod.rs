//! The body under its tool: mesh and material, converged state, a trial and the response to it, energies, fields.

pub mod failure;

pub mod discrete_body;

pub mod state;

pub mod assembly;

mod elements;

mod flow;

mod extrapolation;

mod commit;

pub mod remesh;
mod surface_curve;

mod transfer;

pub mod energy;

pub mod surface;

pub mod fields;

pub mod islands;
