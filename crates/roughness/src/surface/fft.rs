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

/// The map whose spectrum is that of `noise` times `gain(frequency index x, y)`, indices from -n/2 to n/2.
pub(crate) fn shaped(noise: &[f64], columns: usize, gain: impl Fn(f64, f64) -> f64 + Sync) -> Vec<f64> {
    let rows = noise.len() / columns;
    let signed = |k: usize, n: usize| if 2 * k > n { k as f64 - n as f64 } else { k as f64 };
    let mut spectrum =
        both(noise.iter().map(|z| Complex64::new(*z, 0.0)).collect(), columns, FftDirection::Forward);
    spectrum.par_chunks_mut(rows).enumerate().for_each(|(kx, line)| {
        for (ky, value) in line.iter_mut().enumerate() {
            *value *= gain(signed(kx, columns), signed(ky, rows));
        }
    });
    let map = both(spectrum, rows, FftDirection::Inverse);
    let scale = 1.0 / noise.len() as f64;
    map.into_par_iter().map(|z| z.re * scale).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gain_of_one_returns_the_map_and_of_a_shift_of_sign_its_negative() {
        let map: Vec<f64> = (0..12 * 35).map(|i| ((i * i) as f64).sin()).collect();
        for (gain, sign) in [(1.0, 1.0), (-1.0, -1.0)] {
            let out = shaped(&map, 35, |_, _| gain);
            assert!(map.iter().zip(&out).all(|(a, b)| (a * sign - b).abs() < 1e-13));
        }
    }

    #[test]
    fn one_frequency_is_kept() {
        let wave = |i: usize| (std::f64::consts::TAU * ((i % 16) * 3) as f64 / 16.0).cos() + 5.0;
        let map: Vec<f64> = (0..16 * 8).map(wave).collect();
        let out = shaped(&map, 16, |x, y| if x.abs() == 3.0 && y == 0.0 { 1.0 } else { 0.0 });
        assert!(map.iter().zip(&out).all(|(a, b)| (a - 5.0 - b).abs() < 1e-13));
    }
}
