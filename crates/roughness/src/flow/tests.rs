//! The error of a flow against finer maps of the same surface.

use super::*;
use crate::Load;
use crate::half_space::{HalfSpace, TOLERANCE};
use crate::test_waves::Waves;

/// Gaps of waves down to four pixels, from open to nearly closed, beside those of four times as many pixels a
/// side: the leak of the map lies within its error of the other.
#[test]
fn the_error_of_a_leak_holds_until_it_is_nearly_closed() {
    let n = 64;
    let body = HalfSpace { reduced_modulus: 1e9, limit: None, tolerance: TOLERANCE };
    let (mut held, mut cases, mut widest) = (0, 0, 0.0f64);
    for (seed, load) in [(1, 0.03), (2, 0.08), (3, 0.12), (4, 0.15), (5, 0.18)] {
        let waves = Waves::drawn(n as f64 / 4.0, seed);
        let [coarse, fine] = [1, 4].map(|times| {
            let surface = waves.surface(n * times);
            let found = body.press(&surface, Load::Pressure(load * 1e9)).unwrap();
            let map = Gap::new(&surface.map, &found.gaps);
            [Axis::X, Axis::Y].map(|axis| leak(&map, axis))
        });
        for (coarse, fine) in coarse.into_iter().zip(fine) {
            let (Some(coarse), Some(fine)) = (coarse, fine) else { continue };
            let off = (coarse.conductance / fine.conductance).ln().abs();
            cases += 1;
            held += usize::from(off <= coarse.error.ln_1p());
            widest = widest.max(coarse.error);
            assert!(load > 0.05 || coarse.error < 0.6, "{coarse:?}");
        }
    }
    assert!(cases >= 6 && held + 1 >= cases && widest > 2.0, "{held} of {cases}, {widest}");
}
