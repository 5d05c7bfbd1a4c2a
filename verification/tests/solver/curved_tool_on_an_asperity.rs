//! Claim: a ball on an elastic summit follows Hertz with the sum of both curvatures to 1.5 %; a tool comes
//! down on the first summit, in plane strain too, where one that is nearly flat carries the force of a plane
//! to 0.5 %.
//!
//! Source: K. L. Johnson, Contact Mechanics (1985), section 4.2: 1/R = 1/R₁ + 1/R₂, F = 4/3 E* √R h^1.5.
//! Tolerance: Hertz's parabolas leave (a/R)² = 0.3 %, the force of `standard` is good to 1 %; a cylinder of 1
//! m is flat over the contact (a²/2R = 2e-10 m of 5 µm), both runs ripple alike.

use asperity_material::units::Length;
use asperity_simulation::scene::{Accuracy, Scene, Substrate, Symmetry, Tool};
use asperity_verification::contact::hertz_force;
use asperity_verification::single_asperity::{crush, loaded};

fn ball(radius: f64) -> Tool {
    Tool::sphere(Length(radius))
}

fn peak_force(scene: &Scene) -> f64 {
    let outcome = crush(scene).unwrap();
    assert!(outcome.stopped.is_none(), "{:?}", outcome.stopped);
    outcome.summary.peak_force
}

#[test]
fn a_ball_on_a_ball_is_hertz_on_the_sum_of_curvatures() {
    let (summit, tool, depth) = (50e-6, 100e-6, 0.1e-6);
    let mut scene = loaded(Accuracy::Standard).unwrap();
    (scene.material.yield_stress, scene.material.hardening_exponent) = (None, None);
    scene.asperity[0].slope_deg = Some(20.0);
    scene.asperity[0].tip_radius = Some(Length(summit));
    scene.loading.depth = Some(Length(depth));
    scene.tool = ball(tool);
    let radius = 1.0 / (1.0 / summit + 1.0 / tool);
    let ratio = peak_force(&scene) / hertz_force(scene.material.elastic().reduced_modulus(), radius, depth);
    assert!((ratio - 1.0).abs() < 0.015, "{ratio} of Hertz");
}

#[test]
fn a_nearly_flat_cylinder_over_a_ridge_is_a_plane() {
    let mut scene = loaded(Accuracy::Draft).unwrap();
    scene.symmetry = Symmetry::PlaneStrain;
    let size = Some(Length(2e-3));
    scene.substrate = Some(Substrate { radius: size, depth: size });
    let plane = peak_force(&scene);
    scene.tool = ball(1.0);
    let ratio = peak_force(&scene) / plane;
    assert!((ratio - 1.0).abs() < 0.005, "{ratio} of a plane");
}
