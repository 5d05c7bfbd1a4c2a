//! Test of `identify` on metals that are known: of public finite-element results under cones of 60° and 50°
//! half apex angle, of indents in aluminium, of twins made by the program itself; what a fit costs; and two
//! metals that one cone cannot tell apart.
//!
//! `cargo run --release -p asperity-verification --example identify_table -- FOLDER [--twins N]
//! [--imprints N] [--properties N] [--every N] [--leave-out sought,twins] [--pyramid] [--journal FILE]
//! [--out FILE]`; without FOLDER the two metals alone. FOLDER holds FEM_60deg.csv, FEM_50deg.csv (rows 1 to
//! 76 are used) and Al6061.csv. What the journal holds is not computed again.
//! `--pyramid` writes of pyramids as cones alone; it needs Berkovich.csv, and where they are there it takes
//! FEM_70deg.csv, Al6061.csv and Al7075.csv.
//! `--cones N` writes the cones of `results/reference-cones.md`, of which the twins of `--properties` are
//! made.
//! `--every N` takes every N-th published metal but in the fit of two cones with E known.

// on committed cases
#![allow(clippy::expect_used)]

mod beside;
mod book;
mod cases;
mod imprints;
mod least_errors;
mod pair;
mod properties;
mod pyramid;
mod score;

use asperity_verification::report::Report;
use beside::Ratios;
use book::{Book, Solved};
use cases::{Asked, Case, aluminium, published, series, twins};
use imprints::{Indenter, imprints};
use score::{ANY, Bound, HEAD, Row, line};
use std::path::Path;

/// Agreement of a curvature with the published one, within which a metal counts as computed alike: two of the
/// 1.5 % that the covariance of the published finite elements holds.
const ALIKE: f64 = 0.03;

fn stresses(solved: &[Solved], strain: f64) -> Vec<Row> {
    solved.iter().map(|s| (s.case.stress(strain), s.stress(strain))).collect()
}

fn parameter_rows(solved: &[Solved], name: &str, truth: fn(&Case) -> f64) -> Vec<Row> {
    solved.iter().map(|s| (truth(&s.case), s.parameter(name))).collect()
}

fn yields(solved: &[Solved]) -> Vec<Row> {
    parameter_rows(solved, "yield_stress", |c| c.yield_stress)
}

/// Those whose interval is within so many percent of its middle.
fn narrow(rows: &[Row], share: f64) -> Vec<Row> {
    rows.iter().copied().filter(|(_, [value, low, high])| 0.5 * (high - low) <= share * value).collect()
}

fn main() {
    let level = if std::env::args().any(|word| word == "--cones") { "reference" } else { "standard" };
    let level = format!("finite elements at {level}, extrapolated");
    let (mut report, words) = Report::of_example("identify_table", &level);
    let after = |name: &str| words.iter().position(|w| w == name).and_then(|i| words.get(i + 1));
    let left_out = |part: &str| after("--leave-out").is_some_and(|list| list.split(',').any(|w| w == part));
    let every: usize = after("--every").map_or(1, |n| n.parse().expect("a number"));
    let thinned =
        |cases: Vec<Case>| cases.into_iter().skip(every / 2).step_by(every.max(1)).collect::<Vec<_>>();
    if let Some(count) = after("--cones") {
        properties::cones(&mut report, count.parse().expect("a number"));
        report.finish().expect("can be written");
        return;
    }
    let Some(folder) = words.first().map(Path::new) else {
        // what needs no data of others
        pair::section(&mut report);
        report.finish().expect("can be written");
        return;
    };
    let count: usize = after("--twins").map_or(200, |n| n.parse().expect("a number"));
    let book = Book::open(after("--journal").map(Path::new));
    if words.iter().any(|word| word == "--pyramid") {
        pyramid::section(&mut report, folder, &book);
        report.finish().expect("can be written");
        return;
    }
    let metals = series(folder);

    let indents = aluminium(folder);
    let own = if left_out("twins") { Vec::new() } else { twins(count) };
    let imprint = |tool| imprints(tool, 1, imprints::LENGTHS[0]).first().and_then(|case| book.time(case));
    let times = [
        book.time(&indents[0]),
        own.first().and_then(|twin| book.time(twin)),
        imprint(Indenter::Cone),
        imprint(Indenter::Ball),
    ];

    report.table(HEAD);
    let both = book.solve(published(&metals, Asked::TwoCones));
    let ratios = beside::ratios(&book, &metals);
    two_cones(&mut report, &both, &ratios);
    let open = (!left_out("sought")).then(|| book.solve(thinned(published(&metals, Asked::Modulus))));
    unknown_modulus(&mut report, open.as_deref());
    one_cone(&mut report, &book.solve(thinned(published(&metals, Asked::OneCone))));
    berkovich(&mut report, &book.solve(indents));
    let own = book.solve(own);
    noisy_twins(&mut report, &own, count);
    let count: usize = after("--imprints").map_or(100, |n| n.parse().expect("a number"));
    let of_imprints = imprints::LENGTHS.map(|length| book.solve(imprints(Indenter::Cone, count, length)));
    for ((length, found), bound) in imprints::LENGTHS.iter().zip(&of_imprints).zip([IMPRINT, COVERS]) {
        let work = format!("one cone and its imprint, roughness alike over {length} contact radii");
        line(&mut report, &work, "σ_y", &yields(found), count, &bound);
        line(&mut report, &work, "n (differences, not shares)", &differences_of_n(found), count, &COVERS);
    }
    let count = count.min(BALLS);
    let of_balls = book.solve(imprints(Indenter::Ball, count, imprints::LENGTHS[0]));
    imprints_of_balls(&mut report, &of_balls, count);
    least_errors::section(&mut report, &book, &of_imprints);
    let count: usize = after("--properties").map_or(200, |n| n.parse().expect("a number"));
    properties::section(&mut report, &book, count);
    score::times(&mut report, times);
    beside::section(&mut report, &ratios);
    beside::finer(&mut report, &book, &metals);
    misses(&mut report, &both, &ratios);
    if !own.is_empty() {
        score::twins(&mut report, &own);
    }
    pair::section(&mut report);
    report.finish().expect("can be written");
}

/// Cover that is asked of an interval, whatever its errors.
const COVERS: Bound = Bound { covers: [90.0, 100.0], asked: "covers 90", ..ANY };

/// Bound on the yield stress from one cone and its imprint.
const IMPRINT: Bound =
    Bound { mean: 5.0, worst: 12.0, covers: [90.0, 100.0], asked: "5 mean, 12 worst, covers 90" };

/// Bound on a stress within what a ball of 0.4 contact radii reaches.
const STRESS: Bound = Bound { mean: 2.0, covers: [90.0, 100.0], asked: "2 mean, covers 90", ..ANY };

/// Twins of a ball with its imprint: each costs a run at `reference` and one more fit.
const BALLS: usize = 50;

/// Balls with their imprints.
fn imprints_of_balls(report: &mut Report, found: &[Solved], count: usize) {
    let work = "one ball to a contact of 0.4 radii and its imprint";
    for (strain, bound) in [(0.02, &STRESS), (0.05, &STRESS), (0.1, &COVERS)] {
        line(report, work, &format!("stress at ε_p {strain}"), &stresses(found, strain), count, bound);
    }
    line(report, work, "σ_y", &yields(found), count, &COVERS);
    line(report, work, "n (differences, not shares)", &differences_of_n(found), count, &COVERS);
}

/// Two cones under each published metal.
fn two_cones(report: &mut Report, both: &[Solved], ratios: &[Ratios]) {
    let work = "60° and 50°, E known";
    let stress =
        Bound { mean: 4.0, worst: 10.0, covers: [90.0, 100.0], asked: "4 mean, 10 worst, covers 90" };
    let tenth = stresses(both, 0.1);
    line(report, work, "stress at ε_p 0.1", &tenth, both.len(), &stress);
    line(report, work, "σ_y", &yields(both), both.len(), &COVERS);
    let alike = |rows: &[Row]| -> Vec<Row> {
        rows.iter().zip(ratios).filter(|(_, r)| r.agree(ALIKE)).map(|(row, _)| *row).collect()
    };
    let what = format!("of them those whose curvatures agree within {:.0} %: ", 100.0 * ALIKE);
    line(report, work, &format!("{what}stress at ε_p 0.1"), &alike(&tenth), both.len(), &ANY);
    line(report, work, &format!("{what}σ_y"), &alike(&yields(both)), both.len(), &ANY);
}

/// Two cones and a slope, from which the modulus is found too; `None` where they were left out.
fn unknown_modulus(report: &mut Report, open: Option<&[Solved]>) {
    let work = "60° and 50°, unloading slope at 60°, E sought";
    let Some(open) = open else {
        report.line(&format!("| {work} | not run | | | | | 5 mean | |"));
        return;
    };
    let modulus = parameter_rows(open, "youngs_modulus", |c| c.youngs_modulus);
    let bound = Bound { mean: 5.0, asked: "5 mean", ..ANY };
    let what = "E* where its interval is below ±10 %";
    line(report, work, what, &narrow(&modulus, 0.1), open.len(), &bound);
    line(report, work, "E*, all", &modulus, open.len(), &ANY);
}

/// One cone under each published metal.
fn one_cone(report: &mut Report, single: &[Solved]) {
    let work = "60° alone, curvature and slope";
    let best: Vec<Row> = single.iter().map(Solved::best_identified).collect();
    let bound = Bound { mean: 4.0, asked: "4 mean", ..ANY };
    line(report, work, "σ_r, the stress told best", &best, single.len(), &bound);
    let all = yields(single);
    let what = "σ_y where its interval is below ±15 %";
    line(report, work, what, &narrow(&all, 0.15), single.len(), &COVERS);
    line(report, work, "σ_y, all", &all, single.len(), &ANY);
}

/// Measured indents of aluminium.
fn berkovich(report: &mut Report, metal: &[Solved]) {
    let work = "aluminium 6061-T6511, Berkovich as a cone";
    let bound = Bound { mean: 7.0, covers: [100.0, 100.0], asked: "7 mean, covers", ..ANY };
    line(report, work, "stress at ε_p 0.033", &stresses(metal, 0.033), metal.len(), &bound);
    line(report, work, "σ_y", &yields(metal), metal.len(), &ANY);
}

/// `count` twins of random metals; none where they were left out.
fn noisy_twins(report: &mut Report, own: &[Solved], count: usize) {
    let work = "twins, cone and ball, noise 0.5 %";
    if own.is_empty() {
        report.line(&format!("| {work} | not run | | | | | 5 mean, covers 90 to 98 | |"));
        return;
    }
    let bound = Bound { mean: 5.0, covers: [90.0, 98.0], asked: "5 mean, covers 90 to 98", ..ANY };
    line(report, work, "σ_y", &yields(own), count, &bound);
    let bound = Bound { covers: [90.0, 98.0], asked: "covers 90 to 98", ..ANY };
    let moduli = parameter_rows(own, "youngs_modulus", |c| c.youngs_modulus);
    line(report, work, "E", &moduli, count, &bound);
    line(report, work, "n (differences, not shares)", &differences_of_n(own), count, &bound);
}

/// Errors of n as differences, not shares: 1 + n stands for it.
fn differences_of_n(solved: &[Solved]) -> Vec<Row> {
    let rows = parameter_rows(solved, "hardening_exponent", |c| c.exponent);
    rows.iter().map(|(truth, found)| (1.0, found.map(|n| 1.0 + n - truth))).collect()
}

/// The metals whose stress at ε_p 0.1 lies outside its interval.
fn misses(report: &mut Report, solved: &[Solved], ratios: &[Ratios]) {
    report.section("Metals whose stress at ε_p 0.1 lies outside its interval, two cones, E known");
    report.table(
        "| E, GPa | σ_y, MPa | n | error, % | interval, % | found n | K under 60° and under 50°, % above the published |",
    );
    let error = |s: &Solved| s.stress(0.1)[0] / s.case.stress(0.1) - 1.0;
    let mut rows: Vec<(&Solved, &Ratios)> = solved
        .iter()
        .zip(ratios)
        .filter(|(s, _)| !(s.stress(0.1)[1]..=s.stress(0.1)[2]).contains(&s.case.stress(0.1)))
        .collect();
    rows.sort_by(|a, b| error(b.0).abs().total_cmp(&error(a.0).abs()));
    for (s, r) in rows {
        let (truth, [_, low, high]) = (s.case.stress(0.1), s.stress(0.1));
        let above =
            |k: Option<f64>| k.map_or("stopped".to_string(), |k| format!("{:+.1}", 100.0 * (k - 1.0)));
        report.line(&format!(
            "| {} | {} | {} | {:+.1} | {:+.1} to {:+.1} | {:.3} | {} and {} |",
            s.case.youngs_modulus,
            s.case.yield_stress,
            s.case.exponent,
            100.0 * error(s),
            100.0 * (low / truth - 1.0),
            100.0 * (high / truth - 1.0),
            s.parameter("hardening_exponent")[0],
            above(r.curvatures[0]),
            above(r.curvatures[1])
        ));
    }
}
