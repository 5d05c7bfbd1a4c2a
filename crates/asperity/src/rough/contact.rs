//! A rough surface pressed by every closure that its scene asks for.

use super::summary::{ClosureSummary, Summary};
use super::table::{LoadPoint, TableRow};
use super::warnings;
use crate::error::Error;
use crate::progress::Progress;
use crate::rough::closure_contact::{Body, ClosureContact};
use crate::rough::half_space_contacts::{HalfSpaceContacts, compare_with_half_space};
use crate::rough::press_closure::press_by;
use crate::rough::rough_scene::RoughScene;
use asperity_roughness::scene::SceneError;
use asperity_roughness::{Closure, Surface, read_as};
use std::fmt::Write;
use std::time::Instant;

/// Points of a map up to which closures are judged and a spectrum is written unless the scene says otherwise.
pub(super) const MODEST_MAP_POINTS: usize = 1024 * 1024;

/// A rough surface pressed by every closure that its scene asks for.
#[derive(Debug)]
pub struct Rough {
    /// One row per closure: `table.csv`.
    pub table: Vec<TableRow>,
    /// From first touch to the load and back: `load_curve.csv`.
    pub load_curve: Vec<LoadPoint>,
    /// The surface and every closure: `summary.json`.
    pub summary: Summary,
    /// The surface as pressed, levelled and filtered.
    pub surface: Surface,
    /// The contacts with their islands and pressures, one per row of the table.
    pub contacts: Vec<ClosureContact>,
    /// True where the observer ended the run before all closures were done and compared.
    pub stopped: bool,
}

/// Presses a rigid plane on the surface of `scene` by every closure that it asks for.
///
/// `observer` is asked before each closure, which is its news, and before they are compared with the
/// half-space; `false` ends the run, which keeps the closures that were done.
///
/// # Errors
/// A scene that makes no sense, a surface that cannot be read, a closure without its material or its
/// calibration, a load that the surface cannot carry. Of a scene with several closures those that cannot be
/// used are warnings.
pub fn press(
    scene: &RoughScene,
    observer: &mut dyn FnMut(&Progress<'_, Closure>) -> bool,
) -> Result<Rough, Error> {
    let start = Instant::now();
    scene.validate()?;
    let coefficient = scene.coefficient()?;
    let tables = scene.tables();
    let surface = scene.prepare_surface()?;
    let name = scene.surface_name();
    let mut summary = Summary::new(&name, &surface, tables);
    let mut contacts = Vec::new();
    let mut spaces = HalfSpaceContacts::default();
    let closures = tables.closure.closures();
    let mut stopped = false;
    for (i, &closure) in closures.iter().enumerate() {
        stopped = !observer(&Progress::counted(i, closures.len(), Some(&closure)));
        if stopped {
            summary.warnings.push(warnings::stopped_before(closure));
            break;
        }
        let (contact, remarks) = press_by(closure, scene, &surface, coefficient.as_ref(), &mut spaces)?;
        summary.warnings.extend(remarks);
        contacts.extend(contact);
    }
    let judged = tables.judge.unwrap_or(surface.map.heights().len() <= MODEST_MAP_POINTS);
    stopped = stopped || judged && !observer(&Progress::counted(closures.len(), closures.len(), None));
    if judged && !stopped {
        compare_with_half_space(&mut contacts, scene, &surface, &mut spaces);
    }
    if contacts.is_empty() && !stopped && summary.warnings.iter().all(|w| warnings::is_skipped(w)) {
        let message = "no closure can be used with this material: add hardness or yield_stress";
        return Err(scene.error(&SceneError::new("closure", message)).into());
    }
    summary.warnings.extend(warnings::scene_warnings(&surface, tables));
    let table: Vec<TableRow> = contacts.iter().map(|one| TableRow::new(&name, &surface, one)).collect();
    summary.closures =
        table.iter().zip(&contacts).map(|(row, one)| ClosureSummary::new(row.clone(), one)).collect();
    let load_curve = contacts.iter().flat_map(LoadPoint::curve).collect();
    summary.wall_s = start.elapsed().as_secs_f64();
    let mut rough = Rough { table, load_curve, summary, surface, contacts, stopped };
    rough.summary.verdict = rough.verdict();
    Ok(rough)
}

impl Rough {
    /// The contact by one closure; `None` where the scene does not ask for it or it could not be used.
    pub fn contact(&self, closure: Closure) -> Option<&ClosureContact> {
        self.contacts.iter().find(|one| one.closure == closure)
    }

    /// Distance of plane and surface at each node, m, row by row: 0 in contact, NaN where nothing was
    /// measured or the closure has no contact. On a half-space the surface is the deformed one; closures with
    /// islands move no metal beside them, so there it is the surface before it was pressed.
    pub fn gap(&self, one: &ClosureContact) -> Vec<f64> {
        let heights = self.surface.map.heights();
        match &one.body {
            Body::Islands(islands) => {
                let plane = self.surface.parameters.mean + islands.contact.separation;
                // a maximum that lets a missing height through
                heights.iter().map(|z| if plane - z < 0.0 { 0.0 } else { plane - z }).collect()
            }
            Body::HalfSpace(space) => space.contact.gaps.iter().map(|gap| f64::from(*gap)).collect(),
            Body::Failed(_) => vec![f64::NAN; heights.len()],
        }
    }

    /// The text of summary.json.
    ///
    /// # Errors
    /// None that is known: every summary is JSON.
    pub fn json(&self) -> Result<String, Error> {
        crate::results::output::sorted_json(&self.summary)
    }

    /// The table for a person.
    pub fn text(&self) -> String {
        let s = &self.summary;
        let ([nx, ny], [dx, dy]) = (s.pixels, s.pixel_size_um);
        let mut text = read_as(&s.understood);
        // lengths far below a micrometre keep their digits
        let um = |v: f64| if v != 0.0 && v.abs() < 1e-3 { format!("{v:.3e}") } else { format!("{v:.4}") };
        let _ = writeln!(
            text,
            "{}: {nx} x {ny} points of {} x {} um, {} missing{}; Sa {} um, Sq {} um, Sdq {:.4}, beta {:.3} deg (mean |grad h|)",
            s.surface,
            um(dx),
            um(dy),
            s.missing,
            if s.outliers > 0 { format!(", {} outliers", s.outliers) } else { String::new() },
            um(s.sa_um),
            um(s.sq_um),
            s.sdq,
            s.beta_deg,
        );
        text += "closure              A/A0 %   P_m MPa     psi  peak/nom  separation um  asperities  residual um  elastic energy  A/A_hs\n";
        let shown = |v: Option<f64>, digits: usize| {
            v.filter(|v| v.is_finite()).map_or_else(|| "-".into(), |v| format!("{v:.digits$}"))
        };
        for row in &self.table {
            let _ = writeln!(
                text,
                "{:<18} {:>8} {:>9} {:>7} {:>9} {:>14} {:>11} {:>12} {:>15} {:>7}",
                row.closure.name(),
                shown(Some(100.0 * row.best_area_ratio()), 3),
                shown(row.best_mean_pressure_mpa(), 1),
                shown(row.plasticity_index, 3),
                shown(row.max_pressure_over_nominal, 2),
                shown(Some(row.separation_um), 4),
                row.asperities.map_or_else(|| "-".into(), |n| n.to_string()),
                shown(row.residual_displacement_um, 4),
                shown(row.elastic_energy_share, 3),
                shown(row.area_over_half_space, 3),
            );
        }
        if let Some(verdict) = self.verdict() {
            text += &verdict;
            text.push('\n');
        }
        text
    }
}
