//! Claim: the load step of the single asperity is of second order: halving it takes the force to its limit about four
//! times closer, on average over the depths of the promise (0.2 to 1 of the peak).
//!
//! Source: BDF2 (E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, §III.3). Observed from
//! three runs, p = log2(|F₂ - F₁|/|F₃ - F₂|); at least 1.5 is asked, because the contact front enters new elements at
//! increments that differ from run to run, which backward Euler (order 1) would not pass either.

use asperity_solver::record::CurveRow;
use asperity_solver::scene::Accuracy;
use asperity_verification::single_asperity::{crush, force_at, scene};

fn rows(steps: usize) -> Vec<CurveRow> {
    let mut scene = scene(Accuracy::Standard).unwrap();
    scene.numerics.steps = Some(steps);
    scene.loading.unload = false;
    crush(&scene).unwrap().rows
}

/// Mean of the relative difference of the forces: the bias of the step, without the ripple of the front.
fn difference(a: &[CurveRow], b: &[CurveRow]) -> f64 {
    let depths = (0..80).map(|i| 5e-6 * (0.2 + 0.799 * f64::from(i) / 79.0));
    depths.map(|h| force_at(a, h) / force_at(b, h) - 1.0).sum::<f64>() / 80.0
}

#[test]
fn observed_order() {
    let runs = [24, 48, 96].map(rows);
    let order = (difference(&runs[0], &runs[1]) / difference(&runs[1], &runs[2])).abs().log2();
    assert!(order > 1.5, "{order}");
}
