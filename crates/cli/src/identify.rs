//! `asperity identify`: from measured curves to the metal.

use crate::flags::{ReportFlag, RunFlags, told_of_table};
use crate::folder::Folder;
use crate::progress::Line;
use crate::{interrupt, terminal};
use asperity::error::{Error, InputError};
use asperity::identify::{Fit, identify as find};
use clap::Args;
use std::path::PathBuf;

/// Arguments of `asperity identify`.
#[derive(Debug, Args)]
pub struct Identify {
    /// Fit file (TOML); `asperity new fit` writes one
    pub fit: Option<PathBuf>,
    /// Finite elements that give the answer: draft (1 % of a cone's force) or standard (0.5 %) [default: what the file says, else standard]
    #[arg(long, value_name = "LEVEL", value_parser = ["draft", "standard"], hide_possible_values = true)]
    pub accuracy: Option<String>,
    /// Change a value of the file, for example --set material.poissons_ratio=0.3; repeatable
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
/// Input that is wrong (nothing is written), or a search that could not finish.
pub fn identify(args: &Identify) -> Result<(), Error> {
    let Some(path) = &args.fit else {
        let help = "asperity new fit writes fit.toml, a commented fit to start from; then: asperity identify fit.toml";
        return Err(InputError::new("Missing fit file.").help(help).into());
    };
    let accuracy = args.accuracy.iter().map(|level| format!("accuracy={level}"));
    let changes: Vec<String> = args.overrides.iter().cloned().chain(accuracy).collect();
    let fit = Fit::read(path, &changes).map_err(|e| {
        let name = path.display();
        let help =
            format!("asperity new fit writes a commented fit.toml; give a [[curve]] of it file = \"{name}\"");
        told_of_table(e, path, help)
    })?;
    let out = args.run.target(&fit.name());
    let folder = Folder::create(&out, "identify", args.run.force)?;
    interrupt::catch();
    let progress = Line::new(args.run.quiet);
    let found = find(fit, &mut |share, text| {
        progress.show(share, || text.to_string());
        !interrupt::requested()
    });
    progress.finish();
    let found = found.map_err(|e| if interrupt::requested() { stopped() } else { e });
    let found = folder.fill(found, |found, sink| {
        found.write(sink)?;
        args.page.write(sink, || found.report())
    })?;
    if !args.run.quiet {
        found.notes.iter().for_each(terminal::warn);
    }
    args.run.say(&out, || found.to_json(), || found.overview())
}

/// The error of a search that an interrupt ended.
fn stopped() -> Error {
    let reason = "stopped: a search keeps nothing on its way, so that nothing was written and the same command begins anew; \
        with --accuracy draft it is quicker";
    Error::Unfinished(reason.into())
}
