//! Several surfaces pressed one after the other: one table of all.

use super::summary::Summary;
use super::table::TableRow;
use crate::error::Error;
use crate::progress::Progress;
use crate::results::output::{Sink, SinkExt, row, write_csv};
use crate::rough::contact::{Rough, press};
use crate::rough::rough_scene::RoughScene;
use asperity_roughness::Closure;
use std::fmt::Write;

row! {
    /// A row of `surfaces.csv`: the parameters of one surface, or why it could not be pressed.
    SurfaceRow(name: &str, summary: Option<&Summary>, status: String) {
        /// Name of the surface, and of the folder of its own results.
        surface: String = name.into(),
        /// Points along x.
        pixels_x: Option<usize> = summary.map(|s| s.pixels[0]),
        /// Points along y.
        pixels_y: Option<usize> = summary.map(|s| s.pixels[1]),
        /// Distance of the points along x.
        pixel_size_x_um: Option<f64> = summary.map(|s| s.pixel_size_um[0]),
        /// Distance of the points along y.
        pixel_size_y_um: Option<f64> = summary.map(|s| s.pixel_size_um[1]),
        /// Points that were not measured.
        missing: Option<usize> = summary.map(|s| s.missing),
        /// Sa.
        sa_um: Option<f64> = summary.map(|s| s.sa_um),
        /// Sq.
        sq_um: Option<f64> = summary.map(|s| s.sq_um),
        /// Ssk.
        ssk: Option<f64> = summary.and_then(|s| s.ssk),
        /// Sku.
        sku: Option<f64> = summary.and_then(|s| s.sku),
        /// Sp.
        sp_um: Option<f64> = summary.map(|s| s.sp_um),
        /// Sv.
        sv_um: Option<f64> = summary.map(|s| s.sv_um),
        /// Sz.
        sz_um: Option<f64> = summary.map(|s| s.sz_um),
        /// Sdq.
        sdq: Option<f64> = summary.map(|s| s.sdq),
        /// Sdr.
        sdr: Option<f64> = summary.map(|s| s.sdr),
        /// Mean of |∇h|.
        mean_gradient: Option<f64> = summary.map(|s| s.mean_gradient),
        /// atan of it, degrees.
        beta_deg: Option<f64> = summary.map(|s| s.beta_deg),
        /// `ok`, or why there are no numbers.
        status: String = status,
    }
}

/// Several surfaces pressed.
#[derive(Clone, Debug, Default)]
pub struct Several {
    /// One row a surface: `surfaces.csv`.
    pub surfaces: Vec<SurfaceRow>,
    /// One row a surface and closure: `table.csv`.
    pub table: Vec<TableRow>,
}

/// Presses the surface of each of `scenes`; `take` gets each with its name and what was found, of which only
/// the tables are kept. A surface that cannot be pressed is a row with the reason.
///
/// `observer` is asked before each closure of each surface; `false` ends the run, which keeps the surfaces
/// that were done.
///
/// # Errors
/// Those of `take`.
pub fn press_several(
    scenes: &[RoughScene],
    observer: &mut dyn FnMut(usize, &Progress<'_, Closure>) -> bool,
    take: &mut dyn FnMut(&str, &Rough) -> Result<(), Error>,
) -> Result<Several, Error> {
    let mut done = Several::default();
    for (i, scene) in scenes.iter().enumerate() {
        let mut ended = false;
        let name = done.free_name(&scene.name());
        let found = press(scene, &mut |progress| {
            ended = ended || !observer(i, progress);
            !ended
        });
        if ended {
            break;
        }
        match found {
            Ok(rough) => {
                take(&name, &rough)?;
                done.surfaces.push(SurfaceRow::new(&name, Some(&rough.summary), "ok".into()));
                let named = |row: &TableRow| TableRow { surface: name.clone(), ..row.clone() };
                done.table.extend(rough.table.iter().map(named));
            }
            Err(e) => {
                let reason = e.to_string().replace(['\n', '\r'], " ");
                done.surfaces.push(SurfaceRow::new(&name, None, reason));
            }
        }
    }
    Ok(done)
}

impl Several {
    /// `name`, with a number where an earlier surface has it.
    fn free_name(&self, name: &str) -> String {
        let taken = |name: &str| self.surfaces.iter().any(|one| one.surface == name);
        let numbered = (2..).map(|k| format!("{name}-{k}"));
        std::iter::once(name.to_string()).chain(numbered).find(|name| !taken(name)).unwrap_or_default()
    }

    /// The surfaces that could not be pressed, with the reasons.
    pub fn failed(&self) -> impl Iterator<Item = (&str, &str)> {
        let failed = self.surfaces.iter().filter(|one| one.status != "ok");
        failed.map(|one| (one.surface.as_str(), one.status.as_str()))
    }

    /// Writes `table.csv` and `surfaces.csv`.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.csv("table.csv", &self.table)?;
        sink.write("surfaces.csv", |out| write_csv(out, &self.surfaces))
    }

    /// Both tables as JSON.
    ///
    /// # Errors
    /// None that is known: every row is JSON.
    pub fn json(&self) -> Result<String, Error> {
        crate::results::output::json(&serde_json::json!({ "surfaces": self.surfaces, "table": self.table }))
    }

    /// The table for a person.
    pub fn text(&self) -> String {
        let mut text = format!(
            "{:<20} {:<18} {:>8} {:>9} {:>14} {:>7}\n",
            "surface", "closure", "A/A0 %", "P_m MPa", "separation um", "A/A_hs"
        );
        let shown = |v: Option<f64>, digits: usize| {
            v.filter(|v| v.is_finite()).map_or_else(|| "-".into(), |v| format!("{v:.digits$}"))
        };
        for row in &self.table {
            let _ = writeln!(
                text,
                "{:<20} {:<18} {:>8} {:>9} {:>14} {:>7}",
                row.surface,
                row.closure.name(),
                shown(Some(100.0 * row.best_area_ratio()), 3),
                shown(row.best_mean_pressure_mpa(), 1),
                shown(Some(row.separation_um), 4),
                shown(row.area_over_half_space, 3),
            );
        }
        for (name, reason) in self.failed() {
            let _ = writeln!(text, "{name}: {reason}");
        }
        text
    }
}
