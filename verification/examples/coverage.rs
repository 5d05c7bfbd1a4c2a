//! Test of the errors that a run states against the true ones: 630 scenes at all levels. The page of
//! stated errors says which constants had seen them.
//!
//! `cargo run --release -p asperity-verification --example coverage -- [--scenes FROM..TO[,FROM..TO]]
//! [--level LEVEL] [--cache DIR] [--budget SECONDS] [--out FILE]`, or `--scene N` for the text of one scene
//! and its row. The table is `verification/results/coverage.md`.
//!
//! The truth of a scene is a finer run of it ([`Recipe`]), extrapolated by a companion of its own as every
//! run is; of some scenes with the other element. Those that were found are in
//! `verification/results/coverage-truths.json.gz`; the others are searched for and kept in the folder of
//! `--cache` (`target/coverage` unless told) under the number and a hash of the scene, so that what was
//! stopped goes on there. A truth that was not reached is kept too. After the seconds of `--budget` no new
//! truth is begun, and the table is of what there is. `--level` runs all scenes at one level instead of at
//! their own. `pack` before all of these words puts all truths into the committed file.
//!
//! All work comes back from a body that never yields: there the truth of the elastic fraction is 1.
//!
//! Errors of force, contact area and mean pressure are those at the peak and, along the curve, the largest
//! over 0.2 ≤ h/h_peak ≤ 1, relative; the residual depth is over the peak depth, the elastic fraction
//! absolute, the stiffness relative.

// on scenes of its own, for hours
#![allow(clippy::expect_used, clippy::print_stderr, clippy::print_stdout)]

use asperity_simulation::scene::Accuracy;
use asperity_verification::coverage_scenes::{Case, Kind};
use asperity_verification::report::Report;
use asperity_verification::truth::{Answer, Each, QUANTITIES, Recipe, SOFTER_PENALTY, Truths};
use rayon::prelude::*;
use std::error::Error;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Scenes unless told: every kind as often as every level with it.
const SCENES: Range<usize> = 0..630;
/// Those whose numbers no rule had seen, of `coverage-new-scenes.md`.
const NEW_SCENES: [Range<usize>; 3] = [1002..1016, 1020..1034, 1038..1052];

/// The committed truths.
const PACKED: &str = "verification/results/coverage-truths.json.gz";

/// The truth of a scene against its level.
struct Row {
    case: Case,
    other_element: bool,
    /// Errors, those that the run states, and those that the truth states of itself.
    error: Each,
    stated: Each,
    doubt: Each,
    energy_balance: f64,
    /// That the truth took.
    seconds: f64,
}

/// The outcome of a scene.
enum End {
    /// Its truth was not looked for in the time.
    Open,
    /// The truth does not reach the depth.
    NoTruth(Box<Case>, String),
    /// The level does not.
    Stopped(Box<Case>, String),
    Measured(Box<Row>),
}

fn measure(case: Case, truths: &Truths, search: bool) -> End {
    let truth = match truths.find_or_compute(&case, search) {
        None => return End::Open,
        Some(Err(reason)) => return End::NoTruth(Box::new(case), reason),
        Some(Ok(truth)) => truth.exact_where_known(&case.scene),
    };
    let run = case.mesh().map_err(|e| e.to_string()).and_then(|mesh| Answer::compute(&case.scene, mesh));
    match run {
        Err(reason) => End::Stopped(Box::new(case), reason),
        Ok(run) => End::Measured(Box::new(Row {
            error: run.error(&truth.answer),
            stated: run.stated,
            doubt: truth.answer.stated,
            energy_balance: run.energy_balance,
            other_element: truth.other_element,
            seconds: truth.seconds,
            case,
        })),
    }
}

/// One quantity of one scene.
struct Sample {
    error: f64,
    stated: f64,
    /// That the truth states of itself; 0 if it says nothing.
    doubt: f64,
    promise: f64,
}

impl Row {
    /// `None` where nothing is measured or stated, and of the residual depth of elastic bodies, which is 0.
    fn sample(&self, quantity: usize) -> Option<Sample> {
        if !self.counts(quantity) {
            return None;
        }
        Some(Sample {
            error: self.error[quantity]?,
            stated: self.stated[quantity]?,
            doubt: self.doubt[quantity].unwrap_or(0.0),
            promise: self.case.scene.accuracy.promise(),
        })
    }

    fn counts(&self, quantity: usize) -> bool {
        QUANTITIES[quantity] != "residual depth" || self.case.scene.material.yields()
    }
}

impl Sample {
    fn bounded(&self) -> bool {
        self.stated >= self.error
    }
}

/// The value below which this share of `values` lies.
fn quantile(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get((share * values.len() as f64) as usize).copied().unwrap_or(f64::NAN)
}

const COLUMNS: &str = "| scenes of | number | nothing stated | bounded, % | misses | of them within the error of the truth | median of stated over true | 90 % of true errors below, % | stated above the promise, % |";

/// The row of a group of scenes in the table of a quantity; `None` without scenes.
fn summary(name: &str, rows: &[&Row], quantity: usize) -> Option<String> {
    let samples: Vec<Sample> = rows.iter().filter_map(|row| row.sample(quantity)).collect();
    let silent = rows.iter().filter(|row| row.counts(quantity) && row.sample(quantity).is_none()).count();
    if samples.is_empty() && silent == 0 {
        return None;
    }
    let misses: Vec<&Sample> = samples.iter().filter(|s| !s.bounded()).collect();
    let doubtful = misses.iter().filter(|s| s.error <= s.stated + s.doubt).count();
    let percent = |count: usize| 100.0 * count as f64 / samples.len() as f64;
    let promised = if quantity < 2 || quantity == 6 || quantity == 7 {
        format!("{:.0}", percent(samples.iter().filter(|s| s.stated > s.promise).count()))
    } else {
        String::new()
    };
    Some(format!(
        "| {name} | {} | {silent} | {:.1} | {} | {doubtful} | {:.2} | {:.3} | {promised} |",
        samples.len(),
        percent(samples.len() - misses.len()),
        misses.len(),
        quantile(samples.iter().map(|s| s.stated / s.error).collect(), 0.5),
        100.0 * quantile(samples.iter().map(|s| s.error).collect(), 0.9),
    ))
}

/// A table of each quantity over groups of rows.
fn tables(report: &mut Report, groups: &[(&str, Vec<&Row>)]) {
    for (quantity, name) in QUANTITIES.iter().enumerate() {
        let lines: Vec<String> =
            groups.iter().filter_map(|(name, rows)| summary(name, rows, quantity)).collect();
        if !lines.is_empty() {
            report.line(&format!("\n{name}:\n"));
            report.table(COLUMNS);
            lines.iter().for_each(|line| report.line(line));
        }
    }
}

fn those(rows: &[Row], of: impl Fn(&Row) -> bool) -> Vec<&Row> {
    rows.iter().filter(|row| of(row)).collect()
}

/// Names of the levels with the largest energy balance that they may show.
const LEVELS: [(&str, Accuracy, f64); 3] = [
    ("draft", Accuracy::Draft, 1e-2),
    ("standard", Accuracy::Standard, 1e-3),
    ("reference", Accuracy::Reference, 1e-3),
];

fn write(report: &mut Report, rows: &[Row], ends: &[End]) {
    report.section("All");
    report.table(&COLUMNS.replace("scenes of", "quantity"));
    let all: Vec<&Row> = rows.iter().collect();
    let lines = QUANTITIES.iter().enumerate().filter_map(|(i, name)| summary(name, &all, i));
    lines.for_each(|line| report.line(&line));
    report.section("Levels");
    let own = |row: &Row, level: Accuracy| row.case.scene.accuracy == level;
    let levels = LEVELS.map(|(name, level, _)| (name, those(rows, |row| own(row, level))));
    tables(report, &levels);
    report.section("Kinds");
    let kinds = Kind::ALL.map(|kind| (kind.name(), those(rows, |row| row.case.kind == kind)));
    tables(report, &kinds);
    report.section("Element of the truth");
    tables(
        report,
        &[
            ("truth of the same element", those(rows, |row| !row.other_element)),
            ("truth of the other element", those(rows, |row| row.other_element)),
        ],
    );
    report.section("Truths");
    report.table("| truths of | elements, steps and substrate over those of `reference` | penetration | number | mean cost, s |");
    for (name, level, _) in LEVELS {
        let Recipe(finer) = Recipe::for_accuracy(level);
        let seconds: Vec<f64> = those(rows, |row| own(row, level)).iter().map(|row| row.seconds).collect();
        let mean = seconds.iter().sum::<f64>() / seconds.len() as f64;
        report.line(&format!(
            "| {name} | {finer} | {:.2} | {} | {mean:.0} |",
            finer.powf(SOFTER_PENALTY),
            seconds.len()
        ));
    }
    report.section("Energy balance");
    report.table("| level | number | most that it may be | within, % | largest |");
    for (name, level, most) in LEVELS {
        let values: Vec<f64> = those(rows, |row| own(row, level)).iter().map(|r| r.energy_balance).collect();
        let within = values.iter().filter(|b| **b <= most).count();
        let within = 100.0 * within as f64 / values.len() as f64;
        let largest = values.iter().fold(0.0, |m: f64, b| m.max(*b));
        report.line(&format!("| {name} | {} | {most:.0e} | {within:.1} | {largest:.1e} |", values.len()));
    }
    report.section("Misses");
    report.table("| scene | kind | level | quantity | true, % | stated, % | the truth states of itself, % |");
    for row in rows {
        for (quantity, name) in QUANTITIES.iter().enumerate() {
            if let Some(sample) = row.sample(quantity).filter(|sample| !sample.bounded()) {
                let Sample { error, stated, doubt, .. } = sample;
                let [error, stated, doubt] = [error, stated, doubt].map(|x| format!("{:.3}", 100.0 * x));
                report.line(&format!("| {} | {name} | {error} | {stated} | {doubt} |", title(&row.case)));
            }
        }
    }
    report.section("Not measured");
    report.table("| scene | kind | level | reason |");
    for end in ends {
        match end {
            End::NoTruth(case, reason) => report.line(&format!("| {} | truth: {reason} |", title(case))),
            End::Stopped(case, reason) => report.line(&format!("| {} | {reason} |", title(case))),
            End::Open | End::Measured(_) => {}
        }
    }
}

/// Number, kind and level of a scene as columns.
fn title(case: &Case) -> String {
    format!("{} | {} | {}", case.number, case.kind.name(), case.scene.accuracy)
}

/// Prints the text of a scene and what is measured of it.
fn show(case: Case, truths: &Truths) {
    if case.kind == Kind::ImportedMesh {
        println!("# given the mesh that is built for it");
    }
    println!("{}", toml::to_string(&case.scene).expect("a scene is a table"));
    println!("{}, {}", case.kind.name(), case.scene.accuracy);
    match measure(case, truths, true) {
        End::Open => {}
        End::NoTruth(_, reason) => println!("no truth: {reason}"),
        End::Stopped(_, reason) => println!("{reason}"),
        End::Measured(row) => {
            let text = |x: Option<f64>| x.map_or("-".into(), |x| format!("{:.3}", 100.0 * x));
            println!("\n| quantity | true, % | stated, % | the truth states of itself, % |\n|-|-|-|-|");
            for (i, name) in QUANTITIES.iter().enumerate() {
                let [error, stated, doubt] = [row.error[i], row.stated[i], row.doubt[i]].map(text);
                println!("| {name} | {error} | {stated} | {doubt} |");
            }
            println!("\nenergy balance {:.1e}", row.energy_balance);
        }
    }
}

/// Action on the scenes.
#[derive(Clone, Copy, PartialEq)]
enum Task {
    Measure,
    Pack,
}

/// The words of the command line.
struct Options {
    task: Task,
    cache: PathBuf,
    scenes: Vec<Range<usize>>,
    scene: Option<usize>,
    level: Option<Accuracy>,
    budget: f64,
}

fn options(words: &[String]) -> Result<Options, Box<dyn Error>> {
    let cache = PathBuf::from("target/coverage");
    let (task, words) = match words.split_first() {
        Some((word, rest)) if word == "pack" => (Task::Pack, rest),
        _ => (Task::Measure, words),
    };
    let mut scenes = vec![SCENES];
    if task == Task::Pack {
        scenes.extend(NEW_SCENES);
    }
    let mut options = Options { task, cache, scenes, scene: None, level: None, budget: f64::INFINITY };
    for pair in words.chunks(2) {
        let [key, value] = pair else { return Err(format!("{} needs a value", pair[0]).into()) };
        match key.as_str() {
            "--cache" => options.cache = value.into(),
            "--scenes" => {
                let range = |words: &str| -> Result<Range<usize>, Box<dyn Error>> {
                    let (from, to) = words.split_once("..").ok_or("--scenes takes FROM..TO")?;
                    Ok(from.parse()?..to.parse()?)
                };
                options.scenes = value.split(',').map(range).collect::<Result<_, _>>()?;
            }
            "--scene" => options.scene = Some(value.parse()?),
            "--level" => options.level = Some(value.parse()?),
            "--budget" => options.budget = value.parse()?,
            _ => return Err(format!("{key} is no option").into()),
        }
    }
    Ok(options)
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut report, words) = Report::of_example("coverage", "every level against finer runs");
    let options = options(&words)?;
    let make = |number: usize| {
        let mut case = Case::new(number).map_err(|e| format!("scene {number}: {e}"))?;
        case.scene.accuracy = options.level.unwrap_or(case.scene.accuracy);
        Ok::<Case, String>(case)
    };
    let truths = Truths::open(Path::new(PACKED), &options.cache)?;
    if let Some(number) = options.scene {
        show(make(number)?, &truths);
        return Ok(());
    }
    let cases: Vec<Case> = options.scenes.iter().cloned().flatten().map(make).collect::<Result<_, _>>()?;
    if options.task == Task::Pack {
        println!("{} truths", truths.pack(&cases, Path::new(PACKED))?);
        return Ok(());
    }
    let (count, clock) = (cases.len(), Instant::now());
    // in order, so that what is done in a budget holds every kind
    let mut ends: Vec<(usize, End)> = cases
        .into_iter()
        .par_bridge()
        .map(|case| {
            let search = clock.elapsed().as_secs_f64() < options.budget;
            (case.number, measure(case, &truths, search))
        })
        .collect();
    ends.sort_by_key(|(number, _)| *number);
    let (mut rows, mut others) = (Vec::new(), Vec::new());
    for (_, end) in ends {
        match end {
            End::Measured(row) => rows.push(*row),
            other => others.push(other),
        }
    }
    let number = |of: fn(&End) -> bool| others.iter().filter(|end| of(end)).count();
    report.line(&format!(
        "{count} scenes: {} measured, {} of them by a truth of the other element; {} did not reach their depth, the truths of {} neither; {} are still without a truth.",
        rows.len(),
        rows.iter().filter(|row| row.other_element).count(),
        number(|end| matches!(end, End::Stopped(..))),
        number(|end| matches!(end, End::NoTruth(..))),
        number(|end| matches!(end, End::Open)),
    ));
    write(&mut report, &rows, &others);
    report.finish()?;
    Ok(())
}
