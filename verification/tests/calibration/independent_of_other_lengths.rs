//! Claim: K of a sharp cone does not depend on the lengths that a sharp cone on a half space does not have:
//! the radius of its tip, its height and its substrate.
//!
//! Source: dimensional analysis; a sharp cone on a half space has no length but the depth.
//! Tolerance 0.5 %: the bound on mesh, step and substrate that `standard` states. What a rounded tip leaves
//! of its effect falls with the square of its radius over the contact's.

use asperity_calibration::case::{Case, Tool};
use asperity_calibration::loading_curvature::solve;
use asperity_material::{HardeningLaw, StressMeasure};
use asperity_simulation::scene::Accuracy;
use asperity_simulation::setup::discretisation::ConeDiscretisation;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::calibration::metal;

#[test]
fn tip_height_and_substrate_do_not_change_k() {
    let yielding = Some(metal(HardeningLaw::Hollomon, 0.3, 300.0));
    let case = Case {
        beta_deg: 8.0,
        yielding,
        poissons_ratio: 0.3,
        tool: Tool::Plane,
        stress_measure: StressMeasure::Kirchhoff,
        friction: None,
    };
    let standard = case.discretisation(Accuracy::Standard);
    type Change = fn(&mut ConeDiscretisation);
    let k = |change: Change| {
        let mut changed = standard;
        change(&mut changed);
        solve(&case, &changed, &Analyses::default()).unwrap().k_over_e
    };
    let sharp = k(|_| ());
    let changes: [(&str, Change); 3] = [
        ("tip", |d| d.sizes.rounding = 0.025),
        ("height", |d| d.sizes.foot = 16.0),
        ("substrate", |d| d.numbers.domain = 400.0),
    ];
    for (name, change) in changes {
        let other = k(change);
        assert!((other / sharp - 1.0).abs() < 0.005, "{name}: {other} {sharp}");
    }
}
