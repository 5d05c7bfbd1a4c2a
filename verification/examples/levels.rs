//! Errors of the levels of accuracy on ten scenes that none of them was chosen by: the true error of the
//! force and the stated one.
//!
//! `cargo run --release -p asperity-verification --example levels -- [ROW …] [--out FILE]` (rows counted from
//! 1; all of them unless told; a scene takes minutes at reference); the table is
//! `verification/results/levels.md`. The converged force is the mean of the smoothed curves of `reference`
//! and of a mesh finer by a quarter, so that the column of `reference` shows half of what the two differ by.

// on scenes of its own
#![allow(clippy::expect_used)]

use asperity_simulation::record::curve::{Curve, Smooth};
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, Scene};
use asperity_simulation::setup::discretisation::Discretisation;
use asperity_verification::coverage_scenes::{Entry, others};
use asperity_verification::report::Report;
use asperity_verification::single_asperity::crush;
use rayon::prelude::*;

const LEVELS: [Accuracy; 3] = [Accuracy::Draft, Accuracy::Standard, Accuracy::Reference];

fn finish(scene: &Scene) -> Result<Outcome, String> {
    let outcome = crush(scene).map_err(|e| e.to_string())?;
    match &outcome.stopped {
        Some(stopped) => Err(stopped.reason.to_string()),
        None => Ok(outcome),
    }
}

/// A row of the table.
fn row(entry: &Entry) -> Result<String, String> {
    let runs: Vec<Outcome> = LEVELS
        .iter()
        .map(|&accuracy| finish(&Scene { accuracy, ..entry.scene.clone() }))
        .collect::<Result<_, _>>()?;
    let mut other = Scene { accuracy: Accuracy::Reference, ..entry.scene.clone() };
    // another mesh, so that what ripple the fits leave averages out
    other.numerics.elements_in_contact = Some(Discretisation::new(&other).elements_in_contact * 5 / 4);
    let other = Curve::force(&finish(&other)?.rows);
    let curves: Vec<Curve> = runs.iter().map(|run| Curve::force(&run.rows)).collect();
    let peak = curves[2].end();
    let (a, b) = (curves[2].smooth(peak), other.smooth(peak));
    let converged = Smooth::mean(&a, &b);
    let cells: String = curves
        .iter()
        .zip(&runs)
        .map(|(curve, run)| {
            let error = curve.worst_difference(|h| converged.value(h), peak);
            format!(" {:.2} | {:.2} |", 100.0 * error, 100.0 * run.summary.estimated_error)
        })
        .collect();
    let doubt = [0.2, 0.4, 0.7, 1.0].map(|s| (a.value(s * peak) / b.value(s * peak) - 1.0).abs());
    Ok(format!("| {} |{cells} {:.2} |", entry.name, 50.0 * doubt.iter().fold(0.0, |m: f64, d| m.max(*d))))
}

fn main() {
    let (mut report, words) = Report::of_example("levels", "draft, standard and reference");
    let rows: Vec<usize> = words.iter().map(|a| a.parse().expect("a row is a number")).collect();
    let entries = others().expect("the committed scene reads").into_iter().enumerate();
    let entries: Vec<Entry> =
        entries.filter(|(i, _)| rows.is_empty() || rows.contains(&(i + 1))).map(|(_, entry)| entry).collect();
    let measured = |entry: &Entry| {
        row(entry).unwrap_or_else(|reason| format!("| {} | {reason} | | | | | | |", entry.name))
    };
    let rows: Vec<String> = entries.par_iter().with_max_len(1).map(measured).collect();
    report.table(
        "| scene | draft, % | stated | standard, % | stated | reference, % | stated | converged ± % |",
    );
    rows.iter().for_each(|row| report.line(row));
    report.finish().expect("the file named can be written");
}
