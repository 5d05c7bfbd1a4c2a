//! Claim: crushed toward its whole height of 20 µm the paper's asperity reaches at least half of it, and one
//! of 30 degrees all of it; where a crush cannot go on, it stops with a reason and keeps every increment that
//! converged.
//!
//! Source: another element on another mesh, for the force; its tolerance stands with it.

use asperity_simulation::record::curve::Curve;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, ElementChoice};
use asperity_verification::single_asperity::{crush, scene};

fn toward_whole_height(slope_deg: f64, element: ElementChoice) -> Outcome {
    let mut scene = scene(Accuracy::Draft).unwrap();
    scene.numerics.element = Some(element);
    scene.asperity[0].slope_deg = Some(slope_deg);
    // the height itself: 20 times 1e-6, as a scene file reads it
    scene.loading.depth = scene.asperity[0].height;
    scene.loading.unload = false;
    crush(&scene).unwrap()
}

/// Either the end was reached, or the outcome says why not and where.
fn honest(outcome: &Outcome) {
    let last = outcome.rows.last().unwrap();
    assert!(outcome.rows.iter().all(|row| row.depth.is_finite() && row.force.is_finite()));
    // until the flat base comes into contact too, and the penetration taken off the depth drops all at once
    let before_base = outcome.rows.iter().take_while(|row| row.depth < 19e-6);
    let depths: Vec<f64> = before_base.map(|row| row.depth).collect();
    assert!(depths.windows(2).all(|pair| pair[1] > pair[0]));
    match &outcome.stopped {
        None => assert!((last.depth / 20e-6 - 1.0).abs() < 1e-6),
        Some(stopped) => {
            assert_eq!(stopped.depth, last.depth);
            assert!(!stopped.reason.to_string().is_empty());
        }
    }
}

#[test]
fn ten_degree_asperity_reaches_half_its_height() {
    let outcome = toward_whole_height(10.0, ElementChoice::Q8r);
    honest(&outcome);
    let reached = outcome.rows.last().unwrap().depth;
    assert!(reached >= 10e-6, "stopped at {reached:e}: {:?}", outcome.stopped);
}

/// Force at three quarters of the height beside that of the other element on its own mesh: the 5 % that draft
/// promises. (With nine tenths of the height both lie down on the base, where the force is steep in the
/// depth.)
#[test]
fn thirty_degree_asperity_reaches_its_height_with_the_force_of_the_other_element() {
    let outcome = toward_whole_height(30.0, ElementChoice::Q8r);
    honest(&outcome);
    assert!(outcome.stopped.is_none(), "{:?}", outcome.stopped);
    let at = |outcome: &Outcome| Curve::force(&outcome.rows).value(15e-6);
    let ratio = at(&outcome) / at(&toward_whole_height(30.0, ElementChoice::Q4));
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}
