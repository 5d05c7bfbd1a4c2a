//! Lower bound on the time of a Newton iteration, from its operations and the peak rate of the machine.
//!
//! The rate is that of a product of dense matrices that fit into the second cache, measured in the same
//! process: what a core does when nothing waits for memory. Operations of the factorisation and of the solve
//! are counted from the factor's own pattern, those of an element from its kernel; a logarithm, an
//! exponential or a power counts as 20.

use asperity_mesh::ElementKind;
use asperity_numerics::sparse::cholesky::Operations;
use faer::linalg::matmul::matmul;
use faer::{Accum, Mat, Par};
use std::time::Instant;

/// Operations per second of one core.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roofline {
    rate: f64,
}

/// Rows of the dense matrices: three of them take 1.5 MB.
const ROWS: usize = 256;

/// Products of which the fastest counts.
const REPEATS: usize = 30;

/// Operations of a yielding point with its tangent: per node 40 for A G_b and 160 for its columns of the
/// stiffness, 20 for the gradients and 16 for the forces; 500 for the push forward, the spectral form, the
/// return and the moduli.
fn point(kind: ElementKind) -> f64 {
    500.0 + 236.0 * kind.nodes() as f64
}

impl Roofline {
    /// Measures this core, in some hundredths of a second.
    pub fn measure() -> Roofline {
        let [a, b] = [1.0, 2.0].map(|x| Mat::from_fn(ROWS, ROWS, |i, j| x / (1.0 + (i + 2 * j) as f64)));
        let mut product = Mat::zeros(ROWS, ROWS);
        let seconds = (0..REPEATS).map(|_| {
            let clock = Instant::now();
            matmul(product.as_mut(), Accum::Replace, a.as_ref(), b.as_ref(), 1.0, Par::Seq);
            clock.elapsed().as_secs_f64()
        });
        Roofline { rate: 2.0 * (ROWS as f64).powi(3) / seconds.fold(f64::INFINITY, f64::min) }
    }

    /// Operations per second.
    pub fn rate(&self) -> f64 {
        self.rate
    }

    /// Seconds of an iteration with a new tangent of `points` points of elements of `kind`, all of which
    /// yield.
    pub fn iteration(&self, kind: ElementKind, points: usize, system: Operations) -> f64 {
        (point(kind) * points as f64 + system.factor + system.solve) / self.rate
    }
}
