//! Claims about the contact area that pixels leave: its stated error holds, and is not far too wide.

use super::*;
use crate::test_waves::Waves;
use crate::{Load, Surface};

const MODULUS: f64 = 1e9;

fn pressed(surface: &Surface, load: f64) -> Area {
    let body = HalfSpace { reduced_modulus: MODULUS, limit: None, tolerance: TOLERANCE };
    body.press(surface, Load::Pressure(load)).unwrap().area
}

/// Stated over true error in the middle, and the share of the cases in which it is at least 1.
fn judged(mut ratios: Vec<f64>) -> [f64; 2] {
    ratios.sort_by(f64::total_cmp);
    let held = ratios.iter().filter(|ratio| **ratio >= 1.0).count() as f64;
    [ratios[ratios.len() / 2], held / ratios.len() as f64]
}

/// Maps of waves down to four and five pixels, beside the same waves on four times as many pixels a side.
#[test]
fn the_error_of_band_limited_maps_holds_and_is_near() {
    let n = 64;
    let mut ratios = Vec::new();
    for (seed, pixels) in [(11, 4.0), (12, 5.0), (13, 4.0), (14, 5.0)] {
        let waves = Waves::drawn(n as f64 / pixels, seed);
        for load in [0.02, 0.06, 0.2] {
            let [coarse, fine] = [1, 4].map(|times| pressed(&waves.surface(n * times), load * MODULUS));
            ratios.push(coarse.error / (coarse.corrected - fine.corrected).abs());
        }
    }
    let [middle, held] = judged(ratios.clone());
    // over 405 contacts the middle was 4; of twelve some are right by chance
    assert!(held == 1.0 && middle <= 8.0, "{ratios:?}");
}
