//! Power spectral density of a map.
//!
//! C(f) with ∫∫ C df_x df_y = Sq² over all frequencies, averaged over the directions of equal |f|; and the
//! densities of profiles along x and y, with 2∫ C df = Sq² over the positive ones (Jacobs, Junge, Pastewka
//! 2017). A map that is not periodic is weighted with a Hann window first, whose loss of power is made up
//! for.

use crate::surface::filter::fill;
use crate::surface::height_map::{HeightMap, MapError};
use asperity_numerics::transpose::transposed;
use rayon::prelude::*;
use realfft::RealFftPlanner;
use realfft::num_complex::Complex64;
use rustfft::FftPlanner;
use std::f64::consts::TAU;

/// Points of the spectrum between a frequency and its double.
const PER_OCTAVE: f64 = 8.0;

/// Densities around one frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectrumPoint {
    /// Mean frequency, 1/m.
    pub frequency: f64,
    /// Waves of the map that the mean over all directions is of, each of a pair that are one real wave.
    pub waves: f64,
    /// Mean frequency of their power, 1/m.
    pub frequency_of_power: f64,
    /// Mean over all directions, m⁴; `None` where the map has no wave so short or long.
    pub areal: Option<f64>,
    /// Of profiles along x, m³.
    pub along_x: Option<f64>,
    /// Of profiles along y, m³.
    pub along_y: Option<f64>,
}

/// Sums over the waves of a band.
#[derive(Clone, Copy, Default)]
struct Sum {
    frequency: f64,
    density: f64,
    waves: f64,
    /// Σ of density times frequency.
    moment: f64,
}

impl Sum {
    fn add(&mut self, frequency: f64, density: f64, waves: f64) {
        self.frequency += waves * frequency;
        self.density += waves * density;
        self.waves += waves;
        self.moment += waves * density * frequency;
    }

    fn mean(&self) -> Option<f64> {
        (self.waves > 0.0).then(|| self.density / self.waves)
    }
}

/// Bands of frequency, and which one holds a frequency.
struct Bands {
    least: f64,
    sums: Vec<[Sum; 3]>,
}

impl Bands {
    fn band(&mut self, frequency: f64) -> &mut [Sum; 3] {
        let k = ((frequency / self.least).log2() * PER_OCTAVE + 0.5).max(0.0) as usize;
        let last = self.sums.len() - 1;
        &mut self.sums[k.min(last)]
    }
}

/// The spectrum of `map` about its mean, from its longest wave to the shortest; holes are filled first.
///
/// # Errors
/// A map without any height.
pub fn spectrum(map: &HeightMap) -> Result<Vec<SpectrumPoint>, MapError> {
    map.extent()?;
    let filled = fill(map)?;
    let (nx, ny) = (map.columns(), map.rows());
    let [dx, dy] = map.pixel();
    let windows = [nx, ny].map(|n| window(n, map.periodic()));
    let heights = weighted(&filled, &windows);
    let steps = [1.0 / (nx as f64 * dx), 1.0 / (ny as f64 * dy)];
    let most = (0.5 / dx).hypot(0.5 / dy);
    let least = steps[0].min(steps[1]);
    let count = ((most / least).log2() * PER_OCTAVE).ceil() as usize + 2;
    let mut bands = Bands { least, sums: vec![[Sum::default(); 3]; count] };
    let rows = transformed_rows(&heights, nx);
    let width = nx / 2 + 1;
    // waves of a real line stand for two, but the mean and the shortest of an even length
    let twice = |k: usize, n: usize| if k == 0 || 2 * k == n { 1.0 } else { 2.0 };
    profile(&rows, width, nx, [dx, steps[0]], &mut bands, 1);
    let lines = transposed(&heights, nx);
    profile(&transformed_rows(&lines, ny), ny / 2 + 1, ny, [dy, steps[1]], &mut bands, 2);
    drop(lines);
    let columns = transformed_columns(transposed(&rows, width), ny);
    let scale = dx * dy / (nx as f64 * ny as f64);
    for (kx, column) in columns.chunks(ny).enumerate() {
        for (ky, wave) in column.iter().enumerate().filter(|(ky, _)| kx > 0 || *ky > 0) {
            let signed = if 2 * ky > ny { ky as f64 - ny as f64 } else { ky as f64 };
            let frequency = (kx as f64 * steps[0]).hypot(signed * steps[1]);
            bands.band(frequency)[0].add(frequency, wave.norm_sqr() * scale, twice(kx, nx));
        }
    }
    let point = |sums: &[Sum; 3]| {
        let (frequency, waves) = sums.iter().fold((0.0, 0.0), |(f, w), s| (f + s.frequency, w + s.waves));
        let [areal, along_x, along_y] = [0, 1, 2].map(|k: usize| sums[k].mean());
        let frequency = frequency / waves;
        let power = sums[0].density;
        let frequency_of_power = if power > 0.0 { sums[0].moment / power } else { frequency };
        let waves_of_map = sums[0].waves;
        let found =
            SpectrumPoint { frequency, waves: waves_of_map, frequency_of_power, areal, along_x, along_y };
        (waves > 0.0).then_some(found)
    };
    Ok(bands.sums.iter().filter_map(point).collect())
}

/// Hann's window over `n` points with a mean square of 1; 1 everywhere of a period.
fn window(n: usize, periodic: bool) -> Vec<f64> {
    if periodic || n < 3 {
        return vec![1.0; n];
    }
    let hann = |i: usize| (2.0 / 3.0f64).sqrt() * (1.0 - (TAU * (i as f64 + 0.5) / n as f64).cos());
    (0..n).map(hann).collect()
}

/// Heights about their weighted mean, times the windows.
fn weighted(map: &HeightMap, [across, down]: &[Vec<f64>; 2]) -> Vec<f64> {
    let columns = map.columns();
    let sum = |row: usize| {
        let line = map.row(row).iter().zip(across).map(|(z, w)| z * w).sum::<f64>();
        line * down[row]
    };
    let whole = across.iter().sum::<f64>() * down.iter().sum::<f64>();
    let mean = (0..map.rows()).map(sum).sum::<f64>() / whole;
    let mut out = vec![0.0; map.heights().len()];
    out.par_chunks_mut(columns).enumerate().for_each(|(row, line)| {
        for ((out, z), w) in line.iter_mut().zip(map.row(row)).zip(across) {
            *out = (z - mean) * w * down[row];
        }
    });
    out
}

/// Real rows of `columns` numbers, each as its waves 0..=columns/2.
fn transformed_rows(data: &[f64], columns: usize) -> Vec<Complex64> {
    let plan = RealFftPlanner::<f64>::new().plan_fft_forward(columns);
    let width = columns / 2 + 1;
    let mut out = vec![Complex64::default(); data.len() / columns * width];
    out.par_chunks_mut(width).zip(data.par_chunks(columns)).for_each(|(out, line)| {
        // the lengths are those of the plan
        let _ = plan.process(&mut line.to_vec(), out);
    });
    out
}

fn transformed_columns(mut columns: Vec<Complex64>, rows: usize) -> Vec<Complex64> {
    let plan = FftPlanner::new().plan_fft_forward(rows);
    columns.par_chunks_mut(rows).for_each(|line| plan.process(line));
    columns
}

/// Adds the mean density of transformed lines of `n` points `pixel` apart.
fn profile(
    lines: &[Complex64],
    width: usize,
    n: usize,
    [pixel, step]: [f64; 2],
    bands: &mut Bands,
    kind: usize,
) {
    let mut power = vec![0.0; width];
    for line in lines.chunks(width) {
        power.iter_mut().zip(line).for_each(|(p, wave)| *p += wave.norm_sqr());
    }
    let count = (lines.len() / width) as f64;
    for (k, power) in power.iter().enumerate().skip(1) {
        let density = power / count * pixel / n as f64;
        bands.band(k as f64 * step)[kind].add(k as f64 * step, density, 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A wave of amplitude a and n periods: all its power, a²/2, at n/L.
    #[test]
    fn a_wave_has_its_power_at_its_frequency() {
        let (nx, ny) = (96, 80);
        let wave = |i: usize| 3.0 + 0.7 * (TAU * 8.0 * (i % nx) as f64 / nx as f64).cos();
        let map = HeightMap::new(nx, ny, [0.5, 0.25], (0..nx * ny).map(wave).collect()).unwrap();
        let found = spectrum(&map.clone().with_periodic(true)).unwrap();
        let frequency = 8.0 / 48.0;
        let top = found
            .iter()
            .max_by(|a, b| a.along_x.unwrap_or(0.0).total_cmp(&b.along_x.unwrap_or(0.0)))
            .unwrap();
        // in a band of one wave along x: density times step, both signs
        assert!((top.frequency / frequency - 1.0).abs() < 0.1, "{top:?}");
        assert!((2.0 * top.along_x.unwrap() / 48.0 - 0.245).abs() < 1e-12);
        assert!(found.iter().all(|p| p.along_y.is_none_or(|c| c < 1e-25)));
        // the window spreads the wave over its neighbours and keeps its power
        let spread = spectrum(&map).unwrap();
        let power: f64 = spread.iter().filter_map(|p| p.along_x).sum::<f64>() * 2.0 / 48.0;
        assert!((0.5 * 0.245..1.1 * 0.245).contains(&power), "{power}");
    }

    #[test]
    fn white_noise_is_flat_and_holds_its_variance() {
        let n = 256;
        // splitmix64
        let noise = (1..=(n * n) as u64).map(|i| {
            let a = i.wrapping_mul(0x9e3779b97f4a7c15);
            let b = (a ^ (a >> 30)).wrapping_mul(0xbf58476d1ce4e5b9);
            let c = (b ^ (b >> 27)).wrapping_mul(0x94d049bb133111eb);
            ((c ^ (c >> 31)) >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        });
        let map = HeightMap::new(n, n, [2.0, 2.0], noise.collect()).unwrap();
        let inner = |points: &[SpectrumPoint]| {
            // few waves lie at the ends
            points.iter().copied().filter(|p| (0.15..0.25).contains(&p.frequency)).collect::<Vec<_>>()
        };
        for periodic in [true, false] {
            // variance 1/12 over frequencies up to 1/4 on both sides
            let level = 1.0 / 12.0 * 4.0;
            for point in inner(&spectrum(&map.clone().with_periodic(periodic)).unwrap()) {
                // a band of 2000 waves scatters by 3 %
                assert!((point.areal.unwrap() / level - 1.0).abs() < 0.12, "{point:?}");
            }
        }
        assert!(spectrum(&HeightMap::new(4, 4, [1.0, 1.0], vec![f64::NAN; 16]).unwrap()).is_err());
    }
}
