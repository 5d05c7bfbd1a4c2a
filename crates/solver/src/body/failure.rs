//! Reasons why a body cannot be assembled or its stiffness not be factorised.

use crate::point::failure::Failure as PointFailure;

/// The failure of a trial; the load path answers it with a smaller increment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// An integration point could not be updated.
    #[error("element {cell}: {cause}")]
    Element {
        /// Number of the element, from 0.
        cell: usize,
        /// The reason why a point of it fails.
        cause: PointFailure,
    },
    /// The stiffness could not be factorised in any of the ways tried.
    #[error("the stiffness is singular")]
    Singular,
}
