//! The body under its tool: mesh and material, converged state, a trial and the response to it, energies,
//! fields.

pub mod failure;

pub mod dofs;

pub mod stiffness;

pub mod analysis;

pub mod discrete_body;

pub mod state;

pub mod assembly;

mod elements;

mod flow;

mod extrapolation;

mod commit;

pub mod energy;

pub mod surface;

pub mod fields;

pub mod islands;
