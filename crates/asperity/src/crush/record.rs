//! Rows of `curve.csv`, `asperities.csv`, `gaps.csv`, `cycles.csv` and `surface_NNNN.csv`, as they are written and read.
//!
//! Fields are named as the columns of an axisymmetric crush, units included; [`crate::units`] names them in plane strain.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use crate::error::{Error, InputError};
use crate::output::{read_csv, write_csv};
use crate::units::{MEGAPASCAL, MICROMETRE, Units, axisymmetric_name, file_name};
use asperity_solver::body::fields::SurfacePoint;
use asperity_solver::run::record;
use asperity_solver::scene::Symmetry;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::io::Write;
use std::path::Path;

/// Whether the tool advances or retreats; `cycles.csv` says where it advances again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Phase {
    /// The tool advances.
    Load,
    /// The tool retreats.
    Unload,
}

impl From<record::Phase> for Phase {
    fn from(phase: record::Phase) -> Self {
        match phase {
            record::Phase::Load | record::Phase::Reload => Phase::Load,
            record::Phase::Unload => Phase::Unload,
        }
    }
}

/// One converged increment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CurveRow {
    /// Counted from 0, the first touch.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// Tool travel from first touch, corrected for penetration.
    pub depth_um: f64,
    /// Force on the tool, positive in compression, of the full body of revolution (in plane strain per mm).
    pub force_N: f64,
    /// Projected current area under pressure (in plane strain its width in µm).
    pub contact_area_um2: f64,
    /// Outer edge of the contact that holds the axis; in plane strain half the contact width.
    pub contact_radius_um: f64,
    /// Force over contact area; 0 without contact.
    pub mean_pressure_MPa: f64,
    /// ∫F dh over the raw tool displacement.
    pub external_work_uJ: f64,
    /// Stored elastic energy, residual stress included.
    pub elastic_energy_uJ: f64,
    /// Σ∫σ_y dε_p.
    pub plastic_work_uJ: f64,
    /// ½ε∫g² dA of the penalty.
    pub contact_energy_uJ: f64,
    /// Mean penetration, weighted by the pressure.
    pub penetration_um: f64,
    /// Newton iterations spent since the last row.
    pub newton_iterations: usize,
}

impl CurveRow {
    pub(super) fn new(row: &record::CurveRow, units: Units) -> CurveRow {
        CurveRow {
            increment: row.increment,
            phase: row.phase.into(),
            depth_um: row.depth / MICROMETRE,
            force_N: row.force / units.force,
            contact_area_um2: row.contact_area / units.area,
            contact_radius_um: row.contact_radius / MICROMETRE,
            mean_pressure_MPa: row.mean_pressure / MEGAPASCAL,
            external_work_uJ: row.external_work / units.energy,
            elastic_energy_uJ: row.elastic_energy / units.energy,
            plastic_work_uJ: row.plastic_work / units.energy,
            contact_energy_uJ: row.contact_energy / units.energy,
            penetration_um: row.penetration / MICROMETRE,
            newton_iterations: row.newton_iterations,
        }
    }
}

/// The share of one asperity in one increment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct AsperityRow {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// Counted from 0, from the axis (left side) outward.
    pub asperity: usize,
    /// As in the curve.
    pub depth_um: f64,
    /// Force on this asperity.
    pub force_N: f64,
    /// Its contact area.
    pub contact_area_um2: f64,
    /// Innermost (leftmost) point of its contact; `None` without contact.
    pub contact_left_um: Option<f64>,
    /// Outermost point of its contact; `None` without contact.
    pub contact_right_um: Option<f64>,
    /// Largest contact pressure on it.
    pub max_pressure_MPa: f64,
}

impl AsperityRow {
    pub(super) fn new(row: &record::AsperityRow, units: Units) -> AsperityRow {
        let place = |x: f64| Some(x / MICROMETRE).filter(|x| x.is_finite());
        AsperityRow {
            increment: row.increment,
            phase: row.phase.into(),
            asperity: row.asperity,
            depth_um: row.depth / MICROMETRE,
            force_N: row.force / units.force,
            contact_area_um2: row.contact_area / units.area,
            contact_left_um: place(row.contact_left),
            contact_right_um: place(row.contact_right),
            max_pressure_MPa: row.max_pressure / MEGAPASCAL,
        }
    }
}

/// An untouched stretch of surface between two contacts in one increment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GapRow {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// As in the curve.
    pub depth_um: f64,
    /// End of the contact before the gap.
    pub left_um: f64,
    /// Beginning of the contact after it.
    pub right_um: f64,
    /// Distance of the two.
    pub width_um: f64,
    /// Largest distance from the tool in between.
    pub height_um: f64,
}

impl From<&record::GapRow> for GapRow {
    fn from(row: &record::GapRow) -> GapRow {
        GapRow {
            increment: row.increment,
            phase: row.phase.into(),
            depth_um: row.depth / MICROMETRE,
            left_um: row.left / MICROMETRE,
            right_um: row.right / MICROMETRE,
            width_um: (row.right - row.left) / MICROMETRE,
            height_um: row.height / MICROMETRE,
        }
    }
}

/// One loading with its unloading: the first one, then the reloads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CycleRow {
    /// 0: the first loading; then the reloads.
    pub cycle: usize,
    /// Increment of the peak.
    pub peak_increment: usize,
    /// Increment at which the tool is gone.
    pub end_increment: usize,
    /// Depth at the peak.
    pub peak_depth_um: f64,
    /// Force at the peak.
    pub peak_force_N: f64,
    /// Initial summit minus the highest point of the body in equilibrium without the tool.
    pub residual_depth_um: f64,
    /// ∫F dh on the way in, over the corrected depth.
    pub work_in_uJ: f64,
    /// Work returned on the way out.
    pub work_out_uJ: f64,
    /// The difference of the two.
    pub hysteresis_uJ: f64,
    /// Plastic work of both ways.
    pub plastic_work_uJ: f64,
}

impl CycleRow {
    pub(super) fn new(row: &record::CycleRow, units: Units) -> CycleRow {
        CycleRow {
            cycle: row.cycle,
            peak_increment: row.peak_increment,
            end_increment: row.end_increment,
            peak_depth_um: row.peak_depth / MICROMETRE,
            peak_force_N: row.peak_force / units.force,
            residual_depth_um: row.residual_depth / MICROMETRE,
            work_in_uJ: row.work_in / units.energy,
            work_out_uJ: row.work_out / units.energy,
            hysteresis_uJ: (row.work_in - row.work_out) / units.energy,
            plastic_work_uJ: row.plastic_work / units.energy,
        }
    }
}

/// A node of the free surface: pile-up and sink-in. In plane strain r is x.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceRow {
    /// Current radius.
    pub r_um: f64,
    /// Current height over the initial summit.
    pub z_um: f64,
    /// Displacement along r.
    pub u_r_um: f64,
    /// Displacement along z.
    pub u_z_um: f64,
    /// Contact pressure.
    pub pressure_MPa: f64,
    /// 1 where the material has yielded, else 0.
    pub yielded: u8,
}

impl From<&SurfacePoint> for SurfaceRow {
    fn from(point: &SurfacePoint) -> SurfaceRow {
        let [r_um, z_um] = point.position.map(|x| x / MICROMETRE);
        let [u_r_um, u_z_um] = point.displacement.map(|x| x / MICROMETRE);
        let (pressure_MPa, yielded) = (point.pressure / MEGAPASCAL, u8::from(point.yielded));
        SurfaceRow { r_um, z_um, u_r_um, u_z_um, pressure_MPa, yielded }
    }
}

/// Writes rows as the CSV of a crush in this symmetry.
///
/// # Errors
/// A writer that fails.
pub fn write_rows<T: Serialize>(out: &mut dyn Write, rows: &[T], symmetry: Symmetry) -> csv::Result<()> {
    write_csv(out, rows, |name| file_name(name, symmetry))
}

/// Reads the rows of a CSV file of a crush in either symmetry.
///
/// # Errors
/// A file that cannot be read, or holds other rows.
pub fn read_rows<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, Error> {
    let error = |e: &dyn std::fmt::Display| InputError::new(format!("cannot read {}: {e}", path.display()));
    let file = std::fs::File::open(path).map_err(|e| error(&e))?;
    read_csv(file, axisymmetric_name).map_err(|e| error(&e).into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(symmetry: Symmetry) -> CurveRow {
        let row = record::CurveRow {
            increment: 3,
            phase: record::Phase::Unload,
            depth: 5.0 * 1e-6,
            force: 5.52,
            contact_area: 3e-10,
            contact_radius: 1e-5,
            mean_pressure: 1.84e10,
            external_work: 9.46e-6,
            elastic_energy: 1e-6 / 3.0,
            plastic_work: 8e-6,
            contact_energy: 5e-11,
            penetration: 2e-8,
            newton_iterations: 6,
        };
        CurveRow::new(&row, Units::of(symmetry))
    }

    fn text<T: Serialize>(symmetry: Symmetry, row: T) -> String {
        let mut out = Vec::new();
        write_rows(&mut out, &[row], symmetry).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn the_curve_has_the_columns_and_units_of_the_contract() {
        let text = text(Symmetry::Axisymmetric, row(Symmetry::Axisymmetric));
        let (head, line) = text.trim_end().split_once('\n').unwrap();
        assert_eq!(
            head,
            "increment,phase,depth_um,force_N,contact_area_um2,contact_radius_um,mean_pressure_MPa,external_work_uJ,\
             elastic_energy_uJ,plastic_work_uJ,contact_energy_uJ,penetration_um,newton_iterations"
        );
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[..4], ["3", "unload", "5.0", "5.52"]);
        assert_eq!(cells[10..], ["5e-5", "0.02", "6"]);
        for (k, value) in [(4, 300.0), (5, 10.0), (6, 18400.0), (7, 9.46), (8, 1.0 / 3.0)] {
            let got: f64 = cells[k].parse().unwrap();
            assert!((got / value - 1.0).abs() < 1e-15, "{k}: {got}");
        }
    }

    #[test]
    fn in_plane_strain_forces_and_energies_are_per_length() {
        let text = text(Symmetry::PlaneStrain, row(Symmetry::PlaneStrain));
        let (head, line) = text.trim_end().split_once('\n').unwrap();
        assert!(head.starts_with("increment,phase,depth_um,force_N_per_mm,contact_width_um,"));
        assert!(head.contains(",external_work_uJ_per_mm,"));
        let cells: Vec<f64> = line.split(',').skip(2).map(|c| c.parse().unwrap()).collect();
        // 5.52 N/m, and 9.46e-6 J/m = 9.46 µJ/m
        assert!((cells[1] - 5.52e-3).abs() < 1e-15 && (cells[5] - 9.46e-3).abs() < 1e-15);
    }

    #[test]
    fn rows_read_back_to_the_same_bits_in_both_symmetries() {
        let dir = tempfile::tempdir().unwrap();
        for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
            let path = dir.path().join("curve.csv");
            std::fs::write(&path, text(symmetry, row(symmetry))).unwrap();
            assert_eq!(read_rows::<CurveRow>(&path).unwrap(), [row(symmetry)]);
            assert!(read_rows::<CycleRow>(&path).unwrap_err().to_string().contains("curve.csv"));
        }
    }

    #[test]
    fn an_asperity_out_of_contact_has_no_place() {
        let row = record::AsperityRow {
            increment: 1,
            phase: record::Phase::Reload,
            asperity: 2,
            depth: 1e-6,
            force: 0.0,
            contact_area: 0.0,
            contact_left: f64::NAN,
            contact_right: f64::NAN,
            max_pressure: 0.0,
        };
        let row = AsperityRow::new(&row, Units::of(Symmetry::Axisymmetric));
        assert_eq!(text(Symmetry::Axisymmetric, row).lines().nth(1).unwrap(), "1,load,2,1.0,0.0,0.0,,,0.0");
    }
}
