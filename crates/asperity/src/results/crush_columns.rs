//! Rows of `curve.csv`, `asperities.csv`, `gaps.csv`, `cycles.csv`, and `surface_NNNN.csv`: their columns.

use crate::results::columns::columns;
use asperity_simulation::record::rows::{AsperityRow, CurveRow, CycleRow, GapRow};
use asperity_solver::body::fields::SurfacePoint;

columns! {
    CurveRow {
        /// Counted from 0, the first touch.
        increment: Plain,
        /// `load` or `unload`; a reload is a load, `cycles.csv` says where it begins.
        phase: Plain,
        /// Travel of the tool from first touch, less the penalty correction, plus the far field of the
        /// half-space and the deflection of an elastic tool and of the machine.
        depth: Length,
        /// Force on the tool, positive in compression, of the full body of revolution (in plane strain per
        /// mm); without the ripple of the mesh, and extrapolated with the companion run.
        force: Force,
        /// Projected current area under pressure (in plane strain its width in µm); without the ripple of the
        /// mesh, and extrapolated.
        contact_area: Contact,
        /// Radius of the disc of the area of the contact that holds the axis; in plane strain half the
        /// contact width.
        contact_radius: Length,
        /// Force over contact area; 0 without contact.
        mean_pressure: Pressure,
        /// ∫F dh over the raw travel of the tool, which includes `contact_energy_uJ`.
        external_work: Energy,
        /// Stored elastic energy, residual stress included.
        elastic_energy: Energy,
        /// Work of plastic flow, Σ∫σ_y dε_p; never found by subtraction.
        plastic_work: Energy,
        /// Energy stored in the penalty, ½ε∫d² dA with the penetration d, less what it changed by so far as
        /// the contact was measured anew over the last converged surface, which is no work of the tool: an
        /// artefact of the method, no energy of the metal.
        contact_energy: Energy,
        /// Work that friction has taken; no column without friction.
        friction_work: Energy,
        /// Mean penetration, weighted by the pressure.
        penetration: Length,
        /// Newton iterations spent since the last row.
        newton_iterations: Plain,
        /// Sum of the nodal forces: the force with the ripple of the mesh, which the works are made of.
        force_nodal: Force,
        /// 95 % bound of the relative error of the force in this row; empty where there is no force or the
        /// bound is not known. While unloading it holds the error of the residual depth, by which the curve
        /// is shifted.
        force_error: Plain,
        /// 95 % bound of the relative error of the contact area in this row, likewise.
        area_error: Plain,
        /// Change of the elastic, plastic and contact energy by all transfers to better meshes so far, which
        /// is no work of the tool.
        transfer_energy: Energy,
    }
}

columns! {
    AsperityRow {
        /// Increment of the curve.
        increment: Plain,
        /// Loading or unloading.
        phase: Plain,
        /// Counted from 0, from the axis (left side) outward.
        asperity: Plain,
        /// As in the curve.
        depth: Length,
        /// Force on this asperity.
        force: Force,
        /// Its contact area.
        contact_area: Contact,
        /// Innermost (leftmost) point of its contact; `None` without contact.
        contact_left: Length,
        /// Outermost point of its contact; `None` without contact.
        contact_right: Length,
        /// Largest contact pressure on it.
        max_pressure: Pressure,
    }
}

columns! {
    GapRow {
        /// Increment of the curve.
        increment: Plain,
        /// Loading or unloading.
        phase: Plain,
        /// As in the curve.
        depth: Length,
        /// End of the contact before the gap.
        left: Length,
        /// Beginning of the contact after it.
        right: Length,
        /// Distance of the two.
        width: Length,
        /// Largest distance from the tool in between; from the lowest to the highest point of an enclosed
        /// gap.
        height: Length,
        /// True where flanks that press each other close it off from the tool.
        enclosed: Plain,
    }
}

columns! {
    CycleRow {
        /// 0: the first loading; then the reloads.
        cycle: Plain,
        /// Increment of the peak.
        peak_increment: Plain,
        /// Increment at which the tool is gone.
        end_increment: Plain,
        /// Depth at the peak.
        peak_depth: Length,
        /// Force at the peak.
        peak_force: Force,
        /// Initial summit minus the highest point of the body in equilibrium without the tool; of an indent,
        /// the depth at which the tool touches again.
        residual_depth: Length,
        /// ∫F dh on the way in, over the corrected depth.
        work_in: Energy,
        /// Work returned on the way out.
        work_out: Energy,
        /// The difference of the two.
        hysteresis: Energy,
        /// Plastic work of both ways.
        plastic_work: Energy,
    }
}

columns! {
    SurfacePoint {
        /// Current radius.
        r: Length,
        /// Current height over the initial summit.
        z: Length,
        /// Displacement along r.
        u_r: Length,
        /// Displacement along z.
        u_z: Length,
        /// Contact pressure, without the zigzag between corners and mid-side nodes.
        pressure: Pressure,
        /// Shear traction along the tool, positive where the tool pushes the surface towards the axis; no
        /// column without friction.
        shear_traction: Pressure,
        /// 1 where the surface sticks to the tool, 0 where it slips or does not touch; no column without
        /// friction.
        sticks: Bit,
        /// 1 where the material has yielded, else 0.
        yielded: Bit,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::results::columns::{Described, read_rows, write_rows};
    use asperity_simulation::record::rows::Phase;
    use asperity_simulation::scene::Symmetry;
    use serde::Serialize;

    fn row() -> CurveRow {
        CurveRow {
            increment: 3,
            phase: Phase::Unload,
            depth: 5.0 * 1e-6,
            force: 5.52,
            contact_area: 3e-10,
            contact_radius: 1e-5,
            mean_pressure: 1.84e10,
            external_work: 9.46e-6,
            elastic_energy: 1e-6 / 3.0,
            plastic_work: 8e-6,
            contact_energy: 5e-11,
            friction_work: None,
            penetration: 2e-8,
            compliance_depth: 0.0,
            newton_iterations: 6,
            force_nodal: 5.5,
            force_error: Some(0.01),
            area_error: Some(0.02),
            transfer_energy: -1e-12,
        }
    }

    fn text<T: Described + Serialize>(symmetry: Symmetry, row: T) -> String {
        let mut out = Vec::new();
        write_rows(&mut out, &[row], symmetry).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn the_curve_has_the_columns_and_units_of_the_contract() {
        let text = text(Symmetry::Axisymmetric, row());
        let (head, line) = text.trim_end().split_once('\n').unwrap();
        assert_eq!(
            head,
            "increment,phase,depth_um,force_N,contact_area_um2,contact_radius_um,mean_pressure_MPa,external_work_uJ,\
             elastic_energy_uJ,plastic_work_uJ,contact_energy_uJ,penetration_um,newton_iterations,force_nodal_N,force_error,area_error,transfer_energy_uJ"
        );
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[..4], ["3", "unload", "5.0", "5.52"]);
        assert_eq!(cells[10..], ["5e-5", "0.02", "6", "5.5", "0.01", "0.02", "-1e-6"]);
        for (k, value) in [(4, 300.0), (5, 10.0), (6, 18400.0), (7, 9.46), (8, 1.0 / 3.0)] {
            let got: f64 = cells[k].parse().unwrap();
            assert!((got / value - 1.0).abs() < 1e-15, "{k}: {got}");
        }
    }

    #[test]
    fn in_plane_strain_forces_and_energies_are_per_length() {
        let text = text(Symmetry::PlaneStrain, row());
        let (head, line) = text.trim_end().split_once('\n').unwrap();
        assert!(head.starts_with("increment,phase,depth_um,force_N_per_mm,contact_width_um,"));
        assert!(head.contains(",external_work_uJ_per_mm,"));
        let cells: Vec<f64> = line.split(',').skip(2).map(|c| c.parse().unwrap()).collect();
        // 5.52 N/m, and 9.46e-6 J/m = 9.46 µJ/m
        assert!((cells[1] - 5.52e-3).abs() < 1e-15 && (cells[5] - 9.46e-3).abs() < 1e-15);
    }

    #[test]
    fn rows_read_back_to_the_same_text_in_both_symmetries() {
        let dir = tempfile::tempdir().unwrap();
        for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
            let path = dir.path().join("curve.csv");
            let written = text(symmetry, row());
            std::fs::write(&path, &written).unwrap();
            assert_eq!(text(symmetry, read_rows::<CurveRow>(&path).unwrap()[0]), written);
            assert!(read_rows::<CycleRow>(&path).unwrap_err().to_string().contains("curve.csv"));
        }
    }

    #[test]
    fn an_asperity_out_of_contact_has_no_place() {
        let row = AsperityRow {
            increment: 1,
            phase: Phase::Reload,
            asperity: 2,
            depth: 1e-6,
            force: 0.0,
            contact_area: 0.0,
            contact_left: f64::NAN,
            contact_right: f64::NAN,
            max_pressure: 0.0,
        };
        assert_eq!(text(Symmetry::Axisymmetric, row).lines().nth(1).unwrap(), "1,load,2,1.0,0.0,0.0,,,0.0");
    }
}
