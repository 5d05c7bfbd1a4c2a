//! Cost of runs, beside the bounds that were set and beside the floor of their arithmetic; and where the time
//! goes.
//!
//! `cargo run --release -p asperity-verification --example speed [-- --out FILE]`; the tables are
//! `verification/results/speed.md`. Seconds are the least of several runs in one process, on as many threads
//! as told; what compares two of them is measured side by side. The floor is that of
//! [`asperity_verification::roofline`]: every iteration with a new tangent and every point yielding.

use asperity_calibration::solve_case::solve;
use asperity_calibration::sweep::Sweep;
use asperity_mesh::ElementKind;
use asperity_numerics::newton::System;
use asperity_simulation::load_path::Path;
use asperity_simulation::run::Watcher;
use asperity_simulation::scene::{Accuracy, ElementChoice, Scene};
use asperity_simulation::setup::problem::Problem;
use asperity_simulation::simulate::simulate;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::element::kernel::POINTS;
use asperity_verification::report::{Report, timed};
use asperity_verification::roofline::Roofline;
use asperity_verification::single_asperity::{crush, finely_meshed, prepared, scene};
use rayon::prelude::*;
use std::error::Error;
use std::ops::ControlFlow;

/// Levels with the runs of which the quickest counts.
const LEVELS: [(&str, Accuracy, usize); 3] = [
    ("draft", Accuracy::Draft, 5),
    ("standard", Accuracy::Standard, 5),
    ("reference", Accuracy::Reference, 2),
];

/// Elements across the contact of meshes of some 76,000 and 437,000 unknowns.
const FINE: [usize; 2] = [272, 710];

/// `work` on so many threads.
fn on_threads<T: Send>(
    threads: usize,
    work: impl FnOnce() -> T + Send,
) -> Result<T, rayon::ThreadPoolBuildError> {
    Ok(rayon::ThreadPoolBuilder::new().num_threads(threads).build()?.install(work))
}

/// The least seconds of `repeats` runs of `scene`.
fn least(scene: &Scene, repeats: usize) -> f64 {
    (0..repeats).map(|_| timed(|| crush(scene)).1).fold(f64::INFINITY, f64::min)
}

/// Seconds of an iteration of `problem` at the floor.
fn floor_of(problem: &Problem, floor: &Roofline) -> Result<f64, Box<dyn Error>> {
    let operations = Path::new(problem, &Analyses::default())?.model.operations();
    Ok(floor.iteration(problem.mesh.kind, problem.mesh.cell_count() * POINTS, operations))
}

/// A row of the profile: unknowns, iterations and seconds over the floor; then the shares of its parts in the
/// time of the run.
fn profile(
    name: &str,
    accuracy: Accuracy,
    element: ElementChoice,
    repeats: usize,
    floor: &Roofline,
) -> Result<String, Box<dyn Error>> {
    let mut scene = scene(accuracy)?;
    scene.numerics.element = Some(element);
    let whole = least(&scene, repeats);
    let (problem, meshing) = timed(|| prepared(&scene));
    let problem = problem?;
    let (path, analysis) = timed(|| Path::new(&problem, &Analyses::default()));
    drop(path?);
    let observer: &mut Watcher<'_> = &mut |_| ControlFlow::Continue(());
    let (run, main) = timed(|| {
        simulate(&problem, &Analyses::default(), 0, observer).map(|simulation| simulation.outcome(observer))
    });
    let run = run?;
    let (c, s) = (run.counters, &run.summary);
    let over = whole / (s.newton_iterations as f64 * floor_of(&problem, floor)?);
    let residuals = c.assembly_s - c.tangent_s;
    let rest = main - analysis - c.assembly_s - c.factor_s - c.solve_s;
    let shares =
        [meshing + analysis, residuals, c.tangent_s, c.factor_s, c.solve_s, rest, whole - main - meshing]
            .map(|part| format!("{:.0}", 100.0 * part.max(0.0) / whole))
            .join(" | ");
    let kind = if problem.mesh.kind == ElementKind::Quad8 { "q8r" } else { "q4" };
    Ok(format!(
        "| `{name}` | {kind} | {} | {} | {} | {} | {shares} | {over:.1} | {whole:.3} |",
        s.dofs,
        s.newton_iterations,
        c.assemblies + c.residuals,
        c.factorisations
    ))
}

/// A loading of four steps on a mesh of some 76,000 unknowns: unknowns, seconds.
fn loading(elements: usize) -> Result<(usize, f64), Box<dyn Error + Send + Sync>> {
    let problem = finely_meshed(elements)?;
    let mut path = Path::new(&problem, &Analyses::default())?;
    path.settings.tolerance = 1e-5;
    let (end, seconds) = timed(|| path.load(&mut |_, _| true));
    end?;
    Ok((path.model.body().analysis.dofs.count, seconds))
}

/// An iteration with a new tangent on a mesh of `elements` across the contact: unknowns, seconds, seconds at
/// the floor.
fn iteration(elements: usize, floor: &Roofline) -> Result<(usize, f64, f64), Box<dyn Error>> {
    let problem = finely_meshed(elements).map_err(|e| e.to_string())?;
    let least_seconds = floor_of(&problem, floor)?;
    let mut path = Path::new(&problem, &Analyses::default())?;
    path.model.begin(-1e-3 * problem.depth, 0.0, |_| [0.0; 2]);
    let mut seconds = f64::INFINITY;
    for _ in 0..3 {
        let (done, taken) = timed(|| -> Result<(), Box<dyn Error>> {
            path.model.assess(true)?;
            path.model.renew()?;
            path.model.find_direction();
            Ok(())
        });
        done?;
        seconds = seconds.min(taken);
    }
    Ok((path.model.body().analysis.dofs.count, seconds, least_seconds))
}

/// CalculiX's core seconds over ours at equal accuracy, geometric means with our cheapest level and at
/// `standard`, from the table that `verification/measure/peers` writes.
fn beside_calculix() -> Option<[String; 2]> {
    let table = std::fs::read_to_string("verification/results/peers.md").ok()?;
    let mean =
        |line: &str| Some(line.split_once("geometric mean ")?.1.split([',', ';', ' ']).next()?.to_string());
    let [cheapest, standard] = [false, true].map(|at_standard| {
        let mut lines = table.lines().filter(|line| line.starts_with("within 1 % of the common value"));
        lines.find(|line| line.contains("ours at `standard`") == at_standard).and_then(mean)
    });
    Some([cheapest?, standard?])
}

/// The name of the processor.
fn processor() -> String {
    let text = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(':'));
    name.map_or_else(|| std::env::consts::ARCH.to_string(), |(_, name)| name.trim().to_string())
}

fn main() -> Result<(), Box<dyn Error>> {
    let (mut report, _) = Report::of_example("speed", "every level");
    let floor = Roofline::measure();
    report.line(&format!("{}, {:.0} GFLOP/s a core in a dense product.\n", processor(), 1e-9 * floor.rate()));

    report.line("Shares of the time of a run on one thread, in percent:\n");
    report.table("| level | element | unknowns | iterations | assemblies | factorisations | mesh and order | residuals | tangents | factorise | solve | rest of the run | companion | over the floor | run s |");
    for (name, accuracy, repeats) in LEVELS {
        for element in [ElementChoice::Q8r, ElementChoice::Q4] {
            let line = on_threads(1, || {
                profile(name, accuracy, element, repeats, &floor).map_err(|e| e.to_string())
            })??;
            report.line(&line);
        }
    }

    report.section("Bounds");
    report.table("| | measured | bound | aim |");
    if let Some([cheapest, standard]) = beside_calculix() {
        report.line(&format!("| CalculiX's core seconds over ours at equal accuracy ([peers](peers.md)), geometric means: cheapest level / at `standard` | {cheapest} / {standard} | 120 / 35 | 250 |"));
    }
    let sweep = Sweep::default();
    let cases = sweep.cases();
    let (rows, seconds) = timed(|| {
        let analyses = Analyses::for_threads(2);
        on_threads(2, || {
            cases.par_iter().map(|case| solve(case, sweep.accuracy, &analyses)).collect::<Vec<_>>()
        })
    });
    let worst =
        rows?.iter().map(|row| row.outcome.as_ref().map_or(f64::NAN, |k| k.error)).fold(0.0, f64::max);
    report.line(&format!(
        "| {} cones of the sweep, every K within {:.2} % as stated, wall seconds on 2 threads | {seconds:.1} | 6 | 3 |",
        cases.len(),
        100.0 * worst
    ));
    let reference = scene(Accuracy::Reference)?;
    let [one, two] = [on_threads(1, || least(&reference, 2))?, on_threads(2, || least(&reference, 2))?];
    let [(unknowns, single), (_, double)] = [
        on_threads(1, || loading(FINE[0]).map_err(|e| e.to_string()))??,
        on_threads(2, || loading(FINE[0]).map_err(|e| e.to_string()))??,
    ];
    report.line(&format!(
        "| two threads over one, at {unknowns} unknowns / at `reference` | {:.2} / {:.2} | 1.5 / 1.4 | 1.6 |",
        single / double,
        one / two
    ));
    let (unknowns, seconds, least) =
        on_threads(1, || iteration(FINE[1], &floor).map_err(|e| e.to_string()))??;
    report.line(&format!(
        "| an iteration at {unknowns} unknowns over the time of its operations in a dense product | {:.1} | 2 | 1.6 |",
        seconds / least
    ));
    Ok(report.finish()?)
}
