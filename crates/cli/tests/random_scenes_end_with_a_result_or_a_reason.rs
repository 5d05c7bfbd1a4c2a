//! Claim: whatever scene it is given, the program is done, says where and why it stopped, or refuses the
//! scene with a message and nothing written: no panic, no number that is none, no hang, no other exit status.
//!
//! 300 scenes of a seed of their own; `cargo run --release -p asperity-verification --example random_scenes`
//! runs 10,000.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_verification::random_scenes::{Drawn, End, crush, draw};
use rayon::prelude::*;
use std::path::Path;
use std::time::Duration;

#[test]
fn three_hundred_random_scenes_end_with_a_result_or_a_reason() {
    let scenes = draw(300, 7).unwrap();
    let faults: Vec<String> = scenes
        .par_iter()
        .filter_map(|drawn| {
            let place = tempfile::tempdir().unwrap();
            let binary = Path::new(env!("CARGO_BIN_EXE_asperity"));
            match crush(binary, drawn, place.path(), Duration::from_secs(300)) {
                End::Fault(what) => Some(format!("{what}\n{}", drawn.text)),
                _ => None,
            }
        })
        .collect();
    assert!(faults.is_empty(), "{} faults, the first: {}", faults.len(), faults[0]);
}

/// A reason is no excuse: a scene that is driven by nine tenths of the force that its own depth carried
/// reaches it.
#[test]
fn a_force_that_a_depth_carries_is_reached() {
    let scenes = draw(60, 11).unwrap();
    let binary = Path::new(env!("CARGO_BIN_EXE_asperity"));
    let limit = Duration::from_secs(300);
    let told: Vec<Option<String>> = scenes
        .par_iter()
        .filter_map(|drawn| {
            let place = tempfile::tempdir().unwrap();
            let End::Done(_) = crush(binary, drawn, place.path(), limit) else { return None };
            let summary = std::fs::read_to_string(place.path().join("out/summary.json")).unwrap();
            let force = driven_by_force(drawn, &serde_json::from_str(&summary).unwrap(), 0.9)?;
            let place = tempfile::tempdir().unwrap();
            Some(match crush(binary, &force, place.path(), limit) {
                End::Done(_) => None,
                other => Some(format!("{other:?}\n{}", force.text)),
            })
        })
        .collect();
    assert!(told.len() >= 30, "{}", told.len());
    let faults: Vec<&String> = told.iter().flatten().collect();
    assert!(faults.is_empty(), "{} of {}, the first: {}", faults.len(), told.len(), faults[0]);
}

/// The scene driven by this share of the force of its summary; `None` where there was no force.
fn driven_by_force(drawn: &Drawn, summary: &serde_json::Value, share: f64) -> Option<Drawn> {
    let (head, loading) = drawn.text.split_once("[loading]\n")?;
    let (_, rest) = loading.split_once('\n')?;
    let force = [("peak_force_N", "N"), ("peak_force_N_per_mm", "N/mm")]
        .into_iter()
        .find_map(|(key, unit)| Some((summary[key].as_f64().filter(|force| *force > 0.0)?, unit)));
    let (force, unit) = force?;
    let text = format!("{head}[loading]\nforce = \"{} {unit}\"\n{rest}", share * force);
    Some(Drawn { text, ..drawn.clone() })
}
