//! Claim: the depth does not depend on the penalty: a run with a penalty gives the force of one whose penalty
//! is so hard that the metal hardly penetrates, whether the metal is elastic, hardly yields or flows.
//! A penalty far too stiff, whose contact opens between the nodes, says how little its area is known.
//!
//! Source: Castigliano for elastic metal (see `asperity_solver::contact`); else the program's own run with a
//! hard penalty. Tolerances, of the force from a fifth of the depth on: what is left is of second order for
//! elastic metal (0.3 % of a cone at a penetration of 0.004, 0.2 % of a ball at 0.016), 0.4 % where metal
//! yields under an uneven pressure; 2 % where it flows, most of it ripple of the mesh. Were the mean
//! penetration taken off everywhere, the stiff cone would miss by 3 %.

use asperity_material::units::{Length, Stress};
use asperity_simulation::record::curve::Curve;
use asperity_simulation::scene::{Accuracy, Scene};
use asperity_verification::single_asperity::{crush, loaded};

fn cone(slope: f64, depth: f64) -> Scene {
    let mut scene = loaded(Accuracy::Draft).unwrap();
    // with fewer elements the hard penalty makes the force ripple by 2 %
    (scene.numerics.elements_in_contact, scene.numerics.steps) = (Some(12), Some(36));
    (scene.asperity[0].slope_deg, scene.asperity[0].tip_radius) = (Some(slope), None);
    scene.loading.depth = Some(Length(depth));
    scene
}

fn elastic(mut scene: Scene) -> Scene {
    (scene.material.yield_stress, scene.material.hardening_exponent) = (None, None);
    scene
}

fn stiff(mut scene: Scene) -> Scene {
    scene.material.yield_stress = Some(Stress(scene.material.youngs_modulus.0 / 100.0));
    scene
}

fn ball() -> Scene {
    let mut scene = elastic(cone(10.0, 1e-6));
    let first = &mut scene.asperity[0];
    (first.radius, first.height, first.slope_deg) = (Some(Length(20e-6)), None, None);
    scene
}

/// Penetration over depth of the hard penalty, at most an eighth of the soft one's. The scenes differ by
/// 0.15,
/// 0.13, 0.16 and 1 %. Under a harder one the force ripples by more than is asked here (with 1e-4 by 0.7 % of
/// the elastic cone and 2.4 % of the one that flows).
const HARD_PENETRATION: f64 = 5e-4;

#[test]
fn a_soft_penalty_gives_the_force_of_a_hard_one() {
    let scenes = [
        ("elastic cone", elastic(cone(5.0, 5e-6)), 0.004, 0.005),
        ("elastic ball", ball(), 0.016, 0.004),
        ("cone that hardly yields", stiff(cone(1.5, 2e-6)), 0.004, 0.005),
        ("cone that flows", cone(10.0, 5e-6), 0.004, 0.02),
    ];
    for (name, mut scene, penetration, tolerance) in scenes {
        scene.numerics.penetration = Some(penetration);
        let penalty = Curve::force(&crush(&scene).unwrap().rows);
        scene.numerics.penetration = Some(HARD_PENETRATION);
        let hard = Curve::force(&crush(&scene).unwrap().rows);
        let worst = penalty.worst_difference(|h| hard.value(h), hard.end());
        assert!(worst < tolerance, "{name}: {worst:e}");
    }
}

/// Penetrations of 1e-5 and 1e-6 of the depth lose 21 to 81 % of the area, and 40 to 300 % are stated. (1e-4
/// at `draft` loses 25 %, of which it says 24 %.)
#[test]
fn a_penalty_far_too_stiff_states_what_it_does_to_the_area() {
    for accuracy in [Accuracy::Draft, Accuracy::Standard] {
        let mut scene = loaded(accuracy).unwrap();
        let own = crush(&scene).unwrap().summary;
        for penetration in [1e-5, 1e-6] {
            scene.numerics.penetration = Some(penetration);
            let stiff = crush(&scene).unwrap().summary;
            for (of, value, expected, stated) in [
                ("force", stiff.peak_force, own.peak_force, stiff.errors.force + own.errors.force),
                ("area", stiff.contact_area, own.contact_area, stiff.errors.contact_area),
            ] {
                let error = (expected / value).ln().abs();
                assert!(error < stated, "{accuracy:?} {penetration:e}: {of} {error}, stated {stated}");
            }
            assert!(stiff.errors.contact_area > accuracy.promise(), "{accuracy:?} {penetration:e}");
        }
    }
}
