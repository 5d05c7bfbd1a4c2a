//! Errors and coverage of what was found, beside what is asked of it.

use crate::book::Solved;
use asperity_verification::report::Report;

/// A true number, and value, low and high of what was found.
pub type Row = (f64, [f64; 3]);

/// Largest error that a row may have, in percent.
pub struct Bound {
    /// Most of the mean absolute error.
    pub mean: f64,
    /// Most of the largest error.
    pub worst: f64,
    /// Least and most of the share of intervals that cover.
    pub covers: [f64; 2],
    /// The same in words; none of a row of which nothing is asked.
    pub asked: &'static str,
}

/// Nothing is asked.
pub const ANY: Bound = Bound { mean: f64::INFINITY, worst: f64::INFINITY, covers: [0.0, 100.0], asked: "" };

/// The columns of [`line`].
pub const HEAD: &str = "| data | what | mean absolute error, % | worst, % | mean error, % | intervals that cover, % | metals | asked | reached |";

fn covers((truth, [_, low, high]): &Row) -> bool {
    (*low..=*high).contains(truth)
}

/// Writes a row of the table.
pub fn line(report: &mut Report, work: &str, what: &str, rows: &[Row], of: usize, bound: &Bound) {
    if rows.is_empty() {
        report.line(&format!("| {work} | {what} | | | | | 0 of {of} | {} | |", bound.asked));
        return;
    }
    let count = rows.len() as f64;
    let errors = || rows.iter().map(|(truth, [value, ..])| 100.0 * (value / truth - 1.0));
    let signed = errors().sum::<f64>() / count;
    let mean = errors().map(f64::abs).sum::<f64>() / count;
    let worst = errors().map(f64::abs).fold(0.0, f64::max);
    let covered = 100.0 * rows.iter().filter(|row| covers(row)).count() as f64 / count;
    let [least, most] = bound.covers;
    let reached = match bound.asked {
        "" => "",
        _ if mean <= bound.mean && worst <= bound.worst && (least..=most).contains(&covered) => "yes",
        _ => "no",
    };
    report.line(&format!(
        "| {work} | {what} | {mean:.1} | {worst:.1} | {signed:+.1} | {covered:.0} | {} of {of} | {} | {reached} |",
        rows.len(),
        bound.asked
    ));
}

/// Writes what fits cost on one thread: three features of a sharp cone, a curve of a cone with one of a ball,
/// a cone and a ball each with its imprint.
pub fn times(report: &mut Report, times: [Option<[f64; 2]>; 4]) {
    report.section("What a fit costs");
    report.table("| fit | core seconds | runs of finite elements | asked, s | reached |");
    let fits = [
        ("one sharp cone, three features", 2.0),
        ("curves of a sharp cone and of a ball", 60.0),
        ("a sharp cone and its imprint", 10.0),
        ("a ball and its imprint", 15.0),
    ];
    for ((name, most), time) in fits.into_iter().zip(times) {
        match time {
            Some([seconds, runs]) => {
                let reached = if seconds <= most { "yes" } else { "no" };
                report.line(&format!("| {name} | {seconds:.1} | {runs} | {most} | {reached} |"));
            }
            None => report.line(&format!("| {name} | not run | | {most} | |")),
        }
    }
}

/// Writes how the numbers of the twins miss, over the half width of their intervals, and the twins that are
/// outside.
pub fn twins(report: &mut Report, solved: &[Solved]) {
    report.section("Twins outside an interval");
    report.table("| twin | E, GPa | σ_y, MPa | n | E found | σ_y found | n found |");
    for s in solved {
        let truth = [s.case.youngs_modulus, s.case.yield_stress, s.case.exponent];
        let found = ["youngs_modulus", "yield_stress", "hardening_exponent"].map(|name| s.parameter(name));
        if truth.iter().zip(found).all(|(t, f)| covers(&(*t, f))) {
            continue;
        }
        let cell = |i: usize, digits: usize| {
            let (row, [value, low, high]) = ((truth[i], found[i]), found[i]);
            let mark = if covers(&row) { "" } else { "outside " };
            format!("{mark}{value:.digits$} ({low:.digits$} to {high:.digits$})")
        };
        report.line(&format!(
            "| {} | {} | {} | {} | {} | {} | {} |",
            s.case.name,
            truth[0],
            truth[1],
            truth[2],
            cell(0, 1),
            cell(1, 0),
            cell(2, 3)
        ));
    }
}
