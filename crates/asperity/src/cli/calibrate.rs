//! `asperity calibrate`: the sweep of crushed cones, the representative strain, and the coefficient for `rough`.

pub use crate::calibrate::results::Calibration;
use crate::cli::flags::{RunFlags, SceneFlags};
use crate::cli::folder::{Folder, journal_beside};
use crate::cli::progress::Progress;
use crate::cli::terminal;
use crate::error::{Error, InputError};
use crate::input::toml_file::TomlFile;
use asperity_calibration::case::Case;
use asperity_calibration::journal::{Journal, fingerprint};
use asperity_calibration::row::Row;
use asperity_calibration::run::{run, shard};
use asperity_calibration::sweep::{Sweep, SweepError};
use clap::{Args, Subcommand};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// A sweep knows three resolutions, where a scene has one for every percentage.
const ACCURACY: &str = "Error of K: draft (5 %), standard (1 %) or reference (0.2 %); a percentage takes the next finer of these \
    [default: what the sweep says, else standard]";

/// Arguments of `asperity calibrate`.
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, mut_arg("accuracy", |a| a.help(ACCURACY)))]
pub struct Calibrate {
    #[command(subcommand)]
    pub merge: Option<Joining>,
    /// Sweep file (TOML) [default: the 480 cases of slopes 1 to 10 degrees]
    pub sweep: Option<PathBuf>,
    /// Solve only part K of N, for the tasks of an array job; join the folders with `asperity calibrate merge`
    #[arg(long, value_name = "K/N", value_parser = parse_shard)]
    pub shard: Option<(usize, usize)>,
    /// What c depends on: a table over laws, tools, exponents and ranges of E over yield stress, from 1800 cases
    #[arg(long, conflicts_with_all = ["sweep", "shard", "slope", "overrides"])]
    pub dependence: bool,
    /// Slope in degrees that collapse.svg shows [default: the largest]
    #[arg(long, value_name = "DEGREES")]
    pub slope: Option<f64>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    #[command(flatten)]
    pub run: RunFlags,
}

/// What else `calibrate` does.
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
    pub run: RunFlags,
}

fn parse_shard(text: &str) -> Result<(usize, usize), String> {
    let parsed = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    match parsed {
        Some((k, n)) if (1..=n).contains(&k) => Ok((k, n)),
        _ => Err("write it as K/N with K from 1 to N, for example 2/8".into()),
    }
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong (nothing is written), or a disk that refuses (finished cases stay in the journal).
pub fn calibrate(args: &Calibrate) -> Result<(), Error> {
    match &args.merge {
        Some(Joining::Merge(merge)) => join(merge),
        None if args.dependence => crate::calibrate::dependence::run(args),
        None => sweep(args),
    }
}

fn sweep(args: &Calibrate) -> Result<(), Error> {
    let (sweep, name) = read_sweep(args)?;
    let all = sweep.cases();
    let cases = match args.shard {
        Some((k, n)) => shard(&all, k, n),
        None => all,
    };
    let default = match args.shard {
        Some((k, n)) => Path::new("out").join(format!("{name}-{k}-of-{n}")),
        None => Path::new("out").join(&name),
    };
    let target = args.run.out.clone().unwrap_or(default);
    let threads = args.run.threads.map_or(0, usize::from);
    let whole = args.shard.is_none();
    let order = Order { sweep: &sweep, cases: &cases, whole, shown: args.slope, threads };
    let calibration = order.fill(&target, args.run.force, args.run.quiet, Progress::new(args.run.quiet))?;
    report(&calibration, &args.run, &target, whole)
}

/// What is to be solved and fitted.
pub struct Order<'a> {
    /// The sweep that the cases are of.
    pub sweep: &'a Sweep,
    /// All of its cases, or a part.
    pub cases: &'a [Case],
    /// Whether they are all.
    pub whole: bool,
    /// Slope in degrees that collapse.svg shows.
    pub shown: Option<f64>,
    /// Threads, 0: all cores.
    pub threads: usize,
}

impl Order<'_> {
    /// Solves what the journal beside `target` does not hold yet, and fills `target`.
    ///
    /// # Errors
    /// A folder that is not ours, or a disk that refuses; finished cases stay in the journal.
    pub fn fill(
        &self,
        target: &Path,
        force: bool,
        quiet: bool,
        progress: Progress,
    ) -> Result<Calibration, Error> {
        let start = Instant::now();
        let mut folder = Folder::create(target, "calibrate", force)?;
        let path = journal_beside(target);
        let rows = match solve(self.cases, self.sweep, &path, self.threads, quiet, progress) {
            Ok(rows) => rows,
            Err(failure) => {
                folder.abandon();
                return Err(failure);
            }
        };
        let calibration = Calibration::new(self.sweep, rows, start.elapsed().as_secs_f64(), self.shown);
        calibration.write(&mut folder, self.whole)?;
        folder.publish()?;
        // the results are in their place: the journal has done its work
        let _ = std::fs::remove_file(&path);
        Ok(calibration)
    }
}

/// The sweep and the name of its results.
fn read_sweep(args: &Calibrate) -> Result<(Sweep, String), Error> {
    let overrides = &args.scene_flags.overrides;
    let (mut file, name): (TomlFile<Sweep>, String) = match &args.sweep {
        Some(path) => {
            let file: TomlFile<Sweep> = TomlFile::read(path, overrides)?;
            let name = file.stem();
            (file, name)
        }
        None => {
            // overrides apply to a file: an empty one stands for the defaults
            let text = "# all defaults\n".to_string();
            (TomlFile::parse(Path::new("default sweep"), text, overrides)?, "calibrate".into())
        }
    };
    if let Some(level) = args.scene_flags.accuracy {
        file.value.accuracy = level;
    }
    file.value.validate().map_err(|e: SweepError| file.error_at(&e.path, &e.message))?;
    Ok((file.value, name))
}

/// Solves what the journal does not hold yet.
pub fn solve(
    cases: &[Case],
    sweep: &Sweep,
    path: &Path,
    threads: usize,
    quiet: bool,
    progress: Progress,
) -> Result<Vec<Row>, Error> {
    // everything the rows depend on: the sweep, the discretisation of every case, and the program
    let numbers: Vec<_> = cases.iter().map(|c| c.discretisation(sweep.accuracy)).collect();
    let definition = format!("{} {sweep:?} {numbers:?}", env!("CARGO_PKG_VERSION"));
    let (journal, lines) = Journal::open(path, fingerprint(&definition))
        .map_err(|e| InputError::new(format!("cannot write the journal {}: {e}", path.display())))?;
    let done = Row::of_cases(cases, lines.iter().map(String::as_str));
    if !done.is_empty() && !quiet {
        terminal::complain(&format!("{} cases of an earlier run are in {}", done.len(), path.display()));
    }
    let finished = AtomicUsize::new(done.len());
    let journal = Mutex::new(journal);
    let rows = run(cases, sweep.accuracy, done, threads, |row| {
        let mut journal = journal.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        journal.append(&row.to_csv())?;
        let count = finished.fetch_add(1, Ordering::Relaxed) + 1;
        progress.show(count as f64 / cases.len().max(1) as f64, || {
            format!("case {count} of {}: {} degrees", cases.len(), row.case.beta_deg)
        });
        Ok(())
    });
    progress.finish();
    rows.map_err(|e: std::io::Error| {
        Error::Unfinished(format!(
            "cannot write the journal {}: {e}; it keeps every case that was finished, and the same command goes on \
             from there",
            path.display()
        ))
    })
}

fn join(args: &Merge) -> Result<(), Error> {
    let start = Instant::now();
    let mut sweep: Option<Sweep> = None;
    let mut lines: HashMap<String, String> = HashMap::new();
    for part in &args.parts {
        let wrong = |file: &str, why: &str| {
            InputError::new(format!("{}: {why}", part.join(file).display()))
                .help("give the folders that `asperity calibrate --shard K/N` has written")
        };
        let read = |file: &str| {
            std::fs::read_to_string(part.join(file)).map_err(|e| wrong(file, &format!("cannot be read: {e}")))
        };
        let of_part: Sweep =
            serde_json::from_str(&read("sweep.json")?).map_err(|e| wrong("sweep.json", &e.to_string()))?;
        if sweep.as_ref().is_some_and(|s| *s != of_part) {
            return Err(wrong("sweep.json", "is another sweep than that of the parts before").into());
        }
        sweep = Some(of_part);
        for line in read("cases.csv")?.lines().skip(1) {
            lines.insert(Row::key_of(line).to_string(), line.to_string());
        }
    }
    let Some(sweep) = sweep else { return Err(InputError::new("no parts were given").into()) };
    let cases = sweep.cases();
    let found = |case: &Case| lines.get(&Row::key(case)).and_then(|line| Row::from_csv(line, case));
    let rows: Vec<Row> = cases.iter().filter_map(found).collect();
    if rows.len() < cases.len() {
        let missing = cases.iter().find(|c| found(c).is_none()).map(Row::key).unwrap_or_default();
        return Err(InputError::new(format!(
            "{} of {} cases are in none of the parts; the first is {missing}",
            cases.len() - rows.len(),
            cases.len()
        ))
        .help("give the folders of all parts")
        .into());
    }
    let target = args.run.out.clone().unwrap_or_else(|| PathBuf::from("out/calibrate"));
    let mut folder = Folder::create(&target, "calibrate", args.run.force)?;
    let calibration = Calibration::new(&sweep, rows, start.elapsed().as_secs_f64(), args.slope);
    calibration.write(&mut folder, true)?;
    folder.publish()?;
    report(&calibration, &args.run, &target, true)
}

fn report(calibration: &Calibration, flags: &RunFlags, target: &Path, whole: bool) -> Result<(), Error> {
    if flags.json {
        terminal::say(calibration.json()?.trim_end());
    } else if !flags.quiet {
        terminal::say(&calibration.text(whole));
        terminal::say(&format!("results   {}", target.display()));
    }
    Ok(())
}
