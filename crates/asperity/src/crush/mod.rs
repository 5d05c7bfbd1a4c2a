//! The files of a crush: curve, asperities, summary, plot, fields. Inside SI, in the files µm, N, µJ, MPa.

mod fields;
mod plot;
mod summary;
mod table;

pub use fields::{FieldSeries, field_arrays, write_surface};
pub use plot::plot;
pub use summary::{overview, peak_memory_mb, summary_json};
pub use table::{write_asperities, write_curve, write_cycles, write_gaps};

use asperity_solver::scene::Symmetry;

/// SI value of 1 µm.
pub const MICROMETRE: f64 = 1e-6;
/// SI value of 1 MPa.
pub const MEGAPASCAL: f64 = 1e6;
/// SI value of 1 GPa.
pub const GIGAPASCAL: f64 = 1e9;

/// How a quantity that depends on the symmetry is named and scaled: divide SI by `scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unit {
    /// End of the column's name.
    pub suffix: &'static str,
    /// SI value of 1 in the file.
    pub scale: f64,
}

/// Force on the body of revolution, or per length of ridge.
pub fn force_unit(symmetry: Symmetry) -> Unit {
    match symmetry {
        Symmetry::Axisymmetric => Unit { suffix: "N", scale: 1.0 },
        Symmetry::PlaneStrain => Unit { suffix: "N_per_mm", scale: 1e3 },
    }
}

/// Energy of the body of revolution, or per length of ridge.
pub fn energy_unit(symmetry: Symmetry) -> Unit {
    match symmetry {
        Symmetry::Axisymmetric => Unit { suffix: "uJ", scale: 1e-6 },
        Symmetry::PlaneStrain => Unit { suffix: "uJ_per_mm", scale: 1e-3 },
    }
}

/// Stiffness dF/dh.
pub fn stiffness_unit(symmetry: Symmetry) -> Unit {
    match symmetry {
        Symmetry::Axisymmetric => Unit { suffix: "N_per_um", scale: 1e6 },
        Symmetry::PlaneStrain => Unit { suffix: "N_per_um_per_mm", scale: 1e9 },
    }
}

/// Contact area, or contact width; the suffix is the whole name of the column.
pub fn area_unit(symmetry: Symmetry) -> Unit {
    match symmetry {
        Symmetry::Axisymmetric => Unit { suffix: "contact_area_um2", scale: 1e-12 },
        Symmetry::PlaneStrain => Unit { suffix: "contact_width_um", scale: 1e-6 },
    }
}
pub use crate::cli::crush::{Crushed, Sketch, crush_into, resolved};
