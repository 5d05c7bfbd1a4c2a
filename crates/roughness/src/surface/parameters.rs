//! Roughness parameters of a map.

use crate::surface::cells;
use crate::surface::height_map::{Extent, HeightMap};

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
    /// Highest minus lowest node (ISO 25178-2).
    pub sz: f64,
    /// Root mean square gradient (ISO 25178-2).
    pub sdq: f64,
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
    pub fn of(map: &HeightMap, extent: &Extent) -> Parameters {
        let nodes = (map.heights().len() - map.missing()) as f64;
        let reference = 0.5 * (extent.low + extent.high);
        let above = |part: &[f64]| part.iter().filter(|z| !z.is_nan()).map(|z| z - reference).sum::<f64>();
        let mean = reference + map.parts(above).iter().sum::<f64>() / nodes;
        let [sa, s2, s3, s4] = central_sums(map, mean, extent.high - extent.low).map(|s| s / nodes);
        let range = extent.high - extent.low;
        let (ssk, sku) =
            if s2 > 0.0 { (s3 / (s2 * s2.sqrt()), s4 / (s2 * s2)) } else { (f64::NAN, f64::NAN) };
        let [gradient, gradient_squared, slope_x] = slope_sums(map).map(|s| s / extent.cells as f64);
        Parameters {
            mean,
            sa: sa * range,
            sq: s2.sqrt() * range,
            ssk,
            sku,
            sz: range,
            sdq: gradient_squared.sqrt(),
            mean_gradient: gradient,
            mean_slope_x: slope_x,
        }
    }
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

    #[test]
    fn a_tilted_plane_and_a_sinusoid_have_their_numbers() {
        let plane: Vec<f64> =
            (0..30 * 20).map(|i| 0.3 * (i % 30) as f64 - 0.4 * 2.0 * (i / 30) as f64).collect();
        let map = HeightMap::new(30, 20, [1.0, 2.0], plane).unwrap();
        let r = Parameters::of(&map, &map.extent().unwrap());
        assert!((r.mean_gradient - 0.5).abs() < 1e-13 && (r.sdq - 0.5).abs() < 1e-13);
        assert!((r.mean_slope_x - 0.3).abs() < 1e-13);
        let n = 512;
        let wave = (0..n * 2).map(|i| (std::f64::consts::TAU * (i % n) as f64 / n as f64).sin()).collect();
        let map = HeightMap::new(n, 2, [1.0, 1.0], wave).unwrap().with_periodic(true);
        let r = Parameters::of(&map, &map.extent().unwrap());
        // Sa = 2/π, Sq = 1/√2, Ssk 0, Sku 3/2, mean slope 4 amplitudes per wave
        assert!((r.sa - 2.0 / std::f64::consts::PI).abs() < 1e-4 && (r.sq - 0.5f64.sqrt()).abs() < 1e-12);
        assert!(r.ssk.abs() < 1e-12 && (r.sku - 1.5).abs() < 1e-12 && (r.sz - 2.0).abs() < 1e-4);
        assert!(
            (r.mean_gradient * n as f64 - 4.0).abs() < 1e-9 && (r.mean_slope_x * n as f64 - 4.0).abs() < 1e-9
        );
    }
}
