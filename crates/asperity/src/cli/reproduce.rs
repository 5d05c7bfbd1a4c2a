//! `asperity reproduce`: what the paper shows, computed and written up.
//!
//! Parts of the work (`plan`) run side by side, each into a folder of its own with a stamp that says it is done
//! (`part`); the report reads those folders (`evidence`), judges the paper's claims (`claims`) and shows its figures
//! (`figures`, `report`).

use crate::cli::flags::{RunFlags, parse_accuracy};
use crate::cli::progress::Lines;
use crate::cli::terminal;
use crate::error::{Error, InputError};
use crate::output::write_whole;
use crate::reproduce::part::{Job, Stamp};
use crate::reproduce::plan::{ITEMS, Item};
use asperity_solver::scene::Accuracy;
use clap::Args;
use rayon::prelude::*;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
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
        let lines: Vec<String> =
            ITEMS.iter().map(|item| format!("{:<8} {}", item.name, item.title)).collect();
        terminal::say(&lines.join("\n"));
        return Ok(());
    }
    let only: Vec<String> = args.only.iter().map(|name| name.trim().to_lowercase()).collect();
    let items = crate::reproduce::plan::items(&only).map_err(|unknown| {
        let names: Vec<&str> = ITEMS.iter().map(|item| item.name).collect();
        let near = crate::input::suggest::nearest(&unknown, &names);
        let did_you = near.map_or_else(String::new, |near| format!("did you mean {near}? "));
        InputError::new(format!("--only: the paper has no `{unknown}` that can be computed"))
            .help(format!("{did_you}Known here: {}", names.join(", ")))
    })?;
    let accuracy = args.accuracy.unwrap_or_default();
    let target = args.run.out.clone().unwrap_or_else(|| PathBuf::from("out/reproduce"));
    let _mark = claim_folder(&target, args.run.force)?;
    let parts = target.join("parts");
    fs::create_dir_all(&parts).map_err(|e| Error::disk(&parts, e))?;
    let program = program_hash();
    let jobs: Result<Vec<Job>, Error> = crate::reproduce::plan::parts(&items)
        .into_iter()
        .map(|part| Job::new(part, accuracy, &parts, program))
        .collect();
    let jobs = jobs?;
    if !args.run.quiet {
        announce(&jobs, accuracy)?;
    }
    let start = Instant::now();
    let failures = run_all(&jobs, args.run.quiet);
    let report = write_report(&target, &parts, &items, &jobs, accuracy)?;
    if args.run.json {
        terminal::say(report.claims_json.trim_end());
    } else if !args.run.quiet {
        terminal::say(report.overview.trim_end());
        let path = target.join("report/index.html");
        terminal::say(&format!("report    {} ({:.0} s)", path.display(), start.elapsed().as_secs_f64()));
    }
    let stopped = jobs.iter().filter_map(|job| Some((job.part.name, job.done()?.stopped?)));
    let unfinished: Vec<String> =
        failures.into_iter().chain(stopped.map(|(name, why)| format!("{name}: {why}"))).collect();
    if unfinished.is_empty() { Ok(()) } else { Err(Error::Unfinished(unfinished.join("\nasperity: "))) }
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
    let mut entries = fs::read_dir(target).map_err(error)?;
    if !ours
        && !force
        && let Some(Ok(entry)) = entries.next()
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
        use std::io::Write;
        (&mark).write_all(b"reproduce\n").map_err(error)?;
    }
    Ok(mark)
}

/// A number that changes with the program: results of another build are not taken for those of this one.
fn program_hash() -> u64 {
    let mut hasher = DefaultHasher::new();
    let program = std::env::current_exe().and_then(fs::read);
    program.ok().hash(&mut hasher);
    env!("CARGO_PKG_VERSION").hash(&mut hasher);
    hasher.finish()
}

/// Says what will run and how long it takes.
fn announce(jobs: &[Job], accuracy: Accuracy) -> Result<(), Error> {
    let open: Vec<&Job> = jobs.iter().filter(|job| job.done().is_none()).collect();
    let level = accuracy.to_string();
    if open.is_empty() {
        terminal::complain(&format!(
            "all {} parts are done at {level}: only the report is written",
            jobs.len()
        ));
        return Ok(());
    }
    let (seconds, single) = crate::reproduce::part::yardstick()?;
    let cores = rayon::current_num_threads();
    let mut total = 0.0;
    for job in jobs {
        let serves = job.part.serves.join(" ");
        let time = if job.done().is_some() {
            "done".into()
        } else {
            let time = seconds * job.effort(single);
            total += time;
            format!("about {}", duration(time))
        };
        terminal::complain(&format!("  {:<28} {time:<16} {serves}", job.part.name));
    }
    let done = jobs.len() - open.len();
    terminal::complain(&format!(
        "{} parts at {level}, {done} of them done; about {} on {cores} cores",
        jobs.len(),
        duration(total / cores as f64)
    ));
    Ok(())
}

fn duration(seconds: f64) -> String {
    if seconds < 100.0 { format!("{:.0} s", seconds.max(1.0)) } else { format!("{:.0} min", seconds / 60.0) }
}

/// Runs what is not done, a part on each core, and says what is done in the order of the plan; the failures.
fn run_all(jobs: &[Job], quiet: bool) -> Vec<String> {
    let lines = Lines::new(quiet);
    let open: Vec<&Job> = jobs.iter().filter(|job| job.done().is_none()).collect();
    // outcomes wait until those before them are told
    let told: Mutex<(usize, Vec<Option<String>>)> = Mutex::new((0, vec![None; open.len()]));
    let mut failures: Vec<(usize, String)> = open
        .iter()
        .enumerate()
        .par_bridge()
        .filter_map(|(i, job)| {
            let name = job.part.name;
            let outcome = job.run(lines.add(name));
            let text = match &outcome {
                Ok(Stamp { wall_s, stopped: None, .. }) => format!("{name:<28} {wall_s:.1} s"),
                Ok(Stamp { stopped: Some(why), .. }) => format!("{name:<28} {why}"),
                Err(_) => format!("{name:<28} could not be done"),
            };
            if !quiet {
                let mut told = told.lock().unwrap_or_else(PoisonError::into_inner);
                told.1[i] = Some(text);
                while let Some(Some(text)) = told.1.get(told.0).cloned() {
                    lines.say(&text);
                    told.0 += 1;
                }
            }
            outcome
                .err()
                .map(|failure| (i, format!("{name}: {}", crate::cli::failure::report(failure).trim())))
        })
        .collect();
    failures.sort_by_key(|(i, _)| *i);
    failures.into_iter().map(|(_, text)| text).collect()
}

/// Reads the parts and writes the report, its claims as JSON and as a table for a page of text.
fn write_report(
    target: &Path,
    parts: &Path,
    items: &[Item],
    jobs: &[Job],
    accuracy: Accuracy,
) -> Result<crate::reproduce::report::Report, Error> {
    let evidence = crate::reproduce::evidence::Evidence::read(parts, jobs);
    let report = crate::reproduce::report::report(&evidence, items, accuracy).map_err(Error::Unfinished)?;
    let folder = target.join("report");
    fs::create_dir_all(&folder).map_err(|e| Error::disk(&folder, e))?;
    write_whole(&folder.join("index.html"), report.html.as_bytes())?;
    write_whole(&folder.join("claims.json"), report.claims_json.as_bytes())?;
    write_whole(&folder.join("claims.md"), report.claims_markdown.as_bytes())?;
    write_whole(&folder.join("numbers.md"), report.numbers_markdown.as_bytes())?;
    Ok(report)
}
