//! Reasons why an integration point cannot be updated.

/// A deformation that a point cannot follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// The element is, or the increment would turn it, inside out at the point: det J or det f is not
    /// positive.
    #[error("the element is turned inside out")]
    Inverted,
    /// The left Cauchy-Green tensor is not positive definite or not finite: no logarithmic strain exists.
    #[error("the strain has no logarithm")]
    NotPositive,
}
