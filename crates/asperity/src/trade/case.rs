//! One run of a trade.

use super::settings::Setting;
use crate::crush::peak_memory;
use crate::results::output::row;
use asperity_simulation::record::curve::Curve;
use asperity_simulation::record::rows::Phase;
use asperity_simulation::run::{Outcome, Run};
use asperity_simulation::scene::Scene;
use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::time::Instant;

row! {
    /// The results of a run, SI units.
    Measured(outcome: &Outcome, wall_s: f64, core_s: f64) {
        /// Depth, force and contact area of each increment of loading.
        loading: Vec<[f64; 3]> = outcome
            .rows
            .iter()
            .filter(|row| row.phase == Phase::Load)
            .map(|row| [row.depth, row.force, row.contact_area])
            .collect(),
        /// Depth that remains without the tool, m.
        residual_depth: Option<f64> = outcome.summary.residual_depth,
        /// Share of the work that is recovered.
        elastic_fraction: Option<f64> = outcome.summary.elastic_fraction,
        /// The error that the run states itself.
        estimated_error: Option<f64> = Some(outcome.summary.estimated_error).filter(|e| e.is_finite()),
        /// Newton iterations, failed ones included.
        newton_iterations: usize = outcome.summary.newton_iterations,
        /// Unknowns.
        dofs: usize = outcome.summary.dofs,
        /// Seconds on the clock.
        wall_s: f64 = wall_s,
        /// Seconds of the core.
        core_s: f64 = core_s,
        /// Largest resident memory of the process, MB of 10⁶ bytes; absent where the system does not say.
        peak_memory_mb: Option<f64> = peak_memory().map(|bytes| bytes / 1e6),
    }
}

impl Measured {
    /// Force over depth while loading.
    pub fn force(&self) -> Curve {
        Curve::new(self.loading.iter().map(|[h, f, _]| [*h, *f]))
    }

    /// Contact area over depth while loading.
    pub fn area(&self) -> Curve {
        Curve::new(self.loading.iter().map(|[h, _, a]| [*h, *a]))
    }
}

/// A setting and its results, or why it has none.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finished {
    /// The setting.
    pub setting: Setting,
    /// Its results.
    pub outcome: Result<Measured, String>,
}

/// The reason why a setting has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TradeError {
    /// The run stopped, and would again.
    #[error("{0}")]
    Run(String),
    /// The process of the run failed; another one may do better.
    #[error("the process of the run failed: {0}")]
    Process(String),
}

/// Runs `setting` of `scene` in this process.
///
/// # Errors
/// A run that stopped.
pub fn measure(setting: &Setting, scene: &Scene) -> Result<Measured, TradeError> {
    solve(&setting.scene(scene)).map_err(TradeError::Run)
}

/// Runs `scene` as it is.
///
/// # Errors
/// The place where the run stopped, and the reason.
pub fn solve(scene: &Scene) -> Result<Measured, String> {
    let (clock, core) = (Instant::now(), ThreadTime::now());
    let outcome = Run::new(scene).run(&mut |_| ControlFlow::Continue(())).map_err(|e| e.to_string())?;
    let (core_s, wall_s) = (core.elapsed().as_secs_f64(), clock.elapsed().as_secs_f64());
    if let Some(stopped) = &outcome.stopped {
        return Err(format!("stopped at {:.4} um: {}", stopped.depth * 1e6, stopped.reason));
    }
    Ok(Measured::new(&outcome, wall_s, core_s))
}
