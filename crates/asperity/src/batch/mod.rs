//! Many runs that do not depend on each other: one journal, one resume, one way to share them among tasks.
//!
//! Every finished run is a line of the journal, forced to the disk, under a key that says which run it is. A
//! run that is found there is not run again, so that a killed batch resumes and a batch that has grown runs
//! only what is new.

pub use asperity_formats::journal;

use crate::batch::journal::{Journal, Opened};
use crate::error::{Error, InputError};
use crate::progress::{Observer, Progress};
use crate::results::output::open_journal;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::collections::{HashMap, HashSet};
use std::fmt::{self, Display};
use std::io;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Part k of n (k from 1) of a batch: every n-th run, so that the parts take about equally long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    k: usize,
    n: usize,
}

impl Shard {
    /// Part `k` of `n`; `None` unless k lies from 1 to n.
    pub fn new(k: usize, n: usize) -> Option<Shard> {
        (1..=n).contains(&k).then_some(Shard { k, n })
    }

    /// The ending that makes the name of a folder its own: `-2-of-8`.
    pub fn suffix(self) -> String {
        format!("-{}-of-{}", self.k, self.n)
    }

    /// The numbers of its runs out of `runs`.
    pub(crate) fn case_numbers(part: Option<Shard>, runs: usize) -> impl Iterator<Item = usize> {
        let Shard { k, n } = part.unwrap_or(Shard { k: 1, n: 1 });
        (k - 1..runs).step_by(n)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let parsed = text.split_once('/').and_then(|(k, n)| Shard::new(k.parse().ok()?, n.parse().ok()?));
        parsed.ok_or_else(|| "write it as K/N with K from 1 to N, for example 2/8".into())
    }
}

impl Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.k, self.n)
    }
}

/// Runs one case; it may ask whether to go on.
pub(crate) type Solve<'a, C, R> = dyn Fn(&C, &dyn Fn() -> bool) -> Option<R> + Sync + 'a;

/// The work of a batch, and what each run leaves.
pub(crate) struct Batch<'a, C, R> {
    /// All that the results depend on beside the keys: a journal of another definition is begun anew.
    pub definition: &'a str,
    /// The runs, in the order of the results.
    pub cases: &'a [C],
    /// Names a run; those of equal names are run once.
    pub key: &'a (dyn Fn(&C) -> String + Sync),
    /// Runs one; it may ask whether to go on, and gives `None` where it was told not to.
    pub solve: &'a Solve<'a, C, R>,
    /// Threads, 0: all cores.
    pub threads: usize,
    /// File that keeps finished runs.
    pub journal: Option<&'a Path>,
}

/// The results of a batch.
pub(crate) struct Finished<R> {
    /// One for each run that is done, with its number among the cases, in their order.
    pub rows: Vec<(usize, R)>,
    /// True where the observer ended it before all were done.
    pub stopped: bool,
}

/// The state that the threads of a batch share.
struct Shared<'a, 'o, R> {
    journal: Option<Journal>,
    observer: &'a mut Observer<'o, R>,
    done: usize,
}

/// Runs all that the journal does not hold yet.
///
/// # Errors
/// A journal that cannot be written; it keeps every finished run.
pub(crate) fn run<C: Sync, R: Clone + Send + Sync + Serialize + DeserializeOwned>(
    batch: &Batch<'_, C, R>,
    observer: &mut Observer<'_, R>,
) -> Result<Finished<R>, Error> {
    let keys: Vec<String> = batch.cases.iter().map(batch.key).collect();
    let Resumed { mut rows, journal, notice } = resume(batch, &keys)?;
    // cases of one key are one run
    let mut seen = HashSet::new();
    let runs: Vec<usize> = (0..keys.len()).filter(|&i| seen.insert(keys[i].as_str())).collect();
    let open: Vec<usize> = runs.iter().copied().filter(|&i| !rows.contains_key(&keys[i])).collect();
    let (done, all) = (runs.len() - open.len(), runs.len());
    let first = Progress { notice: notice.as_deref(), ..Progress::counted(done, all, None) };
    let stop = AtomicBool::new(!observer(&first));
    let shared = Mutex::new(Shared { journal, observer, done });
    let lock = || shared.lock().unwrap_or_else(PoisonError::into_inner);
    let go_on = || {
        if !stop.load(Ordering::Relaxed) {
            let mut shared = lock();
            let done = shared.done;
            if !(shared.observer)(&Progress::counted(done, all, None)) {
                stop.store(true, Ordering::Relaxed);
            }
        }
        !stop.load(Ordering::Relaxed)
    };
    let one = |i: usize| -> io::Result<Option<(usize, R)>> {
        if stop.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let Some(row) = (batch.solve)(&batch.cases[i], &go_on) else { return Ok(None) };
        let mut shared = lock();
        if let Some(journal) = &mut shared.journal {
            let line = serde_json::to_string(&(&keys[i], &row)).map_err(io::Error::from);
            line.and_then(|line| journal.append(&line))
                .inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
        }
        shared.done += 1;
        let done = shared.done;
        if !(shared.observer)(&Progress::counted(done, all, Some(&row))) {
            stop.store(true, Ordering::Relaxed);
        }
        Ok(Some((i, row)))
    };
    let outcomes = side_by_side(batch.threads, &open, &one);
    for outcome in outcomes {
        if let Some((i, row)) = outcome.map_err(|e| refused(batch.journal, &e))? {
            rows.insert(keys[i].clone(), row);
        }
    }
    let rows: Vec<(usize, R)> =
        keys.iter().enumerate().filter_map(|(i, key)| Some((i, rows.get(key)?.clone()))).collect();
    Ok(Finished { stopped: rows.len() < keys.len(), rows })
}

/// The work of earlier starts.
struct Resumed<R> {
    /// Results that are wanted, under their keys.
    rows: HashMap<String, R>,
    journal: Option<Journal>,
    /// See [`Progress::notice`].
    notice: Option<String>,
}

/// Opens the journal of the batch, whose runs have these `keys`.
///
/// # Errors
/// A journal that cannot be written.
fn resume<C, R: DeserializeOwned>(batch: &Batch<'_, C, R>, keys: &[String]) -> Result<Resumed<R>, Error> {
    let Some(opened) = open_journal(batch.journal, batch.definition)? else {
        return Ok(Resumed { rows: HashMap::new(), journal: None, notice: None });
    };
    let wanted: HashSet<&str> = keys.iter().map(String::as_str).collect();
    let mut rows: HashMap<String, R> =
        opened.texts.iter().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let known = rows.len();
    rows.retain(|key, _| wanted.contains(key.as_str()));
    let notice = left_behind(&opened, known - rows.len());
    Ok(Resumed { rows, journal: Some(opened.journal), notice })
}

/// A word on what the journal holds and this work does not take up: another's runs, damaged lines, `others`,
/// the number of runs with other values.
fn left_behind(opened: &Opened, others: usize) -> Option<String> {
    let set_aside = opened.set_aside.as_ref().map(|old| {
        format!(
            "the runs of an earlier start had another scene, accuracy, definition or version of the program: their journal is kept as {}",
            old.display()
        )
    });
    let runs = |n: usize| if n == 1 { "1 run".to_string() } else { format!("{n} runs") };
    let damaged = (opened.damaged > 0)
        .then(|| format!("{} in the journal cannot be read and will be done again", runs(opened.damaged)));
    let others = (others > 0).then(|| {
        format!("{} with other values stay in the journal and are not in the results", runs(others))
    });
    let words: Vec<String> = [set_aside, damaged, others].into_iter().flatten().collect();
    (!words.is_empty()).then(|| words.join("; "))
}

/// Threads where `asked` are asked for: 0 stands for all cores.
pub(crate) fn thread_count(asked: usize) -> usize {
    if asked == 0 { rayon::current_num_threads() } else { asked }
}

/// The results of `one` for all of `open`, as they end, each on one thread: what a run does side by side in
/// itself is done one after the other, unless there are fewer runs than threads. `threads` is how many, 0 for
/// all cores.
pub fn side_by_side<T: Send>(threads: usize, open: &[usize], one: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let threads = thread_count(threads);
    let workers = threads.min(open.len()).max(1);
    let next = AtomicUsize::new(0);
    // a pool of its own for each: a thread of a common pool that waits for a part of its run would begin
    // another run
    let work = || {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads / workers).build().ok();
        let taken = std::iter::from_fn(|| open.get(next.fetch_add(1, Ordering::Relaxed)).copied());
        taken
            .map(|i| pool.as_ref().map_or_else(|| one(i), |pool| pool.install(|| one(i))))
            .collect::<Vec<T>>()
    };
    thread::scope(|scope| {
        // a thread that is not to be had leaves its runs to the others
        let spawned = (1..workers).map_while(|_| thread::Builder::new().spawn_scoped(scope, work).ok());
        let spawned: Vec<_> = spawned.collect();
        let mut done = work();
        for thread in spawned {
            done.extend(thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
        }
        done
    })
}

fn refused(journal: Option<&Path>, error: &io::Error) -> Error {
    let name = journal.map_or_else(String::new, |path| format!(" {}", path.display()));
    Error::unfinished(format!(
        "cannot write the journal{name}: {error}; it keeps every finished case, and the same command resumes from it"
    ))
}

/// The definition that all of `parts` share, and what each of them holds. `read` gives both of a folder.
///
/// # Errors
/// Those of `read`, parts of different definitions, or none.
pub(crate) fn parts<D: PartialEq, R>(
    parts: &[PathBuf],
    read: impl Fn(&Path) -> Result<(D, Vec<R>), InputError>,
) -> Result<(D, Vec<R>), InputError> {
    let mut joined: Option<(D, Vec<R>)> = None;
    for part in parts {
        let (definition, rows) = read(part)?;
        match &mut joined {
            Some((known, _)) if *known != definition => {
                let message = format!("{} is a part of another whole than those before", part.display());
                return Err(InputError::new(message).help("give the folders of one sweep or study"));
            }
            Some((_, all)) => all.extend(rows),
            None => joined = Some((definition, rows)),
        }
    }
    joined.ok_or_else(|| InputError::new("no parts were given"))
}

/// True where every one of `keys` is among the `found` runs of the parts.
///
/// # Errors
/// The number of those that are missing, and the first of them.
pub(crate) fn all_found<R>(keys: &[String], found: &HashMap<String, R>) -> Result<(), InputError> {
    let missing: Vec<&String> = keys.iter().filter(|key| !found.contains_key(*key)).collect();
    let Some(first) = missing.first() else { return Ok(()) };
    let message =
        format!("{} of {} runs are in none of the parts; the first is {first}", missing.len(), keys.len());
    let help =
        "give the folders of all parts; one that was killed goes on where it was when it is started again";
    Err(InputError::new(message).help(help))
}

/// The `file` of a folder is none of a part that `command` wrote.
pub(crate) fn not_a_part(command: &str, part: &Path, file: &str, why: impl Display) -> InputError {
    InputError::new(format!("{}: {why}", part.join(file).display()))
        .help(format!("give the folders that `asperity {command} --shard K/N` has written"))
}

/// The results that the journal at `path` holds of the batch of this definition, by their keys.
///
/// # Errors
/// A file that cannot be read.
pub(crate) fn read<R: DeserializeOwned>(path: &Path, definition: &str) -> io::Result<Vec<(String, R)>> {
    let lines = Journal::read(path, crate::batch::journal::fingerprint(definition))?;
    Ok(lines.iter().filter_map(|line| serde_json::from_str(line).ok()).collect())
}

/// The way a batch is run; its results do not depend on it.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Threads, 0: all cores.
    pub threads: usize,
    /// Only a part of the runs.
    pub part: Option<Shard>,
    /// Folder that keeps finished runs and their curves: a batch that was stopped resumes from it.
    pub folder: Option<PathBuf>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn squares(cases: &[u32], journal: &Path, solved: &AtomicUsize, most: usize) -> Finished<u32> {
        let batch = Batch {
            definition: "squares",
            cases,
            key: &|c: &u32| c.to_string(),
            solve: &|c: &u32, _: &dyn Fn() -> bool| {
                solved.fetch_add(1, Ordering::Relaxed);
                Some(c * c)
            },
            threads: 1,
            journal: Some(journal),
        };
        run(&batch, &mut |reached| reached.done < most).unwrap()
    }

    #[test]
    fn a_stopped_batch_resumes_and_a_grown_one_runs_what_is_new() {
        let dir = tempfile::tempdir().unwrap();
        let (journal, solved) = (dir.path().join("journal"), AtomicUsize::new(0));
        let first = squares(&[1, 2, 3, 4], &journal, &solved, 2);
        assert!(first.stopped && first.rows.len() == 2 && solved.load(Ordering::Relaxed) == 2);
        let second = squares(&[1, 2, 3, 4], &journal, &solved, 99);
        assert!(!second.stopped && solved.load(Ordering::Relaxed) == 4);
        assert_eq!(second.rows, [(0, 1), (1, 4), (2, 9), (3, 16)]);
        // 5 is new and stands twice, 9 is in no journal line
        let grown = squares(&[5, 4, 5, 1], &journal, &solved, 99);
        assert_eq!(
            (grown.rows, solved.load(Ordering::Relaxed)),
            (vec![(0, 25), (1, 16), (2, 25), (3, 1)], 5)
        );
    }

    #[test]
    fn every_run_is_in_one_part() {
        let mut all: Vec<usize> =
            (1..=3).flat_map(|k| Shard::case_numbers(Shard::new(k, 3), 8).collect::<Vec<_>>()).collect();
        all.sort_unstable();
        assert_eq!(all, (0..8).collect::<Vec<_>>());
        assert_eq!("2/3".parse(), Ok(Shard { k: 2, n: 3 }));
        for wrong in ["0/3", "4/3", "2", "a/b", "1/0"] {
            assert!(wrong.parse::<Shard>().unwrap_err().contains("2/8"), "{wrong}");
        }
    }
}
