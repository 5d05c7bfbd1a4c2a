//! `asperity rough --table1`: the paper's Table 1 beside ours, with the contradictions named.

use super::run;
use crate::cli::flags::RunFlags;
use crate::cli::folder::Folder;
use crate::cli::terminal;
use crate::error::{Error, InputError};
use crate::output::SinkExt;
use asperity_law::units::{Length, Stress};
use asperity_roughness::scene::{Choice, GenerateScene, LoadScene, Material, Output, Scene, SurfaceScene};
use asperity_roughness::{Coefficient, KindName, PUBLISHED, Profile};
use serde::Serialize;
use std::fmt::Write;

/// A row of the paper's Table 1.
#[derive(Serialize)]
pub struct Printed {
    /// The surface.
    #[serde(skip)]
    pub kind: KindName,
    /// Ra, µm.
    pub ra: f64,
    /// β, degrees.
    pub beta: f64,
    /// P_m, MPa.
    pub pressure: f64,
    /// A_r, %.
    pub area: f64,
    /// ψ.
    pub index: f64,
    /// Largest over nominal pressure, as the text says.
    pub peak: &'static str,
}

/// Table 1 as printed.
pub const TABLE: [Printed; 3] = [
    Printed {
        kind: KindName::Ground,
        ra: 0.23,
        beta: 1.57,
        pressure: 719.0,
        area: 13.74,
        index: 0.52,
        peak: "8",
    },
    Printed {
        kind: KindName::Milled,
        ra: 2.95,
        beta: 4.08,
        pressure: 3830.0,
        area: 5.35,
        index: 1.37,
        peak: "60-80",
    },
    Printed {
        kind: KindName::Sanded,
        ra: 5.27,
        beta: 11.38,
        pressure: 75683.0,
        area: 2.23,
        index: 3.87,
        peak: "60-80",
    },
];
const NOMINAL: f64 = 200.0;
const SEEDS: u64 = 5;
const HARDNESS: f64 = 1280.0;
const MODULUS: f64 = 210e3;
const POISSON: f64 = 0.3;
/// σ_y for the closures that need it: eq. [20], H = 3 σ_y.
const YIELD: f64 = HARDNESS / 3.0;

fn scene(row: &Printed, seed: u64) -> Scene {
    Scene {
        closure: Choice::All,
        coefficient: None,
        pressure_profile: Profile::Hertz,
        surface: SurfaceScene {
            file: None,
            generate: Some(GenerateScene {
                kind: row.kind,
                ra: Some(Length(row.ra * 1e-6)),
                mean_slope_deg: Some(row.beta),
                size: [Length(2e-3), Length(2e-3)],
                pixels: [1024, 1024],
                seed,
                hurst: None,
                rolloff: None,
                cutoff: None,
            }),
            pixel_size: None,
            height_unit: None,
            override_file: false,
            level: None,
            missing: Default::default(),
            s_filter: None,
            l_filter: None,
            periodic: false,
        },
        material: Material {
            youngs_modulus: Stress(MODULUS * 1e6),
            poissons_ratio: POISSON,
            hardness: Some(Stress(HARDNESS * 1e6)),
            yield_stress: Some(Stress(YIELD * 1e6)),
            hardening_exponent: Some(0.3),
            hardening_law: None,
        },
        load: LoadScene { pressure: Some(Stress(NOMINAL * 1e6)), separation: None, unload: true },
        output: Output { maps: false, surface: None },
    }
}

/// Values of one quantity over the seeds.
#[derive(Default, Serialize)]
pub struct Spread(Vec<f64>);

impl Spread {
    fn mean(&self) -> f64 {
        self.0.iter().sum::<f64>() / self.0.len() as f64
    }

    fn deviation(&self) -> f64 {
        let mean = self.mean();
        let sum: f64 = self.0.iter().map(|v| (v - mean).powi(2)).sum();
        (sum / (self.0.len().max(2) - 1) as f64).sqrt()
    }

    fn text(&self, digits: usize) -> String {
        if self.0.is_empty() {
            return "-".into();
        }
        format!("{:.digits$} ± {:.digits$}", self.mean(), self.deviation())
    }
}

/// What a closure says of one kind of surface.
#[derive(Default, Serialize)]
pub struct Ours {
    closure: &'static str,
    pressure: Spread,
    area: Spread,
    index: Spread,
    peak: Spread,
    residual: Spread,
    elastic: Spread,
}

/// One row of the paper's table beside ours.
#[derive(Serialize)]
pub struct Measured {
    surface: &'static str,
    /// The row as printed.
    paper: &'static Printed,
    /// Every closure, one value per seed.
    closures: Vec<Ours>,
    /// What a reader should know.
    notes: Vec<String>,
    /// The numbers of the row that contradict each other.
    against_itself: String,
}

/// Every closure on the surfaces of one row.
///
/// # Errors
/// A calibration that cannot be read, or a surface that cannot be made or pressed.
pub fn measure(row: &'static Printed) -> Result<Measured, Error> {
    let mut table: Vec<Ours> = Vec::new();
    let mut notes = Vec::new();
    let calibration = Coefficient::committed()
        .map_err(|e| InputError::new(format!("the calibration of this program: {e}")))?;
    for seed in 1..=SEEDS {
        let scene = scene(row, seed);
        let prepared =
            scene.surface.prepare(|path| path.to_path_buf()).map_err(|e| InputError::new(e.to_string()))?;
        let (pressed, warnings) = run::press_all(&scene, &prepared, Some(&calibration))
            .map_err(|(_, message)| InputError::new(message))?;
        if seed == 1 {
            notes = warnings
                .into_iter()
                .map(|warning| format!("{}, seed 1: {warning}", run::kind_name(row.kind)))
                .collect();
        }
        for one in &pressed {
            let closure = one.model.closure.name();
            let at = table.iter().position(|o| o.closure == closure).unwrap_or_else(|| {
                table.push(Ours { closure, ..Ours::default() });
                table.len() - 1
            });
            let ours = &mut table[at];
            ours.pressure.0.extend(one.contact.mean_pressure().map(|p| p * 1e-6));
            ours.area.0.push(100.0 * one.contact.area_ratio);
            ours.index.0.extend(one.plasticity_index);
            ours.peak.0.extend(one.peak_ratio());
            if let Some(unloading) = &one.unloading {
                ours.residual.0.push(unloading.residual_displacement * 1e6);
                ours.elastic.0.extend(unloading.elastic_share_by_law.map(|e| 100.0 * e));
            }
        }
    }
    Ok(Measured {
        surface: run::kind_name(row.kind),
        paper: row,
        closures: table,
        notes,
        against_itself: contradictions(row),
    })
}

/// The numbers of one row of the paper that contradict each other, from its own equations.
fn contradictions(row: &Printed) -> String {
    let tan = row.beta.to_radians().tan();
    let modulus = MODULUS / (1.0 - POISSON * POISSON);
    let eq11 = PUBLISHED * modulus * tan;
    let index = eq11 / HARDNESS;
    let balance = NOMINAL / (row.area / 100.0);
    let mut text = format!(
        "the paper against itself: P_m A_r = {:.1} MPa instead of {NOMINAL} (P_m = {balance:.0} MPa would balance the load); \
         eq. 13 gives psi = {index:.3}, printed {} ({:.2} times less); eq. 11 gives {eq11:.0} MPa, psi H = {:.0} MPa, printed {} MPa",
        row.pressure * row.area / 100.0,
        row.index,
        index / row.index,
        row.index * HARDNESS,
        row.pressure,
    );
    if row.pressure > 20000.0 {
        let _ = write!(
            text,
            "; {0} looks like {1:.1} with its decimal point lost ({1:.1} A_r = {2:.1} MPa)",
            row.pressure,
            row.pressure / 10.0,
            row.pressure * row.area / 1000.0
        );
    }
    text
}

/// Prints the tables; with `--out` they are left there as `table1.txt` and `table1.json` too.
///
/// # Errors
/// What [`measure`] says, or a folder that cannot be written.
pub fn run(flags: &RunFlags) -> Result<(), Error> {
    let rows = TABLE.iter().map(measure).collect::<Result<Vec<Measured>, Error>>()?;
    let text = text(&rows);
    let json = serde_json::to_string_pretty(&rows).map_err(|e| Error::Unfinished(e.to_string()))?;
    if let Some(out) = &flags.out {
        let mut folder = Folder::create(out, "rough", flags.force)?;
        folder.write("table1.txt", |out| out.write_all(text.as_bytes()))?;
        folder.write("table1.json", |out| out.write_all(json.as_bytes()))?;
        folder.publish()?;
    }
    if flags.json {
        terminal::say(&json);
    } else if !flags.quiet {
        terminal::say(text.trim_end());
    }
    Ok(())
}

/// The tables for a reader.
fn text(rows: &[Measured]) -> String {
    let mut text = format!(
        "Table 1: steel E = {MODULUS} MPa, nu = {POISSON}, H = {HARDNESS} MPa under {NOMINAL} MPa; ours: {SEEDS} seeds, 1024 x 1024 points of \
         1.953 um, mean ± standard deviation\n"
    );
    for row in rows {
        let paper = row.paper;
        let _ = writeln!(text, "\n{}: Ra {} um, beta {} deg", row.surface, paper.ra, paper.beta);
        let _ = writeln!(
            text,
            "  {:<11} {:>18} {:>16} {:>7} {:>15} {:>16} {:>14}",
            "", "P_m MPa", "A_r %", "psi", "peak/nominal", "residual um", "returned %"
        );
        let _ = writeln!(
            text,
            "  {:<11} {:>18} {:>16} {:>7} {:>15} {:>16} {:>14}",
            "paper", paper.pressure, paper.area, paper.index, paper.peak, "", ""
        );
        for o in &row.closures {
            let _ = writeln!(
                text,
                "  {:<11} {:>18} {:>16} {:>7.3} {:>15} {:>16} {:>14}",
                o.closure,
                o.pressure.text(0),
                o.area.text(2),
                o.index.mean(),
                o.peak.text(1),
                o.residual.text(2),
                o.elastic.text(1)
            );
        }
        let _ = writeln!(text, "  {}", row.against_itself);
    }
    text += &trends(rows);
    for note in rows.iter().flat_map(|row| &row.notes) {
        let _ = writeln!(text, "note: {note}");
    }
    text
}

/// Whether A_r falls and P_m rises with the slope, per closure.
fn trends(rows: &[Measured]) -> String {
    let mut text = String::from("\ntrend from ground to sanded (the paper: A_r falls, P_m rises):\n");
    for o in rows.first().map_or(&[][..], |row| &row.closures) {
        let column = |of: fn(&Ours) -> f64| -> Vec<f64> {
            rows.iter()
                .filter_map(|row| row.closures.iter().find(|x| x.closure == o.closure).map(of))
                .collect()
        };
        let (area, pressure) = (column(|x| x.area.mean()), column(|x| x.pressure.mean()));
        let holds =
            |v: &[f64], sign: f64| v.len() == rows.len() && v.windows(2).all(|w| sign * (w[1] - w[0]) > 0.0);
        let say = |ok: bool| if ok { "holds" } else { "does not hold" };
        let _ = writeln!(
            text,
            "  {:<11} A_r falls: {}; P_m rises: {}",
            o.closure,
            say(holds(&area, -1.0)),
            say(holds(&pressure, 1.0))
        );
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_contradictions_of_the_paper_are_named_with_their_numbers() {
        let texts: Vec<String> = TABLE.iter().map(contradictions).collect();
        for (text, words) in texts.iter().zip([
            ["98.8", "0.642", "1456"],
            ["204.9", "1.672", "3738"],
            ["1687.7", "4.717", "7568.3"],
        ]) {
            assert!(words.iter().all(|w| text.contains(w)), "{text}");
        }
    }
}
