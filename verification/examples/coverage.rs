//! How well the errors that a run states bound the true ones: 630 scenes at all levels, none of which a constant was chosen on.
//!
//! `cargo run --release -p asperity-verification --example coverage -- [--scenes FROM..TO] [--level LEVEL] [--cache DIR]
//! [--budget SECONDS] [--out FILE]`, or `--scene N` for the text of one scene and its row. The table is
//! `verification/results/coverage.md`.
//!
//! The truth of a scene is a run of it beyond `reference`: 1.6 times its elements and steps, half its penetration, twice its
//! substrate, extrapolated by a companion of its own as every run is; of some scenes with the other element. One takes some 100 s of
//! a core, all of them ten hours of two. Each is kept as a file in the folder of `--cache` (`target/coverage` unless told) under the number and a hash of the scene, so that
//! what was stopped goes on there; a truth that was not reached is kept too, and tried again once its file is removed. After the
//! seconds of `--budget` no new truth is begun, and the table is of what there is. `--level` runs all scenes at one level instead of
//! at their own: the truths are the same.
//!
//! An error is the largest over 0.2 ≤ h/h_peak ≤ 1 for force, contact area and mean pressure, relative; the residual depth is over
//! the peak depth, the elastic fraction absolute, the stiffness relative.

// on scenes of its own, for hours
#![allow(clippy::expect_used, clippy::print_stderr, clippy::print_stdout)]

use asperity_solver::run::crush::{Outcome, run};
use asperity_solver::run::curve::{COUNTS_FROM, Curve};
use asperity_solver::run::discretisation::Discretisation;
use asperity_solver::run::record::{Errors, Phase};
use asperity_solver::scene::{Accuracy, ElementChoice, Numerics, Scene};
use asperity_verification::coverage_scenes::{Case, Kind};
use asperity_verification::report::{Report, replace, timed};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::ops::{ControlFlow, Range};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Scenes unless told: every kind as often as every level with it.
const SCENES: Range<usize> = 0..630;

/// Elements and steps of a truth over those of `reference`.
const FINER: f64 = 1.6;

/// Linear elements in the place of quadratic ones, whose errors are independent of theirs, over those of `reference`: they cost more.
const FINER_LINEAR: f64 = 1.2;

/// Its penetration and its substrate over those of `reference`.
const SOFTER: f64 = 0.5;
const WIDER: f64 = 2.0;

/// Depths at which curves are compared.
const DEPTHS: usize = 81;

/// Largest share of the depth by which the end of a complete run may miss it.
const SHORT: f64 = 1e-3;

/// The quantities whose errors are stated, in the order of [`stated`].
const QUANTITIES: [&str; 6] =
    ["force", "contact area", "mean pressure", "residual depth", "elastic fraction", "unloading stiffness"];

/// A value or a bound of each of [`QUANTITIES`], `None` where it is not known.
type Each = [Option<f64>; 6];

/// The results of a run of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Answer {
    /// Depth over the peak depth, force (N, N/m), contact area (m², m).
    curve: Vec<[f64; 3]>,
    /// Over the peak depth.
    residual_depth: Option<f64>,
    elastic_fraction: Option<f64>,
    /// N/m (N/m²).
    unloading_stiffness: Option<f64>,
    /// The errors that it states, of [`QUANTITIES`].
    stated: Each,
    energy_balance: f64,
}

/// The truth of a scene, and how it was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Truth {
    scene: usize,
    /// With another element than that of the scene.
    other_element: bool,
    numerics: Numerics,
    seconds: f64,
    answer: Answer,
}

/// The truth of a scene against its level.
struct Row {
    case: Case,
    other_element: bool,
    /// Errors, those that the run states, and those that the truth states of itself.
    error: Each,
    stated: Each,
    doubt: Each,
    energy_balance: f64,
}

fn stated(errors: &Errors) -> Each {
    let known = |x: f64| Some(x).filter(|x| x.is_finite());
    [
        known(errors.force),
        known(errors.contact_area),
        known(errors.mean_pressure),
        errors.residual_depth.and_then(known),
        errors.elastic_fraction.and_then(known),
        errors.unloading_stiffness.and_then(known),
    ]
}

impl Answer {
    /// Of a run that reached its depth, or why there is none.
    fn of(outcome: &Outcome, depth: f64) -> Result<Answer, String> {
        let summary = &outcome.summary;
        if let Some(stopped) = &outcome.stopped {
            let way = if stopped.phase == Phase::Load { "" } else { ", unloading" };
            return Err(format!("{} at {:.2} of the depth{way}", stopped.reason, stopped.depth / depth));
        }
        let loading = outcome.rows.iter().filter(|row| row.phase == Phase::Load);
        let force = Curve::force(&outcome.rows);
        let area = Curve::new(loading.map(|row| [row.depth, row.contact_area]));
        if (force.end() / depth - 1.0).abs() > SHORT {
            return Err(format!("ends at {:.4} of the depth", force.end() / depth));
        }
        let share = |i: usize| COUNTS_FROM + (1.0 - COUNTS_FROM) * i as f64 / (DEPTHS - 1) as f64;
        let at = |share: f64| {
            let h = (share * depth).min(force.end());
            [share, force.at(h), area.at(h)]
        };
        let curve: Vec<[f64; 3]> = (0..DEPTHS).map(|i| at(share(i))).collect();
        if curve.iter().flatten().any(|x| !x.is_finite()) {
            return Err("the curve is not known at every depth".into());
        }
        Ok(Answer {
            curve,
            residual_depth: summary.residual_depth.map(|h| h / summary.peak_depth),
            elastic_fraction: summary.elastic_fraction,
            unloading_stiffness: summary.unloading_stiffness,
            stated: stated(&summary.errors),
            energy_balance: summary.energy_balance_error,
        })
    }

    /// Its errors against `truth`.
    fn error(&self, truth: &Answer) -> Each {
        let worst = |of: fn(&[f64; 3]) -> f64| {
            let pairs = self.curve.iter().zip(&truth.curve);
            Some(pairs.map(|(own, other)| (of(own) / of(other) - 1.0).abs()).fold(0.0, f64::max))
        };
        let difference = |own: Option<f64>, other: Option<f64>| Some((own? - other?).abs());
        let stiffness = difference(self.unloading_stiffness, truth.unloading_stiffness);
        [
            worst(|p| p[1]),
            worst(|p| p[2]),
            worst(|p| p[1] / p[2]),
            difference(self.residual_depth, truth.residual_depth),
            difference(self.elastic_fraction, truth.elastic_fraction),
            stiffness.zip(truth.unloading_stiffness).map(|(d, s)| d / s),
        ]
    }
}

fn answer(scene: &Scene, mesh: Option<asperity_mesh::Mesh>) -> Result<Answer, String> {
    let depth = scene.loading.depth.ok_or("the scene is not driven by depth")?.0;
    let outcome = run(scene, mesh, &mut |_| ControlFlow::Continue(())).map_err(|e| e.to_string())?;
    Answer::of(&outcome, depth)
}

/// The scene beyond `reference`.
fn beyond(scene: &Scene, element: ElementChoice) -> Scene {
    let mut finer = Scene { accuracy: Accuracy::Reference, ..scene.clone() };
    finer.numerics = Numerics { element: Some(element), ..Numerics::default() };
    let reference = Discretisation::new(&finer);
    let other = element == ElementChoice::Q4 && Discretisation::new(scene).element != element;
    let more = |count: usize, factor: f64| Some((count as f64 * factor).ceil() as usize);
    let elements = if other { FINER_LINEAR } else { FINER };
    finer.numerics.elements_in_contact = more(reference.elements_in_contact, elements);
    finer.numerics.steps = more(reference.steps, FINER);
    finer.numerics.penetration = Some(reference.penetration * SOFTER);
    finer.numerics.domain = Some((reference.domain * WIDER).min(Numerics::DOMAIN[1]));
    finer
}

/// Finds the truth with the element that the scene is to be judged by, or where that does not reach the depth with its own.
fn find(case: &Case) -> Result<Truth, String> {
    let own = Discretisation::new(&case.scene).element;
    let with = |element: ElementChoice| {
        let finer = beyond(&case.scene, element);
        let (answer, seconds) = timed(|| answer(&finer, None));
        let (scene, numerics) = (case.number, finer.numerics);
        answer.map(|answer| Truth { scene, other_element: element != own, numerics, seconds, answer })
    };
    match case.element_of_truth() {
        element if element == own => with(own),
        other => with(other).or_else(|_| with(own)),
    }
}

/// The key of a truth, which depends not on the level, nor on the numbers of `reference`, as these are only to be surpassed.
fn text(case: &Case) -> String {
    let same = Scene { accuracy: Accuracy::Reference, ..case.scene.clone() };
    let element = case.element_of_truth();
    let recipe = format!("{element:?} {FINER} {FINER_LINEAR} {SOFTER} {WIDER}");
    toml::to_string(&same).expect("a scene is a table") + &recipe
}

/// FNV-1a.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}

/// The truth of `case` from `cache`, or found and put there if `search`; `None` if it is not there.
fn truth(case: &Case, cache: &Path, search: bool) -> Option<Result<Truth, String>> {
    let file = cache.join(format!("{:04}-{:016x}.json", case.number, hash(&text(case))));
    let kept = std::fs::read_to_string(&file).ok().and_then(|text| serde_json::from_str(&text).ok());
    if kept.is_some() || !search {
        return kept;
    }
    let (found, seconds) = timed(|| find(case));
    let text = serde_json::to_string(&found).expect("a truth is plain data");
    if let Err(error) = replace(&file, &text) {
        eprintln!("{} is not kept: {error}", file.display());
    }
    let end = found.as_ref().err().map_or(String::new(), |reason| format!(": {reason}"));
    eprintln!("truth of scene {} ({}): {seconds:.0} s{end}", case.number, case.kind.name());
    Some(found)
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

fn measure(case: Case, cache: &Path, search: bool) -> End {
    let truth = match truth(&case, cache, search) {
        None => return End::Open,
        Some(Err(reason)) => return End::NoTruth(Box::new(case), reason),
        Some(Ok(truth)) => truth,
    };
    let run = case.mesh().map_err(|e| e.to_string()).and_then(|mesh| answer(&case.scene, mesh));
    match run {
        Err(reason) => End::Stopped(Box::new(case), reason),
        Ok(run) => End::Measured(Box::new(Row {
            error: run.error(&truth.answer),
            stated: run.stated,
            doubt: truth.answer.stated,
            energy_balance: run.energy_balance,
            other_element: truth.other_element,
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
    let promised = if quantity < 2 {
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
        report.line(&format!("\n{name}:\n"));
        report.table(COLUMNS);
        let lines = groups.iter().filter_map(|(name, rows)| summary(name, rows, quantity));
        lines.for_each(|line| report.line(&line));
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
    report.section("Truth");
    tables(
        report,
        &[
            ("truth of the same element", those(rows, |row| !row.other_element)),
            ("truth of the other element", those(rows, |row| row.other_element)),
        ],
    );
    report.section("Energy balance");
    report.table("| level | number | most that it may be | above, scenes | largest |");
    for (name, level, most) in LEVELS {
        let values: Vec<f64> = those(rows, |row| own(row, level)).iter().map(|r| r.energy_balance).collect();
        let above = values.iter().filter(|b| **b > most).count();
        let largest = values.iter().fold(0.0, |m: f64, b| m.max(*b));
        report.line(&format!("| {name} | {} | {most:.0e} | {above} | {largest:.1e} |", values.len()));
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
fn show(case: Case, cache: &Path) {
    if case.kind == Kind::ImportedMesh {
        println!("# given the mesh that is built for it");
    }
    println!("{}", toml::to_string(&case.scene).expect("a scene is a table"));
    println!("{}, {}", case.kind.name(), case.scene.accuracy);
    match measure(case, cache, true) {
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

/// The words of the command line.
struct Options {
    cache: PathBuf,
    scenes: Range<usize>,
    scene: Option<usize>,
    level: Option<Accuracy>,
    budget: f64,
}

fn options(words: &[String]) -> Result<Options, Box<dyn Error>> {
    let cache = PathBuf::from("target/coverage");
    let mut options = Options { cache, scenes: SCENES, scene: None, level: None, budget: f64::INFINITY };
    for pair in words.chunks(2) {
        let [key, value] = pair else { return Err(format!("{} needs a value", pair[0]).into()) };
        match key.as_str() {
            "--cache" => options.cache = value.into(),
            "--scenes" => {
                let (from, to) = value.split_once("..").ok_or("--scenes takes FROM..TO")?;
                options.scenes = from.parse()?..to.parse()?;
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
    let (mut report, words) = Report::of("coverage", "every level against finer runs");
    let options = options(&words)?;
    let make = |number: usize| {
        let mut case = Case::new(number).map_err(|e| format!("scene {number}: {e}"))?;
        case.scene.accuracy = options.level.unwrap_or(case.scene.accuracy);
        Ok::<Case, String>(case)
    };
    if let Some(number) = options.scene {
        show(make(number)?, &options.cache);
        return Ok(());
    }
    let cases: Vec<Case> = options.scenes.clone().map(make).collect::<Result<_, _>>()?;
    let (count, clock) = (cases.len(), Instant::now());
    // in order, so that what is done in a budget holds every kind
    let mut ends: Vec<(usize, End)> = cases
        .into_iter()
        .par_bridge()
        .map(|case| {
            let search = clock.elapsed().as_secs_f64() < options.budget;
            (case.number, measure(case, &options.cache, search))
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
