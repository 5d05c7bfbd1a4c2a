//! The body under its tool: converged state, the increment under way, energies, fields.

pub mod model;

pub mod energy;

pub mod fields;

pub mod islands;
