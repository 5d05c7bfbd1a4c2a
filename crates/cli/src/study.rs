//! `asperity study`: a scene over any of its keys.

use crate::flags::{RunFlags, SceneFlags};
use crate::folder::claim;
use crate::progress::BatchProgress;
use asperity::error::{Error, InputError};
use asperity::output::Directory;
use asperity::study::{
    Options, Plan, SampleKind, SampleTable, Shard, Study as Runs, StudyFile, Subject, Vary, merge,
    study as run,
};
use clap::{Args, Subcommand};
use std::path::{Path, PathBuf};

/// Help of the flag that changes a scene of any kind.
const SET: &str =
    "Change a value of the scene in all runs, for example --set material.poissons_ratio=0.3; repeatable";

/// Arguments of `asperity study`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, mut_arg("overrides", |a| a.help(SET)))]
pub struct Study {
    #[command(subcommand)]
    pub merge: Option<Joining>,
    /// Study file (TOML), or a scene of any kind with --vary
    #[arg(required = true)]
    pub file: Option<PathBuf>,
    /// A key and its values, "KEY=V1,V2,…" or "KEY=A..B/N", for example "loading.depth=1 um..5 um/5"; repeatable
    #[arg(long, value_name = "KEY=VALUES")]
    pub vary: Vec<String>,
    /// grid (every combination), list (values in step), lhs N (Latin hypercube) or sobol N; drawn from ranges "KEY=A..B"
    #[arg(long, num_args = 1..=2, value_names = ["KIND", "N"])]
    pub sample: Vec<String>,
    /// Seed of the Latin hypercube
    #[arg(long, value_name = "SEED", requires = "sample")]
    pub seed: Option<u64>,
    /// Keep the curve of every run in DIR/curves
    #[arg(long)]
    pub curves: bool,
    /// Column of results.csv that the picture shows
    #[arg(long, value_name = "COLUMN")]
    pub show: Option<String>,
    /// Run only part K of N, for the tasks of an array job; join the folders with `asperity study merge`
    #[arg(long, value_name = "K/N", value_parser = clap::value_parser!(Shard))]
    pub shard: Option<Shard>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Subcommands of `study`.
#[derive(Debug, Subcommand)]
pub enum Joining {
    /// Join the folders that `--shard` has written
    Merge(Merge),
}

/// Arguments of `asperity study merge`.
#[derive(Debug, Args)]
pub struct Merge {
    /// Folders of all parts
    #[arg(required = true)]
    pub parts: Vec<PathBuf>,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or a study that was ended or a disk that refuses (finished runs
/// are kept).
pub fn study(args: &Study) -> Result<(), Error> {
    match (&args.merge, &args.file) {
        (Some(Joining::Merge(Merge { parts, run })), _) => {
            let joined = merge(parts)?;
            let target = run.target("study");
            let mark = claim(&target, "study", run.force)?;
            joined.copy_curves(parts, &target)?;
            let done = finish(Ok(joined), None, &target, run);
            drop(mark);
            done
        }
        (None, Some(file)) => sweep(args, file),
        (None, None) => Err(InputError::new("a study or scene file is missing").into()),
    }
}

fn sweep(args: &Study, path: &Path) -> Result<(), Error> {
    let file = StudyFile::read(path)?;
    let plan = plan(args, &file)?;
    let stem = |path: &Path| path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = if file.scene == path { format!("{}-study", stem(path)) } else { stem(path) };
    let part = args.shard.map_or_else(String::new, Shard::suffix);
    let target = args.run.target(&format!("{name}{part}"));
    let mark = claim(&target, "study", args.run.force)?;
    let mut progress = BatchProgress::new(args.run.quiet, ["run", "runs"], target.clone());
    let options = Options {
        threads: args.run.threads.map_or(0, usize::from),
        part: args.shard,
        folder: Some(target.clone()),
    };
    let result = run(&plan, &options, &mut |reached| progress.show(reached, |_| String::new()));
    let stopped = progress.finish();
    let done = finish(result, stopped, &target, &args.run);
    drop(mark);
    done
}

fn plan(args: &Study, file: &StudyFile) -> Result<Plan, Error> {
    let overrides = [file.overrides(), args.scene_flags.changes()].concat();
    let subject = Subject::read(&file.scene, &overrides)?;
    let given = args.vary.iter().map(|text| Vary::parse(text)).collect::<Result<Vec<_>, _>>()?;
    let mut vary = file.vary()?;
    // a key of the file that is given anew takes the values of the flag
    vary.retain(|one| given.iter().all(|other| other.key != one.key));
    vary.extend(given);
    let set = |key: &str| overrides.iter().any(|text| text.split('=').next().map(str::trim) == Some(key));
    if let Some(one) = vary.iter().find(|one| set(&one.key)) {
        let message = format!("{}: is varied and has one value for all runs", one.key);
        return Err(InputError::new(message).help("leave out one of the two").into());
    }
    let sample = match &args.sample[..] {
        [] => file.sample.clone(),
        words => SampleTable { seed: args.seed.unwrap_or(0), ..parse_sample(words)? },
    };
    let mut plan = Plan::new(subject, vary, sample.sample()?)?;
    if args.curves || file.curves {
        plan = plan.with_curves();
    }
    Ok(match args.show.as_ref().or(file.show.as_ref()) {
        Some(column) => plan.showing(column),
        None => plan,
    })
}

fn parse_sample(words: &[String]) -> Result<SampleTable, InputError> {
    let kind = match words[0].as_str() {
        "grid" => SampleKind::Grid,
        "list" => SampleKind::List,
        "lhs" => SampleKind::Lhs,
        "sobol" => SampleKind::Sobol,
        other => {
            return Err(InputError::new(format!("--sample: `{other}` is no way to combine values"))
                .help("give grid, list, lhs N or sobol N"));
        }
    };
    let points = words.get(1).map(|text| {
        let wrong = || InputError::new(format!("--sample: `{text}` is no number of points"));
        text.parse().map_err(|_| wrong().help("for example --sample lhs 100"))
    });
    Ok(SampleTable { kind, points: points.transpose()?, seed: 0 })
}

/// Writes what was found; `stopped` is the error of a study that was ended.
fn finish(
    result: Result<Runs, Error>,
    stopped: Option<Error>,
    target: &Path,
    flags: &RunFlags,
) -> Result<(), Error> {
    let done = result?;
    done.write(&mut Directory::create(target)?)?;
    if let Some(stopped) = stopped {
        return Err(stopped);
    }
    flags.say(target, || done.json(), || done.text())
}
