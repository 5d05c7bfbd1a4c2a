//! Asperities side by side: how three ridges approach three times one, what
//! a ring adds to the depth of the centre, the eight committed rows, and the convergence of those of three
//! equal asperities.
//!
//! `cargo run --release -p asperity-verification --example several [-- approach.csv] [--out FILE]` (about two
//! minutes of one core); the tables are `verification/results/several.md`. The argument `convergence` prints
//! only that; another names a file for the approach, which `verification/measure/draw-fig6` draws.

// on committed scenes
#![allow(clippy::expect_used)]

use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, Lateral, Scene, Symmetry};
use asperity_verification::report::{Report, replace};
use asperity_verification::several::{
    FOOT, LOW_MEMBER, Member, PAPER, depth_at, interpolated, of_asperity, row, three_over_one, whole,
};
use asperity_verification::single_asperity::crush;
use std::path::Path;

/// A row of `meshes/`: its name and its text.
macro_rules! committed {
    ($name:literal) => {
        ($name, include_str!(concat!("../../meshes/", $name, ".toml")))
    };
}

const SCENES: [(&str, &str); 8] = [
    committed!("three-identical"),
    committed!("three-identical-plane-strain"),
    committed!("slopes-1-4"),
    committed!("slopes-5-8"),
    committed!("slopes-9-12"),
    committed!("slopes-1-4-plane-strain"),
    committed!("slopes-5-8-plane-strain"),
    committed!("slopes-9-12-plane-strain"),
];
const DEPTHS: [f64; 3] = [100e-6, 200e-6, 400e-6];
const PITCHES: [f64; 7] = [0.6, 1.2, 2.0, 2.4, 3.0, 4.0, 6.0];

/// Three ridges over three times one, by the pitch in depths of the layer.
fn approach(report: &mut Report) -> String {
    report.section("Three ridges with free sides over three times one");
    report.line("Largest difference of the force from a fifth of the depth on, %, draft.\n");
    report.table("| pitch over depth of the substrate | 100 µm | 200 µm | 400 µm |");
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
        report.line(&format!("| {pitch} | {} |", cells.join(" | ")));
    }
    csv
}

/// The depth that a ring adds to the centre, over 2P/E*.
fn rings(report: &mut Report) {
    report.section("Depth of the centre added by a touched ring, over 2P/E*");
    report.table("| radius of the ring, µm | elastic | n = 0.3 |");
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
            let alone = whole(&crush(&body(LOW_MEMBER)).expect("the row runs"));
            let both = crush(&body(PAPER)).expect("the row runs");
            let [depth, force] = of_asperity(&both, 0).last().copied().unwrap_or([f64::NAN; 2]);
            let line_load = interpolated(&of_asperity(&both, 1), depth) / (std::f64::consts::TAU * pitch);
            let modulus = body(PAPER).material.elastic().reduced_modulus();
            (depth - depth_at(&alone, force)) * modulus / (2.0 * line_load)
        });
        report.line(&format!("| {:.0} | {:.3} | {:.3} |", 1e6 * pitch, ratios[0], ratios[1]));
    }
}

/// Force and work in N and µJ, or N/mm and µJ/mm.
fn force_and_work(scene: &Scene, outcome: &Outcome) -> [f64; 2] {
    let s = &outcome.summary;
    match scene.symmetry {
        Symmetry::Axisymmetric => [s.peak_force, 1e6 * s.total_work],
        Symmetry::PlaneStrain => [1e-3 * s.peak_force, 1e3 * s.total_work],
    }
}

/// The committed rows, at their own accuracy.
fn committed(report: &mut Report) {
    report.section("The eight scenes at standard accuracy");
    report.line("Forces in N and works in µJ, in plane strain per mm; crushed to 5 µm and unloaded.\n");
    report.table(
        "| scene | peak force | total work | elastic share, % | residual depth, µm | energy balance | estimated error, % | elements | iterations |",
    );
    for (name, text) in SCENES {
        let mut scene: Scene = toml::from_str(text).expect("the committed scene reads");
        scene.output.every = Some(0);
        let outcome = crush(&scene).expect("the committed scene runs");
        let s = &outcome.summary;
        let [force, work] = force_and_work(&scene, &outcome);
        report.line(&format!(
            "| {name} | {force:.2} | {work:.2} | {:.1} | {:.3} | {:.1e} | {:.2} | {} | {} |",
            100.0 * s.elastic_fraction.unwrap_or(f64::NAN),
            1e6 * s.residual_depth.unwrap_or(f64::NAN),
            s.energy_balance_error,
            100.0 * s.estimated_error,
            s.elements,
            s.newton_iterations,
        ));
    }
}

/// Headline numbers of a committed scene over meshes and steps.
fn convergence(report: &mut Report, name: &str, text: &str) {
    report.section(name);
    report.table(
        "| elements in contact | steps | peak force | total work | elastic share, % | energy balance | estimated error, % | iterations |"
    );
    let settings = [(11, 149), (16, 149), (22, 74), (22, 149), (22, 298), (32, 149)];
    for (elements, steps) in settings {
        let mut scene: Scene = toml::from_str(text).expect("the committed scene reads");
        scene.output.every = Some(0);
        scene.numerics.elements_in_contact = Some(elements);
        scene.numerics.steps = Some(steps);
        let outcome = crush(&scene).expect("the committed scene runs");
        let s = &outcome.summary;
        let [force, work] = force_and_work(&scene, &outcome);
        report.line(&format!(
            "| {elements} | {steps} | {force:.2} | {work:.2} | {:.2} | {:.1e} | {:.2} | {} |",
            100.0 * s.elastic_fraction.unwrap_or(f64::NAN),
            s.energy_balance_error,
            100.0 * s.estimated_error,
            s.newton_iterations,
        ));
    }
}

fn main() {
    let (mut report, words) = Report::of_example("several", "draft and standard");
    let word = words.first().map(String::as_str);
    if word != Some("convergence") {
        let csv = approach(&mut report);
        if let Some(file) = word {
            replace(Path::new(file), &csv).expect("the file named can be written");
        }
        rings(&mut report);
        committed(&mut report);
    }
    convergence(&mut report, "Three identical asperities, axisymmetric (N, µJ)", SCENES[0].1);
    convergence(&mut report, "Three identical ridges, plane strain (N/mm, µJ/mm)", SCENES[1].1);
    report.finish().expect("the file named can be written");
}
