//! Claim: a body that is unloaded and loaded again ten times to the same depth shakes down to elastic cycles:
//! the force comes back, nothing ratchets, energy balances. An elastic body repeats its first loading from
//! the first reload on.
//!
//! Source: Melan's theorem of shakedown with isotropic hardening: each further flow widens the yield surface,
//! so that flow on a closed path dies out. Measured on the single asperity, with 12 to 32 elements alike:
//! the edge of the contact flows back a little when the load is taken off, which costs the first reload 0.3
//! to 0.5 % of the force; what each further cycle loses is a seventh of that. The 10 elements of draft are
//! too long for that flow and lose 0.07 %: the runs are of `standard`. Tolerances: 1e-5 is ten times that of
//! Newton's method; 5e-3 of the returned work is the quadrature of an unloading in ten increments.

use asperity_simulation::record::rows::Phase;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, Scene, ToolShape};
use asperity_verification::single_asperity::{crush, scene};

const RELOADS: usize = 10;

fn cycled(change: impl FnOnce(&mut Scene)) -> Outcome {
    let mut scene = scene(Accuracy::Standard).unwrap();
    scene.loading.reloads = RELOADS;
    scene.numerics.newton_tolerance = Some(1e-6);
    change(&mut scene);
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none(), "{:?}", outcome.stopped);
    assert_eq!(outcome.cycles.len(), scene.loading.reloads + 1);
    outcome
}

/// The last five cycles are the same to Newton's tolerance.
fn assert_shaken_down(outcome: &Outcome) {
    for pair in outcome.cycles[RELOADS - 5..].windows(2) {
        assert!((pair[1].peak_force / pair[0].peak_force - 1.0).abs() < 1e-5, "{pair:?}");
        assert!((pair[1].residual_depth - pair[0].residual_depth).abs() < 1e-5 * pair[0].peak_depth);
        assert!((pair[1].work_in / pair[1].work_out - 1.0).abs() < 5e-3, "{pair:?}");
        assert!(pair[1].plastic_work < 1e-5 * outcome.summary.total_work);
    }
}

#[test]
fn isotropic_hardening_shakes_down() {
    let outcome = cycled(|_| {});
    let cycles = &outcome.cycles;
    assert!(cycles.iter().all(|c| (c.peak_depth / cycles[0].peak_depth - 1.0).abs() < 1e-8));
    let loss = |k: usize| 1.0 - cycles[k].peak_force / cycles[k - 1].peak_force;
    // no loss at all would be metal that does not flow back, twice as much metal that flows everywhere
    assert!((1.5e-3..5e-3).contains(&loss(1)), "{}", loss(1));
    for k in 2..4 {
        assert!(
            loss(k) > 0.05 * loss(k - 1) && loss(k) < 0.2 * loss(k - 1),
            "{k}: {} {}",
            loss(k - 1),
            loss(k)
        );
    }
    assert_shaken_down(&outcome);
    // as much as the loading alone, at this accuracy
    assert!(outcome.summary.energy_balance_error < 1e-2);
    // the summary is that of the first loading and unloading
    let alone = cycled_once();
    assert_eq!(outcome.summary.peak_force, alone.summary.peak_force);
    assert_eq!(outcome.summary.residual_depth, alone.summary.residual_depth);
    assert_eq!(outcome.summary.elastic_work, alone.summary.elastic_work);
    assert_eq!(outcome.rows[..alone.rows.len()], alone.rows);
}

fn cycled_once() -> Outcome {
    let mut scene = scene(Accuracy::Standard).unwrap();
    scene.numerics.newton_tolerance = Some(1e-6);
    crush(&scene).unwrap()
}

#[test]
fn elastic_reloads_repeat_the_first_loading() {
    let outcome = cycled(|s| (s.material.yield_stress, s.material.hardening_exponent) = (None, None));
    let first = outcome.cycles[0];
    for cycle in &outcome.cycles {
        assert!((cycle.peak_force / first.peak_force - 1.0).abs() < 1e-5);
        assert!(cycle.residual_depth.abs() < 1e-5 * first.peak_depth && cycle.plastic_work == 0.0);
    }
    assert_shaken_down(&outcome);
}

#[test]
fn reloads_by_force_and_under_a_cone_shake_down() {
    let by_force = cycled(|s| (s.loading.depth, s.loading.force) = (None, Some("4 N".parse().unwrap())));
    assert!(by_force.cycles.iter().all(|c| (c.peak_force / 4.0 - 1.0).abs() < 1e-8));
    assert_shaken_down(&by_force);
    let cone = cycled(|s| {
        s.asperity.clear();
        (s.tool.shape, s.tool.slope_deg) = (ToolShape::Cone, Some(20.0));
    });
    assert_shaken_down(&cone);
    assert!(cone.rows.iter().any(|row| row.phase == Phase::Reload));
}
