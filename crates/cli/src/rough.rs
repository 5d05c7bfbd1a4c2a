//! `asperity rough`: the contact of a rough surface with a rigid plane.

use crate::extract::{compare_crushed, scene_of};
use crate::flags::{ReportFlag, RunFlags};
use crate::folder::{Folder, claim};
use crate::progress::Line;
use crate::{interrupt, terminal};
use asperity::error::{Error, InputError};
use asperity::extract::{Extraction, extract};
use asperity::output::Directory;
use asperity::rough::{RoughScene, press, press_several};
use asperity_paper::table1::table1;
use clap::{Args, ValueEnum};
use std::path::{Path, PathBuf};

/// Arguments of `asperity rough`.
#[derive(Debug, Args)]
pub struct Rough {
    /// Scene (TOML) or map of heights (.sur, .x3p, …); several of them give one table
    #[arg(required_unless_present = "table1")]
    pub scenes: Vec<PathBuf>,
    /// Scene whose metal, load and treatment of the surface maps take [default: that of `asperity new surface`]
    #[arg(long, value_name = "SCENE", conflicts_with = "table1")]
    pub like: Option<PathBuf>,
    /// Print the paper's Table 1 beside ours: three generated surfaces, every closure; into files with --out or --report
    #[arg(long, conflicts_with = "scenes")]
    pub table1: bool,
    /// Change a value of the file, for example --set "load.pressure=100 MPa"; repeatable
    #[arg(long = "set", value_name = "KEY.PATH=VALUE", conflicts_with = "table1")]
    pub overrides: Vec<String>,
    /// Compare every closure with the half-space (default on maps of up to 1024 x 1024 points); "crush" crushes three summits too, by finite elements
    #[arg(long, value_name = "BY", num_args = 0..=1, default_missing_value = "half-space", conflicts_with_all = ["table1", "no_judge"])]
    pub judge: Option<Judge>,
    /// Do not compare closures with the half-space
    #[arg(long, conflicts_with = "table1")]
    pub no_judge: bool,
    #[command(flatten)]
    pub page: ReportFlag,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Measure of closures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Judge {
    /// The half-space of the same metal.
    HalfSpace,
    /// Finite elements of the highest summits, beside the half-space.
    Crush,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or results that cannot be written.
pub fn rough(args: &Rough) -> Result<(), Error> {
    match &args.scenes[..] {
        [] => whole_table(&args.page, &args.run),
        [scene] => one_scene(scene, args),
        scenes => several(scenes, args),
    }
}

/// A scene, or a map in a scene like another.
fn read(path: &Path, args: &Rough, quiet: bool) -> Result<RoughScene, Error> {
    let mut overrides = args.overrides.clone();
    if args.judge.is_some() || args.no_judge {
        overrides.push(format!("judge={}", args.judge.is_some()));
    }
    scene_of(path, args.like.as_deref(), &overrides, quiet)
}

/// `asperity rough SCENE.toml`.
fn one_scene(path: &Path, args: &Rough) -> Result<(), Error> {
    let scene = read(path, args, args.run.quiet)?;
    let target = args.run.target(&scene.name());
    let mut folder = Folder::create(&target, "rough", args.run.force)?;
    interrupt::catch();
    let progress = Line::new(args.run.quiet);
    let rough = press(&scene, &mut |reached| {
        progress.show(reached.share, || reached.news.map_or("half-space", |closure| closure.name()).into());
        !interrupt::requested()
    });
    progress.finish();
    let rough = match rough {
        Ok(rough) if rough.stopped && rough.contacts.is_empty() => {
            folder.abandon();
            let reason = "stopped before the first closure was done: nothing was written; the same command begins anew";
            return Err(Error::Unfinished(reason.into()));
        }
        Ok(rough) => rough,
        Err(error) => {
            folder.abandon();
            return Err(error);
        }
    };
    rough.write(&mut folder)?;
    args.page.write(&mut folder, || rough.report())?;
    let target = folder.publish()?;
    if !args.run.quiet {
        rough.summary.warnings.iter().for_each(terminal::warn);
    }
    let crushed = match args.judge {
        Some(Judge::Crush) if !rough.stopped => Some(judge_by_crush(&scene, &target, args)?),
        _ => None,
    };
    args.run.say(&target, || rough.json(), || rough.text() + &crushed.unwrap_or_default())?;
    if rough.stopped {
        let done = format!("{} of {}", rough.contacts.len(), scene.tables().closure.closures().len());
        return Err(Error::Unfinished(format!(
            "stopped: {done} closures are in {}; the same command begins anew",
            target.display()
        )));
    }
    Ok(())
}

/// Crushes the highest summits of the surface and holds closures against them: into the folder `judge` of the
/// results; what that says.
fn judge_by_crush(scene: &RoughScene, target: &Path, args: &Rough) -> Result<String, Error> {
    let found = extract(scene, &Extraction::to_judge())?;
    let target = target.join("judge");
    let mut folder = Directory::create(&target)?;
    found.write(&mut folder)?;
    let count = found.bodies.len();
    if count == 0 {
        let why = found.warnings.last().cloned().unwrap_or_else(|| "none has a profile".into());
        return Ok(format!("no summit can be crushed to judge closures: {why}\n"));
    }
    let (compared, stopped) = compare_crushed(&found, scene, count, &args.run, &target)?;
    compared.write(&mut folder)?;
    match stopped {
        Some(stopped) => Err(stopped),
        None => Ok(compared.verdict().map_or_else(|| compared.text(), |verdict| format!("{verdict}.\n"))),
    }
}

/// `asperity rough A.x3p B.x3p …`: the results of each in a folder of its name, the tables of all beside
/// them.
fn several(paths: &[PathBuf], args: &Rough) -> Result<(), Error> {
    if args.judge == Some(Judge::Crush) {
        let message = "--judge crush takes one surface at a time";
        return Err(InputError::new(message).help("press the others without it, or one by one").into());
    }
    // what is not said is told once
    let quiet = |i: usize| args.run.quiet || i > 0;
    let scenes = paths.iter().enumerate().map(|(i, path)| read(path, args, quiet(i)));
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    let target = args.run.target("rough");
    let mark = claim(&target, "rough", args.run.force)?;
    interrupt::catch();
    let progress = Line::new(args.run.quiet);
    let done = press_several(
        &scenes,
        &mut |i, reached| {
            let share = (i as f64 + reached.share) / scenes.len() as f64;
            let closure = reached.news.map_or("", |closure| closure.name());
            progress.show(share, || format!("{}  {closure}", scenes[i].name()));
            !interrupt::requested()
        },
        &mut |name, rough| {
            let mut folder = Folder::create(&target.join(name), "rough", args.run.force)?;
            rough.write(&mut folder)?;
            args.page.write(&mut folder, || rough.report())?;
            folder.publish()?;
            if !args.run.quiet {
                rough.summary.warnings.iter().for_each(|w| terminal::warn(&format!("{name}: {w}")));
            }
            Ok(())
        },
    )?;
    progress.finish();
    done.write(&mut Directory::create(&target)?)?;
    drop(mark);
    args.run.say(&target, || done.json(), || done.text())?;
    let short = scenes.len() - done.surfaces.len() + done.failed().count();
    if short > 0 {
        let reason = format!(
            "{short} of {} surfaces were not pressed; the others are in {}",
            scenes.len(),
            target.display()
        );
        return Err(Error::Unfinished(reason));
    }
    Ok(())
}

/// `asperity rough --table1`.
fn whole_table(page: &ReportFlag, flags: &RunFlags) -> Result<(), Error> {
    let kept = flags.out.is_some() || page.report;
    let folder = kept.then(|| Folder::create(&flags.target("table1"), "rough", flags.force)).transpose()?;
    interrupt::catch();
    let progress = Line::new(flags.quiet);
    let table = table1(&mut |share, message| {
        progress.show(share, || message.to_string());
        !interrupt::requested()
    });
    progress.finish();
    let (folder, table) = match table {
        Ok(table) => (folder, table),
        Err(error) => {
            folder.into_iter().for_each(Folder::abandon);
            return Err(error);
        }
    };
    if let Some(mut folder) = folder {
        table.write(&mut folder)?;
        page.write(&mut folder, || table.report())?;
        folder.publish()?;
    }
    if flags.json {
        terminal::say(&table.json()?)?;
    } else if !flags.quiet {
        terminal::say(table.text().trim_end())?;
    }
    Ok(())
}
