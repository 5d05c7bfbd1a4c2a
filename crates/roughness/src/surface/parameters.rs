//! Roughness parameters of a map.

use crate::surface::cells;
use crate::surface::height_map::{Extent, HeightMap, chunks};

/// Roughness parameters of a map; heights in metres, slopes pure numbers.
///
/// Height parameters are taken over the nodes about their mean, slopes over the piecewise linear surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Mean height of the nodes, the origin of the separation.
    pub mean: f64,
    /// Arithmetic mean height (ISO 25178-2).
    pub sa: f64,
    /// Root mean square height (ISO 25178-2).
    pub sq: f64,
    /// Skewness (ISO 25178-2).
    pub ssk: f64,
    /// Kurtosis (ISO 25178-2).
    pub sku: f64,
    /// Highest node above the mean (ISO 25178-2).
    pub sp: f64,
    /// Mean above the lowest node (ISO 25178-2).
    pub sv: f64,
    /// Highest minus lowest node (ISO 25178-2).
    pub sz: f64,
    /// Root mean square gradient, by the derivative of seven points (ISO 25178-2); that of the piecewise
    /// linear surface where no node has three measured neighbours on each side along both axes.
    pub sdq: f64,
    /// Developed over projected area, less 1, by the same derivative (ISO 25178-2).
    pub sdr: f64,
    /// Root mean square of |∇h| over the piecewise linear surface.
    pub rms_gradient: f64,
    /// Mean of |∇h|: tan β of the map.
    pub mean_gradient: f64,
    /// Mean of |dz/dx|: the slope a profile along x shows (0.64 of `mean_gradient` for an isotropic surface).
    pub mean_slope_x: f64,
}

impl Parameters {
    /// The mean slope β = atan(mean |∇h|), in degrees.
    pub fn beta_deg(&self) -> f64 {
        self.mean_gradient.atan().to_degrees()
    }

    /// The numbers of `map`; `extent` is its own.
    pub fn measure(map: &HeightMap, extent: &Extent) -> Parameters {
        let (mean, [sa, s2, s3, s4]) = moments(map, extent);
        let range = extent.high - extent.low;
        let (ssk, sku) =
            if s2 > 0.0 { (s3 / (s2 * s2.sqrt()), s4 / (s2 * s2)) } else { (f64::NAN, f64::NAN) };
        let [gradient, gradient_squared, slope_x] = slope_sums(map).map(|s| s / extent.cells as f64);
        let [squared, developed] =
            seven_points(map).unwrap_or([gradient_squared, linear_developed(map, extent)]);
        Parameters {
            mean,
            sa: sa * range,
            sq: s2.sqrt() * range,
            ssk,
            sku,
            sp: extent.high - mean,
            sv: mean - extent.low,
            sz: range,
            sdq: squared.sqrt(),
            sdr: developed,
            rms_gradient: gradient_squared.sqrt(),
            mean_gradient: gradient,
            mean_slope_x: slope_x,
        }
    }
}

/// Arithmetic mean height of `map` over its mean |∇h|, whose `extent` is its own, in metres.
pub(crate) fn height_over_slope(map: &HeightMap, extent: &Extent) -> f64 {
    let (_, [sa, ..]) = moments(map, extent);
    let [gradient, ..] = slope_sums(map).map(|s| s / extent.cells as f64);
    sa * (extent.high - extent.low) / gradient
}

/// Mean height of the nodes, and the means of |u|, u², u³, u⁴ with u = (z - mean)/range.
fn moments(map: &HeightMap, extent: &Extent) -> (f64, [f64; 4]) {
    let nodes = (map.heights().len() - map.missing()) as f64;
    let reference = 0.5 * (extent.low + extent.high);
    let above = |part: &[f64]| part.iter().filter(|z| !z.is_nan()).map(|z| z - reference).sum::<f64>();
    let mean = reference + map.parts(above).iter().sum::<f64>() / nodes;
    (mean, central_sums(map, mean, extent.high - extent.low).map(|s| s / nodes))
}

/// Σ|u|, Σu², Σu³, Σu⁴ with u = (z - mean)/range.
fn central_sums(map: &HeightMap, mean: f64, range: f64) -> [f64; 4] {
    let scale = if range > 0.0 { 1.0 / range } else { 0.0 };
    total(&map.parts(|part| {
        let mut s = [0.0; 4];
        for z in part.iter().filter(|z| !z.is_nan()) {
            let u = (z - mean) * scale;
            let u2 = u * u;
            s[0] += u.abs();
            s[1] += u2;
            s[2] += u2 * u;
            s[3] += u2 * u2;
        }
        s
    }))
}

/// Σ|∇h|, Σ|∇h|², Σ|dz/dx| over the cells (means of their four triangles).
fn slope_sums(map: &HeightMap) -> [f64; 3] {
    let inverse_pixel = map.inverse_pixel();
    total(&map.chunks(|rows| {
        let mut s = [0.0; 3];
        for row in rows {
            map.for_each_cell(row, |z| {
                let g = cells::gradients(&z, inverse_pixel);
                s[0] += 0.25 * ((g[0] + g[1]) + (g[2] + g[3]));
                s[1] += 0.25 * ((g[0] * g[0] + g[1] * g[1]) + (g[2] * g[2] + g[3] * g[3]));
                let (low, high) = (z[1] - z[0], z[2] - z[3]);
                // the triangles on the left and right have the mean of the two
                s[2] += 0.25 * ((low.abs() + high.abs()) + (low + high).abs()) * inverse_pixel[0];
            });
        }
        s
    }))
}

/// √(1 + g²) - 1 without cancellation.
fn developed(squared: f64) -> f64 {
    squared / (1.0 + (1.0 + squared).sqrt())
}

/// Mean of √(1 + |∇h|²) - 1 over the piecewise linear surface.
fn linear_developed(map: &HeightMap, extent: &Extent) -> f64 {
    let inverse_pixel = map.inverse_pixel();
    let [sum] = total(&map.chunks(|rows| {
        let mut sum = 0.0;
        for row in rows {
            map.for_each_cell(row, |z| {
                sum +=
                    0.25 * cells::gradients(&z, inverse_pixel).map(|g| developed(g * g)).iter().sum::<f64>();
            });
        }
        [sum]
    }));
    sum / extent.cells as f64
}

/// Weights of the nodes 1, 2 and 3 away in a derivative, times 60 (ISO 25178-2).
const SEVEN_POINT_WEIGHTS: [f64; 3] = [45.0, -9.0, 1.0];

/// 60 times the derivative along a line, per pixel; the nodes near the ends of one that is not periodic keep
/// what they had.
fn slopes_of_seven(line: &[f64], periodic: bool, slopes: &mut [f64]) {
    let reach = SEVEN_POINT_WEIGHTS.len();
    let n = line.len();
    let inner = slopes[reach..n - reach].iter_mut().zip(line.windows(2 * reach + 1));
    inner.for_each(|(slope, z)| {
        *slope = SEVEN_POINT_WEIGHTS[0] * (z[4] - z[2])
            + SEVEN_POINT_WEIGHTS[1] * (z[5] - z[1])
            + SEVEN_POINT_WEIGHTS[2] * (z[6] - z[0]);
    });
    if periodic {
        for i in (0..reach).chain(n - reach..n) {
            let sides = (1..)
                .zip(SEVEN_POINT_WEIGHTS)
                .map(|(k, weight)| weight * (line[(i + k) % n] - line[(i + n - k) % n]));
            slopes[i] = sides.sum();
        }
    }
}

/// Means of |∇h|² and of √(1 + |∇h|²) - 1 over the nodes with three measured neighbours on each side along
/// both axes; `None` where there is no such node.
fn seven_points(map: &HeightMap) -> Option<[f64; 2]> {
    let (columns, rows) = (map.columns(), map.rows());
    let reach = SEVEN_POINT_WEIGHTS.len();
    // beyond the edges of a periodic map its other side; elsewhere a border is left out
    let border = if map.periodic() { 0 } else { reach };
    if columns <= 2 * reach || rows <= 2 * reach {
        return None;
    }
    let [along_x, along_y] = map.inverse_pixel().map(|p| p / 60.0);
    let whole = map.missing() == 0;
    let lines = chunks(rows - 2 * border, |part| {
        let (mut sum, mut x, mut y) = ([0.0; 3], vec![0.0; columns], vec![0.0; columns]);
        for row in part {
            let row = row + border;
            slopes_of_seven(map.row(row), map.periodic(), &mut x);
            let beside = |step: i64| map.row((row as i64 + step).rem_euclid(rows as i64) as usize);
            y.fill(0.0);
            for (k, weight) in (1..).zip(SEVEN_POINT_WEIGHTS) {
                let sides = beside(k).iter().zip(beside(-k));
                y.iter_mut().zip(sides).for_each(|(y, (a, b))| *y += weight * (a - b));
            }
            let nodes = x.iter_mut().zip(&y).skip(border).take(columns - 2 * border);
            nodes.for_each(|(x, y)| *x = (*x * along_x).powi(2) + (y * along_y).powi(2));
            let inner = &mut x[border..columns - border];
            if !whole {
                // a node that lacks a neighbour adds nothing
                sum[0] -= inner.iter().filter(|squared| squared.is_nan()).count() as f64;
                inner.iter_mut().filter(|squared| squared.is_nan()).for_each(|squared| *squared = 0.0);
            }
            sum[0] += inner.len() as f64;
            sum[1] += inner.iter().sum::<f64>();
            inner.iter_mut().for_each(|squared| *squared = developed(*squared));
            sum[2] += inner.iter().sum::<f64>();
        }
        sum
    });
    let [nodes, squared, developed] = total(&lines);
    (nodes > 0.0).then(|| [squared / nodes, developed / nodes])
}

fn total<const N: usize>(parts: &[[f64; N]]) -> [f64; N] {
    let mut sum = [0.0; N];
    for part in parts {
        sum.iter_mut().zip(part).for_each(|(a, b)| *a += b);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ISO 25178-2, by its formula written out at each node.
    #[test]
    fn the_derivative_is_that_of_seven_points() {
        let (nx, ny) = (23, 19);
        let z: Vec<f64> = (0..nx * ny).map(|i| ((i * i % 97) as f64).sin()).collect();
        for (periodic, holes) in [(false, false), (true, false), (false, true)] {
            let mut z = z.clone();
            if holes {
                z[9 * nx + 11] = f64::NAN;
            }
            let map = HeightMap::new(nx, ny, [0.5, 2.0], z.clone()).unwrap().with_periodic(periodic);
            let (mut squared, mut developed, mut n) = (0.0, 0.0, 0.0);
            for i in 0..nx * ny {
                let at = |dx: i64, dy: i64| {
                    let [x, y] = [(i % nx) as i64 + dx, (i / nx) as i64 + dy];
                    let inside = (0..nx as i64).contains(&x) && (0..ny as i64).contains(&y);
                    let [x, y] = [x.rem_euclid(nx as i64), y.rem_euclid(ny as i64)];
                    if inside || periodic { z[y as usize * nx + x as usize] } else { f64::NAN }
                };
                let slope = |f: &dyn Fn(i64) -> f64| {
                    (f(3) - 9.0 * f(2) + 45.0 * f(1) - 45.0 * f(-1) + 9.0 * f(-2) - f(-3)) / 60.0
                };
                let [x, y] = [slope(&|k| at(k, 0)) / 0.5, slope(&|k| at(0, k)) / 2.0];
                let g: f64 = x * x + y * y;
                if !g.is_nan() {
                    (squared, developed, n) = (squared + g, developed + (1.0 + g).sqrt() - 1.0, n + 1.0);
                }
            }
            let r = Parameters::measure(&map, &map.extent().unwrap());
            assert!((r.sdq - (squared / n).sqrt()).abs() < 1e-12, "{periodic} {holes}");
            assert!((r.sdr - developed / n).abs() < 1e-12 && r.rms_gradient != r.sdq);
        }
        let small = HeightMap::new(6, 9, [1.0, 1.0], z[..54].to_vec()).unwrap();
        let r = Parameters::measure(&small, &small.extent().unwrap());
        assert!(r.sdq == r.rms_gradient && r.sdr > 0.0);
    }

    #[test]
    fn a_tilted_plane_and_a_sinusoid_have_their_numbers() {
        let plane: Vec<f64> =
            (0..30 * 20).map(|i| 0.3 * (i % 30) as f64 - 0.4 * 2.0 * (i / 30) as f64).collect();
        let map = HeightMap::new(30, 20, [1.0, 2.0], plane).unwrap();
        let r = Parameters::measure(&map, &map.extent().unwrap());
        assert!((r.mean_gradient - 0.5).abs() < 1e-13 && (r.sdq - 0.5).abs() < 1e-13);
        assert!((r.sdr - (1.25f64.sqrt() - 1.0)).abs() < 1e-13 && (r.sp + r.sv - r.sz).abs() < 1e-13);
        assert!((r.mean_slope_x - 0.3).abs() < 1e-13);
        let n = 512;
        let wave = (0..n * 2).map(|i| (std::f64::consts::TAU * (i % n) as f64 / n as f64).sin()).collect();
        let map = HeightMap::new(n, 2, [1.0, 1.0], wave).unwrap().with_periodic(true);
        let r = Parameters::measure(&map, &map.extent().unwrap());
        // Sa = 2/π, Sq = 1/√2, Ssk 0, Sku 3/2, mean slope 4 amplitudes per wave
        assert!((r.sa - 2.0 / std::f64::consts::PI).abs() < 1e-4 && (r.sq - 0.5f64.sqrt()).abs() < 1e-12);
        assert!(r.ssk.abs() < 1e-12 && (r.sku - 1.5).abs() < 1e-12 && (r.sz - 2.0).abs() < 1e-4);
        assert!(
            (r.mean_gradient * n as f64 - 4.0).abs() < 1e-9 && (r.mean_slope_x * n as f64 - 4.0).abs() < 1e-9
        );
    }
}
