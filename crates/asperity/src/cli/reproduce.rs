//! `asperity reproduce`: the figures and tables of the paper, computed and written up.

use crate::cli::failure;
use crate::cli::flags::{RunFlags, parse_accuracy};
use crate::cli::progress::{Lines, Progress as Line};
use crate::cli::terminal;
use crate::error::{Error, InputError};
use crate::reproduce::part::Stamp;
use crate::reproduce::plan::{ITEMS, items};
use crate::reproduce::{Options, Planned, Progress};
use asperity_solver::scene::Accuracy;
use clap::Args;
use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Names the command that a folder belongs to.
const MARK: &str = ".asperity-run";

/// Arguments of `asperity reproduce`.
#[derive(Debug, Args)]
pub struct Reproduce {
    /// Error of the force: draft (5 %), standard (1 %), reference (0.2 %) or a percentage like 0.5% [default: standard]
    #[arg(long, value_name = "LEVEL", value_parser = parse_accuracy)]
    pub accuracy: Option<Accuracy>,
    /// Only these figures and tables, for example fig6,table1 [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub only: Vec<String>,
    /// Print the names that --only takes
    #[arg(long)]
    pub list: bool,
    #[command(flatten)]
    pub run: RunFlags,
}

/// Runs the command.
///
/// # Errors
/// Input that is wrong, or parts that could not be done; the report is written with what there is.
pub fn reproduce(args: &Reproduce) -> Result<(), Error> {
    if args.list {
        let lines = ITEMS.map(|item| format!("{:<8} {}", item.name, item.title));
        terminal::say(&lines.join("\n"));
        return Ok(());
    }
    let (items, quiet) = (items(&args.only)?, args.run.quiet);
    let accuracy = args.accuracy.unwrap_or_default();
    let target = args.run.out.clone().unwrap_or_else(|| PathBuf::from("out/reproduce"));
    let _mark = claim_folder(&target, args.run.force)?;
    let (start, lines, open) = (Instant::now(), Lines::new(quiet), Mutex::new(HashMap::<_, Line>::new()));
    let options = Options { out: &target, items: &items, accuracy, estimate: !quiet };
    let done = crate::reproduce::reproduce(&options, &|progress| {
        let mut open = open.lock().unwrap_or_else(PoisonError::into_inner);
        match progress {
            Progress::Planned(parts) => announce(parts, accuracy),
            Progress::Reached { part, share, message } => {
                open.entry(*part).or_insert_with(|| lines.add(part)).show(*share, || message.to_string());
            }
            Progress::Ended { part, outcome } => {
                open.remove(part).into_iter().for_each(Line::finish);
                if !quiet {
                    lines.say(&format!("{part:<28} {}", ending(outcome)));
                }
            }
        }
        true
    })?;
    if args.run.json {
        terminal::say(done.report.claims_json.trim_end());
    } else if !quiet {
        terminal::say(done.report.overview.trim_end());
        let path = target.join("report/index.html");
        terminal::say(&format!("report    {} ({:.0} s)", path.display(), start.elapsed().as_secs_f64()));
    }
    let unfinished = done.parts.into_iter().filter_map(|(name, outcome)| match outcome {
        Ok(stamp) => stamp.stopped.map(|why| format!("{name}: {why}")),
        Err(error) => Some(format!("{name}: {}", failure::report(error).trim())),
    });
    let unfinished: Vec<String> = unfinished.collect();
    if unfinished.is_empty() { Ok(()) } else { Err(Error::Unfinished(unfinished.join("\nasperity: "))) }
}

fn ending(outcome: &Result<Stamp, Error>) -> String {
    match outcome {
        Ok(Stamp { stopped: Some(why), .. }) => why.clone(),
        Ok(stamp) => format!("{:.1} s", stamp.wall_s),
        Err(_) => "could not be done".into(),
    }
}

/// Marks the folder as ours and holds it as long as the mark is held.
fn claim_folder(target: &Path, force: bool) -> Result<fs::File, InputError> {
    let name = target.display();
    let error = |e: std::io::Error| {
        InputError::new(format!("cannot write to {name}: {e}"))
            .help("give a folder you may write to with --out")
    };
    fs::create_dir_all(target).map_err(error)?;
    let path = target.join(MARK);
    let ours = fs::read_to_string(&path).is_ok_and(|mark| mark.starts_with("reproduce"));
    if !ours
        && !force
        && let Some(Ok(entry)) = fs::read_dir(target).map_err(error)?.next()
    {
        let file = entry.file_name();
        return Err(InputError::new(format!(
            "{name} holds {}, which no run of this command made: nothing was written",
            file.to_string_lossy()
        ))
        .help("give another folder with --out, or --force to write there"));
    }
    let mark = fs::OpenOptions::new().append(true).create(true).open(&path).map_err(error)?;
    if let Err(fs::TryLockError::WouldBlock) = mark.try_lock() {
        return Err(InputError::new(format!("another run is writing to {name}"))
            .help("wait for it, or give another folder with --out"));
    }
    if !ours {
        fs::write(&path, "reproduce\n").map_err(error)?;
    }
    Ok(mark)
}

/// Says what will run and how long it takes.
fn announce(parts: &[Planned], accuracy: Accuracy) {
    let open: Vec<f64> = parts.iter().filter_map(|part| part.seconds).collect();
    let count = parts.len();
    if open.is_empty() {
        terminal::complain(&format!("all {count} parts are done at {accuracy}: only the report is written"));
        return;
    }
    for part in parts {
        let time = part.seconds.map_or_else(|| "done".into(), |s| format!("about {}", duration(s)));
        terminal::complain(&format!("  {:<28} {time:<16} {}", part.name, part.serves.join(" ")));
    }
    let cores = rayon::current_num_threads();
    terminal::complain(&format!(
        "{count} parts at {accuracy}, {} of them done; about {} on {cores} cores",
        count - open.len(),
        duration(open.iter().sum::<f64>() / cores as f64)
    ));
}

fn duration(seconds: f64) -> String {
    if seconds < 100.0 { format!("{:.0} s", seconds.max(1.0)) } else { format!("{:.0} min", seconds / 60.0) }
}
