//! The solves of a run on disk, so that a run that was killed goes on where it was.
//!
//! Everything a run computes follows from its problem and the ends of its solves. A run that is taken up goes its whole way again and
//! recalls each solve instead of iterating, a small part of the work, up to the last one on disk. There it takes over what the solver
//! remembered (factors, secants) and goes on as if nothing had happened: no state of the path has to be stored, and none can be
//! forgotten.
//!
//! The folder holds `solves`, one after the other, and `solver`: the number of the problem, how many solves there are, and what the
//! solver remembered after the last of them. The second is replaced in one move, so that the two agree whenever the run is killed.
//! Past a length that the caller says no more solves are kept. Whatever does not agree is solved anew; a folder that cannot be written keeps nothing and stops no run.

use crate::setup::problem::Problem;
use asperity_numerics::newton::{Settings, solve};
use asperity_solver::equilibrium::Equilibrium;
use asperity_solver::equilibrium::solved::{Outcome, Solved};
use std::collections::hash_map::DefaultHasher;
use std::fmt::{self, Write as _};
use std::fs::{self, File, OpenOptions};
use std::hash::Hasher;
use std::io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write};
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Where a run keeps its solves, and how often it writes them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checkpoints {
    /// A folder of their own, made when the first of them is written.
    pub folder: PathBuf,
    /// Time to the first of them and between two; a shorter run writes none.
    pub every: Duration,
    /// Bytes of solves from which on no more of them are kept: a longer run is taken up where it had as many.
    pub largest: u64,
}

impl Checkpoints {
    /// Whether there are any.
    pub fn exist(&self) -> bool {
        self.folder.join(SOLVER).exists()
    }

    /// Removes them, which are of no use once the results of the run are in their place.
    pub fn remove(&self) {
        for name in [SOLVER, PARTIAL, SOLVES] {
            let _ = fs::remove_file(self.folder.join(name));
        }
        // only if it is empty
        let _ = fs::remove_dir(&self.folder);
    }
}

/// The files: what the solver remembers, the same while it is written, and the solves.
const SOLVER: &str = "solver";
const PARTIAL: &str = "solver.partial";
const SOLVES: &str = "solves";

/// Writing takes at most this share of the time.
const SHARE: f64 = 0.01;

/// Bytes of solves that are held before they go to their file.
const HELD: usize = 4 << 20;

/// A number for a text that is never held as a whole.
struct Digest(DefaultHasher);

impl fmt::Write for Digest {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write(text.as_bytes());
        Ok(())
    }
}

/// A number for all that the solves of `problem` depend on.
fn number(problem: &Problem) -> u64 {
    let mut digest = Digest(DefaultHasher::new());
    // a digest takes every text
    let _ = write!(digest, "{} {problem:?}", env!("CARGO_PKG_VERSION"));
    digest.0.finish()
}

/// Solves of an earlier run that are still to be recalled.
struct Recalled {
    solves: BufReader<File>,
    left: u64,
    /// Memory of the solver after the last of them.
    solver: BufReader<File>,
}

/// The solves of a path: those of an earlier run first, then its own.
pub(crate) struct Journal<'p> {
    checkpoints: Checkpoints,
    problem: &'p Problem,
    recalled: Option<Recalled>,
    /// Solves in the file, and its length.
    done: u64,
    length: u64,
    /// Solves that are not there yet.
    held: u64,
    bytes: Vec<u8>,
    written: Instant,
    pause: Duration,
}

/// Solves the increment of `model` that was begun, or recalls its solve from the `journal`.
pub(crate) fn solve_or_recall(
    model: &mut Equilibrium<'_>,
    settings: &Settings,
    journal: &mut Option<Journal<'_>>,
) -> Outcome {
    let recalled = journal.as_mut().and_then(|journal| journal.recall(model));
    if let Some(outcome) = recalled {
        return outcome;
    }
    let outcome = solve(model, settings).map(|done| done.iterations);
    if let Some(kept) = journal
        && kept.note(model, outcome).is_err()
    {
        *journal = None;
    }
    outcome
}

impl<'p> Journal<'p> {
    /// The journal of a run of `problem`, with what an earlier run of it left.
    pub fn open(checkpoints: &Checkpoints, problem: &'p Problem) -> Journal<'p> {
        let mut journal = Journal {
            checkpoints: checkpoints.clone(),
            problem,
            recalled: None,
            done: 0,
            length: 0,
            held: 0,
            bytes: Vec::new(),
            written: Instant::now(),
            pause: checkpoints.every,
        };
        journal.recalled = journal.left_before().ok().flatten();
        journal
    }

    fn file(&self, name: &str) -> PathBuf {
        self.checkpoints.folder.join(name)
    }

    /// Solves of an earlier run of the same problem.
    fn left_before(&self) -> io::Result<Option<Recalled>> {
        let mut solver = BufReader::new(File::open(self.file(SOLVER))?);
        let mut words = [[0; 8]; 2];
        words.iter_mut().try_for_each(|word| solver.read_exact(word))?;
        let [problem, left] = words.map(u64::from_le_bytes);
        let solves = BufReader::new(File::open(self.file(SOLVES))?);
        Ok((problem == number(self.problem) && left > 0).then_some(Recalled { solves, left, solver }))
    }

    /// Takes `model` to the end of the next solve of the earlier run; `None` where there is none, or none of this problem.
    fn recall(&mut self, model: &mut Equilibrium<'_>) -> Option<Outcome> {
        let recalled = self.recalled.as_mut()?;
        let nodes = self.problem.mesh.nodes.len();
        let met = Solved::read(&mut recalled.solves, nodes).ok().and_then(|solved| model.recall(&solved));
        match (met, recalled.solves.stream_position()) {
            (Some(outcome), Ok(length)) => {
                (self.done, self.length) = (self.done + 1, length);
                recalled.left -= 1;
                if recalled.left == 0 {
                    // a damaged file costs a factorisation, and the last bits
                    let _ = model.read_memory(&mut recalled.solver);
                    self.recalled = None;
                }
                Some(outcome)
            }
            _ => {
                self.recalled = None;
                None
            }
        }
    }

    /// Takes down the solve of `model` that ended with `outcome`, and writes if it is time.
    fn note(&mut self, model: &mut Equilibrium<'_>, outcome: Outcome) -> io::Result<()> {
        if self.is_full() {
            return Ok(());
        }
        model.solved(outcome).write(&mut self.bytes)?;
        self.held += 1;
        if self.written.elapsed() >= self.pause
            || self.length + self.bytes.len() as u64 >= self.checkpoints.largest
        {
            return self.write(model);
        }
        if self.bytes.len() > HELD { self.append().map(drop) } else { Ok(()) }
    }

    /// Whether no more solves are kept: what the solver remembered after the last of them stays as it is.
    fn is_full(&self) -> bool {
        self.length >= self.checkpoints.largest
    }

    /// Writes what is not there yet, of a run that ends here and is long enough to keep.
    pub fn interrupted(&mut self, model: &Equilibrium<'_>) {
        let kept = self.checkpoints.exist() || self.written.elapsed() >= self.checkpoints.every;
        if kept && self.recalled.is_none() && !self.is_full() {
            // the checkpoint before stays
            let _ = self.write(model);
        }
    }

    /// Puts the solves that are held into their file, behind those that are there.
    fn append(&mut self) -> io::Result<File> {
        fs::create_dir_all(&self.checkpoints.folder)?;
        let mut solves =
            OpenOptions::new().write(true).create(true).truncate(false).open(self.file(SOLVES))?;
        solves.set_len(self.length)?;
        solves.seek(SeekFrom::End(0))?;
        solves.write_all(&self.bytes)?;
        self.done += std::mem::take(&mut self.held);
        self.length += self.bytes.len() as u64;
        self.bytes.clear();
        Ok(solves)
    }

    fn write(&mut self, model: &Equilibrium<'_>) -> io::Result<()> {
        let start = Instant::now();
        self.append()?.sync_data()?;
        let mut solver = BufWriter::new(File::create(self.file(PARTIAL))?);
        for word in [number(self.problem), self.done] {
            solver.write_all(&word.to_le_bytes())?;
        }
        model.write_memory(&mut solver)?;
        solver.into_inner()?.sync_data()?;
        fs::rename(self.file(PARTIAL), self.file(SOLVER))?;
        self.written = Instant::now();
        self.pause = self.checkpoints.every.max(start.elapsed().div_f64(SHARE));
        Ok(())
    }
}
