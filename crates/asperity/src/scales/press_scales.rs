//! The surface of a scene at all its scales.

use super::summary::Summary;
use super::table::{ScaleRow, SlopeRow};
use crate::error::{Error, InputError};
use crate::progress::Progress;
use crate::results::units::MICROMETRE;
use crate::rough::tables::SceneError;
use crate::rough::{RoughScene, SpectrumRow, half_space_of, scene_warnings};
use asperity_roughness::scales::{self as library, ScalesError, Task};
use asperity_roughness::{Closure, ClosureLaw};
use std::time::Instant;

/// The scales of a surface.
#[derive(Clone, Debug)]
pub struct Scales {
    /// A row a cut-off and closure: `scales.csv`.
    pub rows: Vec<ScaleRow>,
    /// A row a cut-off: `slopes.csv`.
    pub slopes: Vec<SlopeRow>,
    /// The power spectrum: `spectrum.csv`.
    pub spectrum: Vec<SpectrumRow>,
    /// Verdicts, fits and what was pressed: `summary.json`.
    pub summary: Summary,
    /// The same in SI.
    pub found: library::Scales,
}

/// Presses the surface of the first of `scenes` at every scale by its metal and load; the others are repeated
/// maps of it, which tell its noise.
///
/// `observer` is asked before each scale, whose cut-off (m) is its news; `false` ends the run.
///
/// # Errors
/// A scene that makes no sense, a surface that cannot be read or is flat, repeated maps of another size, a
/// load that touches nothing, a contact that is not found, a run that was ended.
pub fn scales(
    scenes: &[RoughScene],
    observer: &mut dyn FnMut(&Progress<'_, f64>) -> bool,
) -> Result<Scales, Error> {
    let start = Instant::now();
    let Some(scene) = scenes.first() else {
        return Err(InputError::new("no surface was given").help("give a scene or a map of heights").into());
    };
    scenes.iter().try_for_each(RoughScene::validate)?;
    let refused = |e: ScalesError| Error::from(scene.error(&SceneError::new(e.key(), e)));
    let load = scene.tables().load.load().map_err(|e| scene.error(&e))?;
    let surfaces = scenes.iter().map(RoughScene::prepare_surface).collect::<Result<Vec<_>, _>>()?;
    let task = task(scene)?;
    let tip = scene.tables().scales.tip_radius.map(|radius| radius.0);
    let trusted = library::trusted(&surfaces, tip).map_err(refused)?;
    let mut visit =
        |done: usize, all: usize, cutoff: f64| observer(&Progress::counted(done, all, Some(&cutoff)));
    let Some(found) = task.follow(&surfaces[0], load, &mut visit).map_err(refused)? else {
        let text = "stopped before the last scale: nothing was written; the same command begins anew";
        return Err(Error::Unfinished(text.into()));
    };
    let mut summary = Summary::new(&scene.surface_name(), &surfaces[0], scene.tables(), &found);
    summary.trusted_um = trusted.map(|cutoff| cutoff / MICROMETRE);
    summary.warnings = found.warnings(trusted);
    summary.warnings.extend(scene_warnings(&surfaces[0], scene.tables()));
    let of = |step: &library::Step| -> Vec<ScaleRow> {
        step.contacts.iter().map(|(by, numbers)| ScaleRow::new(step, *by, numbers)).collect()
    };
    summary.wall_s = start.elapsed().as_secs_f64();
    Ok(Scales {
        rows: found.steps.iter().flat_map(of).collect(),
        slopes: found.steps.iter().map(SlopeRow::new).collect(),
        spectrum: found.spectrum.iter().map(SpectrumRow::new).collect(),
        summary,
        found,
    })
}

/// The metal of `scene`, with every closure of islands that it allows.
fn task(scene: &RoughScene) -> Result<Task, InputError> {
    let tables = scene.tables();
    let islands: Vec<Closure> = Closure::ALL.into_iter().filter(|closure| !closure.is_half_space()).collect();
    let coefficient = scene.coefficient_of(&islands)?;
    let of = |closure: &Closure| ClosureLaw::new(*closure, &tables.material, coefficient.as_ref()).ok();
    Ok(Task {
        material: tables.material,
        law: scene.hardening_law()?,
        body: half_space_of(tables, None),
        closures: islands.iter().filter_map(of).collect(),
    })
}
