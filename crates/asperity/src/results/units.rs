//! Units of the result files, and the names that quantities have there in plane strain.
//!
//! The rows and summaries of this library are named as in the files of an axisymmetric crush. In plane strain forces and
//! energies are per length of ridge and the area is a width; [`plane_strain_name`] is the one place that says so.

use asperity_simulation::scene::Symmetry;

/// SI value of 1 µm.
pub const MICROMETRE: f64 = 1e-6;
/// SI value of 1 MPa.
pub const MEGAPASCAL: f64 = 1e6;
/// SI value of 1 GPa.
pub const GIGAPASCAL: f64 = 1e9;

/// SI values of 1 in a file, of the quantities that depend on the symmetry.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// Of a force: N, or N/mm.
    pub force: f64,
    /// Of an energy: µJ, or µJ/mm.
    pub energy: f64,
    /// Of a stiffness: N/µm, or N/µm/mm.
    pub stiffness: f64,
    /// Of the contact area, µm², or the contact width, µm.
    pub area: f64,
}

impl Units {
    /// Those of the files of a run.
    pub fn of(symmetry: Symmetry) -> Units {
        match symmetry {
            Symmetry::Axisymmetric => Units { force: 1.0, energy: 1e-6, stiffness: 1e6, area: 1e-12 },
            Symmetry::PlaneStrain => Units { force: 1e3, energy: 1e-3, stiffness: 1e9, area: 1e-6 },
        }
    }
}

/// The column that an area becomes in plane strain.
const AREA: [&str; 2] = ["contact_area_um2", "contact_width_um"];
/// Ends of names of quantities that are per length in plane strain.
const PER_LENGTH: [&str; 3] = ["_N", "_uJ", "_N_per_um"];

/// The name in plane strain of the column or key `name` of an axisymmetric file.
pub fn plane_strain_name(name: &str) -> String {
    match name {
        name if name == AREA[0] => AREA[1].to_string(),
        name if PER_LENGTH.iter().any(|end| name.ends_with(end)) => format!("{name}_per_mm"),
        name => name.to_string(),
    }
}

/// The name in an axisymmetric file of the column or key `name` of either: the inverse of [`plane_strain_name`].
pub fn axisymmetric_name(name: &str) -> &str {
    if name == AREA[1] { AREA[0] } else { name.strip_suffix("_per_mm").unwrap_or(name) }
}

/// The name of the column or key `name` in the files of a run.
pub fn file_name(name: &str, symmetry: Symmetry) -> String {
    match symmetry {
        Symmetry::Axisymmetric => name.to_string(),
        Symmetry::PlaneStrain => plane_strain_name(name),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_plane_strain_lead_back() {
        for (name, plane) in [
            ("force_N", "force_N_per_mm"),
            ("external_work_uJ", "external_work_uJ_per_mm"),
            ("unloading_stiffness_N_per_um", "unloading_stiffness_N_per_um_per_mm"),
            ("contact_area_um2", "contact_width_um"),
            ("depth_um", "depth_um"),
            ("mean_pressure_MPa", "mean_pressure_MPa"),
        ] {
            assert_eq!(plane_strain_name(name), plane);
            assert_eq!(axisymmetric_name(plane), name);
            assert_eq!(axisymmetric_name(name), name);
        }
    }
}
