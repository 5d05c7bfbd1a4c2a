//! `curve.csv`, `asperities.csv`, `gaps.csv` and `cycles.csv`.

use super::{MEGAPASCAL, MICROMETRE, area_unit, energy_unit, force_unit};
use asperity_solver::run::record::{AsperityRow, CurveRow, CycleRow, GapRow, Phase};
use asperity_solver::scene::Symmetry;
use std::io::{self, Write};

/// Whether the tool goes down or up; `cycles.csv` says where a load is a reload.
fn phase_name(phase: Phase) -> &'static str {
    match phase {
        Phase::Load | Phase::Reload => "load",
        Phase::Unload => "unload",
    }
}

/// A number in its shortest digits that read back to the same value; empty where there is none.
pub(super) fn number(value: f64) -> String {
    if value.is_finite() { format!("{value:?}") } else { String::new() }
}

/// Writes the loading and unloading curve, one row per converged increment.
///
/// # Errors
/// A writer that fails.
pub fn write_curve(out: &mut dyn Write, symmetry: Symmetry, rows: &[CurveRow]) -> io::Result<()> {
    let (force, energy, area) = (force_unit(symmetry), energy_unit(symmetry), area_unit(symmetry));
    let (f, e, a) = (force.suffix, energy.suffix, area.suffix);
    writeln!(
        out,
        "increment,phase,depth_um,force_{f},{a},contact_radius_um,mean_pressure_MPa,external_work_{e},\
         elastic_energy_{e},plastic_work_{e},contact_energy_{e},penetration_um,newton_iterations"
    )?;
    for row in rows {
        let values = [
            row.depth / MICROMETRE,
            row.force / force.scale,
            row.contact_area / area.scale,
            row.contact_radius / MICROMETRE,
            row.mean_pressure / MEGAPASCAL,
            row.external_work / energy.scale,
            row.elastic_energy / energy.scale,
            row.plastic_work / energy.scale,
            row.contact_energy / energy.scale,
            row.penetration / MICROMETRE,
        ]
        .map(number);
        let (i, phase, n) = (row.increment, phase_name(row.phase), row.newton_iterations);
        writeln!(out, "{i},{phase},{},{n}", values.join(","))?;
    }
    Ok(())
}

/// Writes the share of each asperity in each increment; places are empty where there is no contact.
///
/// # Errors
/// A writer that fails.
pub fn write_asperities(out: &mut dyn Write, symmetry: Symmetry, rows: &[AsperityRow]) -> io::Result<()> {
    let (force, area) = (force_unit(symmetry), area_unit(symmetry));
    writeln!(
        out,
        "increment,phase,asperity,depth_um,force_{},{},contact_left_um,contact_right_um,max_pressure_MPa",
        force.suffix, area.suffix
    )?;
    for row in rows {
        let values = [
            row.depth / MICROMETRE,
            row.force / force.scale,
            row.contact_area / area.scale,
            row.contact_left / MICROMETRE,
            row.contact_right / MICROMETRE,
            row.max_pressure / MEGAPASCAL,
        ]
        .map(number);
        writeln!(out, "{},{},{},{}", row.increment, phase_name(row.phase), row.asperity, values.join(","))?;
    }
    Ok(())
}

/// Writes the untouched stretches of surface between contacts: where they are, how wide and how high.
///
/// # Errors
/// A writer that fails.
pub fn write_gaps(out: &mut dyn Write, rows: &[GapRow]) -> io::Result<()> {
    writeln!(out, "increment,phase,depth_um,left_um,right_um,width_um,height_um")?;
    for row in rows {
        let lengths = [row.depth, row.left, row.right, row.right - row.left, row.height];
        let lengths = lengths.map(|v| number(v / MICROMETRE));
        writeln!(out, "{},{},{}", row.increment, phase_name(row.phase), lengths.join(","))?;
    }
    Ok(())
}

/// Writes each loading with its unloading: the first one, then the reloads.
///
/// # Errors
/// A writer that fails.
pub fn write_cycles(out: &mut dyn Write, symmetry: Symmetry, rows: &[CycleRow]) -> io::Result<()> {
    let (force, energy) = (force_unit(symmetry), energy_unit(symmetry));
    let (f, e) = (force.suffix, energy.suffix);
    writeln!(
        out,
        "cycle,peak_increment,end_increment,peak_depth_um,peak_force_{f},residual_depth_um,work_in_{e},work_out_{e},\
         hysteresis_{e},plastic_work_{e}"
    )?;
    for row in rows {
        let values = [
            row.peak_depth / MICROMETRE,
            row.peak_force / force.scale,
            row.residual_depth / MICROMETRE,
            row.work_in / energy.scale,
            row.work_out / energy.scale,
            (row.work_in - row.work_out) / energy.scale,
            row.plastic_work / energy.scale,
        ]
        .map(number);
        writeln!(out, "{},{},{},{}", row.cycle, row.peak_increment, row.end_increment, values.join(","))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

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
            contact_energy: 0.0,
            penetration: 2e-8,
            newton_iterations: 6,
        }
    }

    fn text(symmetry: Symmetry) -> String {
        let mut out = Vec::new();
        write_curve(&mut out, symmetry, &[row()]).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn the_curve_has_the_columns_and_units_of_the_contract() {
        let text = text(Symmetry::Axisymmetric);
        let (head, line) = text.trim_end().split_once('\n').unwrap();
        assert_eq!(
            head,
            "increment,phase,depth_um,force_N,contact_area_um2,contact_radius_um,mean_pressure_MPa,external_work_uJ,\
             elastic_energy_uJ,plastic_work_uJ,contact_energy_uJ,penetration_um,newton_iterations"
        );
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells[..4], ["3", "unload", "5.0", "5.52"]);
        for (k, value) in [(4, 300.0), (5, 10.0), (6, 18400.0), (7, 9.46), (8, 1.0 / 3.0), (11, 0.02)] {
            let got: f64 = cells[k].parse().unwrap();
            assert!((got / value - 1.0).abs() < 1e-15, "{k}: {got}");
        }
        assert_eq!(cells[12], "6");
    }

    #[test]
    fn in_plane_strain_forces_and_energies_are_per_length() {
        let text = text(Symmetry::PlaneStrain);
        let (head, line) = text.trim_end().split_once('\n').unwrap();
        assert!(head.starts_with("increment,phase,depth_um,force_N_per_mm,contact_width_um,"));
        assert!(head.contains(",external_work_uJ_per_mm,"));
        let cells: Vec<f64> = line.split(',').skip(2).map(|c| c.parse().unwrap()).collect();
        // 5.52 N/m, and 9.46e-6 J/m = 9.46 µJ/m
        assert!((cells[1] - 5.52e-3).abs() < 1e-15 && (cells[5] - 9.46e-3).abs() < 1e-15);
    }

    #[test]
    fn an_asperity_out_of_contact_has_no_place() {
        let row = AsperityRow {
            increment: 1,
            phase: Phase::Load,
            asperity: 2,
            depth: 1e-6,
            force: 0.0,
            contact_area: 0.0,
            contact_left: f64::NAN,
            contact_right: f64::NAN,
            max_pressure: 0.0,
        };
        let mut out = Vec::new();
        write_asperities(&mut out, Symmetry::Axisymmetric, &[row]).unwrap();
        assert_eq!(String::from_utf8(out).unwrap().lines().nth(1).unwrap(), "1,load,2,1.0,0.0,0.0,,,0.0");
    }
}
