//! The single asperity, crushed and then unloaded and loaded again ten times, with a yield surface that grows
//! and with one that moves.
//!
//! `cargo run --release -p asperity-verification --example cycles [-- draft] [--out FILE]`; the table is
//! `verification/results/cycles.md`.

use asperity_material::HardeningMode;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::Accuracy;
use asperity_verification::report::Report;
use asperity_verification::single_asperity::{crush, scene};

/// Cycles that are shown.
const SHOWN: [usize; 5] = [0, 1, 2, 5, 10];

fn table(report: &mut Report, name: &str, outcome: &Outcome) {
    let Some(first) = outcome.cycles.first().map(|c| c.work_in) else { return };
    for row in SHOWN.iter().filter_map(|&k| outcome.cycles.get(k)) {
        report.line(&format!(
            "| {name} | {} | {:.4} | {:.4} | {:.3} | {:.4} | {:.4} |",
            row.cycle,
            row.peak_force,
            1e6 * row.residual_depth,
            100.0 * row.work_out / first,
            100.0 * (row.work_in - row.work_out) / first,
            100.0 * row.plastic_work / first,
        ));
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let draft = std::env::args().any(|a| a == "draft");
    let (level, named) = if draft { (Accuracy::Draft, "draft") } else { (Accuracy::Standard, "standard") };
    let (mut report, _) = Report::of_example("cycles", named);
    report.table(
        "| hardening | cycle | peak force, N | residual depth, µm | work returned, % | hysteresis, % | plastic work, % |"
    );
    let modes = [("isotropic", None), ("a quarter kinematic", Some(0.25)), ("half kinematic", Some(0.5))];
    let mut balances = Vec::new();
    for (name, share) in modes {
        let mut scene = scene(level)?;
        scene.loading.reloads = 10;
        if share.is_some() {
            scene.material.hardening_mode = HardeningMode::Kinematic;
            scene.material.kinematic_share = share;
        }
        let outcome = crush(&scene)?;
        table(&mut report, name, &outcome);
        let end = outcome.stopped.map_or("none".to_string(), |stopped| stopped.reason.to_string());
        balances.push(format!("| {name} | {:.1e} | {end} |", outcome.summary.energy_balance_error));
    }
    report.section("Energy");
    report.table("| hardening | energy balance | stopped early |");
    balances.iter().for_each(|row| report.line(row));
    Ok(report.finish()?)
}
