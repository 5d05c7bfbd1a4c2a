//! The cost of a case of the default sweep: core-seconds, increments, iterations, and the floor of those
//! iterations.
//!
//! `cargo bench -p asperity-verification` solves every tenth case of the grid on one thread and prints a row
//! for each slope and the mean. Roofline: the iterations, each with a new tangent and every point flowing, at
//! the arithmetic of this core (`asperity_verification::roofline`).
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use asperity_calibration::case::Case;
use asperity_calibration::solve_case::solve;
use asperity_calibration::sweep::Sweep;
use asperity_simulation::load_path::Path;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::element::kernel::POINTS;
use asperity_verification::roofline::Roofline;

/// Sums over cases.
#[derive(Clone, Copy, Default)]
struct Sums {
    cases: f64,
    seconds: f64,
    increments: f64,
    iterations: f64,
    unknowns: f64,
    floor: f64,
}

impl Sums {
    fn add(self, other: Sums) -> Sums {
        Sums {
            cases: self.cases + other.cases,
            seconds: self.seconds + other.seconds,
            increments: self.increments + other.increments,
            iterations: self.iterations + other.iterations,
            unknowns: self.unknowns + other.unknowns,
            floor: self.floor + other.floor,
        }
    }

    fn print(&self, name: &str) {
        let mean = |sum: f64| sum / self.cases;
        println!(
            "| {name} | {} | {:.3} | {:.0} | {:.0} | {:.0} | {:.3} | {:.2} |",
            self.cases,
            mean(self.seconds),
            mean(self.increments),
            mean(self.iterations),
            mean(self.unknowns),
            mean(self.floor),
            self.seconds / self.floor
        );
    }
}

fn measure(case: &Case, sweep: &Sweep, floor: &Roofline, analyses: &Analyses) -> Sums {
    let problem = case.problem(&case.discretisation(sweep.accuracy));
    let row = solve(case, sweep.accuracy, analyses);
    let (increments, iterations) = row.outcome.map_or((0, 0), |k| (k.increments, k.iterations));
    let points = problem.mesh.cell_count() * POINTS;
    let (unknowns, least) = Path::new(&problem, analyses).map_or((0, 0.0), |path| {
        let operations = path.model.operations();
        (path.model.body().analysis.dofs.count, floor.iteration(problem.mesh.kind, points, operations))
    });
    Sums {
        cases: 1.0,
        seconds: row.wall_s,
        increments: increments as f64,
        iterations: iterations as f64,
        unknowns: unknowns as f64,
        floor: iterations as f64 * least,
    }
}

fn main() {
    let floor = Roofline::measure();
    let analyses = Analyses::default();
    let sweep = Sweep::default();
    let cases: Vec<Case> = sweep.cases().into_iter().skip(2).step_by(10).collect();
    println!(
        "| slope | cases | core-seconds | increments | iterations | unknowns | floor s | over the floor |"
    );
    println!("|-|-|-|-|-|-|-|-|");
    let mut all = Sums::default();
    for slope in &sweep.slopes_deg {
        let own = cases.iter().filter(|case| case.beta_deg == *slope);
        let sums = own.map(|case| measure(case, &sweep, &floor, &analyses)).fold(Sums::default(), Sums::add);
        if sums.cases > 0.0 {
            sums.print(&format!("{slope}°"));
            all = all.add(sums);
        }
    }
    all.print("all");
}
