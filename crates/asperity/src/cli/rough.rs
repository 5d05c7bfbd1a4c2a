//! `asperity rough`: the contact of a rough surface with a rigid plane.

use crate::cli::flags::RunFlags;
use crate::cli::folder::Folder;
use crate::cli::terminal;
use crate::error::{Error, InputError};
use crate::input::toml_file::TomlFile;
use crate::output::SinkExt;
use crate::press::run::Pressed;
use asperity_roughness::scene::{Scene, SceneError};
use asperity_roughness::{Closure, Coefficient};
use clap::Args;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Arguments of `asperity rough`.
#[derive(Debug, Args)]
pub struct Rough {
    /// Scene file (TOML)
    #[arg(required_unless_present = "table1")]
    pub scene: Option<PathBuf>,
    /// Print the paper's Table 1 beside ours: three generated surfaces, every closure; into files with --out
    #[arg(long, conflicts_with = "scene")]
    pub table1: bool,
    /// Change a value of the file, for example --set "load.pressure=100 MPa"; repeatable
    #[arg(long = "set", value_name = "KEY.PATH=VALUE", conflicts_with = "table1")]
    pub overrides: Vec<String>,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or results that cannot be written.
pub fn rough(args: &Rough) -> Result<(), Error> {
    match &args.scene {
        Some(scene) if !args.table1 => one_scene(scene, args),
        _ => crate::press::table1::run(&args.run),
    }
}

/// `asperity rough SCENE.toml`.
fn one_scene(path: &Path, args: &Rough) -> Result<(), Error> {
    let start = Instant::now();
    let file: TomlFile<Scene> = TomlFile::read(path, &args.overrides)?;
    let scene = &file.value;
    let at = |e: SceneError| file.error_at(&e.path, &e.message);
    scene.validate().map_err(at)?;
    let coefficient = read_coefficient(&file)?;
    let target = args.run.out.clone().unwrap_or_else(|| Path::new("out").join(file.stem()));
    let prepared = scene.surface.prepare(|path| file.resolve(path)).map_err(at)?;
    let name = surface_name(&file);
    let (pressed, warnings) = crate::press::run::press_all(scene, &prepared, coefficient.as_ref())
        .map_err(|(path, message)| file.error_at(path, &message))?;
    let mut folder = Folder::create(&target, "rough", args.run.force)?;
    let outcome = crate::press::files::Outcome {
        name: &name,
        scene,
        prepared: &prepared,
        pressed: &pressed,
        warnings: &warnings,
    };
    outcome.write_tables(&mut folder)?;
    if scene.output.maps {
        outcome.write_maps(&mut folder)?;
    }
    outcome.write_surface(&mut folder)?;
    let summary = outcome.summary(start.elapsed().as_secs_f64());
    let text = serde_json::to_string_pretty(&summary).map_err(|e| Error::Unfinished(e.to_string()))?;
    folder.write("summary.json", |out| out.write_all(text.as_bytes()))?;
    let target = folder.publish()?;
    if !args.run.quiet {
        warnings.iter().for_each(terminal::warn);
    }
    if args.run.json {
        terminal::say(&text);
    } else if !args.run.quiet {
        terminal::say(&format!("{}results   {}", outcome.text(), target.display()));
    }
    Ok(())
}

/// The calibration's result that the scene names, or the one that comes with the program.
fn read_coefficient(file: &TomlFile<Scene>) -> Result<Option<Coefficient>, InputError> {
    let wanted = file.value.closure.closures();
    if !wanted.iter().any(|c| matches!(c, Closure::Fitted | Closure::Calibrated | Closure::Johnson)) {
        return Ok(None);
    }
    let Some(path) = &file.value.coefficient else {
        return Coefficient::committed()
            .map(Some)
            .map_err(|e| file.error_at("closure", &format!("the calibration of this program: {e}")));
    };
    let path = file.resolve(path);
    let text = std::fs::read_to_string(&path)
        .map_err(|e| file.error_at("coefficient", &format!("{} cannot be read: {e}", path.display())))?;
    Coefficient::from_toml(&text)
        .map(Some)
        .map_err(|e| file.error_at("coefficient", &format!("{}: {e}", path.display())))
}

/// What the surface is called in the tables: the kind it was generated as, or the name of its file.
fn surface_name(file: &TomlFile<Scene>) -> String {
    let surface = &file.value.surface;
    match (&surface.file, &surface.generate) {
        (Some(path), _) => {
            path.file_stem().map_or_else(|| "surface".into(), |s| s.to_string_lossy().into_owned())
        }
        (None, Some(made)) => crate::press::run::kind_name(made.kind).into(),
        (None, None) => file.stem(),
    }
}

/// A pressed surface by its closure.
pub type AllPressed = Vec<Pressed>;
