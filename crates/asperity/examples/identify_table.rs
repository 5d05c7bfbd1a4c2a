//! How well `identify` finds metals again: of public finite-element results under cones of 60° and 50° half apex angle, of
//! indents in aluminium, of twins made by the program itself; and two metals that one cone cannot tell apart.
//!
//! `cargo run --release -p asperity --example identify_table -- FOLDER [--twins N] [--every N] [--leave-out sought,twins] [--journal FILE]
//! [--out FILE]`; without FOLDER the two metals alone. FOLDER holds
//! FEM_60deg.csv, FEM_50deg.csv (rows 1 to 76 are used) and Al6061.csv. What the journal holds is not computed again.
//! `--every N` takes every N-th published metal but in the fit of two cones with E known.

// on committed cases
#![allow(clippy::expect_used)]

#[path = "identify_table/cases.rs"]
mod cases;
#[path = "identify_table/pair.rs"]
mod pair;

use asperity::{Fit, identify};
use asperity_calibration::journal::{Journal, fingerprint};
use asperity_verification::report::Report;
use cases::{Case, aluminium, published, twins};
use rayon::prelude::*;
use serde_json::Value;
use std::collections::HashMap;
use std::path::Path;
use std::sync::Mutex;

/// A case with the `fit.json` that came of it.
struct Solved {
    case: Case,
    fit: Value,
}

impl Solved {
    fn number(&self, parameter: &str, key: &str) -> f64 {
        self.fit["parameters"][parameter][key].as_f64().unwrap_or(f64::NAN)
    }

    /// Value, low and high of a stress (MPa) at a plastic strain.
    fn stress(&self, strain: f64) -> [f64; 3] {
        let rows = self.fit["stress_strain"].as_array().cloned().unwrap_or_default();
        let row =
            rows.iter().find(|r| r["plastic_strain"].as_f64() == Some(strain)).cloned().unwrap_or_default();
        ["value_MPa", "low_MPa", "high_MPa"].map(|key| row[key].as_f64().unwrap_or(f64::NAN))
    }
}

/// Solves all that the journal does not hold; a case without an answer is left out, and said.
#[allow(clippy::print_stderr)]
fn solve(cases: Vec<Case>, journal: &Mutex<Option<Journal>>, known: &HashMap<u64, Value>) -> Vec<Solved> {
    let one = |case: Case| {
        let key = fingerprint(&case.fit);
        let fit = known.get(&key).cloned().or_else(|| {
            let fit = Fit::from_toml(&case.fit, &case.folder).and_then(|fit| identify(fit, &mut |_, _| true));
            match fit.and_then(|found| found.to_json()) {
                Ok(text) => {
                    let value: Value = serde_json::from_str(&text).ok()?;
                    if let Some(journal) = journal.lock().expect("no panics").as_mut() {
                        journal.append(&format!("[{key},{value}]")).expect("can be written");
                    }
                    Some(value)
                }
                Err(error) => {
                    eprintln!("{}: {error}", case.name);
                    None
                }
            }
        })?;
        Some(Solved { case, fit })
    };
    cases.into_par_iter().with_max_len(1).filter_map(one).collect()
}

/// Mean absolute and largest error, and the share of truths within the intervals, in percent.
struct Score {
    mean: f64,
    worst: f64,
    covered: f64,
    count: usize,
}

/// Of (truth, [value, low, high]).
fn score(rows: &[(f64, [f64; 3])]) -> Score {
    let count = rows.len().max(1) as f64;
    let errors = || rows.iter().map(|(truth, [value, ..])| 100.0 * (value / truth - 1.0).abs());
    let inside = rows.iter().filter(|(truth, [_, low, high])| (*low..=*high).contains(truth)).count();
    Score {
        mean: errors().sum::<f64>() / count,
        worst: errors().fold(0.0, f64::max),
        covered: 100.0 * inside as f64 / count,
        count: rows.len(),
    }
}

fn line(report: &mut Report, work: &str, what: &str, rows: &[(f64, [f64; 3])], of: usize, bound: &str) {
    let Score { mean, worst, covered, count } = score(rows);
    report.line(&format!(
        "| {work} | {what} | {mean:.1} | {worst:.1} | {covered:.0} | {count} of {of} | {bound} |"
    ));
}

/// Whether an interval is within so many percent of its middle.
fn within([value, low, high]: [f64; 3], share: f64) -> bool {
    0.5 * (high - low) <= share * value
}

fn parameter(s: &Solved, name: &str) -> [f64; 3] {
    ["value", "low", "high"].map(|key| s.number(name, key))
}

fn truth_and_stress(solved: &[Solved], strain: f64) -> Vec<(f64, [f64; 3])> {
    solved.iter().map(|s| (s.case.stress(strain), s.stress(strain))).collect()
}

fn yields(solved: &[Solved]) -> Vec<(f64, [f64; 3])> {
    solved.iter().map(|s| (s.case.yield_stress, parameter(s, "yield_stress"))).collect()
}

fn main() {
    let (mut report, words) =
        Report::of_package("asperity", "identify_table", "finite elements at draft, extrapolated");
    let after = |name: &str| words.iter().position(|w| w == name).and_then(|i| words.get(i + 1));
    let left_out = |part: &str| after("--leave-out").is_some_and(|list| list.split(',').any(|w| w == part));
    let every: usize = after("--every").map_or(1, |n| n.parse().expect("a number"));
    let thinned =
        |cases: Vec<Case>| cases.into_iter().skip(every / 2).step_by(every.max(1)).collect::<Vec<_>>();
    let Some(folder) = words.first().map(Path::new) else {
        // what needs no data of others
        pair::section(&mut report);
        report.finish().expect("can be written");
        return;
    };
    let count: usize = after("--twins").map_or(40, |n| n.parse().expect("a number"));
    let opened = after("--journal").map(|file| Journal::open(Path::new(file), 1).expect("can be written"));
    let (journal, lines) = opened.map_or((None, Vec::new()), |(journal, lines)| (Some(journal), lines));
    let known: HashMap<u64, Value> =
        lines.iter().filter_map(|l| serde_json::from_str::<(u64, Value)>(l).ok()).collect();
    let journal = Mutex::new(journal);

    report.table(
        "| data | what | mean absolute error, % | worst, % | intervals that cover, % | metals | bound |",
    );
    let both = solve(published(folder, [true, true], false), &journal, &known);
    line(
        &mut report,
        "60° and 50°, E known",
        "stress at ε_p 0.1",
        &truth_and_stress(&both, 0.1),
        both.len(),
        "4 mean, 10 worst, covers 90",
    );
    line(&mut report, "60° and 50°, E known", "σ_y", &yields(&both), both.len(), "covers 90");
    let single = solve(thinned(published(folder, [true, false], false)), &journal, &known);
    let best: Vec<_> = single
        .iter()
        .map(|s| {
            let r = &s.fit["representative"];
            let strain = r["plastic_strain"].as_f64().unwrap_or(0.033);
            (s.case.stress(strain), s.stress(strain))
        })
        .collect();
    line(
        &mut report,
        "60° alone, curvature and slope",
        "σ_r, the stress told best",
        &best,
        single.len(),
        "4",
    );
    let all = yields(&single);
    let narrow: Vec<_> = all.iter().copied().filter(|(_, found)| within(*found, 0.15)).collect();
    line(
        &mut report,
        "60° alone, curvature and slope",
        "σ_y where its interval is below ±15 %",
        &narrow,
        single.len(),
        "covers 90",
    );
    line(&mut report, "60° alone, curvature and slope", "σ_y, all", &all, single.len(), "");
    let metal = solve(aluminium(folder), &journal, &known);
    line(
        &mut report,
        "aluminium 6061-T6511, Berkovich as a cone",
        "stress at ε_p 0.033",
        &truth_and_stress(&metal, 0.033),
        metal.len(),
        "7 mean, covers",
    );
    line(&mut report, "aluminium 6061-T6511, Berkovich as a cone", "σ_y", &yields(&metal), metal.len(), "");
    if left_out("sought") {
        report.line("| 60° and 50°, unloading slope at 60°, E sought | not run | | | | | 5 |");
    } else {
        let open = solve(thinned(published(folder, [true, true], true)), &journal, &known);
        let modulus: Vec<_> =
            open.iter().map(|s| (s.case.youngs_modulus, parameter(s, "youngs_modulus"))).collect();
        let narrow: Vec<_> = modulus.iter().copied().filter(|(_, found)| within(*found, 0.1)).collect();
        line(
            &mut report,
            "60° and 50°, unloading slope at 60°, E sought",
            "E* where its interval is below ±10 %",
            &narrow,
            open.len(),
            "5",
        );
        line(&mut report, "the same", "E*, all", &modulus, open.len(), "");
    }
    if left_out("twins") {
        report.line("| twins, cone and ball, noise 0.5 % | not run | | | | | 5 mean, covers 90 to 98 |");
    } else {
        let own = solve(twins(count), &journal, &known);
        line(
            &mut report,
            "twins, cone and ball, noise 0.5 %",
            "σ_y",
            &yields(&own),
            own.len(),
            "5 mean, covers 90 to 98",
        );
        let of = |name: &str, truth: fn(&Case) -> f64| -> Vec<_> {
            own.iter().map(|s| (truth(&s.case), parameter(s, name))).collect()
        };
        line(
            &mut report,
            "twins, cone and ball, noise 0.5 %",
            "E",
            &of("youngs_modulus", |c| c.youngs_modulus),
            own.len(),
            "covers 90 to 98",
        );
        // errors of n are differences, not shares
        let n = of("hardening_exponent", |c| c.exponent);
        let covered = score(&n).covered;
        let mean = 100.0 * n.iter().map(|(t, [v, ..])| (v - t).abs()).sum::<f64>() / n.len().max(1) as f64;
        report.line(&format!("| twins, cone and ball, noise 0.5 % | n (differences, not shares) | {mean:.1} | | {covered:.0} | {} of {} | covers 90 to 98 |", n.len(), own.len()));
    }
    misses(&mut report, &both);
    pair::section(&mut report);
    report.finish().expect("can be written");
}

/// The metals whose stress at ε_p 0.1 is missed most.
fn misses(report: &mut Report, solved: &[Solved]) {
    report.section("The largest misses of the stress at ε_p 0.1 under two cones");
    report.table("| E, GPa | σ_y, MPa | n | error, % | interval, % | found n |");
    let mut rows: Vec<(f64, &Solved)> =
        solved.iter().map(|s| (s.stress(0.1)[0] / s.case.stress(0.1) - 1.0, s)).collect();
    rows.sort_by(|a, b| b.0.abs().total_cmp(&a.0.abs()));
    for (error, s) in rows.iter().take(8) {
        let (truth, [_, low, high]) = (s.case.stress(0.1), s.stress(0.1));
        report.line(&format!(
            "| {} | {} | {} | {:+.1} | {:+.1} to {:+.1} | {:.3} |",
            s.case.youngs_modulus,
            s.case.yield_stress,
            s.case.exponent,
            100.0 * error,
            100.0 * (low / truth - 1.0),
            100.0 * (high / truth - 1.0),
            s.number("hardening_exponent", "value")
        ));
    }
}
