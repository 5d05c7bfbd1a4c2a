//! Claim: whatever scene it is given, the program is done, says where and why it stopped, or refuses the
//! scene with a message and nothing written: no panic, no number that is none, no hang, no other exit status.
//!
//! 300 scenes of a seed of their own; `cargo run --release -p asperity-verification --example random_scenes`
//! runs 10,000.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_verification::random_scenes::{End, crush, draw};
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
