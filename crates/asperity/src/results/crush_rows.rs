//! Rows of `curve.csv`, `asperities.csv`, `gaps.csv`, `cycles.csv` and `surface_NNNN.csv`, as they are written and read.
//!
//! Fields are named as the columns of an axisymmetric crush, units included; [`crate::results::units`] names them in plane strain.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the files")]

use crate::error::{Error, InputError};
use crate::results::output::{read_csv, row, write_csv};
use crate::results::units::{MEGAPASCAL, MICROMETRE, Units, axisymmetric_name, file_name};
use asperity_simulation::record::rows;
use asperity_simulation::scene::Symmetry;
use asperity_solver::body::fields::SurfacePoint;
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

impl From<rows::Phase> for Phase {
    fn from(phase: rows::Phase) -> Self {
        match phase {
            rows::Phase::Load | rows::Phase::Reload => Phase::Load,
            rows::Phase::Unload => Phase::Unload,
        }
    }
}

/// A place in µm; `None` where there is none.
fn place(metres: f64) -> Option<f64> {
    Some(metres / MICROMETRE).filter(|um| um.is_finite())
}

row! {
    /// One converged increment.
    CurveRow(row: &rows::CurveRow, units: Units) {
        /// Counted from 0, the first touch.
        increment: usize = row.increment,
        /// `load` or `unload`; a reload is a load, `cycles.csv` says where it begins.
        phase: Phase = row.phase.into(),
        /// Travel of the tool from first touch, less the penalty correction, plus the far field of the half-space and the deflection of
        /// an elastic tool and of the machine.
        depth_um: f64 = row.depth / MICROMETRE,
        /// Force on the tool, positive in compression, of the full body of revolution (in plane strain per mm); without the
        /// ripple of the mesh, and extrapolated with the companion run.
        force_N: f64 = row.force / units.force,
        /// Projected current area under pressure (in plane strain its width in µm); without the ripple of the mesh, and extrapolated.
        contact_area_um2: f64 = row.contact_area / units.area,
        /// Radius of the disc of the area of the contact that holds the axis; in plane strain half the contact width.
        contact_radius_um: f64 = row.contact_radius / MICROMETRE,
        /// Force over contact area; 0 without contact.
        mean_pressure_MPa: f64 = row.mean_pressure / MEGAPASCAL,
        /// ∫F dh over the raw travel of the tool, which includes `contact_energy_uJ`.
        external_work_uJ: f64 = row.external_work / units.energy,
        /// Stored elastic energy, residual stress included.
        elastic_energy_uJ: f64 = row.elastic_energy / units.energy,
        /// Work of plastic flow, Σ∫σ_y dε_p; never found by subtraction.
        plastic_work_uJ: f64 = row.plastic_work / units.energy,
        /// Energy stored in the penalty, ½ε∫d² dA with the penetration d, less what it changed by so far as the contact was measured anew over
        /// the last converged surface, which is no work of the tool: an artefact of the method, no energy of the metal.
        contact_energy_uJ: f64 = row.contact_energy / units.energy,
        /// Mean penetration, weighted by the pressure.
        penetration_um: f64 = row.penetration / MICROMETRE,
        /// Newton iterations spent since the last row.
        newton_iterations: usize = row.newton_iterations,
        /// Sum of the nodal forces: the force with the ripple of the mesh, which the works are made of.
        force_nodal_N: f64 = row.force_nodal / units.force,
        /// 95 % bound of the relative error of the force in this row; empty where there is no force or the bound is not known. While
        /// unloading it holds the error of the residual depth, by which the curve is shifted.
        force_error: Option<f64> = row.force_error,
        /// Change of the elastic, plastic and contact energy by all transfers to better meshes so far, which is no work of the tool.
        transfer_energy_uJ: f64 = row.transfer_energy / units.energy,
    }
}

row! {
    /// The share of one asperity in one increment.
    AsperityRow(row: &rows::AsperityRow, units: Units) {
        /// Increment of the curve.
        increment: usize = row.increment,
        /// Loading or unloading.
        phase: Phase = row.phase.into(),
        /// Counted from 0, from the axis (left side) outward.
        asperity: usize = row.asperity,
        /// As in the curve.
        depth_um: f64 = row.depth / MICROMETRE,
        /// Force on this asperity.
        force_N: f64 = row.force / units.force,
        /// Its contact area.
        contact_area_um2: f64 = row.contact_area / units.area,
        /// Innermost (leftmost) point of its contact; `None` without contact.
        contact_left_um: Option<f64> = place(row.contact_left),
        /// Outermost point of its contact; `None` without contact.
        contact_right_um: Option<f64> = place(row.contact_right),
        /// Largest contact pressure on it.
        max_pressure_MPa: f64 = row.max_pressure / MEGAPASCAL,
    }
}

row! {
    /// An untouched stretch of surface between two contacts in one increment.
    GapRow(row: &rows::GapRow) {
        /// Increment of the curve.
        increment: usize = row.increment,
        /// Loading or unloading.
        phase: Phase = row.phase.into(),
        /// As in the curve.
        depth_um: f64 = row.depth / MICROMETRE,
        /// End of the contact before the gap.
        left_um: f64 = row.left / MICROMETRE,
        /// Beginning of the contact after it.
        right_um: f64 = row.right / MICROMETRE,
        /// Distance of the two.
        width_um: f64 = (row.right - row.left) / MICROMETRE,
        /// Largest distance from the tool in between; from the lowest to the highest point of an enclosed gap.
        height_um: f64 = row.height / MICROMETRE,
        /// Whether flanks that press each other close it off from the tool.
        enclosed: bool = row.enclosed,
    }
}

row! {
    /// One loading with its unloading: the first one, then the reloads.
    CycleRow(row: &rows::CycleRow, units: Units) {
        /// 0: the first loading; then the reloads.
        cycle: usize = row.cycle,
        /// Increment of the peak.
        peak_increment: usize = row.peak_increment,
        /// Increment at which the tool is gone.
        end_increment: usize = row.end_increment,
        /// Depth at the peak.
        peak_depth_um: f64 = row.peak_depth / MICROMETRE,
        /// Force at the peak.
        peak_force_N: f64 = row.peak_force / units.force,
        /// Initial summit minus the highest point of the body in equilibrium without the tool; of an indent, the depth at which the
        /// tool touches again.
        residual_depth_um: f64 = row.residual_depth / MICROMETRE,
        /// ∫F dh on the way in, over the corrected depth.
        work_in_uJ: f64 = row.work_in / units.energy,
        /// Work returned on the way out.
        work_out_uJ: f64 = row.work_out / units.energy,
        /// The difference of the two.
        hysteresis_uJ: f64 = (row.work_in - row.work_out) / units.energy,
        /// Plastic work of both ways.
        plastic_work_uJ: f64 = row.plastic_work / units.energy,
    }
}

row! {
    /// A node of the free surface: pile-up and sink-in. In plane strain r is x.
    SurfaceRow(point: &SurfacePoint) {
        /// Current radius.
        r_um: f64 = point.position[0] / MICROMETRE,
        /// Current height over the initial summit.
        z_um: f64 = point.position[1] / MICROMETRE,
        /// Displacement along r.
        u_r_um: f64 = point.displacement[0] / MICROMETRE,
        /// Displacement along z.
        u_z_um: f64 = point.displacement[1] / MICROMETRE,
        /// Contact pressure, without the zigzag between corners and mid-side nodes.
        pressure_MPa: f64 = point.pressure / MEGAPASCAL,
        /// 1 where the material has yielded, else 0.
        yielded: u8 = u8::from(point.yielded),
    }
}

/// A node of the free surface in one state: a row of `surfaces.csv`. In plane strain r is x.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SurfaceStateRow {
    /// Increment of the curve; 0: before the crush.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// Depth of the increment.
    pub depth_um: f64,
    /// Current radius.
    pub r_um: f64,
    /// Current height over the initial summit.
    pub z_um: f64,
    /// Displacement along r.
    pub u_r_um: f64,
    /// Displacement along z.
    pub u_z_um: f64,
    /// Contact pressure, without the zigzag between corners and mid-side nodes.
    pub pressure_MPa: f64,
    /// 1 where the material has yielded, else 0.
    pub yielded: u8,
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
        let row = rows::CurveRow {
            increment: 3,
            phase: rows::Phase::Unload,
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
            compliance_depth: 0.0,
            newton_iterations: 6,
            force_nodal: 5.5,
            force_error: Some(0.01),
            transfer_energy: -1e-12,
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
             elastic_energy_uJ,plastic_work_uJ,contact_energy_uJ,penetration_um,newton_iterations,force_nodal_N,force_error,transfer_energy_uJ"
        );
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[..4], ["3", "unload", "5.0", "5.52"]);
        assert_eq!(cells[10..], ["5e-5", "0.02", "6", "5.5", "0.01", "-1e-6"]);
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
        let row = rows::AsperityRow {
            increment: 1,
            phase: rows::Phase::Reload,
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
