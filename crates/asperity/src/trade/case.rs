//! One run of a trade.

use super::settings::Setting;
use crate::crush::peak_memory_mb;
use asperity_solver::run::crush::run;
use asperity_solver::run::curve::Curve;
use asperity_solver::run::record::Phase;
use asperity_solver::scene::Scene;
use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use std::time::Instant;

/// The results of a run, SI units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Depth, force and contact area of each increment of loading.
    pub loading: Vec<[f64; 3]>,
    /// Depth that remains without the tool, m.
    pub residual_depth: Option<f64>,
    /// Share of the work that came back.
    pub elastic_fraction: Option<f64>,
    /// The error that the run states itself.
    pub estimated_error: Option<f64>,
    /// Newton iterations, failed ones included.
    pub newton_iterations: usize,
    /// Unknowns.
    pub dofs: usize,
    /// Seconds on the clock.
    pub wall_s: f64,
    /// Seconds of the core.
    pub core_s: f64,
    /// Largest resident memory of the process, MB of 10⁶ bytes; absent where the system does not say.
    pub peak_memory_mb: Option<f64>,
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

/// Why a setting has no result.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Failed {
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
pub fn measure(setting: &Setting, scene: &Scene) -> Result<Measured, Failed> {
    solve(&setting.scene(scene)).map_err(Failed::Run)
}

/// Runs `scene` as it is.
///
/// # Errors
/// Where and why the run stopped.
pub fn solve(scene: &Scene) -> Result<Measured, String> {
    let (clock, core) = (Instant::now(), ThreadTime::now());
    let outcome = run(scene, None, &mut |_| ControlFlow::Continue(())).map_err(|e| e.to_string())?;
    let (core_s, wall_s) = (core.elapsed().as_secs_f64(), clock.elapsed().as_secs_f64());
    if let Some(stopped) = &outcome.stopped {
        return Err(format!("stopped at {:.4} um: {}", stopped.depth * 1e6, stopped.reason));
    }
    let summary = &outcome.summary;
    let loading = outcome.rows.iter().filter(|row| row.phase == Phase::Load);
    Ok(Measured {
        loading: loading.map(|row| [row.depth, row.force, row.contact_area]).collect(),
        residual_depth: summary.residual_depth,
        elastic_fraction: summary.elastic_fraction,
        estimated_error: Some(summary.estimated_error).filter(|e| e.is_finite()),
        newton_iterations: summary.newton_iterations,
        dofs: summary.dofs,
        wall_s,
        core_s,
        peak_memory_mb: peak_memory_mb(),
    })
}
