//! Claim: the load step of the single asperity is of second order: halving it takes the force to its limit
//! about four times closer, on average over the depths of the promise (0.2 to 1 of the peak).
//!
//! Source: BDF2 (E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, §III.3).
//! Observed from three runs, p = log2(|F₂ - F₁|/|F₃ - F₂|); tolerance: at least 1.8, because the contact
//! front enters new elements at increments that differ from run to run, which backward Euler (order 1) would
//! not pass either.

use asperity_simulation::record::curve::Curve;
use asperity_simulation::scene::Accuracy;
use asperity_verification::single_asperity::{crush, scene};

fn curve(steps: usize) -> Curve {
    let mut scene = scene(Accuracy::Standard).unwrap();
    scene.numerics.steps = Some(steps);
    scene.loading.unload = false;
    // of the nodes: the reported force is extrapolated
    Curve::new(crush(&scene).unwrap().rows.iter().map(|row| [row.depth, row.force_nodal]))
}

/// The bias of the step, without the ripple of the front.
fn difference(a: &Curve, b: &Curve) -> f64 {
    a.mean_difference(|h| b.value(h), 0.999 * 5e-6)
}

#[test]
fn force_is_of_second_order_in_the_load_step() {
    let runs = [48, 96, 192].map(curve);
    let order = (difference(&runs[0], &runs[1]) / difference(&runs[1], &runs[2])).abs().log2();
    assert!(order > 1.8, "{order}");
}
