//! `asperity trade`: the price of accuracy, measured on a scene.
//!
//! Each setting runs in a process of its own, so that its memory is its own and a run that dies is a row.

use crate::flags::{RunFlags, SceneFlags};
use crate::folder::{Folder, journal_beside};
use crate::progress::BatchProgress;
use crate::{interrupt, terminal};
use asperity::error::Error;
use asperity::input::scene::Scene;
use asperity::output::json;
use asperity::simulation::scene::{Scene as Tables, SceneError};
use asperity::trade::case::{Measured, TradeError, solve};
use asperity::trade::settings::Setting;
use asperity::trade::{DEFAULT_SCENE, Options};
use clap::Args;
use std::fmt::Display;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread;
use std::time::Duration;

/// Arguments of `asperity trade`.
#[derive(Debug, Args)]
pub struct Trade {
    /// Scene file (TOML) [default: the asperity of the paper]
    pub scene: Option<PathBuf>,
    /// Number of settings that differ in everything at once
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = clap::value_parser!(u16).range(..=1000))]
    pub combinations: u16,
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
/// Input that is wrong (nothing is written), a scene whose converged value cannot be computed, or a disk that
/// refuses.
pub fn trade(args: &Trade) -> Result<(), Error> {
    if args.case {
        return answer();
    }
    let (scene, name) = read_scene(args)?;
    if scene.tables().mesh.is_some() {
        let message = "a trade varies the mesh: leave [mesh] out".into();
        return Err(scene.error(&SceneError { path: "mesh".into(), message }).into());
    }
    let target = args.run.target(&name);
    let folder = Folder::create(&target, "trade", args.run.force)?;
    let journal = journal_beside(&target);
    let options = Options { combinations: args.combinations.into(), journal: Some(&journal), runner: &ask };
    let mut progress = BatchProgress::new(args.run.quiet, ["run", "runs"], journal.clone());
    let result = asperity::trade::trade(scene.tables(), &options, &mut |reached| {
        progress.show(reached, |knob| format!("{knob:?}").to_lowercase())
    });
    let result = progress.finish().map_or(result, Err);
    let trade = folder.fill(result, |trade, folder| trade.write(folder))?;
    // the results are in their place: the journal has done its work
    let _ = std::fs::remove_file(&journal);
    args.run.say(&target, || json(&trade.rows), || trade.text())
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

/// Time between two looks at a run in another process: the hundredth of a quick one.
const BETWEEN_LOOKS: Duration = Duration::from_millis(5);

/// Asks another instance of this program for a setting.
fn ask(setting: &Setting, scene: &Tables) -> Result<Measured, TradeError> {
    let failed = |e: &dyn Display| TradeError::Process(e.to_string());
    let program = std::env::current_exe().map_err(|e| failed(&e))?;
    let question = serde_json::to_vec(&setting.scene(scene)).map_err(|e| failed(&e))?;
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
    let mut answer = child.stdout.take();
    let reader = thread::spawn(move || {
        let mut text = Vec::new();
        answer.as_mut().map_or(Ok(0), |answer| answer.read_to_end(&mut text)).map(|_| text)
    });
    let status = loop {
        if let Some(status) = child.try_wait().map_err(|e| failed(&e))? {
            break status;
        }
        if interrupt::requested() {
            // one that has ended by itself is as good as one that is ended
            let _ = child.kill();
        }
        thread::sleep(BETWEEN_LOOKS);
    };
    let text = reader.join().map_err(|_| failed(&"its answer could not be read"))?.map_err(|e| failed(&e))?;
    if !status.success() {
        return Err(failed(&status));
    }
    let answer: Result<Measured, String> = serde_json::from_slice(&text).map_err(|e| failed(&e))?;
    answer.map_err(TradeError::Run)
}

/// The other side of [`ask`]: reads a scene from stdin, runs it, writes its results to stdout.
fn answer() -> Result<(), Error> {
    let failed = |e: &dyn Display| Error::Unfinished(format!("no case of a trade: {e}"));
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).map_err(|e| failed(&e))?;
    let scene: Tables = serde_json::from_str(&text).map_err(|e| failed(&e))?;
    terminal::say(&serde_json::to_string(&solve(&scene)).map_err(|e| failed(&e))?)?;
    Ok(())
}
