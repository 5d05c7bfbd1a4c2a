//! Prints what was measured of asperities side by side as markdown tables: how three ridges approach three times one, what
//! a ring adds to the depth of the centre, and the convergence of the committed scenes of three asperities.
//!
//! `cargo run --release -p asperity-verification --example several [-- approach.csv]` (about two minutes of one
//! core). The argument `convergence` prints only that; another names a file for the approach, which `scripts/figures.py` draws.

// a program whose output is the point, on committed scenes
#![allow(clippy::print_stdout, clippy::expect_used)]

use asperity_solver::scene::{Accuracy, Lateral, Scene, Symmetry};
use asperity_verification::several::{
    FOOT, LOW, Member, PAPER, at, depth_at, of_asperity, row, three_over_one, whole,
};
use asperity_verification::single_asperity::crush;

const DEPTHS: [f64; 3] = [100e-6, 200e-6, 400e-6];
const PITCHES: [f64; 7] = [0.6, 1.2, 2.0, 2.4, 3.0, 4.0, 6.0];

/// Three ridges over three times one, by the pitch in depths of the layer.
fn approach() -> String {
    println!("\n### Three ridges with free sides over three times one\n");
    println!("Largest difference of the force from a fifth of the depth on, %, draft.\n");
    println!("| pitch over depth of the substrate | 100 µm | 200 µm | 400 µm |\n|-|-|-|-|");
    let mut csv = String::from("pitch_over_depth,depth_um,difference\n");
    for pitch in PITCHES {
        let cells = DEPTHS.map(|depth| {
            if pitch * depth < 2.0 * FOOT {
                return String::new();
            }
            let difference = three_over_one(pitch * depth, depth, Accuracy::Draft).expect("the rows run");
            csv += &format!("{pitch},{:.0},{difference}\n", 1e6 * depth);
            format!("{:.2}", 100.0 * difference)
        });
        println!("| {pitch} | {} |", cells.join(" | "));
    }
    csv
}

/// The depth that a ring adds to the centre, over 2P/E*.
fn rings() {
    println!("\n### What a touched ring adds to the depth of the centre, over 2P/E*\n");
    println!("| radius of the ring, µm | elastic | n = 0.3 |\n|-|-|-|");
    for pitch in [300e-6, 600e-6, 1200e-6, 2400e-6] {
        let ratios = [true, false].map(|elastic| {
            let cone = Member { spacing: pitch - 2.0 * FOOT, ..PAPER };
            let body = |ring: Member| {
                let size = Some([400.0 * pitch; 2]);
                let mut scene = row(Symmetry::Axisymmetric, Lateral::Free, &[cone, ring], size)
                    .expect("the committed scene reads");
                if elastic {
                    (scene.material.yield_stress, scene.material.hardening_exponent) = (None, None);
                }
                scene
            };
            let alone = whole(&crush(&body(LOW)).expect("the row runs"));
            let both = crush(&body(PAPER)).expect("the row runs");
            let [depth, force] = of_asperity(&both, 0).last().copied().unwrap_or([f64::NAN; 2]);
            let line_load = at(&of_asperity(&both, 1), depth) / (std::f64::consts::TAU * pitch);
            let modulus = body(PAPER).material.elastic().reduced_modulus();
            (depth - depth_at(&alone, force)) * modulus / (2.0 * line_load)
        });
        println!("| {:.0} | {:.3} | {:.3} |", 1e6 * pitch, ratios[0], ratios[1]);
    }
}

/// Headline numbers of a committed scene over meshes and steps.
fn convergence(name: &str, text: &str) {
    println!("\n### {name}\n");
    println!(
        "| elements in contact | steps | peak force | total work | elastic share, % | energy balance | estimated error, % | iterations |"
    );
    println!("|-|-|-|-|-|-|-|-|");
    let settings = [(11, 149), (16, 149), (22, 74), (22, 149), (22, 298), (32, 149)];
    for (elements, steps) in settings {
        let mut scene: Scene = toml::from_str(text).expect("the committed scene reads");
        scene.output.every = Some(0);
        scene.numerics.elements_in_contact = Some(elements);
        scene.numerics.steps = Some(steps);
        let outcome = crush(&scene).expect("the committed scene runs");
        let s = &outcome.summary;
        // N and µJ, or N/mm and µJ/mm
        let [force, work] = match scene.symmetry {
            Symmetry::Axisymmetric => [s.peak_force, 1e6 * s.total_work],
            Symmetry::PlaneStrain => [1e-3 * s.peak_force, 1e3 * s.total_work],
        };
        println!(
            "| {elements} | {steps} | {force:.2} | {work:.2} | {:.2} | {:.1e} | {:.2} | {} |",
            100.0 * s.elastic_fraction.unwrap_or(f64::NAN),
            s.energy_balance_error,
            100.0 * s.estimated_error,
            s.newton_iterations,
        );
    }
}

fn main() {
    let argument = std::env::args().nth(1);
    if argument.as_deref() != Some("convergence") {
        let csv = approach();
        if let Some(path) = argument {
            std::fs::write(path, csv).expect("the file named can be written");
        }
        rings();
    }
    convergence(
        "Three identical asperities, axisymmetric (N, µJ)",
        include_str!("../../meshes/three-identical.toml"),
    );
    convergence(
        "Three identical ridges, plane strain (N/mm, µJ/mm)",
        include_str!("../../meshes/three-identical-plane-strain.toml"),
    );
}
