//! `asperity crush`: one scene from its file to a folder of results.

use crate::flags::{ReportFlag, RunFlags, SceneFlags};
use crate::folder::{Folder, journal_beside};
use crate::progress::Line;
use crate::{interrupt, terminal};
use asperity::columns::Unit;
use asperity::crush::{Checkpoints, CurveRow, Sketch, crush_with};
use asperity::error::{Error, InputError};
use asperity::simulation::scene::Symmetry;
use asperity::units::MICROMETRE;
use clap::Args;
use std::path::PathBuf;
use std::time::Duration;

/// A killed run loses at most this much.
const BETWEEN_CHECKPOINTS: Duration = Duration::from_secs(30);

/// Bytes that the solves of a run take on the disk at most; a run that needs more is taken up where it had as many.
const LARGEST_JOURNAL: u64 = 2 << 30;

/// Arguments of `asperity crush`.
#[derive(Debug, Args)]
pub struct Crush {
    /// Scene file (TOML); `asperity new single` writes one
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    #[command(flatten)]
    pub page: ReportFlag,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or a run that could not finish (what it reached is written).
pub fn crush(args: &Crush) -> Result<(), Error> {
    let Some(path) = &args.scene else {
        let help = "asperity new single writes single.toml, a commented scene to start from; then: asperity crush single.toml";
        return Err(InputError::new("Missing scene file.").help(help).into());
    };
    let scene = args.scene_flags.read(path)?;
    if !args.run.quiet {
        scene.tables().unused().iter().for_each(terminal::warn);
    }
    let out = args.run.target(&scene.name());
    let earlier = scene.tables().initial.as_ref().and_then(|initial| initial.from.as_ref());
    if let Some(earlier) = earlier.map(|from| scene.resolve(from))
        && earlier.canonicalize().is_ok_and(|earlier| out.canonicalize().is_ok_and(|out| out == earlier))
    {
        let message = format!("{} is the result that this scene starts from", out.display());
        return Err(InputError::new(message)
            .help("name another folder with --out, or rename the scene")
            .into());
    }
    let mut folder = Folder::create(&out, "crush", args.run.force)?;
    interrupt::catch();
    let progress = Line::new(args.run.quiet);
    let symmetry = scene.tables().symmetry;
    let checkpoints =
        Checkpoints { folder: journal_beside(&out), every: BETWEEN_CHECKPOINTS, largest: LARGEST_JOURNAL };
    if checkpoints.exist() && !args.run.quiet {
        let place = checkpoints.folder.display();
        terminal::complain(&format!("the solves of a stopped run in {place} are used as far as they fit"));
    }
    let result = crush_with(&scene, Some(&checkpoints), &mut folder, &[Sketch::PEAK], &mut |reached| {
        if let Some(increment) = reached.news {
            progress.show(reached.share, || progress_line(increment.row, symmetry));
        }
        !interrupt::requested()
    });
    progress.finish();
    if let Err(Error::Input(error)) = result {
        folder.abandon();
        return Err(error.into());
    }
    let result = result.and_then(|crush| {
        args.page.write(&mut folder, || crush.report())?;
        Ok(crush)
    });
    folder.publish()?;
    let summary = result?.summary;
    let kept = interrupt::requested() && checkpoints.exist();
    if !kept {
        checkpoints.remove();
    }
    if !args.run.quiet {
        summary.warnings().iter().for_each(terminal::warn);
    }
    args.run.say(&out, || summary.to_json(), || summary.overview())?;
    match summary.stopped {
        Some(reason) => {
            let again = if kept { "; the same command goes on from there" } else { "" };
            Err(Error::Unfinished(format!("{reason}; what was reached is in {}{again}", out.display())))
        }
        None => Ok(()),
    }
}

fn progress_line(row: &CurveRow, symmetry: Symmetry) -> String {
    let verb = if row.phase.advances() { "loading" } else { "unloading" };
    let per = if symmetry == Symmetry::PlaneStrain { "/mm" } else { "" };
    format!(
        "{verb}  {:.3} um  {:.3} N{per}  increment {}",
        row.depth / MICROMETRE,
        row.force / Unit::Force.value(symmetry),
        row.increment
    )
}
