//! `asperity reproduce`: the figures and tables of the paper, computed and written up.

use crate::failure;
use crate::flags::{AccuracyParser, RunFlags};
use crate::folder::claim;
use crate::progress::{Line, Lines};
use crate::{interrupt, terminal};
use asperity::error::Error;
use asperity::simulation::scene::Accuracy;
use asperity_paper::pace::Outlook;
use asperity_paper::part::Stamp;
use asperity_paper::plan::{ITEMS, items, parts};
use asperity_paper::{News, Options, Planned};
use clap::Args;
use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// Arguments of `asperity reproduce`.
#[derive(Debug, Args)]
pub struct Reproduce {
    /// Error of the force: draft (5 %), standard (1 %), reference (0.2 %) or a percentage like 0.5% [default: standard]
    #[arg(long, value_name = "LEVEL", value_parser = AccuracyParser, hide_possible_values = true)]
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
        terminal::say(&lines.join("\n"))?;
        return Ok(());
    }
    let (items, quiet) = (items(&args.only)?, args.run.quiet);
    let accuracy = args.accuracy.unwrap_or_default();
    let target = args.run.target("reproduce");
    let _mark = claim(&target, "reproduce", args.run.force)?;
    interrupt::catch();
    let (start, lines, open) = (Instant::now(), Lines::new(quiet), Mutex::new(HashMap::<_, Line>::new()));
    let whole = lines.add_whole("all parts");
    let options = Options { out: &target, items: &items, accuracy, estimate: !quiet };
    let done = asperity_paper::reproduce(&options, &|progress| {
        let mut open = open.lock().unwrap_or_else(PoisonError::into_inner);
        match progress {
            News::Planned(parts) => announce(parts, accuracy),
            News::Reached { part, share, message, outlook } => {
                open.entry(*part).or_insert_with(|| lines.add(part)).show(*share, || message.to_string());
                outlook.iter().for_each(|all| whole.show(all.share, || left(*all)));
            }
            News::Ended { part, outcome, outlook } => {
                open.remove(part).into_iter().for_each(Line::finish);
                if !quiet {
                    let left = outlook.filter(|all| all.left > 0.0).map_or_else(String::new, left);
                    lines.say(format!("{part:<36} {:<10} {left}", ending(outcome)).trim_end());
                }
            }
        }
        !interrupt::requested()
    })?;
    whole.finish();
    if interrupt::requested() {
        let (all, place) = (parts(&items).len(), target.display());
        let done = done.parts.iter().filter(|(_, outcome)| outcome.is_ok()).count();
        if done < all {
            let reason = format!(
                "stopped: {done} of {all} parts are done and kept in {place}; the same command goes on from there"
            );
            return Err(Error::Unfinished(reason));
        }
    }
    if args.run.json {
        terminal::say(done.report.claims_json.trim_end())?;
    } else if !quiet {
        terminal::say(done.report.overview.trim_end())?;
        let path = target.join("report/index.html");
        terminal::say(&format!("report    {} ({:.0} s)", path.display(), start.elapsed().as_secs_f64()))?;
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
        Err(_) if interrupt::requested() => "stopped".into(),
        Err(_) => "could not be done".into(),
    }
}

/// The time that all parts still take, in words.
fn left(all: Outlook) -> String {
    format!("about {} left", duration(all.left))
}

/// Announces the parts and how long they take.
fn announce(parts: &[Planned], accuracy: Accuracy) {
    let open: Vec<f64> = parts.iter().filter_map(|part| part.seconds).collect();
    let count = parts.len();
    if open.is_empty() {
        terminal::complain(&format!("all {count} parts are done at {accuracy}: only the report is written"));
        return;
    }
    for part in parts {
        let time = part.seconds.map_or_else(|| "done".into(), |s| format!("about {}", duration(s)));
        terminal::complain(&format!("  {:<36} {time:<12} {}", part.name, part.serves.join(" ")));
    }
    let cores = rayon::current_num_threads();
    // no part is shared by cores
    let longest = open.iter().copied().fold(0.0, f64::max);
    terminal::complain(&format!(
        "{count} parts at {accuracy}, {} of them done; about {} on {cores} cores",
        count - open.len(),
        duration((open.iter().sum::<f64>() / cores as f64).max(longest))
    ));
}

fn duration(seconds: f64) -> String {
    if seconds < 100.0 { format!("{:.0} s", seconds.max(1.0)) } else { format!("{:.0} min", seconds / 60.0) }
}
