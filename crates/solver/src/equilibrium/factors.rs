//! The factors of a tangent, and what corrects them since.

use crate::point::material::Metal;
use asperity_numerics::corrected::Correction;
use asperity_numerics::secants::Secants;
use asperity_numerics::sparse::cholesky::{Factor, Precision};
use asperity_numerics::sparse::front_tree::FrontTree;
use std::sync::Arc;

/// The factors of a tangent, and what corrects them since it was made.
pub(super) struct Factors {
    pub factor: Factor,
    /// The part of friction that is not symmetric.
    pub correction: Correction,
    pub secants: Secants,
    /// True where they are of the tangent of some iterate of this body.
    pub valid: bool,
    /// True for each point that yielded there.
    yielded: Vec<bool>,
}

/// Bulk modulus over shear modulus from which single precision is too little: with the thousandfold
/// differences of stiffness in a graded mesh the factors then have no digit to spare. 100 is Poisson's ratio
/// 0.495; at 0.4999999 no first increment of an elastic cone converges.
const NEARLY_INCOMPRESSIBLE: f64 = 100.0;

/// Digits of the factors that a body of `metal` begins with.
pub(super) fn precision(metal: &Metal) -> Precision {
    let elastic = &metal.elastic;
    let ratio = elastic.bulk_modulus() / elastic.shear_modulus();
    if ratio < NEARLY_INCOMPRESSIBLE { Precision::Single } else { Precision::Double }
}

impl Factors {
    /// None yet, of a stiffness whose fronts are known.
    pub fn new(fronts: Arc<FrontTree>, precision: Precision) -> Factors {
        Factors {
            factor: Factor::with_tree(fronts, precision),
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

    /// True where other points are `yielding` than where they were made: where a point yields that did not,
    /// or the other way, its modulus has leapt.
    pub fn are_stale(&self, yielding: impl Iterator<Item = bool>) -> bool {
        !yielding.eq(self.yielded.iter().copied())
    }
}
