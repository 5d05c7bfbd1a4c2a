//! Claim: while a body is loaded the tool never goes back, however much less the penetration is than was
//! expected.
//!
//! Source: none outside; a sharp cone of soft metal, whose penetration over its depth falls by a third within
//! the first increments. Tolerance: none.

use asperity_material::units::Stress;
use asperity_simulation::record::rows::Phase;
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
    assert!(travels.len() > 20);
    for pair in travels.windows(2) {
        assert!(pair[1] > pair[0], "from {:e} to {:e}", pair[0], pair[1]);
    }
}
