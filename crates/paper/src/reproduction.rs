//! A reproduction from the items to the report.

use super::pace::{Outlook, Pace};
use super::part::{Job, Stamp, yardstick};
use super::plan::{Item, parts};
use super::results_reader::Results;
use crate::paper_report::{Report, report};
use asperity::batch::side_by_side;
use asperity::error::Error;
use asperity::output::write_whole;
use asperity::simulation::scene::Accuracy;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

/// The items to reproduce, and where.
#[derive(Clone, Copy, Debug)]
pub struct Options<'a> {
    /// The folder that holds the parts and the report. Completed parts are cached there; interrupted runs
    /// resume.
    pub out: &'a Path,
    /// Figures and tables, of [`super::plan::items`].
    pub items: &'a [Item],
    /// Accuracy of the crushes and of the sweep.
    pub accuracy: Accuracy,
    /// True where the observer is told how long each part takes, which costs a few small crushes.
    pub estimate: bool,
}

/// A part before it is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    /// Name of the part and of its folder.
    pub name: &'static str,
    /// Items that need it.
    pub serves: &'static [&'static str],
    /// Seconds it takes on one core; `None` if it is done.
    pub seconds: Option<f64>,
}

/// News for the observer; parts run side by side.
#[derive(Clone, Copy, Debug)]
pub enum News<'a> {
    /// Every part, before the first begins.
    Planned(&'a [Planned]),
    /// A part has done a share (0 to 1) of its work.
    Reached {
        /// Name of the part.
        part: &'static str,
        /// Share that is done.
        share: f64,
        /// Its place.
        message: &'a str,
        /// The remaining work of all parts; `None` without an estimate.
        outlook: Option<Outlook>,
    },
    /// A part has ended.
    Ended {
        /// Name of the part.
        part: &'static str,
        /// Its stamp, or why it could not be done.
        outcome: &'a Result<Stamp, Error>,
        /// The remaining work of all parts; `None` without an estimate.
        outlook: Option<Outlook>,
    },
}

/// A report and the parts behind it.
#[derive(Debug)]
pub struct Reproduction {
    /// Every part in the order of the plan, with its stamp or the reason why it could not be done; parts that
    /// were not begun are absent.
    pub parts: Vec<(&'static str, Result<Stamp, Error>)>,
    /// The report with its claims, as written to `report/`.
    pub report: Report,
}

/// Computes the parts that the items need and writes `report/index.html` (with `claims.json`, `claims.md`,
/// `numbers.md`).
///
/// Parts that are done are not computed again; a part that fails is missing from the report and has its error
/// in the result. `observer` is called from several threads; `false` begins no further parts.
///
/// # Errors
/// A folder that cannot be written, a chart that cannot be drawn.
pub fn reproduce(
    options: &Options<'_>,
    observer: &(dyn Fn(&News<'_>) -> bool + Sync),
) -> Result<Reproduction, Error> {
    let folder = options.out.join("parts");
    fs::create_dir_all(&folder).map_err(|e| Error::disk(&folder, e))?;
    let program = program_hash();
    let jobs = parts(options.items)
        .into_iter()
        .map(|part| Job::new(part, options.accuracy, &folder, program))
        .collect::<Result<Vec<Job>, Error>>()?;
    let planned = if options.estimate { plan(&jobs)? } else { Vec::new() };
    let cores = rayon::current_num_threads();
    let pace = Pace::new(planned.iter().map(|part| part.seconds.unwrap_or(0.0)), cores);
    let reach = |i: usize, share: f64| options.estimate.then(|| pace.reach(i, share));
    let stopped = AtomicBool::new(options.estimate && !observer(&News::Planned(&planned)));
    let one = |i: usize| {
        let (job, part) = (&jobs[i], jobs[i].part.name);
        if let Some(stamp) = job.done() {
            return Some((i, part, Ok(stamp)));
        }
        if stopped.load(Ordering::Relaxed) {
            return None;
        }
        pace.begin(i);
        let outcome = job.run(&mut |share, message| {
            observer(&News::Reached { part, share, message, outlook: reach(i, share) })
        });
        if !observer(&News::Ended { part, outcome: &outcome, outlook: reach(i, 1.0) }) {
            stopped.store(true, Ordering::Relaxed);
        }
        Some((i, part, outcome))
    };
    let order: Vec<usize> = (0..jobs.len()).collect();
    let mut parts: Vec<_> = side_by_side(cores, &order, &one).into_iter().flatten().collect();
    parts.sort_by_key(|(i, ..)| *i);
    let report =
        report(&Results::read(&folder, &jobs), options.items, options.accuracy).map_err(Error::Unfinished)?;
    report.write(&options.out.join("report"))?;
    Ok(Reproduction { parts: parts.into_iter().map(|(_, part, outcome)| (part, outcome)).collect(), report })
}

/// A number that changes with the program: results of another build are not taken for those of this one.
fn program_hash() -> u64 {
    let mut hasher = DefaultHasher::new();
    std::env::current_exe().and_then(fs::read).ok().hash(&mut hasher);
    env!("CARGO_PKG_VERSION").hash(&mut hasher);
    hasher.finish()
}

/// Every part with the time it takes on this machine.
fn plan(jobs: &[Job]) -> Result<Vec<Planned>, Error> {
    let open = jobs.iter().any(|job| job.done().is_none());
    let (seconds, single) = if open { yardstick()? } else { (0.0, 1.0) };
    let planned = |job: &Job| Planned {
        name: job.part.name,
        serves: job.part.serves,
        seconds: job.done().is_none().then(|| seconds * job.effort(single)),
    };
    Ok(jobs.iter().map(planned).collect())
}

impl Report {
    /// Writes the files, each whole or as it was.
    fn write(&self, folder: &Path) -> Result<(), Error> {
        fs::create_dir_all(folder).map_err(|e| Error::disk(folder, e))?;
        let files = [
            ("index.html", &self.html),
            ("claims.json", &self.claims_json),
            ("claims.md", &self.claims_markdown),
            ("numbers.md", &self.numbers_markdown),
        ];
        files.iter().try_for_each(|(name, text)| write_whole(&folder.join(name), text.as_bytes()))
    }
}
