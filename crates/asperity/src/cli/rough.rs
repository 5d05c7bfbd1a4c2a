//! `asperity rough`: the contact of a rough surface with a rigid plane.

use crate::cli::flags::RunFlags;
use crate::cli::folder::Folder;
use crate::cli::terminal;
use crate::error::Error;
use crate::press::table1::table1;
use crate::press::{RoughScene, press};
use clap::Args;
use std::path::{Path, PathBuf};

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
    /// Compare every closure with the half-space (default on maps of up to 1024 x 1024 points)
    #[arg(long, conflicts_with_all = ["table1", "no_judge"])]
    pub judge: bool,
    /// Do not compare closures with the half-space
    #[arg(long, conflicts_with = "table1")]
    pub no_judge: bool,
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
        _ => whole_table(&args.run),
    }
}

/// `asperity rough SCENE.toml`.
fn one_scene(path: &Path, args: &Rough) -> Result<(), Error> {
    let mut overrides = args.overrides.clone();
    if args.judge || args.no_judge {
        overrides.push(format!("judge={}", args.judge));
    }
    let scene = RoughScene::read(path, &overrides)?;
    let rough = press(&scene, &mut |_| true)?;
    let target = args.run.target(&scene.name());
    let mut folder = Folder::create(&target, "rough", args.run.force)?;
    rough.write(&mut folder)?;
    let target = folder.publish()?;
    if !args.run.quiet {
        rough.summary.warnings.iter().for_each(terminal::warn);
    }
    args.run.say(&target, || rough.json(), || rough.text())
}

/// `asperity rough --table1`.
fn whole_table(flags: &RunFlags) -> Result<(), Error> {
    let table = table1()?;
    if let Some(out) = &flags.out {
        let mut folder = Folder::create(out, "rough", flags.force)?;
        table.write(&mut folder)?;
        folder.publish()?;
    }
    if flags.json {
        terminal::say(&table.json()?);
    } else if !flags.quiet {
        terminal::say(table.text().trim_end());
    }
    Ok(())
}
