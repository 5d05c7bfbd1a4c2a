//! What a case of the default sweep costs: core-seconds, increments, iterations, and the floor of those iterations.
//!
//! `cargo bench -p asperity-calibration` solves every tenth case of the grid on one thread and prints a row for each slope
//! and the mean. Roofline: the iterations, each with a new tangent and every point flowing, at the arithmetic of this core
//! (`asperity_solver::algebra::roofline`).
#![allow(clippy::print_stdout, reason = "a benchmark prints")]

use asperity_calibration::body::Body;
use asperity_calibration::case::Case;
use asperity_calibration::resolution::Resolution;
use asperity_calibration::run::{shard, solve};
use asperity_calibration::sweep::Sweep;
use asperity_solver::body::discrete_body::Body as Discrete;
use asperity_solver::element::kernel::POINTS;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::run::equilibrium::Equilibrium;
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

fn measure(case: &Case, sweep: &Sweep, floor: &Roofline) -> Sums {
    let resolution = Resolution::of(case, sweep.accuracy);
    let body = Body::new(case, &resolution);
    let unknowns = body.held.iter().flatten().filter(|held| !**held).count() as f64;
    let row = solve(case, sweep.accuracy);
    let (increments, iterations) = row.outcome.map_or((0, 0), |k| (k.increments, k.iterations));
    let held = |node: usize| body.held[node];
    let model =
        Discrete::new(&body.mesh, Symmetry::Axisymmetric, body.metal.clone(), held, Some(body.contact))
            .and_then(Equilibrium::new);
    let points = body.mesh.cell_count() * POINTS;
    let least = model.map_or(0.0, |m| floor.iteration(resolution.kind, points, m.operations()));
    Sums {
        cases: 1.0,
        seconds: row.wall_s,
        increments: increments as f64,
        iterations: iterations as f64,
        unknowns,
        floor: iterations as f64 * least,
    }
}

fn main() {
    let floor = Roofline::measure();
    let sweep = Sweep::default();
    let cases = shard(&sweep.cases(), 3, 10);
    println!(
        "| slope | cases | core-seconds | increments | iterations | unknowns | floor s | over the floor |"
    );
    println!("|-|-|-|-|-|-|-|-|");
    let mut all = Sums::default();
    for slope in &sweep.slopes_deg {
        let own = cases.iter().filter(|case| case.beta_deg == *slope);
        let sums = own.map(|case| measure(case, &sweep, &floor)).fold(Sums::default(), Sums::add);
        if sums.cases > 0.0 {
            sums.print(&format!("{slope}°"));
            all = all.add(sums);
        }
    }
    all.print("all");
}
