//! How well the error that a run states bounds the true one: a battery of 300 scenes at draft accuracy, each
//! against the smoothed curve of a much finer run of its own. The constants of the estimate were chosen on the first 200.
//!
//! `cargo run --release -p asperity-verification --example coverage [-- --out FILE]` (about seven minutes of two cores);
//! with the argument `rows` also every scene, with numbers only the scenes of these numbers. The table is
//! `verification/results/coverage.md`.

// on scenes of its own
#![allow(clippy::expect_used)]

use asperity_solver::run::crush::Outcome;
use asperity_solver::run::curve::Curve;
use asperity_solver::scene::{Accuracy, Scene};
use asperity_verification::coverage_scenes::{Entry, battery};
use asperity_verification::report::Report;
use asperity_verification::single_asperity::{crush, driven_by};
use rayon::prelude::*;

/// Scenes of the battery that the constants of the estimate were chosen on; half as many others follow.
const CHOSEN: usize = 200;

/// Errors of one scene, relative to the force.
struct Row {
    name: String,
    /// Largest difference of the force from the finer one.
    error: f64,
    /// Its mean, with sign.
    bias: f64,
    /// Largest difference of the finer force from its own smoothed curve.
    doubt: f64,
    stated: f64,
    balance: f64,
}

fn finish(scene: &Scene) -> Result<Outcome, String> {
    let outcome = crush(scene).map_err(|e| e.to_string())?;
    match &outcome.stopped {
        Some(stopped) => Err(stopped.reason.to_string()),
        None => Ok(outcome),
    }
}

/// The scene driven by the force that it has at its depth.
fn by_force(scene: &Scene) -> Result<Scene, String> {
    let force = finish(&Scene { accuracy: Accuracy::Draft, ..scene.clone() })?.summary.peak_force;
    Ok(driven_by(scene, force))
}

fn measure(entry: &Entry) -> Result<Row, String> {
    let scene = if entry.by_force { by_force(&entry.scene)? } else { entry.scene.clone() };
    let mut finer = scene.clone();
    finer.numerics.elements_in_contact = Some(40);
    finer.numerics.steps = Some(144);
    finer.numerics.domain = Some(400.0);
    finer.numerics.penetration = Some(0.002);
    let finer = Curve::force(&finish(&finer)?.rows);
    let draft = finish(&Scene { accuracy: Accuracy::Draft, ..scene })?;
    let curve = Curve::force(&draft.rows);
    let peak = curve.end().min(finer.end());
    let smooth = finer.smooth(peak);
    Ok(Row {
        name: entry.name.clone(),
        error: curve.worst_difference(|h| smooth.at(h), peak),
        bias: curve.mean_difference(|h| smooth.at(h), peak),
        doubt: finer.worst_difference(|h| smooth.at(h), peak),
        stated: draft.summary.estimated_error,
        balance: draft.summary.energy_balance_error,
    })
}

/// The row of a battery in the table.
fn summary(name: &str, rows: &[&Row]) -> String {
    let mut ratios: Vec<f64> = rows.iter().map(|r| r.stated / r.error).collect();
    ratios.sort_by(f64::total_cmp);
    let share = |good: &dyn Fn(f64) -> bool| {
        100.0 * ratios.iter().filter(|r| good(**r)).count() as f64 / ratios.len() as f64
    };
    let errors = rows.iter().map(|r| r.error);
    format!(
        "| {name} | {} | {:.0} | {:.0} | {:.1} | {:.2} | {:.2} | {} |",
        rows.len(),
        share(&|r| r >= 1.0),
        share(&|r| r <= 5.0),
        ratios[ratios.len() / 2],
        ratios[0],
        100.0 * errors.clone().fold(0.0, f64::max),
        errors.filter(|e| *e > 0.05).count(),
    )
}

fn main() {
    let batteries = [("the constants were chosen on", 0..CHOSEN), ("others", CHOSEN..CHOSEN + CHOSEN / 2)];
    let (mut report, words) = Report::of("coverage", "draft against finer runs");
    let only: Vec<usize> = words.iter().filter_map(|a| a.parse().ok()).collect();
    let mut summaries = Vec::new();
    for (name, numbers) in batteries {
        let entries: Vec<Entry> = numbers
            .filter(|i| only.is_empty() || only.contains(i))
            .flat_map(|i| battery(i..i + 1).expect("the committed scene reads"))
            .collect();
        if entries.is_empty() {
            continue;
        }
        let results: Vec<_> = entries.par_iter().with_max_len(1).map(|e| (e, measure(e))).collect();
        let rows: Vec<&Row> = results.iter().filter_map(|(_, r)| r.as_ref().ok()).collect();
        if words.iter().any(|word| word == "rows") {
            report.table(
                "| scene | true error, % | bias, % | stated, % | energy balance | ripple of the finer run, % |"
            );
            for row in &rows {
                report.line(&format!(
                    "| {} | {:.2} | {:+.2} | {:.2} | {:.1e} | {:.2} |",
                    row.name,
                    100.0 * row.error,
                    100.0 * row.bias,
                    100.0 * row.stated,
                    row.balance,
                    100.0 * row.doubt
                ));
            }
            report.line("");
        }
        for (entry, reason) in results.iter().filter_map(|(e, r)| Some((e, r.as_ref().err()?))) {
            report.line(&format!("not measured: {}: {reason}\n", entry.name));
        }
        summaries.push(summary(name, &rows));
    }
    report.table(
        "| scenes | number | bounded, % | stated within a factor of 5, % | median of stated over true | smallest | largest true error, % | above 5 %, scenes |"
    );
    summaries.iter().for_each(|line| report.line(line));
    report.finish().expect("the file named can be written");
}
