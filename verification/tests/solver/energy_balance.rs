//! Claim: the work of the tool is stored, dissipated or in the contact: to 1e-3 for n = 0.3 at standard
//! accuracy, to 1e-2 for n = 0 and for metal that stores most of its work (E/σ_y 10), and better with more
//! steps.
//!
//! Source: `Summary::energy_balance_error`, the largest |W - E_e - W_p - E_c|/W. Tolerances: what is asked;
//! the error is that of integrating F dh and σ_y dε_p over finite increments.

use asperity_material::units::Stress;
use asperity_simulation::scene::{Accuracy, HardeningChoice};
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

/// The work of an elastic body on its way back is judged over the largest work, and balances at every row:
/// what is left of it at the end is near nothing, so that an error over that says nothing.
#[test]
fn an_elastic_body_gives_back_its_work() {
    let mut scene = scene(Accuracy::Draft).unwrap();
    (scene.material.yield_stress, scene.material.hardening_exponent) = (None, None);
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none());
    let work = outcome.summary.total_work;
    assert!(outcome.summary.plastic_work.abs() < 1e-12 * work);
    // two per cent: forces of draft over the steps of draft, there and back
    let last = outcome.rows.last().unwrap();
    assert!(last.external_work.abs() < 0.02 * work, "{:e} of {work:e}", last.external_work);
    let elastic = outcome.summary.elastic_work.unwrap();
    assert!((elastic / work - 1.0).abs() < 0.02, "{elastic:e} of {work:e}");
}

/// Little is left of the work when the tool has gone, and the balance is not judged over that: 2e-3 to 3e-3
/// were measured at `draft`, 3e-2 over what is left.
#[test]
fn work_balances_in_metal_that_hardly_yields() {
    for (slope, exponent) in [(10.0, 0.3), (10.0, 0.0), (30.0, 0.0)] {
        let mut scene = scene(Accuracy::Draft).unwrap();
        scene.asperity[0].slope_deg = Some(slope);
        scene.asperity[0].tip_radius = None;
        scene.material.yield_stress = Some(Stress(scene.material.youngs_modulus.0 / 10.0));
        scene.material.hardening_exponent = Some(exponent);
        scene.material.hardening_law = HardeningChoice::Swift;
        let outcome = crush(&scene).unwrap();
        assert!(outcome.stopped.is_none(), "{slope}°, n {exponent}: {:?}", outcome.stopped);
        let summary = outcome.summary;
        assert!(summary.energy_balance_error < 1e-2, "{slope}°: {:e}", summary.energy_balance_error);
    }
}
