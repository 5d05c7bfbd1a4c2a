//! Contact area from pixels.

use super::rim::Rim;
use crate::HeightMap;
use std::f64::consts::{LN_2, PI};

/// Part of a pixel by which each pixel edge on the rim of the contact makes its area too large (Yastrebov,
/// Anciaux and Molinari 2017, Tribology International 114, 161-171).
const RIM: f64 = (PI - 1.0 + LN_2) / 24.0;
/// Share of that correction that is uncertain: it is the mean over rims that run all ways. Of 140 contacts of
/// band-limited maps against the same refined eight times, the areas differ by -0.26 to 0.21 of it.
const RIM_DOUBT: f64 = 0.25;
/// The same where a rim runs straight across the map: along the grid the area is too large by 0.20 of a
/// pixel an edge, the mean over its places between two lines, and by 0.11 to 0.15 in other directions.
const STRAIGHT_RIM_DOUBT: f64 = 0.7;
/// Standard deviations of a bound.
const DEVIATIONS: f64 = 2.0;

/// Contact area over the area of the pixels used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Area {
    /// Pixels under pressure.
    pub ratio: f64,
    /// The same less what the rim of the contact adds, but no less than carries the load at the limit of
    /// pressure.
    pub corrected: f64,
    /// 95 % bound of the error of the corrected ratio that pixels make: a quarter of the correction, and the
    /// places that straight pieces of the rim may take between the lines of the grid.
    pub error: f64,
    /// Pixel edges between contact and none.
    pub edges: usize,
}

impl Area {
    /// Of `touching` pixels under pressure of `pixels` used, of which the share `least` carries the load with
    /// all of them at the limit of pressure.
    pub(super) fn from_pixels(
        map: &HeightMap,
        pressures: &[f32],
        [touching, pixels]: [usize; 2],
        least: f64,
    ) -> Area {
        let rim = Rim::new(map, pressures);
        let (edges, n) = (rim.edges(), pixels as f64);
        let correction = RIM * edges as f64 * Rim::hidden(map, pressures);
        let ratio = touching as f64 / n;
        // the rule of the rim is for pressures that fall to nothing there; at the limit they end as they are
        let corrected = (ratio - correction / n).max(least).min(ratio);
        let doubt = rim.doubt();
        let straight = (STRAIGHT_RIM_DOUBT - RIM_DOUBT) * RIM * doubt.crossing as f64;
        let error = (RIM_DOUBT * correction + straight + DEVIATIONS * doubt.variance.sqrt()) / n;
        Area { ratio, corrected, error, edges }
    }
}

/// Patches of pixels under pressure, joined over sides and corners, and over the edges of a periodic map:
/// their number.
pub fn patches(map: &HeightMap, pressures: &[f32]) -> usize {
    each_patch(map, pressures, |_| {})
}

/// Calls `visit` with the pixels of each patch; their number.
pub(crate) fn each_patch(map: &HeightMap, pressures: &[f32], mut visit: impl FnMut(&[usize])) -> usize {
    let (nx, ny) = (map.columns(), map.rows());
    let mut seen = vec![false; pressures.len()];
    let mut patch = Vec::new();
    let mut count = 0;
    // the neighbour of `at` by `step`, where there is one
    let beside = |at: usize, n: usize, step: usize| match (at + step).checked_sub(1) {
        Some(next) if next < n => Some(next),
        Some(_) => map.periodic().then_some(0),
        None => map.periodic().then(|| n - 1),
    };
    for first in 0..pressures.len() {
        if seen[first] || pressures[first] <= 0.0 {
            continue;
        }
        count += 1;
        seen[first] = true;
        patch.clear();
        patch.push(first);
        let mut done = 0;
        while let Some(&i) = patch.get(done) {
            done += 1;
            for (dx, dy) in (0..9).map(|k| (k % 3, k / 3)) {
                if let (Some(x), Some(y)) = (beside(i % nx, nx, dx), beside(i / nx, ny, dy)) {
                    let j = y * nx + x;
                    if !seen[j] && pressures[j] > 0.0 {
                        seen[j] = true;
                        patch.push(j);
                    }
                }
            }
        }
        visit(&patch);
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A round contact of which three tenths of the points were not measured: the rim of the holes is no rim
    /// of the contact, whose corrected share of what was measured is that of the whole map. A tenth of the
    /// correction is left to chance: 37 of 75 edges are seen.
    #[test]
    fn holes_have_no_rim() {
        let n = 96_usize;
        let inside = |i: usize| (i % n) as f64 - 47.3;
        let touches = |i: usize| inside(i).hypot((i / n) as f64 - 48.1) < 30.0;
        let area = |holes: bool| {
            let missing = |i: usize| holes && (i.wrapping_mul(2_654_435_761) >> 7) % 10 < 3;
            let heights = (0..n * n).map(|i| if missing(i) { f64::NAN } else { 1e-6 }).collect();
            let map = HeightMap::new(n, n, [1e-6; 2], heights).unwrap();
            let pressed = |i: usize| touches(i) && !missing(i);
            let pressures: Vec<f32> = (0..n * n).map(|i| f32::from(u8::from(pressed(i)))).collect();
            let touching = (0..n * n).filter(|i| pressed(*i)).count();
            Area::from_pixels(&map, &pressures, [touching, n * n - map.missing()], 0.0)
        };
        let [whole, holed] = [false, true].map(area);
        let correction = |area: &Area| 1.0 - area.corrected / area.ratio;
        assert!((correction(&holed) / correction(&whole) - 1.0).abs() < 0.1, "{holed:?} {whole:?}");
        assert!((PI * 900.0 / (n * n) as f64 / whole.ratio - 1.0).abs() < 0.01);
    }

    /// Three pixels in a row have twelve sides, of which one at the side of the map is none; towards a point
    /// that was not measured one less is seen.
    #[test]
    fn sides_towards_holes_are_counted() {
        let hidden = |periodic: bool, hole: usize| {
            let mut heights = vec![1e-6; 5 * 4];
            heights[hole] = f64::NAN;
            let map = HeightMap::new(5, 4, [1e-6; 2], heights).unwrap().with_periodic(periodic);
            let pressures: Vec<f32> = (0..20).map(|i| f32::from(u8::from((10..13).contains(&i)))).collect();
            Rim::hidden(&map, &pressures)
        };
        for hole in [5, 6, 7, 13, 15, 16, 17] {
            assert_eq!(hidden(false, hole), 11.0 / 10.0, "{hole}");
            assert_eq!(hidden(true, hole), 12.0 / 11.0, "{hole}");
        }
        assert_eq!((hidden(false, 14), hidden(true, 14)), (1.0, 12.0 / 11.0));
        assert_eq!((hidden(false, 18), hidden(true, 9)), (1.0, 1.0));
    }

    /// Against the definition, on random maps: two pixels under pressure are of one patch if a chain of
    /// touching neighbours joins them, over sides, corners and the edges of a periodic map.
    #[test]
    fn patches_are_what_chains_of_neighbours_join() {
        let mut state = 3_u32;
        let mut drawn = |n: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 16) % n
        };
        for _ in 0..200 {
            let (nx, ny, periodic) = (1 + drawn(7) as usize, 1 + drawn(7) as usize, drawn(2) == 0);
            let map = HeightMap::new(nx, ny, [1e-6; 2], vec![0.0; nx * ny]).unwrap().with_periodic(periodic);
            let pressures: Vec<f32> = (0..nx * ny).map(|_| f32::from(u8::from(drawn(3) == 0))).collect();
            let apart = |a: usize, b: usize, n: usize| {
                let d = a.abs_diff(b);
                if periodic { d.min(n - d) } else { d }
            };
            let joined =
                |i: usize, j: usize| apart(i % nx, j % nx, nx) <= 1 && apart(i / nx, j / nx, ny) <= 1;
            let mut label: Vec<usize> = (0..nx * ny).collect();
            for _ in 0..nx * ny {
                for i in (0..nx * ny).filter(|i| pressures[*i] > 0.0) {
                    for j in (0..nx * ny).filter(|j| pressures[*j] > 0.0 && joined(i, *j)) {
                        label[i] = label[i].min(label[j]);
                    }
                }
            }
            let mut sizes = vec![0; nx * ny];
            (0..nx * ny).filter(|i| pressures[*i] > 0.0).for_each(|i| sizes[label[i]] += 1);
            let mut wanted: Vec<usize> = sizes.into_iter().filter(|size| *size > 0).collect();
            let mut found = Vec::new();
            let count = each_patch(&map, &pressures, |patch| found.push(patch.len()));
            assert_eq!(
                (count, patches(&map, &pressures)),
                (wanted.len(), wanted.len()),
                "{map:?} {pressures:?}"
            );
            wanted.sort_unstable();
            found.sort_unstable();
            assert_eq!(found, wanted, "{pressures:?}");
        }
    }
}
