//! `asperity scales`: which waves of a surface matter.

use crate::extract::scene_of;
use crate::flags::{ReportFlag, RunFlags};
use crate::folder::Folder;
use crate::progress::Line;
use crate::{interrupt, terminal};
use asperity::error::Error;
use asperity::scales::scales as press_scales;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `asperity scales`.
#[derive(Debug, Args)]
pub struct Scales {
    /// Map of heights (.sur, .x3p, …) or scene (TOML); more maps are repeated measurements of the first, which tell its noise
    #[arg(required = true)]
    pub surfaces: Vec<PathBuf>,
    /// Scene whose metal, load and treatment of the surface maps take [default: that of `asperity new surface`]
    #[arg(long, value_name = "SCENE")]
    pub like: Option<PathBuf>,
    /// Change a value of the file, for example --set "load.pressure=100 MPa" or --set "scales.tip_radius=2 um"; repeatable
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
    #[command(flatten)]
    pub page: ReportFlag,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or results that cannot be written.
pub fn scales(args: &Scales) -> Result<(), Error> {
    // what is not said is told once
    let scenes = args.surfaces.iter().enumerate().map(|(i, path)| {
        let quiet = args.run.quiet || i > 0;
        scene_of(path, args.like.as_deref(), &args.overrides, quiet)
    });
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    let target = args.run.target(&scenes[0].name());
    let folder = Folder::create(&target, "scales", args.run.force)?;
    interrupt::catch();
    let progress = Line::new(args.run.quiet);
    let found = press_scales(&scenes, &mut |reached| {
        let next = || reached.news.map_or(String::new(), |l| format!("waves from {:.4} um", l * 1e6));
        progress.show(reached.share, next);
        !interrupt::requested()
    });
    progress.finish();
    let found = folder.fill(found, |found, folder| {
        found.write(folder)?;
        args.page.write(folder, || found.report())
    })?;
    if !args.run.quiet {
        found.summary.warnings.iter().for_each(terminal::warn);
    }
    args.run.say(&target, || found.json(), || found.text())
}
