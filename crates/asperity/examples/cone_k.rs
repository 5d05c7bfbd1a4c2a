//! The loading curvature K = F/h² of one cone under a plane.

#![allow(clippy::print_stdout, reason = "an example prints its result")]

use asperity_calibration::case::{Case, Tool, Yielding};
use asperity_calibration::solve_case::solve;
use asperity_material::{HardeningLaw, StressMeasure};
use asperity_simulation::scene::Accuracy;
use asperity_solver::body::analysis::Analyses;

fn main() {
    let yielding = Yielding { law: HardeningLaw::Hollomon, exponent: 0.3, e_over_sy: 300.0 };
    let case = Case {
        beta_deg: 10.0,
        yielding: Some(yielding),
        poissons_ratio: 0.3,
        tool: Tool::Plane,
        stress_measure: StressMeasure::Kirchhoff,
        friction: None,
    };
    match solve(&case, Accuracy::Draft, &Analyses::default()).outcome {
        Ok(cone) => println!("K/E = {:.4} within {:.2} %", cone.k_over_e, 100.0 * cone.error),
        Err(reason) => println!("no K: {reason}"),
    }
}
