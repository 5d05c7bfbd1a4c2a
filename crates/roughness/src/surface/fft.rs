//! Discrete Fourier transforms of lines and maps.

use asperity_numerics::transpose::transposed;
use rayon::prelude::*;
use rustfft::{FftDirection, FftPlanner};

use rustfft::num_complex::Complex64;

/// The least even length of factors 2, 3 and 5 that holds `least`.
pub(crate) fn good_length(least: usize) -> usize {
    let smooth = |mut n: usize| {
        for factor in [2, 3, 5] {
            while n.is_multiple_of(factor) {
                n /= factor;
            }
        }
        n == 1
    };
    (least.max(2)..).find(|n| n.is_multiple_of(2) && smooth(*n)).unwrap_or(least)
}

/// Both passes of a transform of a map with rows of `columns` numbers; the result is transposed. There and
/// back multiplies by the number of nodes.
fn both(mut data: Vec<Complex64>, columns: usize, direction: FftDirection) -> Vec<Complex64> {
    let mut planner = FftPlanner::new();
    let rows = data.len() / columns;
    let along_x = planner.plan_fft(columns, direction);
    data.par_chunks_mut(columns).for_each(|line| along_x.process(line));
    let mut data = transposed(&data, columns);
    let along_y = planner.plan_fft(rows, direction);
    data.par_chunks_mut(rows).for_each(|line| along_y.process(line));
    data
}

/// The spectrum of a map, of which maps with other spectra are made.
pub(crate) struct Spectrum {
    values: Vec<Complex64>,
    columns: usize,
    rows: usize,
}

impl Spectrum {
    /// That of a map with rows of `columns` numbers.
    pub fn of_map(map: &[f64], columns: usize) -> Spectrum {
        let values =
            both(map.iter().map(|z| Complex64::new(*z, 0.0)).collect(), columns, FftDirection::Forward);
        Spectrum { values, columns, rows: map.len() / columns }
    }

    /// The map whose spectrum is this one times `gain(frequency index x, y)`, indices from 0 to n/2: waves
    /// that run the other way have the same gain.
    pub fn shaped(&self, gain: impl Fn(f64, f64) -> f64 + Sync) -> Vec<f64> {
        let Spectrum { columns, rows, .. } = *self;
        let folded = |k: usize, n: usize| k.min(n - k);
        let [along_x, along_y] = [columns, rows].map(|n| n / 2 + 1);
        let gains: Vec<f64> = (0..along_x * along_y)
            .into_par_iter()
            .map(|i| gain((i / along_y) as f64, (i % along_y) as f64))
            .collect();
        let mut spectrum = self.values.clone();
        spectrum.par_chunks_mut(rows).enumerate().for_each(|(kx, line)| {
            let gains = &gains[folded(kx, columns) * along_y..];
            for (ky, value) in line.iter_mut().enumerate() {
                *value *= gains[folded(ky, rows)];
            }
        });
        let map = both(spectrum, rows, FftDirection::Inverse);
        let scale = 1.0 / (columns * rows) as f64;
        map.into_par_iter().map(|z| z.re * scale).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gain_of_one_returns_the_map_and_of_a_shift_of_sign_its_negative() {
        let map: Vec<f64> = (0..12 * 35).map(|i| ((i * i) as f64).sin()).collect();
        for (gain, sign) in [(1.0, 1.0), (-1.0, -1.0)] {
            let out = Spectrum::of_map(&map, 35).shaped(|_, _| gain);
            assert!(map.iter().zip(&out).all(|(a, b)| (a * sign - b).abs() < 1e-13));
        }
    }

    #[test]
    fn one_frequency_is_kept() {
        let wave = |i: usize| (std::f64::consts::TAU * ((i % 16) * 3) as f64 / 16.0).cos() + 5.0;
        let map: Vec<f64> = (0..16 * 8).map(wave).collect();
        let out = Spectrum::of_map(&map, 16).shaped(|x, y| if x == 3.0 && y == 0.0 { 1.0 } else { 0.0 });
        assert!(map.iter().zip(&out).all(|(a, b)| (a - 5.0 - b).abs() < 1e-13));
    }
}
