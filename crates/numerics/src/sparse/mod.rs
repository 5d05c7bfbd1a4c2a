//! A symmetric sparse matrix factorised as LDLᵀ by fronts: the order of elimination, the tree of fronts, the
//! factor and its solves.

pub mod failure;

pub mod minimum_degree;

pub mod fill_ordering;

mod front_size;

mod large_front;

pub mod front;

pub mod front_tree;

pub mod front_solve;

mod factor_numbers;

pub mod cholesky;

/// A matrix of compressed rows or columns, of the crate sprs.
pub use sprs::CsMat;
