//! Slopes and curvatures at one scale.

use super::cutoffs::Scale;
use super::slope_power::SlopePower;
use crate::HeightMap;
use crate::surface::cells;

/// Shares of the surface that are less steep than the quantiles of [`Slopes`].
pub const QUANTILES: [f64; 5] = [0.01, 0.1, 0.5, 0.9, 0.99];
/// Bins of the distribution: to an octave, and the octaves below the rms slope.
const PER_OCTAVE: f64 = 32.0;
const OCTAVES_BELOW: f64 = 12.0;
const BINS: usize = 640;
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
    bins: Vec<f64>,
    /// Pieces, |∇h|.
    moments: [f64; 2],
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
            mean: factor * sums.moments[1] / sums.moments[0],
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
    let parts = map.chunks(|rows| {
        let mut sums = Sums { bins: vec![0.0; BINS], moments: [0.0; 2], tensor: [0.0; 3] };
        for row in rows {
            map.for_each_cell(row, |z| {
                for g in cells::gradients(&z, inverse_pixel) {
                    let bin = ((g / rms).log2() + OCTAVES_BELOW) * PER_OCTAVE;
                    sums.bins[(bin.max(0.0) as usize).min(BINS - 1)] += 1.0;
                    sums.moments[0] += 1.0;
                    sums.moments[1] += g;
                }
                let dx = 0.5 * ((z[1] - z[0]) + (z[2] - z[3])) * inverse_pixel[0];
                let dy = 0.5 * ((z[3] - z[0]) + (z[2] - z[1])) * inverse_pixel[1];
                let products = [dx * dx, dx * dy, dy * dy];
                sums.tensor.iter_mut().zip(products).for_each(|(sum, product)| *sum += product);
            });
        }
        sums
    });
    let mut total = Sums { bins: vec![0.0; BINS], moments: [0.0; 2], tensor: [0.0; 3] };
    for part in parts {
        total.moments.iter_mut().zip(part.moments).for_each(|(a, b)| *a += b);
        total.tensor.iter_mut().zip(part.tensor).for_each(|(a, b)| *a += b);
        total.bins.iter_mut().zip(&part.bins).for_each(|(a, b)| *a += b);
    }
    total
}

/// The slope over its rms that the share `share` lies below.
fn quantile(bins: &[f64], share: f64) -> f64 {
    let wanted = share * bins.iter().sum::<f64>();
    let mut below = 0.0;
    for (k, count) in bins.iter().enumerate() {
        if below + count >= wanted && *count > 0.0 {
            let bin = k as f64 + (wanted - below) / count;
            return 2f64.powf(bin / PER_OCTAVE - OCTAVES_BELOW);
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
        let mut sums = [[0.0; 2]; 2];
        let mut add = |k: usize, value: f64| {
            if !value.is_nan() {
                sums[k] = [sums[k][0] + value * value, sums[k][1] + 1.0];
            }
        };
        for y in rows.filter(|y| y.is_multiple_of(stride)) {
            for x in 0..nx {
                let here = [x, y][axis];
                let shifted = |by: usize| {
                    let to = here + by;
                    let to = if to < n { to } else { to - n };
                    if axis == 0 { map.row(y)[to] } else { map.row(to)[x] }
                };
                let (own, ahead, behind) = (map.row(y)[x], here + step < n, here >= step);
                if map.periodic() || ahead {
                    add(0, (shifted(step) - own) / length);
                }
                if map.periodic() || (ahead && behind) {
                    add(1, (shifted(step) - 2.0 * own + shifted(n - step)) / (length * length));
                }
            }
        }
        sums
    });
    [0, 1].map(|k| {
        let [sum, count] = parts.iter().fold([0.0; 2], |s, p| [s[0] + p[k][0], s[1] + p[k][1]]);
        (count > 0.0).then(|| sum / count)
    })
}
