//! A trade from the scene to its rows and files.

use super::case::{self, Failed, Finished, Measured};
use super::converged::Converged;
use super::overview::overview;
use super::picture;
use super::row::{TradeRow, rows};
use super::settings::{Knob, Setting, converged, settings};
use crate::error::{Error, InputError};
use crate::output::{Sink, SinkExt, open_journal};
use asperity_calibration::journal::Journal;
use asperity_solver::scene::Scene;
use rayon::prelude::*;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Runs one setting of a scene.
pub type Runner = dyn Fn(&Setting, &Scene) -> Result<Measured, Failed> + Sync;

/// How a trade is run.
pub struct Options<'a> {
    /// How many settings differ in everything at once.
    pub combinations: usize,
    /// A file that keeps every finished run; the same trade goes on from there.
    pub journal: Option<&'a Path>,
    /// Runs one setting; [`case::measure`] in this process, where the memory of a run is that of the process so far.
    pub runner: &'a Runner,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options { combinations: 30, journal: None, runner: &case::measure }
    }
}

/// How far a trade has come.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Share of the work that is done, 0 to 1.
    pub share: f64,
    /// Settings with an outcome.
    pub finished: usize,
    /// The knob of the last one; absent at the start, when all that is finished is from the journal.
    pub knob: Option<Knob>,
}

/// The result of a trade.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// One row per setting: `trade.csv`.
    pub rows: Vec<TradeRow>,
    /// Relative uncertainty of the converged force; absent where the scene fixes mesh and steps, so that nothing finer was
    /// run and whether it is converged is not known.
    pub converged_to: Option<f64>,
}

/// Runs `scene` at many settings and compares each with the converged values of the scene. Numbers that the scene fixes
/// are not varied.
///
/// Settings run side by side on rayon's threads. `observer` hears of every finished one; `false` starts no further ones,
/// and the result is what was reached.
///
/// # Errors
/// [`Error::Input`] for a scene with a mesh of its own or a journal that cannot be written, [`Error::Unfinished`] where the
/// converged values cannot be computed.
pub fn trade(
    scene: &Scene,
    options: &Options<'_>,
    observer: &mut (dyn FnMut(&Progress) -> bool + Send),
) -> Result<Trade, Error> {
    if scene.mesh.is_some() {
        return Err(InputError::new("a trade varies the mesh: leave [mesh] out").into());
    }
    let finished = measure_all(scene, options, observer)?;
    let finer: Vec<&Finished> = finished.iter().filter(|f| f.setting.knob == Knob::Converged).collect();
    let [a, b] = finer[..] else {
        return Err(Error::Unfinished("the converged value was not computed".into()));
    };
    let run = |f: &'_ Finished| {
        f.outcome
            .clone()
            .map_err(|reason| Error::Unfinished(format!("the converged value cannot be computed: {reason}")))
    };
    let converged = Converged::new([&run(a)?, &run(b)?]);
    let finer_differ = a.setting.numerics != b.setting.numerics;
    Ok(Trade { rows: rows(&finished, &converged), converged_to: finer_differ.then_some(converged.doubt) })
}

/// The state that the threads of a trade share.
struct Shared<'a> {
    journal: Option<Journal>,
    observer: &'a mut (dyn FnMut(&Progress) -> bool + Send),
    weight: f64,
    finished: usize,
    stopped: bool,
}

/// Runs the settings that the journal does not hold yet, the longest first; outcomes in the order of the settings.
fn measure_all(
    scene: &Scene,
    options: &Options<'_>,
    observer: &mut (dyn FnMut(&Progress) -> bool + Send),
) -> Result<Vec<Finished>, Error> {
    let mut settings = [&converged(scene)[..], &settings(scene, options.combinations)].concat();
    let definition = format!("{} {scene:?} {settings:?}", env!("CARGO_PKG_VERSION"));
    let (journal, lines) = open_journal(options.journal, &definition)?;
    let mut finished: Vec<Finished> =
        lines.iter().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let mut open: Vec<&Setting> =
        settings.iter().filter(|s| !finished.iter().any(|f| f.setting == **s)).collect();
    open.sort_by(|a, b| b.weight().total_cmp(&a.weight()));
    let whole: f64 = settings.iter().map(Setting::weight).sum();
    let weight = whole - open.iter().map(|s| s.weight()).sum::<f64>();
    let stopped = !observer(&Progress { share: weight / whole, finished: finished.len(), knob: None });
    let shared = Mutex::new(Shared { journal, observer, weight, finished: finished.len(), stopped });
    let lock = || shared.lock().unwrap_or_else(PoisonError::into_inner);
    // a bridge hands the cases out in their order, which keeps the longest first
    let new: Result<Vec<Option<Finished>>, Error> = open
        .into_iter()
        .par_bridge()
        .map(|setting| {
            if lock().stopped {
                return Ok(None);
            }
            let outcome = (options.runner)(setting, scene);
            let mut shared = lock();
            // a process that died may do better the next time
            let kept = !matches!(outcome, Err(Failed::Process(_)));
            let finished = Finished { setting: *setting, outcome: outcome.map_err(|e| e.to_string()) };
            if let (Some(journal), true) = (&mut shared.journal, kept) {
                let line = serde_json::to_string(&finished).map_err(std::io::Error::from);
                line.and_then(|line| journal.append(&line)).map_err(|e| disk(options.journal, &e))?;
            }
            shared.weight += setting.weight();
            shared.finished += 1;
            let progress = Progress {
                share: shared.weight / whole,
                finished: shared.finished,
                knob: Some(setting.knob),
            };
            let go_on = (shared.observer)(&progress);
            shared.stopped |= !go_on;
            Ok(Some(finished))
        })
        .collect();
    finished.extend(new?.into_iter().flatten());
    settings.retain(|s| finished.iter().any(|f| f.setting == *s));
    Ok(settings.iter().filter_map(|s| finished.iter().find(|f| f.setting == *s).cloned()).collect())
}

fn disk(journal: Option<&Path>, error: &std::io::Error) -> Error {
    let name = journal.map_or_else(String::new, |path| format!(" {}", path.display()));
    Error::Unfinished(format!(
        "cannot write the journal{name}: {error}; finished runs are cached there, and the same command resumes"
    ))
}

impl Trade {
    /// Writes `trade.csv`, `trade.svg` and `trade.md`.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        let picture = picture::draw(&self.rows).map_err(Error::Unfinished)?;
        sink.csv("trade.csv", &self.rows)?;
        sink.text("trade.svg", &picture)?;
        sink.write("trade.md", |out| writeln!(out, "{}", overview(&self.rows)))
    }

    /// The levels and the Pareto front as a table for a person, and how well the converged force is known.
    pub fn text(&self) -> String {
        let known = self.converged_to.map_or_else(
            || "that of the scene's own mesh and steps: whether it is converged is not known".to_string(),
            |doubt| format!("known to {:.3} %", 100.0 * doubt),
        );
        let failed = self.rows.iter().filter(|row| row.core_s.is_none()).count();
        format!(
            "{}\n\n{} settings, {failed} without a result; the converged force is {known}",
            overview(&self.rows),
            self.rows.len(),
        )
    }
}
