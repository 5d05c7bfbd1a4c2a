//! The system of equations: numbering, assembly, order of elimination, factors, secants, Newton-Raphson.

pub mod dofs;

pub mod failure;

pub mod assemble;

pub mod fill_ordering;

pub mod minimum_degree;

pub mod front_size;

pub mod front;

pub mod front_solve;

pub mod large_front;

pub mod front_tree;

pub mod cholesky;

pub mod analysis;

pub mod vectors;

pub mod lbfgs;

pub mod newton;
