//! Convolution of a map with a Gaussian, a line at a time.
//!
//! Narrow Gaussians are summed directly, wide ones multiplied in the spectrum of real lines, padded to
//! lengths that transform fast.

use super::fft::good_length;
use asperity_numerics::transpose::transposed;
use rayon::prelude::*;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex64;
use std::f64::consts::{LN_2, PI};

/// Reach in pixels up to which the sum is quicker than the transform (measured at 4096 pixels a line: equal
/// at about 60).
const DIRECT_SUM_REACH: usize = 48;
/// Rows that one task sums into, and the columns of them at a time: what it sums stays in the cache.
const ROWS: usize = 8;
const TILE: usize = 128;

/// Weights of a Gaussian over pixels at distances 0, 1, … from its middle; those of both sides add up to 1.
pub(super) struct Gaussian {
    weights: Vec<f64>,
}

/// Evenly spaced places of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Places {
    /// The first.
    pub first: usize,
    /// Pixels from one to the next.
    pub step: usize,
    /// Their number.
    pub count: usize,
}

impl Places {
    /// Every place of a line of `length`.
    pub fn all(length: usize) -> Places {
        Places { first: 0, step: 1, count: length }
    }

    /// Each of them.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        (0..self.count).map(move |i| self.first + i * self.step)
    }
}

impl Gaussian {
    /// That of a filter with this cut-off, in pixels (ISO 16610-21).
    pub fn with_cutoff(cutoff: f64) -> Gaussian {
        let alpha = (LN_2 / PI).sqrt();
        // at one cut-off from its middle the weight is 7e-7
        let reach = cutoff.ceil() as usize;
        let weight = |k: usize| (-PI * (k as f64 / (alpha * cutoff)).powi(2)).exp();
        let weights: Vec<f64> = (0..=reach).map(weight).collect();
        let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
        Gaussian { weights: weights.iter().map(|w| w / sum).collect() }
    }

    fn reach(&self) -> usize {
        self.weights.len() - 1
    }

    /// True where the sums at `places` alone are quicker than the transform of whole lines.
    pub fn is_summed_at(&self, places: Places) -> bool {
        self.reach() <= DIRECT_SUM_REACH * places.step
    }

    /// The convolution of every line of `length` numbers at `places` of it.
    pub fn rows_at(&self, data: &[f64], length: usize, places: Places, periodic: bool) -> Vec<f64> {
        let reach = self.reach();
        let mut out = vec![0.0; data.len() / length * places.count];
        out.par_chunks_mut(places.count.max(1)).zip(data.par_chunks(length)).for_each_init(
            || vec![0.0; length + 2 * reach],
            |wide, (out, line)| {
                extend(wide, line, reach, periodic);
                for (out, place) in out.iter_mut().zip(places.iter()) {
                    let (left, right) = (&wide[place..=place + reach], &wide[place + reach..]);
                    let pairs = left.iter().rev().zip(right);
                    let both: f64 = pairs.zip(&self.weights).map(|((a, b), weight)| weight * (a + b)).sum();
                    *out = both - self.weights[0] * left[reach];
                }
            },
        );
        out
    }

    /// The convolution of every column of a map with rows of `columns` numbers, less `offset` each, at
    /// `places` of it.
    pub fn columns_at(
        &self,
        data: &[f64],
        offset: f64,
        columns: usize,
        places: Places,
        periodic: bool,
    ) -> Vec<f64> {
        let rows = data.len() / columns;
        let line = |row: i64| {
            let inside = (0..rows as i64).contains(&row);
            let row = row.rem_euclid(rows as i64) as usize;
            (inside || periodic).then(|| &data[row * columns..(row + 1) * columns])
        };
        let mut out = vec![0.0; places.count * columns];
        out.par_chunks_mut(ROWS * columns).enumerate().for_each(|(part, lines)| {
            for from in (0..columns).step_by(TILE) {
                let tile = from..columns.min(from + TILE);
                for (i, out) in lines.chunks_mut(columns).enumerate() {
                    let (row, out) =
                        ((places.first + (part * ROWS + i) * places.step) as i64, &mut out[tile.clone()]);
                    for (k, weight) in self.weights.iter().enumerate() {
                        let k = k as i64;
                        let sides = if k == 0 { [line(row), None] } else { [line(row - k), line(row + k)] };
                        for side in sides.into_iter().flatten() {
                            out.iter_mut()
                                .zip(&side[tile.clone()])
                                .for_each(|(z, a)| *z += weight * (a - offset));
                        }
                    }
                }
            }
        });
        out
    }

    /// Convolves every line of `length` numbers; what lies beyond its ends is the line again if `periodic`,
    /// else 0.
    pub fn along_rows(&self, data: &mut [f64], length: usize, periodic: bool) {
        if self.reach() <= DIRECT_SUM_REACH {
            self.sum_rows(data, length, periodic);
        } else {
            self.transform_rows(data, length, periodic);
        }
    }

    /// The same down the columns of a map with rows of `columns` numbers.
    pub fn along_columns(&self, data: Vec<f64>, columns: usize, periodic: bool) -> Vec<f64> {
        if self.reach() <= DIRECT_SUM_REACH {
            return self.columns_at(&data, 0.0, columns, Places::all(data.len() / columns), periodic);
        }
        let rows = data.len() / columns;
        let mut lines = transposed(&data, columns);
        drop(data);
        self.transform_rows(&mut lines, rows, periodic);
        transposed(&lines, rows)
    }

    fn sum_rows(&self, data: &mut [f64], length: usize, periodic: bool) {
        let reach = self.reach();
        data.par_chunks_mut(length).for_each_init(
            || vec![0.0; length + 2 * reach],
            |wide, line| {
                extend(wide, line, reach, periodic);
                for (z, middle) in line.iter_mut().zip(&wide[reach..]) {
                    *z = self.weights[0] * middle;
                }
                for (k, weight) in self.weights.iter().enumerate().skip(1) {
                    let (left, right) = (&wide[reach - k..], &wide[reach + k..]);
                    line.iter_mut()
                        .zip(left.iter().zip(right))
                        .for_each(|(z, (a, b))| *z += weight * (a + b));
                }
            },
        );
    }

    fn transform_rows(&self, data: &mut [f64], length: usize, periodic: bool) {
        let reach = self.reach();
        let circular = periodic && good_length(length) == length;
        // a line of another period is continued on both sides, so that its length may be any
        let before = if periodic && !circular { reach } else { 0 };
        let padded = if circular { length } else { good_length(length + before + reach) };
        let mut planner = RealFftPlanner::<f64>::new();
        let (forward, inverse) = (planner.plan_fft_forward(padded), planner.plan_fft_inverse(padded));
        let mut kernel = vec![0.0; padded];
        for (k, weight) in self.weights.iter().enumerate() {
            kernel[k % padded] += weight / padded as f64;
            if k > 0 {
                kernel[(padded - k % padded) % padded] += weight / padded as f64;
            }
        }
        let mut gain = forward.make_output_vec();
        // the lengths are those of the plans
        let _ = forward.process(&mut kernel, &mut gain);
        data.par_chunks_mut(length).for_each_init(
            || (vec![0.0; padded], vec![Complex64::default(); padded / 2 + 1]),
            |(wide, spectrum), line| {
                wide.fill(0.0);
                extend(&mut wide[..length + 2 * before], line, before, periodic);
                let _ = forward.process(wide, spectrum);
                spectrum.iter_mut().zip(&gain).for_each(|(s, g)| *s *= g.re);
                let _ = inverse.process(spectrum, wide);
                line.copy_from_slice(&wide[before..before + length]);
            },
        );
    }
}

/// `line` with `reach` numbers more on both sides: those of the neighbouring periods, or 0.
fn extend(wide: &mut [f64], line: &[f64], reach: usize, periodic: bool) {
    let n = line.len();
    wide[reach..reach + n].copy_from_slice(line);
    for k in 0..reach {
        let [left, right] = if periodic { [line[n - 1 - k % n], line[k % n]] } else { [0.0; 2] };
        (wide[reach - 1 - k], wide[reach + n + k]) = (left, right);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_and_transforms_agree_for_any_length_and_period() {
        for (length, cutoff, periodic) in [
            (61, 7.3, false),
            (61, 7.3, true),
            (64, 7.3, true),
            (13, 20.0, true),
            (13, 20.0, false),
            (97, 40.0, true),
        ] {
            let map: Vec<f64> = (0..length * 20).map(|i| ((i * i) as f64).sin()).collect();
            let gaussian = Gaussian::with_cutoff(cutoff);
            let (mut sums, mut waves) = (map.clone(), map.clone());
            gaussian.sum_rows(&mut sums, length, periodic);
            gaussian.transform_rows(&mut waves, length, periodic);
            let worst = sums.iter().zip(&waves).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-13, "{length} {cutoff} {periodic}: {worst}");
            let close = |a: &[f64], b: &[f64]| {
                a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-13)
            };
            let down = transposed(&map, length);
            let columns = gaussian.columns_at(&down, 0.0, 20, Places::all(length), periodic);
            assert!(close(&sums, &transposed(&columns, 20)));
            // at some places alone
            let places = Places { first: 2, step: 5, count: (length - 3) / 5 };
            let picked: Vec<f64> =
                sums.chunks(length).flat_map(|line| places.iter().map(move |place| line[place])).collect();
            assert!(close(&gaussian.rows_at(&map, length, places, periodic), &picked));
            let some = gaussian.columns_at(&down, 0.0, 20, places, periodic);
            assert!(close(&transposed(&some, 20), &picked));
        }
    }
}
