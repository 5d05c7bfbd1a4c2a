//! Contact area from pixels.

use crate::HeightMap;
use crate::surface::height_map::chunks;
use std::f64::consts::{LN_2, PI};

/// Part of a pixel by which each pixel edge on the rim of the contact makes its area too large (Yastrebov,
/// Anciaux and Molinari 2017, Tribology International 114, 161-171).
const RIM: f64 = (PI - 1.0 + LN_2) / 24.0;

/// Contact area over the area of the pixels used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Area {
    /// Pixels under pressure.
    pub ratio: f64,
    /// The same less what the rim of the contact adds, but no less than carries the load at the limit of
    /// pressure.
    pub corrected: f64,
    /// The uncertain part of the corrected ratio: the size of the correction.
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
        let edges = edges(map, pressures);
        let n = pixels as f64;
        let ratio = touching as f64 / n;
        // the rule of the rim is for pressures that fall to nothing there; at the limit they end as they are
        let corrected = (ratio - RIM * edges as f64 / n).max(least).min(ratio);
        Area { ratio, corrected, error: ratio - corrected, edges }
    }
}

/// Pixel edges with contact on one side.
fn edges(map: &HeightMap, pressures: &[f32]) -> usize {
    let (nx, ny) = (map.columns(), map.rows());
    let loaded = |x: usize, y: usize| pressures[y * nx + x] > 0.0;
    let across = |x: usize, y: usize| {
        let right = if x + 1 < nx { Some(loaded(x + 1, y)) } else { map.periodic().then(|| loaded(0, y)) };
        let above = if y + 1 < ny { Some(loaded(x, y + 1)) } else { map.periodic().then(|| loaded(x, 0)) };
        let here = loaded(x, y);
        usize::from(right.is_some_and(|r| r != here)) + usize::from(above.is_some_and(|a| a != here))
    };
    let parts = chunks(ny, |rows| rows.map(|y| (0..nx).map(|x| across(x, y)).sum::<usize>()).sum::<usize>());
    parts.iter().sum()
}

/// Patches of pixels under pressure, joined over sides and corners, and over the edges of a periodic map.
pub fn patches(map: &HeightMap, pressures: &[f32]) -> usize {
    let (nx, ny) = (map.columns(), map.rows());
    let mut seen = vec![false; pressures.len()];
    let mut stack = Vec::new();
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
        stack.push(first);
        while let Some(i) = stack.pop() {
            for (dx, dy) in (0..9).map(|k| (k % 3, k / 3)) {
                if let (Some(x), Some(y)) = (beside(i % nx, nx, dx), beside(i / nx, ny, dy)) {
                    let j = y * nx + x;
                    if !seen[j] && pressures[j] > 0.0 {
                        seen[j] = true;
                        stack.push(j);
                    }
                }
            }
        }
    }
    count
}
