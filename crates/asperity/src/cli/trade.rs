//! `asperity trade`: what accuracy costs, measured on a scene.

use crate::cli::flags::{RunFlags, SceneFlags};
use crate::cli::folder::{Folder, journal_beside};
use crate::cli::progress::Progress;
use crate::cli::terminal;
use crate::error::{Error, InputError};
use crate::input::scene::Scene;
use crate::output::SinkExt;
use crate::trade::case::{Finished, Measured};
use crate::trade::errors::Converged;
use crate::trade::settings::{Knob, Setting};
use asperity_calibration::journal::{Journal, fingerprint};
use asperity_solver::scene::{Scene as Tables, SceneError};
use clap::Args;
use rayon::prelude::*;
use std::path::{Path, PathBuf};
use std::sync::Mutex;

/// The scene of a trade that names none: the asperity of the paper.
pub const DEFAULT_SCENE: &str = include_str!("../../scenes/single-asperity.toml");

/// Arguments of `asperity trade`.
#[derive(Debug, Args)]
pub struct Trade {
    /// Scene file (TOML) [default: the asperity of the paper]
    pub scene: Option<PathBuf>,
    /// How many settings differ in everything at once
    #[arg(long, value_name = "N", default_value_t = 30)]
    pub combinations: usize,
    /// Answer one case of another run, given on stdin
    #[arg(long, hide = true)]
    pub case: bool,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), a scene whose converged value cannot be computed, or a disk that refuses.
pub fn trade(args: &Trade) -> Result<(), Error> {
    if args.case {
        return crate::trade::case::answer();
    }
    let (read, name) = read_scene(args)?;
    let scene = read.tables();
    if scene.mesh.is_some() {
        let message = "a trade varies the mesh: leave [mesh] out".into();
        return Err(read.error(&SceneError { path: "mesh".into(), message }).into());
    }
    let target = args.run.out.clone().unwrap_or_else(|| Path::new("out").join(name));
    let mut folder = Folder::create(&target, "trade", args.run.force)?;
    let journal = journal_beside(&target);
    let result = measure_all(scene, args.combinations, &journal, args.run.quiet)
        .and_then(|finished| write(&mut folder, &finished));
    let said = match result {
        Ok(said) => said,
        Err(failure) => {
            folder.abandon();
            return Err(failure);
        }
    };
    folder.publish()?;
    // the results are in their place: the journal has done its work
    let _ = std::fs::remove_file(&journal);
    if args.run.json {
        terminal::say(&said.json);
    } else if !args.run.quiet {
        terminal::say(&said.text);
        terminal::say(&format!("results   {}", target.display()));
    }
    Ok(())
}

/// The scene and the name of its results.
fn read_scene(args: &Trade) -> Result<(Scene, String), Error> {
    match &args.scene {
        Some(path) => {
            let scene = args.scene_flags.read(path)?;
            let name = format!("trade-{}", scene.name());
            Ok((scene, name))
        }
        None => {
            let scene = Scene::from_toml(DEFAULT_SCENE, Path::new(""))?.with(&args.scene_flags.changes())?;
            Ok((scene, "trade".into()))
        }
    }
}

/// Runs what the journal does not hold yet, the longest first, each as a process on a thread of its own.
fn measure_all(
    scene: &Tables,
    combinations: usize,
    path: &Path,
    quiet: bool,
) -> Result<Vec<Finished>, Error> {
    let mut settings = crate::trade::settings::converged(scene).to_vec();
    settings.extend(crate::trade::settings::settings(scene, combinations));
    let definition = format!("{} {scene:?} {settings:?}", env!("CARGO_PKG_VERSION"));
    let disk = |e: std::io::Error| {
        Error::Unfinished(format!(
            "cannot write the journal {}: {e}; it keeps every run that was finished, and the same command goes on from there",
            path.display()
        ))
    };
    let (journal, lines) = Journal::open(path, fingerprint(&definition))
        .map_err(|e| InputError::new(format!("cannot write the journal {}: {e}", path.display())))?;
    let mut finished: Vec<Finished> =
        lines.iter().filter_map(|line| serde_json::from_str(line).ok()).collect();
    if !finished.is_empty() && !quiet {
        terminal::complain(&format!("{} runs of an earlier trade are in {}", finished.len(), path.display()));
    }
    let mut open: Vec<&Setting> =
        settings.iter().filter(|s| !finished.iter().any(|f| f.setting == **s)).collect();
    open.sort_by(|a, b| b.weight().total_cmp(&a.weight()));
    let whole: f64 = settings.iter().map(Setting::weight).sum();
    let left: f64 = open.iter().map(|s| s.weight()).sum();
    let progress = Progress::new(quiet);
    let state = Mutex::new((journal, whole - left));
    // a bridge hands the cases out in their order, which keeps the longest first
    let new: Result<Vec<Finished>, Error> = open
        .into_iter()
        .par_bridge()
        .map(|setting| {
            let finished = match crate::trade::case::measure(setting, scene) {
                Ok(finished) => finished,
                Err(reason) => return Ok(Finished { setting: *setting, outcome: Err(reason) }),
            };
            let line = serde_json::to_string(&finished).map_err(|e| disk(e.into()))?;
            let mut state = state.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
            state.0.append(&line).map_err(disk)?;
            state.1 += setting.weight();
            progress.show(state.1 / whole, || setting.knob.name().to_string());
            Ok(finished)
        })
        .collect();
    progress.finish();
    finished.extend(new?);
    Ok(settings.iter().filter_map(|s| finished.iter().find(|f| f.setting == *s).cloned()).collect())
}

/// What the command says on the terminal.
struct Said {
    /// To a person.
    text: String,
    /// To a program.
    json: String,
}

/// Writes table and picture.
fn write(folder: &mut Folder, finished: &[Finished]) -> Result<Said, Error> {
    let finer: Vec<&Finished> = finished.iter().filter(|f| f.setting.knob == Knob::Converged).collect();
    let run = |i: usize| -> Result<&Measured, Error> {
        let outcome = finer.get(i).map(|f| f.outcome.as_ref());
        match outcome {
            Some(Ok(run)) => Ok(run),
            Some(Err(reason)) => {
                Err(Error::Unfinished(format!("the converged value cannot be computed: {reason}")))
            }
            None => Err(Error::Unfinished("the converged value was not computed".into())),
        }
    };
    let converged = Converged::new(run(0)?, run(1)?);
    let known = if finer[0].setting.numerics == finer[1].setting.numerics {
        "that of the scene's own mesh and steps: whether it is converged is not known".to_string()
    } else {
        format!("known to {:.3} %", 100.0 * converged.doubt)
    };
    let compared: Vec<Finished> =
        finished.iter().filter(|f| f.setting.knob != Knob::Converged).cloned().collect();
    let rows = crate::trade::errors::rows(&compared, &converged);
    let picture = crate::trade::picture::draw(&rows).map_err(Error::Unfinished)?;
    folder.write("trade.csv", |out| crate::trade::table::write(out, &rows))?;
    folder.write("trade.svg", |out| out.write_all(picture.as_bytes()))?;
    let overview = crate::trade::table::overview(&rows);
    folder.write("trade.md", |out| writeln!(out, "{overview}"))?;
    let failed = rows.iter().filter(|r| r.outcome.is_err()).count();
    let json = crate::trade::table::json(&rows).map_err(|e| Error::Unfinished(e.to_string()))?;
    let text = format!(
        "{}\n\n{} settings, {failed} without a result; the converged force is {known}",
        overview,
        rows.len(),
    );
    Ok(Said { text, json })
}
