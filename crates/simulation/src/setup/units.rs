//! The units of a dimensionless problem.

use asperity_solver::point::kinematics::Symmetry;

/// Values of 1 in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// m.
    pub length: f64,
    /// Pa.
    pub stress: f64,
    /// N, or N/m in plane strain.
    pub force: f64,
    /// m², or m.
    pub area: f64,
    /// J, or J/m.
    pub energy: f64,
}

impl Units {
    /// Those that follow from a `length` (m) and a `stress` (Pa).
    pub fn new(length: f64, stress: f64, symmetry: Symmetry) -> Units {
        let (l, e) = (length, stress);
        match symmetry {
            Symmetry::Axisymmetric => {
                Units { length: l, stress: e, force: e * l * l, area: l * l, energy: e * l * l * l }
            }
            Symmetry::PlaneStrain => Units { length: l, stress: e, force: e * l, area: l, energy: e * l * l },
        }
    }
}
