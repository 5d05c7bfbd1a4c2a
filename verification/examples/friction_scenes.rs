//! Scenes with friction beside what they are without: which of those drawn at random reach their depth and
//! with how many more iterations, and how often the stated errors hold.
//!
//! `cargo run --release -p asperity-verification --example friction_scenes -- [COUNT] [SEED] [JUDGED] [--out
//! FILE]`: COUNT scenes of the generator of texts (1000 of seed 1 unless told), and JUDGED scenes (100) of
//! the battery of stated errors, of numbers that are not in it. The table is
//! `verification/results/friction-scenes.md`.

use asperity_simulation::record::rows::Summary;
use asperity_simulation::scene::{Accuracy, Friction, Scene};
use asperity_verification::coverage_scenes::{BEYOND_BATTERY, Case};
use asperity_verification::friction::with_friction;
use asperity_verification::random_scenes::{Kind, draw};
use asperity_verification::report::{Report, quantile};
use asperity_verification::single_asperity::crush;
use asperity_verification::truth::{Answer, Each, QUANTITIES};
use rayon::prelude::*;
use std::error::Error;
use std::path::Path;

/// Coefficients of the scenes in turn, and one that sticks.
const COEFFICIENTS: [f64; 9] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.3, 0.45, 0.7, 1.0];

fn friction(number: usize) -> Friction {
    let turn = number % (COEFFICIENTS.len() + 1);
    COEFFICIENTS.get(turn).map_or(Friction::Sticking, |&coefficient| Friction::Coefficient(coefficient))
}

/// The summary of a run that reached its end.
fn reached(scene: &Scene) -> Option<Summary> {
    let outcome = crush(scene).ok()?;
    outcome.stopped.is_none().then_some(outcome.summary)
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut report, words) = Report::of_example("friction_scenes", "draft");
    let count: usize = words.first().map_or(Ok(1000), |a| a.parse())?;
    let seed: u64 = words.get(1).map_or(Ok(1), |a| a.parse())?;
    let judged: usize = words.get(2).map_or(Ok(100), |a| a.parse())?;
    random(&mut report, count, seed)?;
    stated(&mut report, judged)?;
    Ok(report.finish()?)
}

/// The sound scenes among `count` of `seed` at draft, in one round, without friction and with it.
fn random(report: &mut Report, count: usize, seed: u64) -> Result<(), Box<dyn Error>> {
    report.section(&format!("Scenes drawn at random, {count} of seed {seed} at draft"));
    let sound: Vec<(usize, Scene)> = draw(count, seed)?
        .into_iter()
        .enumerate()
        .filter(|(_, drawn)| drawn.kind == Kind::Sound)
        .filter_map(|(i, drawn)| {
            let scene = asperity::Scene::from_toml(&drawn.text, Path::new(".")).ok()?.tables().clone();
            Some((i, scene.with_accuracy(Accuracy::Draft)))
        })
        .collect();
    let ends: Vec<(usize, Option<[f64; 2]>)> = sound
        .par_iter()
        .with_max_len(1)
        .filter_map(|(number, scene)| {
            let per_increment = |s: &Summary| s.newton_iterations as f64 / s.increments as f64;
            let smooth = reached(&with_friction(scene.clone(), None))?;
            let rough = reached(&with_friction(scene.clone(), Some(friction(*number))));
            let numbers =
                |rough: Summary| [per_increment(&rough) / per_increment(&smooth), rough.energy_balance_error];
            Some((*number, rough.map(numbers)))
        })
        .collect();
    let mut stopped: Vec<usize> = ends.iter().filter(|(_, end)| end.is_none()).map(|(i, _)| *i).collect();
    stopped.sort_unstable();
    let [more, balances] =
        [0, 1].map(|k| ends.iter().filter_map(|(_, end)| Some(end.as_ref()?[k])).collect::<Vec<f64>>());
    report.line(&format!(
        "{} of {} that reach their depth without friction reach it with friction ({:.1} %). Iterations an increment \
         over those without: median {:.2}, 90 % {:.2}. Energy balance: median {:.1e}, 90 % {:.1e}.",
        more.len(),
        ends.len(),
        100.0 * more.len() as f64 / ends.len() as f64,
        quantile(more.iter().copied(), 0.5),
        quantile(more.iter().copied(), 0.9),
        quantile(balances.iter().copied(), 0.5),
        quantile(balances.iter().copied(), 0.9),
    ));
    if !stopped.is_empty() {
        let named: Vec<String> = stopped.iter().map(usize::to_string).collect();
        report.line(&format!("\nScenes that stop with friction alone: {}.", named.join(", ")));
    }
    Ok(())
}

/// Errors that `count` scenes of the battery with friction state at draft, against one run at reference,
/// whose penalties in both directions, elements and steps are four times as fine.
fn stated(report: &mut Report, count: usize) -> Result<(), Box<dyn Error>> {
    report.section(&format!("Stated errors of {count} scenes with friction at draft, against reference"));
    let judged: Vec<Option<[Each; 2]>> = (0..count)
        .into_par_iter()
        .with_max_len(1)
        .map(|i| {
            let case = Case::new(BEYOND_BATTERY + i).ok()?;
            let scene = with_friction(case.scene.clone(), Some(friction(i)));
            let at = |accuracy| Answer::compute(&scene.clone().with_accuracy(accuracy), None).ok();
            let (own, truth) = (at(Accuracy::Draft)?, at(Accuracy::Reference)?);
            Some([own.error(&truth), own.stated])
        })
        .collect();
    let missing = judged.iter().filter(|found| found.is_none()).count();
    report.line(&format!("{missing} of them did not reach their depth at both levels.\n"));
    report.table("| quantity | scenes | bounded, % | median of stated over true |");
    for (i, name) in QUANTITIES.iter().enumerate() {
        let ratios: Vec<f64> = judged
            .iter()
            .flatten()
            .filter_map(|[error, stated]| Some(stated[i]? / error[i]?.max(f64::MIN_POSITIVE)))
            .collect();
        let bounded = ratios.iter().filter(|ratio| **ratio >= 1.0).count();
        report.line(&format!(
            "| {name} | {} | {:.1} | {:.1} |",
            ratios.len(),
            100.0 * bounded as f64 / ratios.len() as f64,
            quantile(ratios.iter().copied(), 0.5)
        ));
    }
    // force and area at the peak
    let outside: Vec<String> = judged
        .iter()
        .enumerate()
        .flat_map(|(number, found)| {
            let told = move |i: usize| {
                let [error, stated] = found.as_ref()?;
                let [error, stated] = [error[i]?, stated[i]?];
                let name = QUANTITIES[i];
                (error > stated).then(|| {
                    format!("{name} of {number} ({:.1} %, {:.1} stated)", 100.0 * error, 100.0 * stated)
                })
            };
            (0..2).filter_map(told)
        })
        .collect();
    if !outside.is_empty() {
        report.line(&format!("\nOutside: {}.", outside.join(", ")));
    }
    Ok(())
}
