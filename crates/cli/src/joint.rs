//! `asperity joint`: the law of a joint for other programs.

use crate::extract::scene_like;
use crate::flags::{ReportFlag, RunFlags};
use crate::folder::Folder;
use crate::progress::Line;
use crate::{interrupt, terminal};
use asperity::error::Error;
use asperity::joint::joint as press_joint;
use asperity::rough::RoughScene;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `asperity joint`.
#[derive(Debug, Args)]
pub struct Joint {
    /// Scene (TOML) or map of heights (.sur, .x3p, …); several maps of one surface give their mean and how far they differ. Of two rough faces give the sum of their heights
    #[arg(required = true)]
    pub surfaces: Vec<PathBuf>,
    /// Scene whose metal, load and treatment of the surface maps take [default: that of `asperity new surface`, to the end of the metal or of the gap]
    #[arg(long, value_name = "SCENE")]
    pub like: Option<PathBuf>,
    /// Change a value of the file, for example --set "load.pressure=100 MPa"; repeatable
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
pub fn joint(args: &Joint) -> Result<(), Error> {
    // what is not said is told once
    let scenes = args.surfaces.iter().enumerate().map(|(i, path)| {
        let quiet = args.run.quiet || i > 0;
        scene_like(path, args.like.as_deref(), RoughScene::usual_joint, &args.overrides, quiet)
    });
    let scenes = scenes.collect::<Result<Vec<_>, _>>()?;
    let name = if scenes.len() == 1 { scenes[0].name() } else { "joint".into() };
    let target = args.run.target(&name);
    let folder = Folder::create(&target, "joint", args.run.force)?;
    interrupt::catch();
    let progress = Line::new(args.run.quiet);
    let found = press_joint(&scenes, &mut |reached| {
        let next = || reached.news.map_or(String::new(), |p| format!("{:.4} MPa", p * 1e-6));
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
