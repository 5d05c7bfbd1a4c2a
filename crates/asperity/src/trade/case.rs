//! One run of a trade, in a process of its own, so that its memory is its own and a run that dies is a row.

use super::settings::Setting;
use crate::cli::terminal;
use crate::crush::peak_memory_mb;
use crate::error::Error;
use asperity_solver::run::crush::run;
use asperity_solver::run::curve::Curve;
use asperity_solver::run::record::Phase;
use asperity_solver::scene::Scene;
use cpu_time::ThreadTime;
use serde::{Deserialize, Serialize};
use std::io::{Read, Write};
use std::ops::ControlFlow;
use std::process::{Command, Stdio};
use std::time::Instant;

/// What a run gave, SI units.
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

/// A setting and what came of it, or why nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Finished {
    /// The setting.
    pub setting: Setting,
    /// What it gave.
    pub outcome: Result<Measured, String>,
}

/// Runs `setting` of `scene` in a process of its own.
///
/// # Errors
/// A process that failed, of which nothing is to be kept: it may do better the next time.
pub fn measure(setting: &Setting, scene: &Scene) -> Result<Finished, String> {
    Ok(Finished { setting: *setting, outcome: ask(&setting.scene(scene))? })
}

/// Asks another instance of this program; the outer error is about the process, the inner one about the run.
fn ask(scene: &Scene) -> Result<Result<Measured, String>, String> {
    let failed = |e: &dyn std::fmt::Display| format!("the process of the run failed: {e}");
    let program = std::env::current_exe().map_err(|e| failed(&e))?;
    let question = serde_json::to_vec(scene).map_err(|e| failed(&e))?;
    let mut child = Command::new(program)
        .args(["trade", "--case"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .map_err(|e| failed(&e))?;
    if let Some(mut input) = child.stdin.take() {
        // a child that died early closes the pipe: its status says more
        let _ = input.write_all(&question);
    }
    let output = child.wait_with_output().map_err(|e| failed(&e))?;
    if !output.status.success() {
        return Err(failed(&output.status));
    }
    serde_json::from_slice(&output.stdout).map_err(|e| failed(&e))
}

/// The other side of [`measure`]: reads a scene from stdin, runs it, writes what it gave to stdout.
///
/// # Errors
/// An input that is no scene.
pub fn answer() -> Result<(), Error> {
    let failed = |e: &dyn std::fmt::Display| Error::Unfinished(format!("no case of a trade: {e}"));
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).map_err(|e| failed(&e))?;
    let scene: Scene = serde_json::from_str(&text).map_err(|e| failed(&e))?;
    terminal::say(&serde_json::to_string(&solve(&scene)).map_err(|e| failed(&e))?);
    Ok(())
}

fn solve(scene: &Scene) -> Result<Measured, String> {
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
