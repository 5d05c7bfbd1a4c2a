//! `asperity extract`: from a measured map to finite elements.

use crate::flags::{AccuracyParser, RunFlags};
use crate::folder::claim;
use crate::progress::BatchProgress;
use crate::terminal;
use asperity::batch::Options;
use asperity::error::{Error, InputError};
use asperity::extract::{Comparison, Extracted, Extraction, LineAt, Parts, extract as take};
use asperity::material::units::Length;
use asperity::output::Directory;
use asperity::rough::RoughScene;
use asperity::roughness::Closure;
use asperity::simulation::scene::Accuracy;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use std::fs;
use std::path::{Path, PathBuf};

/// Share of the surface's height that hills rise by at least, as ISO 25178-2 has it.
const PRUNE: &str = "0.05";

/// Arguments of `asperity extract`.
#[derive(Debug, Args)]
pub struct Extract {
    /// Map of heights (.sur, .x3p, .al3d, .sdf, .npy, .csv, …), or a scene of `asperity rough` (.toml)
    pub surface: PathBuf,
    /// Scene of `asperity rough` whose metal, load and treatment of the surface a map takes [default: that of `asperity new surface`]
    #[arg(long, value_name = "SCENE")]
    pub like: Option<PathBuf>,
    /// Islands above this separation from the mean plane, for example "1 um" [default: --share 0.1 of a map, the load of a scene]
    #[arg(long, value_name = "LENGTH", group = "parts", allow_hyphen_values = true)]
    pub separation: Option<Length>,
    /// Islands above the plane that leaves this share of the measured points above it (the material ratio)
    #[arg(long, value_name = "SHARE", group = "parts")]
    pub share: Option<f64>,
    /// Hills of ISO 25178-2 that rise by at least this share of the surface's height above their highest saddle
    #[arg(long, value_name = "SHARE", group = "parts", num_args = 0..=1, default_missing_value = PRUNE)]
    pub hills: Option<f64>,
    /// Islands above the plane at which this closure carries the pressure of the scene [default of a scene: its first closure of islands, of "all" published]
    #[arg(long, value_name = "NAME", group = "parts", value_parser = closures_of_islands())]
    pub closure: Option<Closure>,
    /// Depth to which scenes crush [default: down to the separation; half the rise of a hill]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub depth: Option<Length>,
    /// Asperities, from the highest down, that get a profile and a scene [default: 20, at least those of --crush]
    #[arg(long, value_name = "N")]
    pub profiles: Option<usize>,
    /// A line of the map as a scene in plane strain: "y=0.2 mm" is a row, "x=0.2 mm" a column; repeatable
    #[arg(long, value_name = "LINE", value_parser = clap::value_parser!(LineAt))]
    pub line: Vec<LineAt>,
    /// Crush so many asperities and hold every closure against them; goes on after a stop
    #[arg(long, value_name = "N")]
    pub crush: Option<usize>,
    /// Error of the force of a crush: draft (5 %), standard (1 %), reference (0.2 %) or a percentage [default: standard]
    #[arg(long, value_name = "LEVEL", value_parser = AccuracyParser, hide_possible_values = true)]
    pub accuracy: Option<Accuracy>,
    /// Change a value of the rough scene, for example --set "surface.s_filter=2 um" or --set "material.yield_stress=300 MPa"; repeatable
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    #[command(flatten)]
    pub run: RunFlags,
}

/// The closures that have islands, by their names.
fn closures_of_islands() -> impl TypedValueParser<Value = Closure> {
    let islands = Closure::ALL.into_iter().filter(|closure| !closure.is_half_space());
    PossibleValuesParser::new(islands.map(Closure::name)).try_map(|name| name.parse())
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), crushes that were ended (those that are done are kept), a disk
/// that refuses.
pub fn extract(args: &Extract) -> Result<(), Error> {
    let scene = scene_of(&args.surface, args.like.as_deref(), &args.overrides, args.run.quiet)?;
    let wanted = wanted(args);
    let count = args.crush.unwrap_or(0);
    let found = take(&scene, &wanted)?;
    found.check_count(count)?;
    let target = args.run.target(&scene.name());
    let mark = claim(&target, "extract", args.run.force)?;
    forget(&target)?;
    let mut folder = Directory::create(&target)?;
    found.write(&mut folder)?;
    if !args.run.quiet {
        found.warnings.iter().for_each(terminal::warn);
    }
    let mut compared = match count {
        0 => None,
        _ => Some(compare_crushed(&found, &scene, count, &args.run, &target)?),
    };
    if let Some((compared, stopped)) = compared.as_mut() {
        compared.write(&mut folder)?;
        if !args.run.quiet {
            compared.warnings.iter().for_each(terminal::warn);
        }
        if let Some(stopped) = stopped.take() {
            return Err(stopped);
        }
    }
    drop(mark);
    let text = || {
        let compared = compared.as_ref().map(|(c, _)| format!("\n{}", c.text()));
        found.text() + &compared.unwrap_or_default()
    };
    args.run.say(&target, || asperity::output::json(&found.summary()), text)
}

/// The scene at `path`; of a map one like the scene `like`.
///
/// # Errors
/// A scene that cannot be read or makes no sense.
pub fn scene_of(
    path: &Path,
    like: Option<&Path>,
    overrides: &[String],
    quiet: bool,
) -> Result<RoughScene, Error> {
    scene_like(path, like, RoughScene::usual, overrides, quiet)
}

/// The same with `usual` for what is not said of a map.
///
/// # Errors
/// A scene that cannot be read or makes no sense.
pub fn scene_like(
    path: &Path,
    like: Option<&Path>,
    usual: fn() -> Result<RoughScene, InputError>,
    overrides: &[String],
    quiet: bool,
) -> Result<RoughScene, Error> {
    if path.extension().is_some_and(|end| end == "toml") {
        return Ok(RoughScene::read(path, overrides)?);
    }
    let given = like.map_or_else(usual, |like| RoughScene::read(like, &[]))?;
    let scene = RoughScene::of_map(path, &given, overrides)?;
    if like.is_none() && !quiet {
        terminal::warn(&format!(
            "metal and load of {} are those of `asperity new surface`: give your own with --like SCENE.toml or --set",
            path.display()
        ));
    }
    Ok(scene)
}

fn wanted(args: &Extract) -> Extraction {
    let usual = Extraction::default();
    let given = [
        args.separation.map(Parts::Separation),
        args.share.map(Parts::Share),
        args.hills.map(Parts::Hills),
        args.closure.map(|closure| Parts::Load(Some(closure))),
    ];
    let of_scene = args.like.is_some() || args.surface.extension().is_some_and(|end| end == "toml");
    let bodies = args.profiles.unwrap_or(usual.bodies).max(args.crush.unwrap_or(0));
    Extraction {
        parts: given.into_iter().flatten().next().unwrap_or(if of_scene {
            Parts::Load(None)
        } else {
            usual.parts
        }),
        depth: args.depth,
        bodies,
        lines: args.line.clone(),
        accuracy: args.accuracy.unwrap_or(usual.accuracy),
    }
}

/// Takes away what an earlier extraction left in the folders of many files.
fn forget(target: &Path) -> Result<(), Error> {
    for folder in ["profiles", "scenes", "curves"].map(|name| target.join(name)) {
        let Ok(entries) = fs::read_dir(&folder) else { continue };
        for path in entries.filter_map(Result::ok).map(|entry| entry.path()) {
            let stem = path.file_stem().unwrap_or_default().to_string_lossy();
            let number = !stem.is_empty() && stem.chars().all(|c| c.is_ascii_digit());
            if number || stem.starts_with("line-") {
                fs::remove_file(&path).map_err(|e| Error::disk(&path, e))?;
            }
        }
    }
    Ok(())
}

/// Crushes `count` asperities of `found`, whose files lie in `target`, and holds closures against them; with
/// the error of crushes that were ended.
pub fn compare_crushed(
    found: &Extracted,
    scene: &RoughScene,
    count: usize,
    run: &RunFlags,
    target: &Path,
) -> Result<(Comparison, Option<Error>), Error> {
    let mut progress = BatchProgress::new(run.quiet, ["asperity", "asperities"], target.to_path_buf());
    let options = Options {
        threads: run.threads.map_or(0, usize::from),
        part: None,
        folder: Some(target.to_path_buf()),
    };
    let compared =
        found.crush(scene, count, &options, &mut |reached| progress.show(reached, |_| String::new()));
    let stopped = progress.finish();
    Ok((compared?, stopped))
}
