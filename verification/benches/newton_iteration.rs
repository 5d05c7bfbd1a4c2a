//! Where the time of a crush goes: milliseconds per Newton iteration in assembly, factorisation and solve, and
//! iterations per run, on the single asperity at each accuracy level and with each element.
//!
//! `cargo bench -p asperity-verification` prints a table. Times are per iteration, of which only some have a new tangent: the
//! others reuse its factors. Roofline: one Newton iteration in the strict sense, with a new tangent and every point flowing, at
//! the arithmetic of this core (see `asperity_verification::roofline`); 3% is what `docs/src/verified/peers.md` runs.
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use asperity_law::HardeningMode;
use asperity_law::StressMeasure;
use asperity_law::units::{Length, Stress};
use asperity_mesh::ElementKind;
use asperity_solver::element::kernel::POINTS;
use asperity_solver::run::crush::run;
use asperity_solver::run::depth_for_force::expect;
use asperity_solver::run::load_path::Path;
use asperity_solver::run::prepare::prepare;
use asperity_solver::scene::{
    Accuracy, Asperity, ElementChoice, HardeningChoice, Lateral, Loading, Material, Numerics, Output, Scene,
    Symmetry, Tool,
};
use asperity_verification::roofline::Roofline;
use std::ops::ControlFlow;
use std::time::Instant;

fn single_asperity(accuracy: Accuracy, element: ElementChoice) -> Scene {
    Scene {
        symmetry: Symmetry::Axisymmetric,
        accuracy,
        lateral: Lateral::Free,
        material: Material {
            youngs_modulus: Stress(210e9),
            poissons_ratio: 0.3,
            yield_stress: Some(Stress(300e6)),
            hardening_exponent: Some(0.3),
            hardening_law: HardeningChoice::Hollomon,
            hardening_file: None,
            hardening_table: None,
            stress_measure: StressMeasure::Cauchy,
            hardening_mode: HardeningMode::Isotropic,
            kinematic_share: None,
        },
        asperity: vec![Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6))],
        profile: Vec::new(),
        substrate: None,
        tool: Tool::plane(),
        loading: Loading { depth: Some(Length(5e-6)), force: None, unload: true, reloads: 0 },
        initial: None,
        output: Output::default(),
        numerics: Numerics { element: Some(element), ..Numerics::default() },
        mesh: None,
    }
}

/// Seconds of an iteration of `scene` at the floor; `None` if it does not mesh.
fn least(scene: &Scene, kind: ElementKind, floor: &Roofline) -> Option<f64> {
    let problem = prepare(scene, None, expect(scene, None).ok()?).ok()?;
    let operations = Path::new(&problem).ok()?.model.operations();
    Some(floor.iteration(kind, problem.mesh.cell_count() * POINTS, operations))
}

fn main() {
    let floor = Roofline::measure();
    println!("{:.1} GFLOP/s", 1e-9 * floor.rate());
    println!(
        "| level | element | unknowns | iterations | new tangents | assembly ms | factorise ms | solve ms | iteration ms | floor ms | over the floor | run s |"
    );
    println!("|-|-|-|-|-|-|-|-|-|-|-|-|");
    for (name, accuracy, repeats) in [
        ("draft", Accuracy::Draft, 5),
        ("3%", Accuracy::Within(0.03), 5),
        ("standard", Accuracy::Standard, 3),
        ("reference", Accuracy::Reference, 1),
    ] {
        for (element, label, kind) in
            [(ElementChoice::Q8r, "q8r", ElementKind::Quad8), (ElementChoice::Q4, "q4", ElementKind::Quad4)]
        {
            let scene = single_asperity(accuracy, element);
            let best = (0..repeats)
                .filter_map(|_| {
                    let clock = Instant::now();
                    let outcome = run(&scene, None, &mut |_| ControlFlow::Continue(())).ok()?;
                    Some((clock.elapsed().as_secs_f64(), outcome))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0));
            let (Some((seconds, outcome)), Some(least)) = (best, least(&scene, kind, &floor)) else {
                continue;
            };
            let (c, s) = (outcome.counters, &outcome.summary);
            let iterations = s.newton_iterations as f64;
            println!(
                "| {name} | {label} | {} | {} | {} | {:.2} | {:.2} | {:.2} | {:.2} | {:.2} | {:.1} | {seconds:.2} |",
                s.dofs,
                s.newton_iterations,
                c.factorisations,
                1e3 * c.assembly_s / iterations,
                1e3 * c.factor_s / iterations,
                1e3 * c.solve_s / iterations,
                1e3 * (c.assembly_s + c.factor_s + c.solve_s) / iterations,
                1e3 * least,
                seconds / (iterations * least),
            );
        }
    }
}
