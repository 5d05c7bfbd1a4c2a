//! `asperity calibrate`: the sweep of crushed cones, the representative strain, and the coefficient for
//! `rough`.

use crate::flags::{ReportFlag, RunFlags, SceneFlags};
use crate::folder::{Folder, journal_beside};
use crate::progress::BatchProgress;
use asperity::batch::Shard;
use asperity::calibrate::{Calibration, CaseRow, Options, calibrate as run, merge, read_sweep};
use asperity::error::{Error, InputError};
use asperity::{Observer, Progress};
use asperity_paper::sensitivity;
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};

/// Help of the flag that changes a sweep.
const SET: &str = "Change a value of the sweep, for example --set slopes_deg=[2,5]; repeatable";
/// A sweep knows three resolutions, where a scene has one for every percentage.
const ACCURACY: &str = "Error of K: draft (5 %), standard (1 %) or reference (0.2 %); a percentage takes the next finer of these \
    [default: what the sweep says, else standard]";

/// Arguments of `asperity calibrate`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, mut_arg("accuracy", |a| a.help(ACCURACY)), mut_arg("overrides", |a| a.help(SET)))]
pub struct Calibrate {
    #[command(subcommand)]
    pub merge: Option<Joining>,
    /// Sweep file (TOML) [default: the 480 cases of slopes 1 to 10 degrees]
    pub sweep: Option<PathBuf>,
    /// Solve only part K of N, for the tasks of an array job; join the folders with `asperity calibrate merge`
    #[arg(long, value_name = "K/N", value_parser = clap::value_parser!(Shard))]
    pub shard: Option<Shard>,
    /// Sensitivity of c: a table over laws, tools, exponents and ranges of E over yield stress, from 1800 cases
    #[arg(long, conflicts_with_all = ["sweep", "shard", "slope", "overrides"])]
    pub dependence: bool,
    /// Slope in degrees that collapse.svg shows [default: the largest]
    #[arg(long, value_name = "DEGREES")]
    pub slope: Option<f64>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    #[command(flatten)]
    pub page: ReportFlag,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Subcommands of `calibrate`.
#[derive(Debug, Subcommand)]
pub enum Joining {
    /// Join the folders that `--shard` has written and fit them as one sweep
    Merge(Merge),
}

/// Arguments of `asperity calibrate merge`.
#[derive(Debug, Args)]
pub struct Merge {
    /// Folders of all parts
    #[arg(required = true)]
    pub parts: Vec<PathBuf>,
    /// Slope in degrees that collapse.svg shows [default: the largest]
    #[arg(long, value_name = "DEGREES")]
    pub slope: Option<f64>,
    #[command(flatten)]
    pub page: ReportFlag,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or a disk that refuses (finished cases stay in the journal).
pub fn calibrate(args: &Calibrate) -> Result<(), Error> {
    match &args.merge {
        Some(Joining::Merge(Merge { parts, slope, page, run })) => {
            let target = run.target("calibrate");
            let calibration = merge(parts, *slope)?;
            let folder = Folder::create(&target, "calibrate", run.force)?;
            finish(Ok(calibration), folder, page, run, &target)
        }
        None if args.dependence => dependence(args),
        None => sweep(args),
    }
}

fn sweep(args: &Calibrate) -> Result<(), Error> {
    let mut sweep = read_sweep(args.sweep.as_deref(), &args.scene_flags.overrides)?;
    if let Some(level) = args.scene_flags.accuracy {
        sweep.accuracy = level;
    }
    if let Some(slope) = args.slope.filter(|slope| !sweep.slopes_deg.contains(slope)) {
        let help = format!("it has {:?}", sweep.slopes_deg);
        return Err(InputError::new(format!("--slope {slope} is no slope of the sweep")).help(help).into());
    }
    let name = args.sweep.as_ref().and_then(|path| path.file_stem()).map(|stem| stem.to_string_lossy());
    let name = name.as_deref().unwrap_or("calibrate");
    let part = args.shard.map_or_else(String::new, Shard::suffix);
    let target = args.run.target(&format!("{name}{part}"));
    let folder = Folder::create(&target, "calibrate", args.run.force)?;
    let options = Options { part: args.shard, shown_slope_deg: args.slope, ..options(&args.run, &target) };
    let result = observed(&options, args.run.quiet, |observer| run(&sweep, &options, observer));
    finish(result, folder, &args.page, &args.run, &target)
}

fn dependence(args: &Calibrate) -> Result<(), Error> {
    let target = args.run.target("dependence");
    let folder = Folder::create(&target, "calibrate", args.run.force)?;
    let options = options(&args.run, &target);
    let accuracy = args.scene_flags.accuracy.unwrap_or_default();
    let result = observed(&options, args.run.quiet, |observer| sensitivity(accuracy, &options, observer));
    let found = folder.fill(result, |found, folder| {
        found.write(folder)?;
        args.page.write(folder, || found.report())
    })?;
    found.remove_journals();
    args.run.say(&target, || found.json(), || found.text())
}

fn options(flags: &RunFlags, target: &Path) -> Options {
    let threads = flags.threads.map_or(0, usize::from);
    Options { threads, journal: Some(journal_beside(target)), ..Options::default() }
}

/// Runs `work` with a line that shows its progress; work that an interrupt ended is an error that says how to
/// go on.
fn observed<T>(
    options: &Options,
    quiet: bool,
    work: impl FnOnce(&mut Observer<'_, CaseRow>) -> Result<T, Error>,
) -> Result<T, Error> {
    let journal = options.journal.clone().unwrap_or_default();
    let mut progress = BatchProgress::new(quiet, ["case", "cases"], journal);
    let result = work(&mut |reached: &Progress<'_, CaseRow>| {
        progress.show(reached, |row| format!("{} degrees", row.beta_deg))
    });
    let stopped = progress.finish();
    result.and_then(|done| stopped.map_or(Ok(done), Err))
}

fn finish(
    result: Result<Calibration, Error>,
    folder: Folder,
    page: &ReportFlag,
    flags: &RunFlags,
    target: &Path,
) -> Result<(), Error> {
    let done = folder.fill(result, |calibration, folder| {
        calibration.write(folder)?;
        page.write(folder, || calibration.report())
    })?;
    done.remove_journal();
    flags.say(target, || done.json(), || done.text())
}
