//! The factors of a tangent, and what corrects them since.

use asperity_numerics::corrected::Correction;
use asperity_numerics::secants::Secants;
use asperity_numerics::sparse::cholesky::Factor;
use asperity_numerics::sparse::front_tree::FrontTree;
use std::sync::Arc;

/// The factors of a tangent, and what corrects them since it was made.
pub(super) struct Factors {
    pub factor: Factor,
    /// The part of friction that is not symmetric.
    pub correction: Correction,
    pub secants: Secants,
    /// Whether they are of the tangent of some iterate of this body.
    pub valid: bool,
    /// Whether each point yielded there.
    yielded: Vec<bool>,
}

impl Factors {
    /// None yet, of a stiffness whose fronts are known.
    pub fn new(fronts: Arc<FrontTree>) -> Factors {
        Factors {
            factor: Factor::with_tree(fronts),
            correction: Correction::default(),
            secants: Secants::default(),
            valid: false,
            yielded: Vec::new(),
        }
    }

    /// They are of another body.
    pub fn discard(&mut self) {
        self.valid = false;
        self.secants.clear();
    }

    /// Takes down which points are `yielding` where they are made.
    pub fn note_yielding(&mut self, yielding: impl Iterator<Item = bool>) {
        self.yielded.clear();
        self.yielded.extend(yielding);
    }

    /// Whether other points are `yielding` than where they were made: where a point yields that did not, or
    /// the other way, its modulus has leapt.
    pub fn are_stale(&self, yielding: impl Iterator<Item = bool>) -> bool {
        !yielding.eq(self.yielded.iter().copied())
    }
}
