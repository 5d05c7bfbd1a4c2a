//! Claim: an elastic cone follows Sneddon's solution, as a cone crushed by a plane and as a flat body under a
//! cone; so does a metal of E/σ_y = 10 at 1°, which hardly yields.
//!
//! Source: I. N. Sneddon, Int. J. Eng. Sci. 3 (1965) 47: F = (2/π) E* h²/tan β, a = (2/π) h/tan β.
//! Tolerance of K 1 %: the bound of `standard`; of the contact ratio 3 %: the radius is taken at the outer
//! edge of a penalty contact, which reaches 1.3 % too far at a penetration of 1.6 % of the depth.

use asperity_calibration::case::{Case, Tool};
use asperity_calibration::loading_curvature::solve;
use asperity_material::{HardeningLaw, StressMeasure};
use asperity_simulation::scene::Accuracy;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::calibration::metal;
use std::f64::consts::FRAC_2_PI;

#[test]
fn elastic_cones_follow_sneddon() {
    for tool in [Tool::Plane, Tool::Cone] {
        for yielding in [None, Some(metal(HardeningLaw::Hollomon, 0.3, 10.0))] {
            let case = Case {
                beta_deg: 1.0,
                yielding,
                poissons_ratio: 0.3,
                tool,
                stress_measure: StressMeasure::Kirchhoff,
                friction: None,
            };
            let kick = solve(&case, &case.discretisation(Accuracy::Standard), &Analyses::default()).unwrap();
            let sneddon = FRAC_2_PI * case.elastic().reduced_modulus() / case.tan_beta();
            assert!((kick.k_over_e / sneddon - 1.0).abs() < 0.01, "{tool:?}: {} {sneddon}", kick.k_over_e);
            assert!((kick.contact_ratio / FRAC_2_PI - 1.0).abs() < 0.03, "{tool:?}: {}", kick.contact_ratio);
        }
    }
}
