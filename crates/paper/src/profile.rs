//! `profile.csv`: a line across a rough surface, and the cones that stand for its islands.

use asperity::roughness::{HeightMap, Islands};
use asperity::units::MICROMETRE;
use serde::{Deserialize, Serialize};
use std::f64::consts::PI;

/// A point of the line.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ProfilePoint {
    /// `surface` or `cones`.
    pub what: String,
    /// Along the line.
    pub x_um: f64,
    /// Height.
    pub z_um: f64,
}

/// The row of the map with the largest summit: its heights, the plane, and the cones that stand for the
/// islands on it.
pub fn profile(map: &HeightMap, islands: &Islands) -> Vec<ProfilePoint> {
    let [width, height] = map.pixel();
    let most = |row: usize| map.row(row).iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let top = (0..map.rows()).max_by(|a, b| most(*a).total_cmp(&most(*b))).unwrap_or(0);
    let y = top as f64 * height;
    let point = |what: &str, x: f64, z: f64| ProfilePoint {
        what: what.into(),
        x_um: x / MICROMETRE,
        z_um: z / MICROMETRE,
    };
    let heights = map.row(top).iter().enumerate().filter(|(_, z)| z.is_finite());
    let mut points: Vec<_> = heights.map(|(column, z)| point("surface", column as f64 * width, *z)).collect();
    let end = map.columns().saturating_sub(1) as f64 * width;
    let d = islands.plane;
    points.push(point("cones", 0.0, d));
    let cone = |island: &asperity::roughness::Island| {
        let radius = (island.area / PI).sqrt();
        let centre = island.ellipse?.centre;
        // the chord of the cone's base on this row
        let aside = (centre[1] - y).abs();
        let seen = aside < 0.5 * radius && radius > 2.0 * width;
        seen.then_some([centre[0], radius, island.slope * (radius - aside)])
    };
    let mut cones: Vec<[f64; 3]> = islands.islands.iter().filter_map(cone).collect();
    cones.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut reached = 0.0;
    for [x, radius, rise] in cones {
        if x - radius > reached {
            points
                .extend([(x - radius, d), (x, d + rise), (x + radius, d)].map(|(x, z)| point("cones", x, z)));
            reached = x + radius;
        }
    }
    points.push(point("cones", end.max(reached), d));
    points
}
