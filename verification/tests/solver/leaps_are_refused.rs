//! Claim: no increment is accepted in which the metal dissipates more than the tool does in work and body and
//! contacts give up, by more than 1 % of the work so far. The scene in which that once happened, a sharp cone
//! of 60° of metal that hardly hardens, reaches its depth with a balance below 3e-2, or stops with its reason
//! and the key that helps.
//!
//! Source: conservation of energy; a solution on another branch of equilibrium does not keep it. Tolerance:
//! the 1 % is the rule itself; transfers to better meshes change energies by what the row says of them.

use asperity_material::units::Length;
use asperity_simulation::load_path::Stop;
use asperity_simulation::record::rows::CurveRow;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::Accuracy;
use asperity_verification::single_asperity::{crush, loaded};

/// A sharp cone of 60° and n = 0.02, to half its height.
fn sharp(accuracy: Accuracy) -> Outcome {
    let mut scene = loaded(accuracy).unwrap();
    (scene.asperity[0].slope_deg, scene.asperity[0].tip_radius) = (Some(60.0), None);
    scene.material.hardening_exponent = Some(0.02);
    scene.loading.depth = Some(Length(10e-6));
    let outcome = crush(&scene).unwrap();
    if let Some(stopped) = &outcome.stopped {
        let key = stopped.way_out(&scene).unwrap();
        assert!(key.contains("asperity[0].tip_radius"), "{accuracy:?}: {key}");
    }
    outcome
}

/// Plastic work of the increment between two rows that nothing pays for, over the largest work so far.
fn unpaid(before: &CurveRow, after: &CurveRow, most: f64) -> f64 {
    let held = |row: &CurveRow| row.elastic_energy + row.contact_energy;
    let paid = after.external_work - before.external_work + held(before) - held(after);
    let moved = (after.transfer_energy - before.transfer_energy).abs();
    (after.plastic_work - before.plastic_work - paid - moved) / most
}

#[test]
fn a_sharp_steep_cone_gets_no_plastic_work_for_nothing() {
    for accuracy in [Accuracy::Draft, Accuracy::Standard] {
        let outcome = sharp(accuracy);
        let mut most = 0.0_f64;
        for pair in outcome.rows.windows(2) {
            most = most.max(pair[1].external_work);
            let share = unpaid(&pair[0], &pair[1], most);
            assert!(share <= 0.01, "{accuracy:?} at {:e} m: {share} of the work", pair[1].depth);
        }
        let balance = outcome.summary.energy_balance_error;
        let leapt = outcome.stopped.as_ref().is_some_and(|stopped| stopped.reason == Stop::Leaps);
        assert!(leapt || balance < 3e-2, "{accuracy:?}: {balance} {:?}", outcome.stopped);
    }
}
