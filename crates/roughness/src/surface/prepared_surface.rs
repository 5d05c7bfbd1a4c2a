//! A surface ready to be pressed.

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
    /// Interpretation of its file, and remarks on it.
    pub notes: Vec<String>,
    /// Extent of the map.
    pub extent: Extent,
    /// Roughness parameters of the map.
    pub parameters: Parameters,
}

/// A line that says by `notes` what was understood of a file; empty where there was none.
pub fn read_as(notes: &[String]) -> String {
    if notes.is_empty() { String::new() } else { format!("read as {}\n", notes.join("; ")) }
}

impl Surface {
    /// The surface of `map` as it is.
    ///
    /// # Errors
    /// A map without a cell of four measured corners.
    pub fn from_map(map: HeightMap) -> Result<Surface, MapError> {
        let extent = map.extent()?;
        let parameters = Parameters::measure(&map, &extent);
        Ok(Surface { missing: map.missing(), outliers: 0, notes: Vec::new(), map, extent, parameters })
    }

    /// Nominal area, in m²: that of the cells with four measured corners.
    pub fn nominal_area(&self) -> f64 {
        self.extent.cells as f64 * self.map.cell_area()
    }

    /// Share of the measured points above `planes` ≥ 2 heights from the highest to the lowest: the areal
    /// material ratio of ISO 25178-2. Heights are above the mean, in metres; a flat map has none.
    pub fn material_ratio(&self, planes: usize) -> Vec<[f64; 2]> {
        let (low, last) = (self.extent.low, planes.max(2) - 1);
        let step = (self.extent.high - low) / last as f64;
        if step.is_nan() || step <= 0.0 {
            return Vec::new();
        }
        // bin k: above plane k - 1, not above plane k
        let parts = self.map.parts(|part| {
            let mut counts = vec![0usize; last + 1];
            for z in part.iter().filter(|z| !z.is_nan()) {
                let place = (z - low) / step;
                let below = place as usize;
                counts[(below + usize::from((below as f64) < place)).min(last)] += 1;
            }
            counts
        });
        let points = (self.map.heights().len() - self.map.missing()) as f64;
        let mut above = 0;
        let plane = |k: usize| {
            let found = [low + k as f64 * step - self.parameters.mean, above as f64 / points];
            above += parts.iter().map(|counts| counts[k]).sum::<usize>();
            found
        };
        (0..=last).rev().map(plane).collect()
    }

    /// Root mean square step across the seam of a periodic map over that between neighbours: far above 1
    /// where the map is no period of a surface. None of a map that is not periodic, or flat.
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
    fn the_material_ratio_of_a_ramp_is_a_line() {
        let z = (0..101 * 3).map(|i| (i % 101) as f64).collect();
        let ramp = Surface::from_map(HeightMap::new(101, 3, [1.0, 1.0], z).unwrap()).unwrap();
        let found = ramp.material_ratio(11);
        for (k, [height, share]) in found.iter().enumerate() {
            assert!((height - (50.0 - 10.0 * k as f64)).abs() < 1e-12);
            assert!((share - 10.0 * k as f64 / 101.0).abs() < 1e-12, "{found:?}");
        }
        let flat = Surface::from_map(HeightMap::new(3, 3, [1.0, 1.0], vec![1.0; 9]).unwrap()).unwrap();
        assert!(flat.material_ratio(11).is_empty());
    }

    #[test]
    fn a_ramp_has_a_seam_and_a_wave_has_none() {
        let n = 32;
        let map = |z: fn(usize) -> f64| {
            let heights = (0..n * n).map(|i| z(i % n) + z(i / n)).collect();
            Surface::from_map(HeightMap::new(n, n, [1.0, 1.0], heights).unwrap().with_periodic(true)).unwrap()
        };
        let wave = map(|i| (std::f64::consts::TAU * i as f64 / 32.0).sin());
        assert!(wave.seam().unwrap() < 1.5 && map(|i| i as f64).seam().unwrap() > 30.0);
        assert_eq!(Surface::from_map(wave.map.with_periodic(false)).unwrap().seam(), None);
    }
}
