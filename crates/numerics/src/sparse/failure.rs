//! The reason why a matrix could not be factorised.

/// The reason why a matrix could not be factorised.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FactorError {
    /// A pivot of the Cholesky factorisation is not positive: the matrix is indefinite.
    #[error("the stiffness matrix is not positive definite")]
    NotPositive,
    /// The matrix is singular or not finite, or memory ran out.
    #[error("the stiffness matrix is singular or not finite")]
    Singular,
}
