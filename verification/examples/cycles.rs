//! Prints the tables "Unloading and reloading" of `verification/README.md`: the single asperity, crushed and then
//! unloaded and loaded again ten times, with a yield surface that grows and with one that moves.

#![allow(clippy::print_stdout, reason = "an example prints")]

use asperity_law::HardeningMode;
use asperity_solver::run::crush::Outcome;
use asperity_solver::scene::Accuracy;
use asperity_verification::single_asperity::{crush, scene};

/// Cycles that are shown.
const SHOWN: [usize; 5] = [0, 1, 2, 5, 10];

fn print(name: &str, outcome: &Outcome) {
    let Some(first) = outcome.cycles.first().map(|c| c.work_in) else { return };
    for row in SHOWN.iter().filter_map(|&k| outcome.cycles.get(k)) {
        println!(
            "| {name} | {} | {:.4} | {:.4} | {:.3} | {:.4} | {:.4} |",
            row.cycle,
            row.peak_force,
            1e6 * row.residual_depth,
            100.0 * row.work_out / first,
            100.0 * (row.work_in - row.work_out) / first,
            100.0 * row.plastic_work / first,
        );
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "| hardening | cycle | peak force, N | residual depth, µm | work returned, % | hysteresis, % | plastic work, % |"
    );
    println!("|-|-|-|-|-|-|-|");
    let modes = [("isotropic", None), ("a quarter kinematic", Some(0.25)), ("half kinematic", Some(0.5))];
    let level = if std::env::args().any(|a| a == "draft") { Accuracy::Draft } else { Accuracy::Standard };
    for (name, share) in modes {
        let mut scene = scene(level)?;
        scene.loading.reloads = 10;
        if share.is_some() {
            scene.material.hardening_mode = HardeningMode::Kinematic;
            scene.material.kinematic_share = share;
        }
        let outcome = crush(&scene)?;
        print(name, &outcome);
        let balance = outcome.summary.energy_balance_error;
        println!("\n{name}: energy balance {balance:.1e}, stopped: {:?}\n", outcome.stopped);
    }
    Ok(())
}
