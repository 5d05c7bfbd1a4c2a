//! Prints the table "Unloading and reloading" of `verification/README.md`: the single asperity, crushed and then
//! unloaded and loaded again ten times.

#![allow(clippy::print_stdout, reason = "an example prints")]

use asperity_solver::crush::Outcome;
use asperity_solver::scene::Accuracy;
use asperity_verification::single_asperity::{crush, scene};

fn print(name: &str, outcome: &Outcome) {
    let first = outcome.cycles[0];
    for row in &outcome.cycles {
        println!(
            "| {name} | {} | {:.6} | {:.6} | {:.6} | {:.6} | {:.2e} | {:.2e} |",
            row.cycle,
            row.peak_force,
            1e6 * row.residual_depth,
            row.work_in / first.work_in,
            row.work_out / first.work_in,
            (row.work_in - row.work_out) / first.work_in,
            row.plastic_work / first.work_in,
        );
    }
    let s = &outcome.summary;
    println!(
        "stopped {:?}, balance {:.2e}, {} increments, {} iterations, {} cut-backs",
        outcome.stopped, s.energy_balance_error, s.increments, s.newton_iterations, s.cutbacks
    );
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for accuracy in [Accuracy::Draft, Accuracy::Standard] {
        let mut scene = scene(accuracy)?;
        scene.loading.reloads = 10;
        print("isotropic", &crush(&scene)?);
    }
    Ok(())
}
