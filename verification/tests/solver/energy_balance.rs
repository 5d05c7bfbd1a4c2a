//! Claim: the work of the tool is stored, dissipated or in the contact: to 1e-3 for n = 0.3 at standard
//! accuracy, to 1e-2 for n = 0, and better with more steps.
//!
//! Source: `Summary::energy_balance_error`, the largest |W - E_e - W_p - E_c|/W. Tolerances: what is asked;
//! the error is that of integrating F dh and σ_y dε_p over finite increments.

use asperity_simulation::scene::Accuracy;
use asperity_verification::single_asperity::{crush, scene};

fn balance_error(exponent: f64, steps: Option<usize>) -> f64 {
    let mut scene = scene(Accuracy::Standard).unwrap();
    scene.material.hardening_exponent = Some(exponent);
    scene.numerics.steps = steps;
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none());
    outcome.summary.energy_balance_error
}

#[test]
fn work_balances_with_hardening() {
    let error = balance_error(0.3, None);
    assert!(error <= 1e-3, "{error:e}");
    let coarse = balance_error(0.3, Some(24));
    assert!(coarse > error, "does not fall with the step: {coarse:e} {error:e}");
}

#[test]
fn work_balances_in_perfect_plasticity() {
    let error = balance_error(0.0, None);
    assert!(error <= 1e-2, "{error:e}");
}
