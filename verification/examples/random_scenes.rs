//! Ends of scenes drawn at random, crushed with the program itself: COUNT scenes of a generator of texts at
//! draft, a tenth as many of the next seed at standard, and a tenth as many of the generator of the battery
//! of stated errors, of numbers that are not in the battery.
//!
//! `cargo build --release && cargo run --release -p asperity-verification --example random_scenes -- [COUNT]
//! [SEED] [--out FILE]` (2000 scenes of seed 1 unless told). A scene that ends as it must not, takes long or
//! whose energy balances poorly, is left in `out/random-scenes` to be run again. A run that was killed goes
//! on from the journals there; remove them when the program has changed. The tables are
//! `verification/results/random-scenes.md`.

use asperity_simulation::scene::Accuracy;
use asperity_verification::coverage_scenes::BEYOND_BATTERY;
use asperity_verification::random_scenes::{Done, Drawn, End, Kind, crush_at, draw, of_battery};
use asperity_verification::report::{Report, timed};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::error::Error;
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::Duration;

/// Longer than the slowest draft scene by far: what is still running then hangs.
const LIMIT: Duration = Duration::from_secs(600);

/// A part of the test: scenes of one generator at one accuracy.
struct Part {
    name: String,
    accuracy: Accuracy,
    scenes: Vec<Drawn>,
}

/// The parts of `count` scenes of `seed`.
fn parts(count: usize, seed: u64) -> Result<[Part; 3], Box<dyn Error>> {
    let tenth = count.div_ceil(10);
    let first = BEYOND_BATTERY * (1 + usize::try_from(seed)?);
    Ok([
        Part {
            name: format!("{count} scenes of seed {seed} at draft"),
            accuracy: Accuracy::Draft,
            scenes: draw(count, seed)?,
        },
        Part {
            name: format!("{tenth} scenes of seed {} at standard", seed + 1),
            accuracy: Accuracy::Standard,
            scenes: draw(tenth, seed + 1)?,
        },
        Part {
            name: format!("{tenth} scenes of the second generator from number {first} on at draft"),
            accuracy: Accuracy::Draft,
            scenes: of_battery(first..first + tenth)?,
        },
    ])
}

/// Scenes that take longer (s) are left as well.
const SLOW: f64 = 10.0;

/// The number of the slowest scenes that are named.
const SLOWEST: usize = 10;

/// Scenes whose energy balances worse than this are left to be looked at.
const POOR_BALANCE: f64 = 0.1;

/// `target/release/asperity`, beside the folder of this example.
fn program() -> Result<PathBuf, Box<dyn Error>> {
    let own = std::env::current_exe()?;
    let folder = own.ancestors().nth(2).ok_or("the example stands in no build folder")?;
    let program = folder.join("asperity");
    if program.exists() { Ok(program) } else { Err("build the program first: cargo build --release".into()) }
}

/// The line that tells of scene `index`; `None` of a fault, which is to be seen again.
fn line(index: usize, end: &End, seconds: f64) -> Option<String> {
    let [word, detail] = match end {
        End::Done(done) => ["done", &format!("{:e} {:?}", done.energy_balance, done.promise_kept)],
        End::Stopped(reason) => ["stopped", reason],
        End::Refused => ["refused", ""],
        End::Fault(_) => return None,
    };
    Some(format!("{index}\t{seconds:.2}\t{word}\t{detail}\n"))
}

/// The inverse of [`line`]; `None` of a line that was cut off.
fn parse(line: &str) -> Option<(usize, (End, f64))> {
    let mut parts = line.split('\t');
    let (index, seconds) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
    let end = match (parts.next()?, parts.next()?) {
        ("done", detail) => {
            let (balance, kept) = detail.split_once(' ')?;
            let promise_kept = match kept {
                "Some(true)" => Some(true),
                "Some(false)" => Some(false),
                _ => None,
            };
            End::Done(Done { energy_balance: balance.parse().ok()?, promise_kept })
        }
        ("stopped", reason) => End::Stopped(reason.into()),
        ("refused", _) => End::Refused,
        _ => return None,
    };
    Some((index, (end, seconds)))
}

fn run(
    program: &Path,
    accuracy: Accuracy,
    place: &Path,
    drawn: &Drawn,
) -> Result<(End, f64), std::io::Error> {
    std::fs::create_dir_all(place)?;
    let (end, seconds) = timed(|| crush_at(accuracy, program, drawn, place, LIMIT));
    let kept = match &end {
        End::Fault(_) => true,
        End::Done(done) => done.energy_balance > POOR_BALANCE,
        End::Stopped(_) | End::Refused => false,
    };
    if !kept && seconds <= SLOW {
        std::fs::remove_dir_all(place)?;
    }
    Ok((end, seconds))
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut report, words) = Report::of_example("random_scenes", "draft and standard");
    let count: usize = words.first().map_or(Ok(2000), |a| a.parse())?;
    let seed: u64 = words.get(1).map_or(Ok(1), |a| a.parse())?;
    let mut faults = 0;
    for (number, part) in parts(count, seed)?.iter().enumerate() {
        let ends = solve(part, &format!("{seed}-{number}"))?;
        let tally = Tally::new(&part.scenes, &ends);
        tally.write(&part.name, &ends, &mut report);
        faults += tally.faults.len();
    }
    report.finish()?;
    if faults == 0 { Ok(()) } else { Err("see the scenes in out/random-scenes".into()) }
}

/// Number, end and seconds of a scene.
type Ended = (usize, End, f64);

/// The end of every scene of `part`; ends that the journal `name` of an earlier run knows are taken from
/// there.
fn solve(part: &Part, name: &str) -> Result<Vec<Ended>, Box<dyn Error>> {
    let (program, kept) = (program()?, PathBuf::from("out/random-scenes").join(name));
    std::fs::create_dir_all(&kept)?;
    let journal = kept.join("ends.tsv");
    let before: BTreeMap<usize, (End, f64)> =
        std::fs::read_to_string(&journal).unwrap_or_default().lines().filter_map(parse).collect();
    let journal: Mutex<File> = Mutex::new(OpenOptions::new().create(true).append(true).open(journal)?);
    let ends = part
        .scenes
        .par_iter()
        .with_max_len(1)
        .enumerate()
        .map(|(i, drawn)| {
            if let Some((end, seconds)) = before.get(&i) {
                return Ok((i, end.clone(), *seconds));
            }
            let (end, seconds) = run(&program, part.accuracy, &kept.join(format!("{i:05}")), drawn)?;
            if let (Some(line), Ok(mut file)) = (line(i, &end, seconds), journal.lock()) {
                file.write_all(line.as_bytes())?;
            }
            Ok((i, end, seconds))
        })
        .collect::<Result<_, std::io::Error>>()?;
    Ok(ends)
}

/// The ends of all scenes, counted.
#[derive(Default)]
struct Tally {
    /// Of scenes of formulas, and of measured outlines: sound ones, and those of them that reached their
    /// depth.
    reached: [[usize; 2]; 2],
    /// Energy balances of runs that choose their own numbers, and of those of which the scene gives some.
    balances: [Vec<f64>; 2],
    /// Of the same two: those of them that keep their promise.
    kept: [usize; 2],
    /// Scenes by the reason of their end.
    stopped: BTreeMap<String, usize>,
    refused: usize,
    faults: Vec<String>,
}

impl Tally {
    fn new(scenes: &[Drawn], ends: &[Ended]) -> Tally {
        let mut tally = Tally::default();
        for (i, end, _) in ends {
            let one = &scenes[*i];
            if one.kind == Kind::Sound {
                let [sound, done] = &mut tally.reached[usize::from(one.is_measured())];
                *sound += 1;
                *done += usize::from(matches!(end, End::Done(_)));
            }
            match end {
                End::Done(done) => {
                    let given = usize::from(one.gives_numbers());
                    tally.balances[given].push(done.energy_balance);
                    tally.kept[given] += usize::from(done.promise_kept == Some(true));
                }
                End::Stopped(reason) => *tally.stopped.entry(reason.clone()).or_default() += 1,
                End::Refused => tally.refused += 1,
                End::Fault(what) => tally.faults.push(format!("scene {i}: {what}")),
            }
        }
        tally
    }

    /// Writes the part `name`, whose scenes ended in `ends`.
    fn write(&self, name: &str, ends: &[Ended], report: &mut Report) {
        report.line(&format!("## {name}\n\n{}", self.summary()));
        report.table("| stopped because | scenes |");
        self.stopped.iter().for_each(|(reason, scenes)| report.line(&format!("| {reason} | {scenes} |")));
        report.line("");
        report.table("| energy balance | own numbers | given numbers |");
        let edges = [0.0, 1e-3, 3e-3, 1e-2, 3e-2, 1e-1, f64::INFINITY];
        for pair in edges.windows(2) {
            let within = |of: &[f64]| of.iter().filter(|b| (pair[0]..pair[1]).contains(b)).count();
            let [own, given] = self.balances.each_ref().map(|of| within(of));
            report.line(&format!("| {:.0e} to {:.0e} | {own} | {given} |", pair[0], pair[1]));
        }
        let total: f64 = ends.iter().map(|(.., seconds)| seconds).sum();
        let mut slowest: Vec<(f64, usize)> = ends.iter().map(|(i, _, seconds)| (*seconds, *i)).collect();
        slowest.sort_by(|a, b| b.0.total_cmp(&a.0));
        report.line(&format!(
            "\n{:.2} s a scene in the mean; the slowest:\n",
            total / ends.len().max(1) as f64
        ));
        report.table("| scene | s |");
        slowest.iter().take(SLOWEST).for_each(|(seconds, i)| report.line(&format!("| {i} | {seconds:.1} |")));
        report.line("");
        self.faults.iter().for_each(|fault| report.line(&format!("{fault}\n")));
    }

    /// Four lines and an empty one.
    fn summary(&self) -> String {
        let percent = |done: usize, sound: usize| 100.0 * done as f64 / sound.max(1) as f64;
        let [sound, done] = [0, 1].map(|i| self.reached[0][i] + self.reached[1][i]);
        let beyond: usize = self
            .stopped
            .iter()
            .filter(|(reason, _)| reason.contains("Hencky"))
            .map(|(_, scenes)| scenes)
            .sum();
        let together = format!(
            "Together {:.2} % of {sound}; without the {beyond} whose elastic strain went beyond what the law of elasticity carries, {:.2} %.",
            percent(done, sound),
            percent(done, sound - beyond),
        );
        let share = |[sound, done]: [usize; 2]| {
            format!("{sound} sound, of which {done} reached their depth ({:.1} %)", percent(done, sound))
        };
        let [formulas, measured] = self.reached.map(share);
        let (refused, faults) = (self.refused, self.faults.len());
        let promises = [0, 1].map(|given| {
            let (kept, balances) = (self.kept[given], &self.balances[given]);
            let above = |limit: f64| balances.iter().filter(|balance| **balance > limit).count();
            format!(
                "{kept} of {} keep their promise ({:.1} %), energy balance above 1e-2 in {} ({:.1} %), above 3e-2 in {}",
                balances.len(),
                percent(kept, balances.len()),
                above(1e-2),
                percent(above(1e-2), balances.len()),
                above(3e-2),
            )
        });
        format!(
            "Of formulas: {formulas}. Of measured outlines: {measured}. {refused} refused;\n\
             {faults} ended as they must not. {together}\n\
             Of runs that choose their own numbers {}.\n\
             Of those of which the scene gives steps or penetration {}.\n",
            promises[0], promises[1]
        )
    }
}
