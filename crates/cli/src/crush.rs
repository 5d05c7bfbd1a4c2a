//! `asperity crush`: one scene from its file to a folder of results.

use crate::flags::{ReportFlag, RunFlags, SceneFlags};
use crate::folder::Folder;
use crate::progress::Line;
use crate::{interrupt, terminal};
use asperity::columns::Unit;
use asperity::crush::{CurveRow, Sketch, crush_into};
use asperity::error::{Error, InputError};
use asperity::identify::metal_override;
use asperity::simulation::scene::Symmetry;
use asperity::units::MICROMETRE;
use clap::Args;
use std::path::PathBuf;

/// Arguments of `asperity crush`.
#[derive(Debug, Args)]
pub struct Crush {
    /// Scene file (TOML); `asperity new single` writes one
    pub scene: Option<PathBuf>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    /// Take the metal of this fit.json, which asperity identify wrote, in place of the scene's [material]
    #[arg(long, value_name = "FIT.JSON")]
    pub metal: Option<PathBuf>,
    /// Run once, whatever errors it states [default: finer rounds until they are what the accuracy promises]
    #[arg(long)]
    pub no_refine: bool,
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
    let mut flags = args.scene_flags.clone();
    if let Some(fit) = &args.metal {
        // a value that is set by hand counts more
        flags.overrides.insert(0, metal_override(fit)?);
    }
    flags.overrides.extend(args.no_refine.then(|| "numerics.refine=false".to_string()));
    let scene = flags.read(path)?;
    if !args.run.quiet {
        scene.understood().iter().for_each(|line| terminal::complain(&format!("read {line}")));
        let tables = scene.tables();
        tables.unused().iter().chain(&tables.costly()).for_each(terminal::warn);
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
    let result = crush_into(&scene, &mut folder, &[Sketch::PEAK], &mut |reached| {
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
    if !args.run.quiet {
        summary.warnings().iter().for_each(terminal::warn);
    }
    args.run.say(&out, || summary.to_json(), || summary.overview())?;
    match summary.stopped {
        Some(reason) => Err(Error::Unfinished(format!("{reason}; what was reached is in {}", out.display()))),
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
