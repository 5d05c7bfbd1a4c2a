//! The sweep of cones and its fit.

pub mod dependence;
pub mod pictures;
pub mod results;
pub use crate::cli::calibrate::Order;
