//! A surface ready to be pressed.

use crate::contact::bearing_area::{self, Above, Planes};
use crate::surface::height_map::{Extent, HeightMap, MapError};
use crate::surface::parameters::Parameters;

/// A surface ready to be pressed: its levelled, filtered map with the numbers that the contact needs.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The map.
    pub map: HeightMap,
    /// Points that were not measured, before any were filled.
    pub missing: usize,
    /// Points that were taken away because they stood out, before any were filled.
    pub outliers: usize,
    /// Extent of the map.
    pub extent: Extent,
    /// Roughness parameters of the map.
    pub parameters: Parameters,
}

impl Surface {
    /// The surface of `map` as it is.
    ///
    /// # Errors
    /// A map without a cell of four measured corners.
    pub fn of(map: HeightMap) -> Result<Surface, MapError> {
        let extent = map.extent()?;
        let parameters = Parameters::of(&map, &extent);
        Ok(Surface { missing: map.missing(), outliers: 0, map, extent, parameters })
    }

    /// Nominal area, in m²: that of the cells with four measured corners.
    pub fn nominal_area(&self) -> f64 {
        self.extent.cells as f64 * self.map.cell_area()
    }

    /// Share of the surface above `points` ≥ 2 heights from the highest to the lowest: the areal material ratio of ISO 25178-2.
    /// Heights are above the mean, in metres.
    pub fn material_ratio(&self, points: usize) -> Vec<[f64; 2]> {
        let planes = Planes::between(self.extent.low, self.extent.high, points.max(2));
        if planes.step <= 0.0 {
            return Vec::new();
        }
        let above = bearing_area::above_planes(&self.map, planes);
        let cells = self.extent.cells as f64;
        let point =
            |(k, above): (usize, &Above)| [planes.height(k) - self.parameters.mean, above.area / cells];
        above.iter().enumerate().map(point).rev().collect()
    }

    /// Root mean square step across the seam of a periodic map over that between neighbours: far above 1 where the map is no
    /// period of a surface. None of a map that is not periodic, or flat.
    pub fn seam(&self) -> Option<f64> {
        let map = &self.map;
        let (nx, ny) = (map.columns(), map.rows());
        if !map.periodic() || nx < 3 || ny < 3 {
            return None;
        }
        let z = |x: usize, y: usize| map.heights()[y * nx + x];
        let mean = |steps: &mut dyn Iterator<Item = f64>| {
            let (sum, n) =
                steps.filter(|s| s.is_finite()).fold((0.0, 0.0), |(sum, n), s| (sum + s * s, n + 1.0));
            sum / n
        };
        let ratio = |seam: f64, inner: f64| if inner > 0.0 { (seam / inner).sqrt() } else { f64::NAN };
        let along_x = ratio(
            mean(&mut (0..ny).map(|y| z(0, y) - z(nx - 1, y))),
            mean(&mut (0..ny).flat_map(|y| (1..nx).map(move |x| (x, y))).map(|(x, y)| z(x, y) - z(x - 1, y))),
        );
        let along_y = ratio(
            mean(&mut (0..nx).map(|x| z(x, 0) - z(x, ny - 1))),
            mean(&mut (0..nx).flat_map(|x| (1..ny).map(move |y| (x, y))).map(|(x, y)| z(x, y) - z(x, y - 1))),
        );
        Some(along_x.max(along_y)).filter(|ratio| ratio.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_has_a_seam_and_a_wave_has_none() {
        let n = 32;
        let map = |z: fn(usize) -> f64| {
            let heights = (0..n * n).map(|i| z(i % n) + z(i / n)).collect();
            Surface::of(HeightMap::new(n, n, [1.0, 1.0], heights).unwrap().with_periodic(true)).unwrap()
        };
        let wave = map(|i| (std::f64::consts::TAU * i as f64 / 32.0).sin());
        assert!(wave.seam().unwrap() < 1.5 && map(|i| i as f64).seam().unwrap() > 30.0);
        assert_eq!(Surface::of(wave.map.with_periodic(false)).unwrap().seam(), None);
    }
}
