//! Claim: while a body is loaded the tool never goes back, however much less the penetration is than was
//! expected.
//!
//! Source: none outside; a sharp cone of soft metal, whose penetration over its depth falls by a third within
//! the first increments. Tolerance: none.

use asperity_material::units::Stress;
use asperity_simulation::record::rows::{CurveRow, Phase};
use asperity_simulation::scene::Accuracy;
use asperity_verification::single_asperity::{crush, loaded};

#[test]
fn travel_grows_from_increment_to_increment() {
    let mut scene = loaded(Accuracy::Draft).unwrap();
    scene.asperity[0].tip_radius = None;
    scene.material.youngs_modulus = Stress(1000e9);
    scene.material.yield_stress = Some(Stress(10e6));
    scene.material.hardening_exponent = Some(0.1);
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none());
    let loading = outcome.rows.iter().filter(|row| row.phase == Phase::Load);
    let travels: Vec<f64> = loading.map(|row| row.depth + row.penetration).collect();
    // 36 steps of draft and more where they are halved; the last ends at the depth, the tool as much further
    // as it is pressed in
    assert!(travels.len() > 36, "{}", travels.len());
    let last = outcome.rows.iter().rfind(|row| row.phase == Phase::Load).unwrap();
    assert!((last.depth / 5e-6 - 1.0).abs() < 1e-9, "{:e}", last.depth);
    // its penetration falls: by a fifth at least of what the first increment had over its depth
    let share = |row: &CurveRow| row.penetration / row.depth;
    let first = outcome.rows.iter().find(|row| row.phase == Phase::Load && row.depth > 0.0).unwrap();
    assert!(share(last) < 0.8 * share(first), "{} {}", share(first), share(last));
    for pair in travels.windows(2) {
        assert!(pair[1] > pair[0], "from {:e} to {:e}", pair[0], pair[1]);
    }
}
