//! Slopes and curvatures at one scale.

use super::cutoffs::Scale;
use super::slope_power::SlopePower;
use crate::HeightMap;
use crate::surface::cells;

/// Shares of the surface that are less steep than the quantiles of [`Slopes`].
pub const QUANTILES: [f64; 5] = [0.01, 0.1, 0.5, 0.9, 0.99];
/// Bins of the distribution of squared slopes: the bits of the mantissa that are told apart, so that an
/// octave has 32 of equal width; the octaves below the mean square, and all bins.
const BITS: u32 = 5;
const OCTAVES_BELOW: u64 = 24;
const BINS: usize = 1280;
/// Rows to a distance that differences over it are taken on: nearer ones are alike.
const ROWS_PER_DISTANCE: usize = 8;

/// Slopes and curvatures of a surface at one scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slopes {
    /// Root mean square of |∇h|.
    pub rms: f64,
    /// Mean of |∇h|.
    pub mean: f64,
    /// tan β that the shares [`QUANTILES`] of the surface lie below.
    pub quantiles: [f64; QUANTILES.len()],
    /// Root mean square of half the Laplacian, 1/m.
    pub rms_curvature: f64,
    /// Smallest over largest rms slope of all directions: 1 of an isotropic surface, 0 of grooves.
    pub anisotropy: f64,
    /// The direction of the largest, in degrees from x to y.
    pub steepest_deg: f64,
    /// Distance of the next two, in metres: half the cut-off, in whole pixels.
    pub distance: f64,
    /// Root mean square of the difference of heights so far apart over their distance, along x and y.
    pub over_distance: [Option<f64>; 2],
    /// Root mean square second difference of three points so far apart over the square of it, 1/m.
    pub curvature_over_distance: [Option<f64>; 2],
}

/// Sums over the pieces of a surface.
struct Sums {
    bins: Vec<u64>,
    /// Of cells: dx², dx dy, dy².
    tensor: [f64; 3],
}

impl Slopes {
    /// Of `scale`, a filtered `whole`. Of a periodic map without holes the rms are those of its waves in
    /// `power`, exact; of others those of the derivative of seven points and of the Laplacian of five. Mean
    /// and quantiles are those of the piecewise linear surface, in proportion to its rms.
    pub fn new(scale: &Scale, whole: &HeightMap, power: &SlopePower) -> Slopes {
        let (map, parameters) = (&scale.surface.map, &scale.surface.parameters);
        let filtered = (scale.wave > scale.cutoff).then_some(scale.cutoff);
        let exact = whole.periodic() && whole.missing() == 0;
        let [rms, rms_curvature] =
            if exact { power.filtered(filtered) } else { [parameters.sdq, half_laplacian(map)] };
        let linear = parameters.rms_gradient;
        let sums = sums(map, linear);
        let factor = if linear > 0.0 { rms / linear } else { 1.0 };
        let [xx, xy, yy] = sums.tensor;
        let (half, apart) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        let distance = [0, 1].map(|k| ((0.5 * scale.cutoff / whole.pixel()[k]).round() as usize).max(1));
        let lines = [0, 1].map(|axis| differences(whole, axis, distance[axis]));
        Slopes {
            rms,
            mean: factor * parameters.mean_gradient,
            quantiles: QUANTILES.map(|share| factor * linear * quantile(&sums.bins, share)),
            rms_curvature,
            anisotropy: ((half - apart).max(0.0) / (half + apart)).sqrt(),
            steepest_deg: (0.5 * (2.0 * xy).atan2(xx - yy)).to_degrees(),
            distance: distance[0] as f64 * whole.pixel()[0],
            over_distance: lines.map(|line| line[0]),
            curvature_over_distance: lines.map(|line| line[1]),
        }
    }
}

fn sums(map: &HeightMap, rms: f64) -> Sums {
    let inverse_pixel = map.inverse_pixel();
    let per_square = if rms > 0.0 { rms.powi(-2) } else { 0.0 };
    let parts = map.chunks(|rows| {
        let mut sums = Sums { bins: vec![0; BINS], tensor: [0.0; 3] };
        for row in rows {
            map.for_each_cell(row, |z| {
                for square in cells::squared_gradients(&z, inverse_pixel) {
                    sums.bins[bin(square * per_square)] += 1;
                }
                let dx = 0.5 * ((z[1] - z[0]) + (z[2] - z[3])) * inverse_pixel[0];
                let dy = 0.5 * ((z[3] - z[0]) + (z[2] - z[1])) * inverse_pixel[1];
                let products = [dx * dx, dx * dy, dy * dy];
                sums.tensor.iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
            });
        }
        sums
    });
    let mut total = Sums { bins: vec![0; BINS], tensor: [0.0; 3] };
    for part in parts {
        total.tensor.iter_mut().zip(part.tensor).for_each(|(a, b)| *a += b);
        total.bins.iter_mut().zip(&part.bins).for_each(|(a, b)| *a += b);
    }
    total
}

/// Bits of the first bin: the exponent and the first bits of the mantissa of 2^-24.
const FIRST: u64 = (1023 - OCTAVES_BELOW) << BITS;

/// The bin of a squared slope over its mean.
fn bin(square: f64) -> usize {
    let bits = square.to_bits() >> (f64::MANTISSA_DIGITS - 1 - BITS);
    (bits.saturating_sub(FIRST) as usize).min(BINS - 1)
}

/// The slope over its rms that the share `share` lies below.
fn quantile(bins: &[u64], share: f64) -> f64 {
    let wanted = share * bins.iter().sum::<u64>() as f64;
    let mut below = 0.0;
    for (k, count) in bins.iter().map(|count| *count as f64).enumerate() {
        if below + count >= wanted && count > 0.0 {
            let start = |k: usize| f64::from_bits((FIRST + k as u64) << (f64::MANTISSA_DIGITS - 1 - BITS));
            return (start(k) + (wanted - below) / count * (start(k + 1) - start(k))).sqrt();
        }
        below += count;
    }
    0.0
}

/// Root mean square of half the five-point Laplacian, 1/m; 0 where no point has four measured neighbours.
fn half_laplacian(map: &HeightMap) -> f64 {
    let second = [0, 1].map(|axis| squares(map, axis, 1));
    // cross terms of an isotropic surface: <(a + b)²> = 8/3 <a²> where <ab> = <a²>/3
    let [x, y] = second.map(|s| s[1].unwrap_or(0.0));
    (0.25 * (x + y + 2.0 / 3.0 * (x * y).sqrt())).sqrt()
}

/// Root mean squares of first and second differences over `step` pixels along `axis`.
fn differences(map: &HeightMap, axis: usize, step: usize) -> [Option<f64>; 2] {
    squares(map, axis, step).map(|square| square.map(f64::sqrt))
}

/// Mean squares of (h(x + l) - h(x))/l and (h(x + l) - 2h(x) + h(x - l))/l² over `step` pixels along `axis`;
/// None where no points are so far apart.
fn squares(map: &HeightMap, axis: usize, step: usize) -> [Option<f64>; 2] {
    let (nx, ny) = (map.columns(), map.rows());
    let n = [nx, ny][axis];
    if step >= n {
        return [None; 2];
    }
    let length = step as f64 * map.pixel()[axis];
    let stride = (step / ROWS_PER_DISTANCE).max(1);
    let parts = crate::surface::height_map::chunks(ny, |rows| {
        let mut sums = [MeanSquare::default(); 2];
        let mut wide = Vec::new();
        for y in rows.filter(|y| y.is_multiple_of(stride)) {
            let [first, second] = &mut sums;
            if axis == 0 {
                wide.clear();
                wide.extend_from_slice(map.row(y));
                if map.periodic() {
                    wide.extend((0..2 * step).map(|x| map.row(y)[x % n]));
                }
                first.add_two(&wide[..n], &wide[step..]);
                second.add_three(&wide, &wide[step..], wide.get(2 * step..).unwrap_or(&[]));
                continue;
            }
            let row = |y: usize| (map.periodic() || y < n).then(|| map.row(y % n));
            let (own, ahead, second_ahead) = (map.row(y), row(y + step), row(y + 2 * step));
            first.add_two(own, ahead.unwrap_or(&[]));
            second.add_three(own, ahead.unwrap_or(&[]), second_ahead.unwrap_or(&[]));
        }
        sums
    });
    [0, 1].map(|k| {
        let total = parts.iter().fold(MeanSquare::default(), |total, part| total.plus(part[k]));
        total.value().map(|square| square / length.powi(2 + 2 * k as i32))
    })
}

/// A mean square of numbers, of which those that are NaN do not count.
#[derive(Clone, Copy, Debug, Default)]
struct MeanSquare {
    sum: f64,
    count: f64,
}

impl MeanSquare {
    fn add(&mut self, value: f64) {
        let known = !value.is_nan();
        self.sum += if known { value * value } else { 0.0 };
        self.count += f64::from(u8::from(known));
    }

    fn add_two(&mut self, own: &[f64], ahead: &[f64]) {
        own.iter().zip(ahead).for_each(|(own, ahead)| self.add(ahead - own));
    }

    fn add_three(&mut self, behind: &[f64], own: &[f64], ahead: &[f64]) {
        let all = behind.iter().zip(own).zip(ahead);
        all.for_each(|((behind, own), ahead)| self.add(ahead - 2.0 * own + behind));
    }

    fn plus(self, other: MeanSquare) -> MeanSquare {
        MeanSquare { sum: self.sum + other.sum, count: self.count + other.count }
    }

    fn value(self) -> Option<f64> {
        (self.count > 0.0).then(|| self.sum / self.count)
    }
}
