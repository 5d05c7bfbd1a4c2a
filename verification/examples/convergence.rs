//! Convergence of the single asperity with mesh, step, penalty and domain, both elements, and the errors of
//! the three levels of accuracy.
//!
//! `cargo run --release -p asperity-verification --example convergence [-- energy] [--out FILE]` (about ten
//! minutes of two cores); with the argument `energy` only the energy balance. The tables are
//! `verification/results/convergence.md`.

// on a committed scene
#![allow(clippy::expect_used)]

use asperity_simulation::record::curve::{Curve, Smooth};
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, ElementChoice, Scene};
use asperity_verification::contact::punch_stiffness;
use asperity_verification::report::{Report, timed};
use asperity_verification::single_asperity::{crush, scene};
use std::sync::atomic::{AtomicUsize, Ordering};

const PEAK: f64 = 5e-6;

struct Run {
    name: String,
    outcome: Outcome,
    seconds: f64,
}

/// Differences of the discretisation from that of the level.
#[derive(Clone, Copy, Default)]
struct Change {
    q4: bool,
    elements: Option<usize>,
    steps: Option<usize>,
    penetration: Option<f64>,
    domain: Option<f64>,
}

fn go(name: &str, accuracy: Accuracy, change: Change) -> Run {
    let mut scene: Scene = scene(accuracy).expect("the committed scene reads");
    let numerics = &mut scene.numerics;
    numerics.element = Some(if change.q4 { ElementChoice::Q4 } else { ElementChoice::Q8r });
    numerics.elements_in_contact = change.elements;
    numerics.steps = change.steps;
    numerics.penetration = change.penetration;
    numerics.domain = change.domain;
    let (outcome, seconds) = timed(|| crush(&scene).expect("the committed scene runs"));
    Run { name: name.into(), outcome, seconds }
}

/// One run to make.
type Job = (String, Accuracy, Change);

/// Makes the runs on two threads; each run is the work of one thread, and the answers do not depend on it.
fn all(jobs: &[Job]) -> Vec<Run> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            // the last ones are the longest
            let Some(index) = jobs.len().checked_sub(index + 1) else { return done };
            let (name, accuracy, change) = &jobs[index];
            done.push((index, go(name, *accuracy, *change)));
        }
    };
    let mut runs: Vec<(usize, Run)> = std::thread::scope(|scope| {
        let threads = [scope.spawn(work), scope.spawn(work)];
        threads.into_iter().flat_map(|t| t.join().expect("no run panics")).collect()
    });
    runs.sort_by_key(|(index, _)| *index);
    runs.into_iter().map(|(_, run)| run).collect()
}

fn header(report: &mut Report, title: &str, fixed: &str) {
    report.section(title);
    report.line(&format!("{fixed}.\n"));
    report.table(
        "| | F(1 µm), N | F(2 µm), N | F(5 µm), N | largest error, % | mean error, % | residual depth, µm | elastic fraction, % | elements | increments | iterations | s |"
    );
}

/// The force while loading.
fn force(run: &Run) -> Curve {
    Curve::force(&run.outcome.rows)
}

fn row(report: &mut Report, run: &Run, converged: &Smooth) {
    let (curve, summary) = (force(run), &run.outcome.summary);
    report.line(&format!(
        "| {} | {:.4} | {:.4} | {:.4} | {:.2} | {:+.2} | {:.4} | {:.2} | {} | {} | {} | {:.1} |",
        run.name,
        curve.value(1e-6),
        curve.value(2e-6),
        curve.value(PEAK),
        100.0 * curve.worst_difference(|h| converged.value(h), PEAK),
        100.0 * curve.mean_difference(|h| converged.value(h), PEAK),
        1e6 * summary.residual_depth.unwrap_or(f64::NAN),
        100.0 * summary.elastic_fraction.unwrap_or(f64::NAN),
        summary.elements,
        summary.increments,
        summary.newton_iterations,
        run.seconds,
    ));
}

fn level(report: &mut Report, run: &Run, converged: &Smooth) {
    let summary = &run.outcome.summary;
    let curve = force(run);
    let worst = curve.worst_difference(|h| converged.value(h), PEAK);
    let modulus = 210e9 / (1.0 - 0.09);
    let ratio =
        summary.unloading_stiffness.unwrap_or(f64::NAN) / punch_stiffness(modulus, summary.contact_radius);
    report.line(&format!(
        "| {} | {:.2} | {:+.2} | {:.1e} | {:.3} | {} | {} | {:.1} |",
        run.name,
        100.0 * worst,
        100.0 * curve.mean_difference(|h| converged.value(h), PEAK),
        summary.energy_balance_error,
        ratio,
        summary.elements,
        summary.newton_iterations,
        run.seconds,
    ));
}

/// Runs of standard accuracy that differ in one number.
fn vary(values: &[f64], name: impl Fn(f64) -> String, change: impl Fn(f64) -> Change) -> Vec<Run> {
    let jobs: Vec<Job> = values.iter().map(|&v| (name(v), Accuracy::Standard, change(v))).collect();
    all(&jobs)
}

/// Converged values: the mean of the two finest quadratic meshes, smoothed over depth. The interval is their
/// difference, or half the difference of the extrapolated linear element if that is larger.
fn converged_values(report: &mut Report, quadratic: &[Run], linear: &[Run]) -> Smooth {
    let smoothed = |run: &Run| force(run).smooth(PEAK);
    let finest: Vec<Smooth> = quadratic.iter().rev().take(2).map(smoothed).collect();
    let converged = Smooth::mean(&finest[0], &finest[1]);
    let q4: Vec<Smooth> = linear.iter().rev().take(2).map(smoothed).collect();
    report.section("Converged force");
    report.table("| h, µm | converged F, N | ± % | Q4 extrapolated, N |");
    for h in [1.0, 2.0, 5.0] {
        let [f, a, b, fine, coarse] =
            [&converged, &finest[0], &finest[1], &q4[0], &q4[1]].map(|curve| curve.value(h * 1e-6));
        // observed: the error of the linear element falls with its size
        let extrapolated = 2.0 * fine - coarse;
        let interval = (a - b).abs().max(0.5 * (extrapolated - f).abs()) / f;
        report.line(&format!("| {h} | {f:.4} | {:.2} | {extrapolated:.4} |", 100.0 * interval));
    }
    converged
}

/// Energy balance for three metals; `exponent` and `steps` are all that differs from standard.
fn energy_balance(report: &mut Report) {
    report.section("Energy balance");
    report.line("Largest |W - E_e - W_p - E_c|/W, standard.\n");
    report.table("| steps | n = 0 | n = 0.1 | n = 0.3 |");
    for steps in [24, 64, 128] {
        let errors = [0.0, 0.1, 0.3].map(|exponent| {
            let mut scene = scene(Accuracy::Standard).expect("the committed scene reads");
            scene.material.hardening_exponent = Some(exponent);
            scene.numerics.steps = Some(steps);
            let outcome = crush(&scene).expect("the committed scene runs");
            format!("{:.1e}", outcome.summary.energy_balance_error)
        });
        report.line(&format!("| {steps} | {} |", errors.join(" | ")));
    }
}

fn main() {
    let (mut report, words) = Report::of_example("convergence", "all levels");
    if words.iter().all(|word| word != "energy") {
        studies(&mut report);
    }
    energy_balance(&mut report);
    report.finish().expect("the file named can be written");
}

/// Every study but that of the energy.
fn studies(report: &mut Report) {
    let fine =
        Change { steps: Some(192), penetration: Some(0.001), domain: Some(800.0), ..Change::default() };
    let mesh = |q4: bool, n: f64| Change { q4, elements: Some(n as usize), ..fine };
    let quadratic =
        vary(&[12.0, 16.0, 24.0, 36.0, 54.0, 80.0], |n| format!("Q8R, {n} in contact"), |n| mesh(false, n));
    let linear = vary(&[27.0, 54.0, 108.0], |n| format!("Q4, {n} in contact"), |n| mesh(true, n));
    let converged = converged_values(report, &quadratic, &linear);
    header(report, "Mesh", "192 steps, penetration 0.001 of the depth, domain 800 contact radii");
    quadratic.iter().chain(&linear).for_each(|run| row(report, run, &converged));

    header(report, "Step", "the rest as standard");
    vary(
        &[16.0, 24.0, 32.0, 48.0, 64.0, 96.0, 192.0, 384.0],
        |n| format!("{n} steps"),
        |n| Change { steps: Some(n as usize), ..Change::default() },
    )
    .iter()
    .for_each(|run| row(report, run, &converged));

    header(report, "Penalty", "the rest as standard, 192 steps");
    vary(
        &[0.016, 0.008, 0.004, 0.002, 0.001, 0.0005],
        |p| format!("penetration {p}"),
        |p| Change { steps: Some(192), penetration: Some(p), ..Change::default() },
    )
    .iter()
    .for_each(|run| row(report, run, &converged));

    header(report, "Domain", "the rest as standard");
    vary(
        &[25.0, 50.0, 100.0, 200.0, 400.0, 800.0, 1600.0],
        |d| format!("{d} contact radii"),
        |d| Change { domain: Some(d), ..Change::default() },
    )
    .iter()
    .for_each(|run| row(report, run, &converged));

    report.section("Levels");
    report.line("Error of the force over depths of 0.2 to 1 of the peak.\n");
    report.table(
        "| | largest, % | mean, % | energy balance | unloading stiffness over 2 E* a | elements | iterations | s |"
    );
    let levels = [
        ("draft", Accuracy::Draft, false),
        ("draft, Q4", Accuracy::Draft, true),
        ("standard", Accuracy::Standard, false),
        ("standard, Q4", Accuracy::Standard, true),
        ("reference", Accuracy::Reference, false),
    ];
    let jobs: Vec<Job> = levels
        .iter()
        .map(|(n, a, q4)| (n.to_string(), *a, Change { q4: *q4, ..Change::default() }))
        .collect();
    all(&jobs).iter().for_each(|run| level(report, run, &converged));
}
