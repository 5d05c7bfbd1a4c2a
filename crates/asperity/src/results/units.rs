//! Units of the result files.

use asperity_simulation::scene::Symmetry;

/// SI value of 1 µm.
pub const MICROMETRE: f64 = 1e-6;
/// SI value of 1 MPa.
pub const MEGAPASCAL: f64 = 1e6;
/// SI value of 1 GPa.
pub const GIGAPASCAL: f64 = 1e9;

/// The end of a unit of force or energy, for people.
pub(crate) fn per_length(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::Axisymmetric => "",
        Symmetry::PlaneStrain => "/mm",
    }
}
