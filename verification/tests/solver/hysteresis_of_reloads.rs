//! Claim: metal whose yield surface moves flows back on unloading and pays for every reload; metal whose
//! surface only grows shakes down (`ten_reloads`). The energy of both balances.
//!
//! Source: Bauschinger's effect, and the remark of Jourani et al. that results differ with the hardening
//! mode. Bounds are those between which half of the hardening lies and a quarter of it, all of it and its
//! square do not: what a share takes of the force and of the residual depth is of first order in it, so that
//! a quarter takes half of what a half takes. Measured at standard: force 6.6 % lower, residual depth 2.4 %
//! smaller, 3.2 and 0.95 % for a quarter; hysteresis of the tenth reload 17 times larger. Energy balance:
//! 1e-2, what draft keeps for isotropic hardening. Metal that flows back far as the tool retreats has a
//! residual depth that does not depend on the step: 5 % of the depth between draft, which promises that, and
//! standard (3 % measured; 10 % when the tool was taken away in one increment from 3 % of the force).

use asperity_material::HardeningMode;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::Accuracy;
use asperity_verification::single_asperity::{crush, scene};

fn cycled(share: Option<f64>) -> Outcome {
    // ten increments of a reload: with the six of draft the quadrature of the work hides what is small
    let mut scene = scene(Accuracy::Standard).unwrap();
    scene.numerics.newton_tolerance = Some(1e-6);
    scene.loading.reloads = 10;
    if share.is_some() {
        scene.material.hardening_mode = HardeningMode::Kinematic;
        scene.material.kinematic_share = share;
    }
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none(), "{share:?} {:?}", outcome.stopped);
    assert!(
        outcome.summary.energy_balance_error < 1e-2,
        "{share:?} {}",
        outcome.summary.energy_balance_error
    );
    outcome
}

#[test]
fn kinematic_hardening_loses_work_in_every_reload() {
    let [grows, quarter, moves] = [None, Some(0.25), Some(0.5)].map(cycled);
    let hysteresis = |o: &Outcome, k: usize| o.cycles[k].work_in - o.cycles[k].work_out;
    assert!(hysteresis(&moves, 10) > 10.0 * hysteresis(&grows, 10));
    assert!(hysteresis(&quarter, 10) < 4.0 * hysteresis(&grows, 10));
    assert!(moves.cycles[10].plastic_work > 100.0 * grows.cycles[10].plastic_work);
    let taken = |quantity: fn(&Outcome) -> f64| {
        [&quarter, &moves].map(|share| 1.0 - quantity(share) / quantity(&grows))
    };
    let [few, half] = taken(|o| o.summary.peak_force);
    assert!((0.058..0.075).contains(&half), "force: {half}");
    assert!((few / half - 0.5).abs() < 0.1, "force: {few} {half}");
    let [few, half] = taken(|o| o.summary.residual_depth.unwrap());
    assert!((0.018..0.03).contains(&half), "residual depth: {half}");
    assert!((few / half - 0.5).abs() < 0.2, "residual depth: {few} {half}");
}

#[test]
fn residual_depth_after_reverse_yielding_is_free_of_the_step() {
    let residual = |accuracy| {
        let mut scene = scene(accuracy).unwrap();
        scene.material.hardening_mode = HardeningMode::Kinematic;
        scene.material.kinematic_share = Some(0.8);
        let outcome = crush(&scene).unwrap();
        assert!(outcome.stopped.is_none(), "{:?}", outcome.stopped);
        outcome.summary.residual_depth.unwrap()
    };
    let [coarse, fine] = [Accuracy::Draft, Accuracy::Standard].map(residual);
    println!("residual depth at draft {coarse:e}, at standard {fine:e}");
    // draft promises 5 % of the depth; a tool taken away from 3 % of the force in one increment missed by 10
    // %
    assert!((coarse - fine).abs() < 0.05 * 5e-6, "{coarse:e} {fine:e}");
}

/// A share of nothing is the isotropic metal, computed in the other space: what differs is where strains that
/// add differ from strains that multiply (`kinematic_hardening`), which metal under a plane hardly sees.
#[test]
fn vanishing_kinematic_share_is_isotropic_hardening() {
    let run = |share| {
        let mut scene = scene(Accuracy::Draft).unwrap();
        scene.loading.unload = false;
        if share > 0.0 {
            scene.material.hardening_mode = HardeningMode::Kinematic;
            scene.material.kinematic_share = Some(share);
        }
        crush(&scene).unwrap().summary.peak_force
    };
    let ratio = run(1e-9) / run(0.0);
    println!("force in the space of additive strains over that of multiplicative ones: {ratio:.5}");
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
}
