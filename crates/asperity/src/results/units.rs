//! Units of the result files, and the endings that they give to names.
//!
//! Rows are in SI; a file has a value over [`Unit::value`] under the name that [`Unit::name`] gives. In plane strain forces and
//! energies are per length of ridge and the contact area is a width.

use asperity_simulation::scene::Symmetry;

/// SI value of 1 µm.
pub const MICROMETRE: f64 = 1e-6;
/// SI value of 1 MPa.
pub const MEGAPASCAL: f64 = 1e6;
/// SI value of 1 GPa.
pub const GIGAPASCAL: f64 = 1e9;

/// The unit of a column or key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// None: a count, a ratio, a word, a table, or a unit that the name has already.
    Plain,
    /// None: 1 for true, 0 for false.
    Bit,
    /// µm.
    Length,
    /// Contact area, µm²; contact width in plane strain, µm.
    Contact,
    /// µm².
    Area,
    /// N, N/mm in plane strain.
    Force,
    /// µJ, µJ/mm in plane strain.
    Energy,
    /// N/µm, N/µm/mm in plane strain.
    Stiffness,
    /// MPa.
    Pressure,
    /// GPa.
    Modulus,
    /// MB of 10⁶ bytes.
    Memory,
}

impl Unit {
    /// SI value of 1 of it in a file.
    pub fn value(self, symmetry: Symmetry) -> f64 {
        use Symmetry::{Axisymmetric, PlaneStrain};
        match (self, symmetry) {
            (Unit::Plain | Unit::Bit, _) => 1.0,
            (Unit::Length, _) => MICROMETRE,
            (Unit::Contact, Axisymmetric) => 1e-12,
            (Unit::Contact, PlaneStrain) => 1e-6,
            (Unit::Area, _) => MICROMETRE * MICROMETRE,
            (Unit::Force, Axisymmetric) => 1.0,
            (Unit::Force, PlaneStrain) => 1e3,
            (Unit::Energy, Axisymmetric) => 1e-6,
            (Unit::Energy, PlaneStrain) => 1e-3,
            (Unit::Stiffness, Axisymmetric) => 1e6,
            (Unit::Stiffness, PlaneStrain) => 1e9,
            (Unit::Pressure, _) => MEGAPASCAL,
            (Unit::Modulus, _) => GIGAPASCAL,
            (Unit::Memory, _) => 1e6,
        }
    }

    /// The name in a file of the quantity `of`.
    pub fn name(self, of: &str, symmetry: Symmetry) -> String {
        let end = match self {
            Unit::Plain | Unit::Bit => "",
            Unit::Length => "_um",
            Unit::Contact | Unit::Area => "_um2",
            Unit::Force => "_N",
            Unit::Energy => "_uJ",
            Unit::Stiffness => "_N_per_um",
            Unit::Pressure => "_MPa",
            Unit::Modulus => "_GPa",
            Unit::Memory => "_MB",
        };
        match (self, symmetry) {
            (Unit::Contact, Symmetry::PlaneStrain) => "contact_width_um".into(),
            (Unit::Force | Unit::Energy | Unit::Stiffness, Symmetry::PlaneStrain) => {
                format!("{of}{end}_per_mm")
            }
            _ => format!("{of}{end}"),
        }
    }
}

/// The end of a unit of force or energy, for people.
pub(crate) fn per_length(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::Axisymmetric => "",
        Symmetry::PlaneStrain => "/mm",
    }
}
