//! Units of the result files.

use asperity_simulation::scene::Symmetry;

pub use asperity_draw::{MEGAPASCAL, MICROMETRE};

/// SI value of 1 GPa.
pub const GIGAPASCAL: f64 = 1e9;

/// The end of a unit of force or energy, for people.
pub(crate) fn per_length(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::Axisymmetric => "",
        Symmetry::PlaneStrain => "/mm",
    }
}
