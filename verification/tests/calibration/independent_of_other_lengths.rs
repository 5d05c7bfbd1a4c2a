//! Claim: K of a sharp cone does not depend on the lengths that a sharp cone on a half space does not have: the radius of its
//! tip, its height and its substrate.
//!
//! Source: dimensional analysis; a sharp cone on a half space has no length but the depth.
//! Tolerance 0.5 %: the bound on mesh, step and substrate that `standard` states. What a rounded tip leaves of its effect
//! falls with the square of its radius over the contact's.

use asperity_calibration::case::{Case, Tool, YieldMeasure};
use asperity_calibration::loading_curvature::solve;
use asperity_calibration::resolution::Resolution;
use asperity_law::HardeningLaw;
use asperity_solver::scene::Accuracy;
use asperity_verification::calibration::metal;

#[test]
fn tip_height_and_substrate_do_not_change_k() {
    let yielding = Some(metal(HardeningLaw::Hollomon, 0.3, 300.0));
    let case = Case {
        beta_deg: 8.0,
        yielding,
        poissons_ratio: 0.3,
        tool: Tool::Plane,
        stress: YieldMeasure::Kirchhoff,
    };
    let standard = Resolution::of(&case, Accuracy::Standard);
    let k = |resolution: &Resolution| solve(&case, resolution).unwrap().k_over_e;
    let sharp = k(&standard);
    for (name, changed) in [
        ("tip", Resolution { rounding: 0.025, ..standard }),
        ("height", Resolution { foot: 16.0, ..standard }),
        ("substrate", Resolution { domain: 400.0, ..standard }),
    ] {
        assert!((k(&changed) / sharp - 1.0).abs() < 0.005, "{name}: {} {sharp}", k(&changed));
    }
}
