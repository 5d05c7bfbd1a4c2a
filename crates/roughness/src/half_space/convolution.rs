//! Displacement of an elastic half-space under a map of pressures, by fast Fourier transforms.
//!
//! Lengths are in pixels (the root of a pixel's area), pressures such that E* is 1.

use crate::half_space::float::Real;
use crate::surface::fft::good_length;
use rayon::prelude::*;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

/// Columns that one task transforms at once: a few cache lines of every row.
const BLOCK: usize = 16;
/// Rows that one task transforms.
const ROWS: usize = 16;
/// Rows that are turned into columns at once: the pieces of columns are whole cache lines, as the columns of
/// a map of 2ⁿ rows share the places that their lines may take in a cache.
const TILE: usize = 8;

/// The direction between pressure and displacement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// Displacement of a pressure.
    Compliance,
    /// Pressure of a displacement on the whole grid: what preconditions the search on a part of it.
    Stiffness,
}

/// The response of the half-space to one wave: the displacement per pressure. It is even in both wave
/// numbers, so that the quarter of waves 0..=n/2 along x and y is enough.
struct Response<T> {
    /// Column by column for waves 0..`rows` along y.
    table: Vec<T>,
    rows: usize,
    /// True where an even pressure displaces nothing: of a periodic surface, whose displacements count from
    /// their mean.
    from_the_mean: bool,
}

/// Transforms of one grid with the half-space's response.
pub(super) struct Convolution<T: Real> {
    nodes: [usize; 2],
    padded: [usize; 2],
    along_x: Arc<dyn RealToComplex<T>>,
    back_x: Arc<dyn ComplexToReal<T>>,
    along_y: Arc<dyn Fft<T>>,
    back_y: Arc<dyn Fft<T>>,
    response: Response<T>,
    /// Transformed rows, one after the other.
    spectrum: Vec<Complex<T>>,
    /// The same after the columns, in blocks of columns: a task owns its block.
    blocks: Vec<Complex<T>>,
}

impl<T: Real> Convolution<T> {
    /// For `nodes` pixels along x and y whose sides are `sides` (in pixels, their product 1).
    pub fn new(nodes: [usize; 2], sides: [f64; 2], periodic: bool) -> Convolution<T> {
        let padded = if periodic { nodes } else { nodes.map(|n| good_length(2 * n - 1)) };
        let mut real = RealFftPlanner::new();
        let mut complex = FftPlanner::new();
        let width = padded[0] / 2 + 1;
        Convolution {
            nodes,
            padded,
            along_x: real.plan_fft_forward(padded[0]),
            back_x: real.plan_fft_inverse(padded[0]),
            along_y: complex.plan_fft_forward(padded[1]),
            back_y: complex.plan_fft_inverse(padded[1]),
            response: if periodic { waves(nodes, sides) } else { free(padded, sides) },
            spectrum: vec![Complex::default(); width * nodes[1]],
            blocks: vec![Complex::default(); width.div_ceil(BLOCK) * BLOCK * nodes[1]],
        }
    }

    /// Pressure of an even displacement by 1, as [`Way::Stiffness`] has it, where an even pressure displaces
    /// nothing: it is no pressure of the half-space. 0 of a surface that stands free, which sinks under one.
    pub fn even_stiffness(&self) -> f64 {
        if self.response.from_the_mean { 1.0 / self.response.table[0].wide() } else { 0.0 }
    }

    /// The least displacement per pressure of a wave; of a periodic surface beside the even one.
    #[cfg(test)]
    pub fn least_response(&self) -> f64 {
        self.response.table.iter().map(|value| value.wide()).fold(f64::INFINITY, f64::min)
    }

    /// `output` = response (or its inverse) applied to `input`, both one number per node.
    pub fn apply(&mut self, way: Way, input: &[T], output: &mut [T]) {
        self.transform_rows(input);
        self.respond_in_columns(way);
        self.transform_back(None, output);
    }

    /// The same less what stands in `from`.
    pub fn apply_less(&mut self, way: Way, input: &[T], from: &[T], output: &mut [T]) {
        self.transform_rows(input);
        self.respond_in_columns(way);
        self.transform_back(Some(from), output);
    }

    /// Waves along x of the rows of `input`, into the spectrum.
    fn transform_rows(&mut self, input: &[T]) {
        let (nx, px) = (self.nodes[0], self.padded[0]);
        let width = px / 2 + 1;
        let along_x = &self.along_x;
        self.spectrum.par_chunks_mut(width * ROWS).enumerate().for_each_init(
            || (vec![T::zero(); px], along_x.make_scratch_vec()),
            |(line, scratch), (k, rows)| {
                for (i, out) in rows.chunks_mut(width).enumerate() {
                    let row = k * ROWS + i;
                    line[..nx].copy_from_slice(&input[row * nx..(row + 1) * nx]);
                    line[nx..].fill(T::zero());
                    // the lengths are those of the plan
                    let _ = along_x.process_with_scratch(line, out, scratch);
                }
            },
        );
    }

    /// The response to every wave: the columns of the spectrum along y and back, into the blocks.
    fn respond_in_columns(&mut self, way: Way) {
        let (ny, [px, py]) = (self.nodes[1], self.padded);
        let width = px / 2 + 1;
        let (spectrum, along_y, back_y, response) =
            (&self.spectrum, &self.along_y, &self.back_y, &self.response);
        let scale = 1.0 / (px as f64 * py as f64);
        let scratch = along_y.get_inplace_scratch_len().max(back_y.get_inplace_scratch_len());
        self.blocks.par_chunks_mut(BLOCK * ny).enumerate().for_each_init(
            || (vec![Complex::<T>::default(); BLOCK * py], vec![Complex::default(); scratch]),
            |(columns, scratch), (b, out)| {
                let first = b * BLOCK;
                let count = BLOCK.min(width - first);
                let used = &mut columns[..count * py];
                for first_row in (0..ny).step_by(TILE) {
                    let rows = first_row..(first_row + TILE).min(ny);
                    for k in 0..count {
                        let line = &mut used[k * py..][rows.clone()];
                        let from = spectrum[first_row * width + first + k..].iter().step_by(width);
                        line.iter_mut().zip(from).for_each(|(to, value)| *to = *value);
                    }
                }
                for line in used.chunks_mut(py) {
                    line[ny..].fill(Complex::default());
                }
                along_y.process_with_scratch(used, scratch);
                for (k, line) in used.chunks_mut(py).enumerate() {
                    response.multiply(way, first + k, line, scale);
                }
                back_y.process_with_scratch(used, scratch);
                for first_row in (0..ny).step_by(TILE) {
                    let rows = first_row..(first_row + TILE).min(ny);
                    for k in 0..count {
                        let to = out[first_row * BLOCK + k..].iter_mut().step_by(BLOCK);
                        let line = &used[k * py..][rows.clone()];
                        to.zip(line).for_each(|(to, value)| *to = *value);
                    }
                }
            },
        );
    }

    /// The rows of the blocks back from their waves along x, less those of `from`, into `output`.
    fn transform_back(&self, from: Option<&[T]>, output: &mut [T]) {
        let ([nx, ny], px) = (self.nodes, self.padded[0]);
        let width = px / 2 + 1;
        let back_x = &self.back_x;
        let blocks = &self.blocks;
        output.par_chunks_mut(nx * ROWS).enumerate().for_each_init(
            || (vec![T::zero(); px], vec![Complex::<T>::default(); width], back_x.make_scratch_vec()),
            |(line, wave, scratch), (k, rows)| {
                for (i, out) in rows.chunks_mut(nx).enumerate() {
                    let row = k * ROWS + i;
                    for (b, part) in wave.chunks_mut(BLOCK).enumerate() {
                        part.copy_from_slice(&blocks[(b * ny + row) * BLOCK..][..part.len()]);
                    }
                    // real numbers have no sine of these
                    wave[0].im = T::zero();
                    if px.is_multiple_of(2) {
                        wave[width - 1].im = T::zero();
                    }
                    if px == nx {
                        let _ = back_x.process_with_scratch(wave, out, scratch);
                    } else {
                        let _ = back_x.process_with_scratch(wave, line, scratch);
                        out.copy_from_slice(&line[..nx]);
                    }
                    if let Some(from) = from {
                        out.iter_mut().zip(&from[row * nx..]).for_each(|(u, h)| *u -= *h);
                    }
                }
            },
        );
    }
}

/// 2/|q| (Westergaard; Johnson 1985, ch. 13) of a periodic grid; of the even pressure that of half the least
/// wave number, for what preconditions.
fn waves<T: Real>(nodes: [usize; 2], sides: [f64; 2]) -> Response<T> {
    let number = |axis: usize, k: usize| TAU * k as f64 / (nodes[axis] as f64 * sides[axis]);
    let longest = [0, 1].into_iter().filter(|axis| nodes[*axis] > 1).map(|axis| number(axis, 1));
    let least = longest.fold(f64::INFINITY, f64::min);
    let least = if least.is_finite() { 0.5 * least } else { 1.0 };
    let rows = nodes[1] / 2 + 1;
    let mut table = vec![T::zero(); (nodes[0] / 2 + 1) * rows];
    table.par_chunks_mut(rows).enumerate().for_each(|(kx, column)| {
        let x2 = number(0, kx).powi(2);
        for (ky, gain) in column.iter_mut().enumerate() {
            *gain = T::nearest(2.0 / (x2 + number(1, ky).powi(2)).sqrt().max(least));
        }
    });
    Response { table, rows, from_the_mean: true }
}

/// ∫∫ dA/r over a rectangle with one corner at the origin: second differences give it over any rectangle.
fn corner(x: f64, y: f64) -> f64 {
    x * (y / x.abs()).asinh() + y * (x / y.abs()).asinh()
}

/// Transform of the displacement around one loaded pixel (Love 1929), of a surface that stands free.
fn free<T: Real>(padded: [usize; 2], sides: [f64; 2]) -> Response<T> {
    let [px, py] = padded;
    let (wide, high) = (px / 2 + 1, py / 2 + 1);
    let corners: Vec<Vec<f64>> = (0..=high)
        .into_par_iter()
        .map(|j| {
            let y = (j as f64 - 0.5) * sides[1];
            (0..=wide).map(|i| corner((i as f64 - 0.5) * sides[0], y)).collect()
        })
        .collect();
    let mut plan = RealFftPlanner::<f64>::new();
    let (along_x, along_y) = (plan.plan_fft_forward(px), plan.plan_fft_forward(py));
    // even in both directions, so that transforms are real and half of them is enough
    let rows: Vec<Vec<f64>> = (0..high)
        .into_par_iter()
        .map(|j| {
            let (low, high) = (&corners[j], &corners[j + 1]);
            let at = |i: usize| (high[i + 1] - high[i] - low[i + 1] + low[i]) / PI;
            let mut line: Vec<f64> = (0..px).map(|i| at(i.min(px - i))).collect();
            let mut wave = along_x.make_output_vec();
            let _ = along_x.process(&mut line, &mut wave);
            wave.iter().map(|value| value.re).collect()
        })
        .collect();
    let mut table = vec![T::zero(); wide * high];
    table.par_chunks_mut(high).enumerate().for_each(|(kx, out)| {
        let mut line: Vec<f64> = (0..py).map(|j| rows[j.min(py - j)][kx]).collect();
        let mut wave = along_y.make_output_vec();
        let _ = along_y.process(&mut line, &mut wave);
        out.iter_mut().zip(&wave).for_each(|(to, value)| *to = T::nearest(value.re));
    });
    Response { table, rows: high, from_the_mean: false }
}

impl<T: Real> Response<T> {
    /// Multiplies the waves of column `kx` by the response, or by its inverse, and by `scale`.
    fn multiply(&self, way: Way, kx: usize, line: &mut [Complex<T>], scale: f64) {
        let n = line.len();
        let (half, scale) = (n / 2 + 1, T::nearest(scale));
        let table = &self.table[kx * self.rows..][..self.rows];
        let gain = |value: T| match way {
            Way::Compliance => value * scale,
            Way::Stiffness => scale / value.abs(),
        };
        if kx == 0 && way == Way::Compliance && self.from_the_mean {
            line[0] = Complex::default();
        }
        let (rising, falling) = line.split_at_mut(half.min(n));
        rising.iter_mut().zip(table).for_each(|(value, g)| *value = value.scale(gain(*g)));
        // wave k of the second half is wave n - k the other way
        falling.iter_mut().rev().zip(&table[1..]).for_each(|(value, g)| *value = value.scale(gain(*g)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_of_pressure_lifts_by_two_over_its_wave_number() {
        for nodes in [[16, 10], [15, 9], [8, 1]] {
            let sides = [2.0, 0.5];
            let mut space = Convolution::<f64>::new(nodes, sides, true);
            let number = TAU * 2.0 / (nodes[0] as f64 * sides[0]);
            let wave = |i: usize| (number * sides[0] * (i % nodes[0]) as f64).cos();
            let input: Vec<f64> = (0..nodes[0] * nodes[1]).map(wave).collect();
            let mut output = vec![0.0; input.len()];
            space.apply(Way::Compliance, &input, &mut output);
            assert!(input.iter().zip(&output).all(|(p, u)| (u - 2.0 / number * p).abs() < 1e-12));
            let lifted = output.clone();
            space.apply(Way::Stiffness, &lifted, &mut output);
            assert!(input.iter().zip(&output).all(|(p, u)| (u - p).abs() < 1e-12));
        }
    }

    /// Love 1929: 4 ln(1 + √2)/π pixels under the middle of a square pixel of unit pressure; far away that of
    /// a point force.
    #[test]
    fn a_loaded_pixel_sinks_as_love_says_and_nothing_returns_from_beyond_the_edge() {
        let (nodes, sides) = ([11, 7], [2.0, 0.5]);
        let mut input = vec![0.0; 77];
        input[0] = 1.0;
        let mut output = vec![0.0; 77];
        let mut square = Convolution::<f64>::new(nodes, [1.0, 1.0], false);
        square.apply(Way::Compliance, &input, &mut output);
        assert!((output[0] - 4.0 * (1.0 + 2f64.sqrt()).ln() / PI).abs() < 1e-12);
        let mut long = Convolution::<f64>::new(nodes, sides, false);
        long.apply(Way::Compliance, &input, &mut output);
        for (x, y) in [(10, 0), (10, 6), (5, 3)] {
            let far = 1.0 / (PI * ((x as f64 * 2.0).powi(2) + (y as f64 * 0.5).powi(2)).sqrt());
            assert!((output[y * 11 + x] / far - 1.0).abs() < 6e-3, "{x} {y}");
        }
    }

    #[test]
    fn good_lengths_hold_what_they_must() {
        let lengths = [1, 2, 7, 13, 199, 2047, 4097].map(good_length);
        assert_eq!(lengths, [2, 2, 8, 16, 200, 2048, 4320]);
    }
}
