//! What one Newton iteration must cost, to hold what it does cost against: measured once for the same work done barely.
//!
//! Element matrix with scatter of one flowing point (finite strain, spectral), and faer's supernodal Cholesky with its
//! solution, on one idle core of a Zen 4; the factorisation of a plane mesh grows with unknowns^1.35 between 5,000 and
//! 10,000 of them.

/// Seconds that the parts of one iteration take at least.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    /// Element matrix of one flowing point.
    point: f64,
    /// Factorisation and solution of [`UNKNOWNS`] unknowns.
    factor: f64,
}

/// Unknowns for which the factorisation was measured.
const UNKNOWNS: f64 = 5000.0;

/// Growth of the factorisation with the unknowns.
const GROWTH: f64 = 1.35;

/// Eight-node elements.
pub const QUADRATIC: Floor = Floor { point: 365e-9, factor: 2.4e-3 };

/// Four-node elements.
pub const LINEAR: Floor = Floor { point: 271e-9, factor: 1.9e-3 };

impl Floor {
    /// Seconds of one iteration with a new tangent.
    pub fn iteration(&self, points: usize, unknowns: f64) -> f64 {
        self.point * points as f64 + self.factor * (unknowns / UNKNOWNS).powf(GROWTH)
    }
}
