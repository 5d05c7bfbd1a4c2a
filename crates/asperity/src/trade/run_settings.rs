//! A trade from the scene to its rows and files.

use super::case::{self, Finished, Measured, TradeError};
use super::converged::Converged;
use super::overview::overview;
use super::picture;
use super::row::{TradeRow, rows};
use super::settings::{Knob, Setting, converged, settings};
use crate::batch::{self, Batch};
use crate::error::{Error, InputError};
use crate::progress::{Observer, Progress};
use crate::results::output::{Sink, SinkExt};
use asperity_simulation::scene::Scene;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// Runs one setting of a scene.
pub type Runner = dyn Fn(&Setting, &Scene) -> Result<Measured, TradeError> + Sync;

/// The way a trade is run.
pub struct Options<'a> {
    /// The number of settings that differ in everything at once.
    pub combinations: usize,
    /// A file that keeps every finished run; the same trade goes on from there.
    pub journal: Option<&'a Path>,
    /// Runs one setting; [`case::measure`] in this process, where the memory of a run is that of the process
    /// so far.
    pub runner: &'a Runner,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Options { combinations: 30, journal: None, runner: &case::measure }
    }
}

/// The result of a trade.
#[derive(Clone, Debug, PartialEq)]
pub struct Trade {
    /// One row per setting: `trade.csv`.
    pub rows: Vec<TradeRow>,
    /// Relative uncertainty of the converged force; absent where the scene fixes mesh and steps, so that
    /// nothing finer was run and whether it is converged is not known.
    pub converged_to: Option<f64>,
}

/// Runs `scene` at many settings and compares each with the converged values of the scene. Numbers that the
/// scene fixes are not varied.
///
/// Settings run side by side on rayon's threads. `observer` hears of every finished one; `false` starts no
/// further ones, and the result is what was reached.
///
/// # Errors
/// [`Error::Input`] for a scene with a mesh of its own or a journal that cannot be written,
/// [`Error::Unfinished`] where the converged values cannot be computed.
pub fn trade(
    scene: &Scene,
    options: &Options<'_>,
    observer: &mut Observer<'_, Knob>,
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

/// Runs the settings that the journal does not hold yet, the longest first; outcomes in the order of the
/// settings.
fn measure_all(
    scene: &Scene,
    options: &Options<'_>,
    observer: &mut Observer<'_, Knob>,
) -> Result<Vec<Finished>, Error> {
    let settings = [&converged(scene)[..], &settings(scene, options.combinations)].concat();
    let mut order: Vec<usize> = (0..settings.len()).collect();
    order.sort_by(|a, b| settings[*b].weight().total_cmp(&settings[*a].weight()));
    let weights = order.iter().scan(0.0, |sum, i| {
        *sum += settings[*i].weight();
        Some(*sum)
    });
    // share of the work of the first runs in their order
    let weights: Vec<f64> = std::iter::once(0.0).chain(weights).collect();
    // a process that died may do better the next time: it is in no journal
    let died: Mutex<Vec<(usize, Finished)>> = Mutex::default();
    let lock = || died.lock().unwrap_or_else(PoisonError::into_inner);
    let solve = |i: &usize, _: &dyn Fn() -> bool| {
        let outcome = (options.runner)(&settings[*i], scene);
        let lost = matches!(outcome, Err(TradeError::Process(_)));
        let finished = Finished { setting: settings[*i], outcome: outcome.map_err(|e| e.to_string()) };
        if lost {
            lock().push((*i, finished));
            return None;
        }
        Some(finished)
    };
    let batch = Batch {
        definition: &format!("{} {scene:?} {settings:?}", env!("CARGO_PKG_VERSION")),
        cases: &order,
        key: &|i: &usize| format!("{:?}", settings[*i]),
        solve: &solve,
        threads: 0,
        journal: options.journal,
    };
    let done = batch::run(&batch, &mut |reached: &Progress<'_, Finished>| {
        let share = weights[reached.done] / weights[settings.len()];
        observer(&Progress { share, ..reached.telling(reached.news.map(|row| &row.setting.knob)) })
    })?;
    let mut finished: Vec<(usize, Finished)> =
        done.rows.into_iter().map(|(k, row)| (order[k], row)).collect();
    finished.append(&mut lock());
    finished.sort_by_key(|(i, _)| *i);
    Ok(finished.into_iter().map(|(_, row)| row).collect())
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
