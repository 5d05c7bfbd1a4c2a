//! Sums of a few waves, for tests that press the same surface on grids of different fineness.

use crate::{HeightMap, Surface};
use std::f64::consts::PI;

/// Waves of a square period of length 1: wave numbers along x and y, amplitude, phase.
pub(crate) struct Waves(Vec<[f64; 4]>);

impl Waves {
    /// Sixty waves from half a period down to 1/`most` of it, drawn by `seed`; the mean square slope is 1.
    pub fn drawn(most: f64, seed: u32) -> Waves {
        let mut state = seed;
        let mut drawn = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(state >> 8) / f64::from(1u32 << 24)
        };
        let mut waves: Vec<[f64; 4]> = Vec::new();
        while waves.len() < 60 {
            let [x, y] = [0, 1].map(|_| (most * (2.0 * drawn() - 1.0)).round());
            let q = x.hypot(y);
            if (2.0..=most).contains(&q) {
                waves.push([x, y, q.powf(-1.3), drawn()]);
            }
        }
        let squares: f64 = waves.iter().map(|[x, y, a, _]| 0.5 * a * a * (x * x + y * y)).sum();
        let slope = 2.0 * PI * squares.sqrt();
        waves.iter_mut().for_each(|wave| wave[2] /= slope);
        Waves(waves)
    }

    /// The periodic surface on `n` x `n` nodes.
    pub fn surface(&self, n: usize) -> Surface {
        let height = |i: usize| -> f64 {
            let [x, y] = [i % n, i / n].map(|i| i as f64 / n as f64);
            let wave = |[kx, ky, a, phase]: &[f64; 4]| a * (2.0 * PI * (kx * x + ky * y + phase)).cos();
            self.0.iter().map(wave).sum()
        };
        let map = HeightMap::new(n, n, [1.0 / n as f64; 2], (0..n * n).map(height).collect()).unwrap();
        Surface::from_map(map.with_periodic(true)).unwrap()
    }
}
