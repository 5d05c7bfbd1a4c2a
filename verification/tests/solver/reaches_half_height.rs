//! Claim: crushed toward its whole height of 20 µm the paper's asperity reaches at least half of it; where
//! that crush or one of 30 degrees cannot go on, it stops with a reason and keeps every increment that
//! converged.
//!
//! Source: the limits of a mesh that is not renewed. No tolerance.

use asperity_simulation::run::Outcome;
use asperity_simulation::scene::Accuracy;
use asperity_verification::single_asperity::{crush, scene};

fn toward_whole_height(slope_deg: f64) -> Outcome {
    let mut scene = scene(Accuracy::Draft).unwrap();
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
    let outcome = toward_whole_height(10.0);
    honest(&outcome);
    let reached = outcome.rows.last().unwrap().depth;
    assert!(reached >= 10e-6, "stopped at {reached:e}: {:?}", outcome.stopped);
}

#[test]
fn thirty_degree_asperity_stops_with_a_reason() {
    let outcome = toward_whole_height(30.0);
    honest(&outcome);
    assert!(outcome.rows.len() > 5);
}
