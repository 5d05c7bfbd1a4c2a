//! The mean of a map around a summit: the body of revolution that stands for an asperity.

use super::hills::Neighbours;
use crate::surface::height_map::{HeightMap, MapError};
use crate::surface::prepared_surface::Surface;
use std::f64::consts::{PI, TAU};
use thiserror::Error;

/// Circles have at least so many points.
const LEAST_POINTS: usize = 16;
/// The reach of a profile, as a multiple of its radius at the depth.
const PROFILE_REACH: f64 = 3.0;
/// A rise by this share of the fall so far ends a profile at the valley before it.
const VALLEY_RISE: f64 = 0.1;
/// Points of a profile from the summit to the depth, below which it is made of too few pixels.
const MIN_PROFILE_POINTS: usize = 4;

/// The reason why no body of revolution stands for an asperity.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum ProfileError {
    /// Circles leave the map, or meet a hole, before the depth is reached.
    #[error(
        "the map ends {radius_um:.4} µm from the summit, where the mean around it has fallen by {fall_um:.4} µm only"
    )]
    Edge {
        /// Radius of the last circle that was measured, µm.
        radius_um: f64,
        /// Fall of the mean until there, µm.
        fall_um: f64,
    },
    /// The mean around the summit does not fall far enough.
    #[error("the mean around the summit falls by {fall_um:.4} µm only, to a valley {radius_um:.4} µm away")]
    Shallow {
        /// Fall of the mean to the valley, µm.
        fall_um: f64,
        /// Radius of the valley, µm.
        radius_um: f64,
    },
    /// Too few pixels.
    #[error(
        "too few circles a pixel apart fit between summit and depth ({points}): measure finer, or go deeper"
    )]
    Coarse {
        /// Circles from the summit to the depth.
        points: usize,
    },
}

/// A body of revolution by the mean height on circles around a summit, a pixel apart, down to its foot.
#[derive(Clone, Debug, PartialEq)]
pub struct RadialProfile {
    /// Radius and height above the foot, m: from the axis outward.
    pub points: Vec<[f64; 2]>,
}

impl RadialProfile {
    /// The mean of `map` around the node `summit` (column, row) of an asperity that is to be pressed by
    /// `depth` (m). It ends at three times the radius where it has fallen by the depth, or in the valley
    /// before that.
    ///
    /// # Errors
    /// A mean that does not fall by the depth, within the map or at all; fewer than four pixels until there.
    pub fn around_summit(
        map: &HeightMap,
        summit: [usize; 2],
        depth: f64,
    ) -> Result<RadialProfile, ProfileError> {
        let step = map.cell_area().sqrt();
        let top = map.row(summit[1])[summit[0]];
        let mut points = vec![[0.0, top]];
        let (mut lowest, mut reach) = (0, f64::INFINITY);
        let fall = |z: f64| top - z;
        let mut edge = false;
        for k in 1.. {
            let radius = k as f64 * step;
            let Some(mean) = circle(map, summit, radius, step) else {
                edge = true;
                break;
            };
            points.push([radius, mean]);
            if fall(mean) >= depth && !reach.is_finite() {
                if k < MIN_PROFILE_POINTS {
                    return Err(ProfileError::Coarse { points: k });
                }
                reach = PROFILE_REACH * radius;
            }
            if mean < points[lowest][1] {
                lowest = k;
            } else if mean - points[lowest][1] > VALLEY_RISE * fall(points[lowest][1]).max(depth) {
                break;
            }
            if radius >= reach {
                break;
            }
        }
        let [radius, foot] = points[lowest];
        let (radius_um, fall_um) = (radius * 1e6, fall(foot) * 1e6);
        if fall(foot) < depth {
            return Err(match edge {
                true => ProfileError::Edge { radius_um, fall_um },
                false => ProfileError::Shallow { fall_um, radius_um },
            });
        }
        points.truncate(lowest + 1);
        points.iter_mut().for_each(|p| p[1] -= foot);
        Ok(RadialProfile { points })
    }

    /// Summit above foot, m.
    pub fn height(&self) -> f64 {
        self.points.first().map_or(0.0, |p| p[1])
    }

    /// The part within `depth` (m) of the summit: projected area in m², and mean of |dz/dr| over it (tan β).
    pub fn area_and_slope(&self, depth: f64) -> (f64, f64) {
        let plane = self.height() - depth;
        let (mut area, mut slope_area) = (0.0, 0.0);
        for pair in self.points.windows(2) {
            let [[r0, z0], [r1, z1]] = [pair[0], pair[1]];
            let cut = r0 + (r1 - r0) * ((z0 - plane) / (z0 - z1)).clamp(0.0, 1.0);
            let (from, to) = match (z0 > plane, z1 > plane) {
                (true, true) => (r0, r1),
                (true, false) => (r0, cut),
                (false, true) => (cut, r1),
                (false, false) => continue,
            };
            let ring = PI * (to * to - from * from);
            area += ring;
            slope_area += ring * ((z1 - z0) / (r1 - r0)).abs();
        }
        (area, if area > 0.0 { slope_area / area } else { 0.0 })
    }

    /// Height above the foot at radius `r`, 0 beyond it.
    pub fn height_at(&self, r: f64) -> f64 {
        let after = self.points.partition_point(|p| p[0] <= r);
        match (self.points.get(after.wrapping_sub(1)), self.points.get(after)) {
            (Some([r0, z0]), Some([r1, z1])) => z0 + (z1 - z0) * (r - r0) / (r1 - r0),
            _ => 0.0,
        }
    }

    /// The body alone on a map of `nodes` × `nodes` that reaches `half_width` (m) to each side of its axis, a
    /// node on it.
    ///
    /// # Errors
    /// A width that is not possible, fewer than two nodes.
    pub fn surface(&self, half_width: f64, nodes: usize) -> Result<Surface, MapError> {
        let pixel = 2.0 * half_width / nodes as f64;
        let middle = (nodes / 2) as f64;
        let height = |i: usize| {
            let [x, y] = [i % nodes.max(1), i / nodes.max(1)].map(|k| (k as f64 - middle) * pixel);
            self.height_at(x.hypot(y))
        };
        Surface::from_map(HeightMap::new(nodes, nodes, [pixel; 2], (0..nodes * nodes).map(height).collect())?)
    }
}

/// Mean height of `map` on a circle about the node `summit`; `None` where a part of it was not measured.
fn circle(map: &HeightMap, summit: [usize; 2], radius: f64, step: f64) -> Option<f64> {
    let neighbours = Neighbours::new(map);
    let pixel = map.pixel();
    let size = [map.columns() as f64 * pixel[0], map.rows() as f64 * pixel[1]];
    // a circle that overlaps itself around a periodic map says nothing more
    if 2.0 * radius >= size[0].min(size[1]) {
        return None;
    }
    let points = ((TAU * radius / step).ceil() as usize).max(LEAST_POINTS);
    let mut sum = 0.0;
    for k in 0..points {
        let angle = TAU * (k as f64 + 0.5) / points as f64;
        let x = summit[0] as f64 + radius * angle.cos() / pixel[0];
        let y = summit[1] as f64 + radius * angle.sin() / pixel[1];
        let (left, low) = (x.floor(), y.floor());
        let (u, v) = (x - left, y - low);
        let node = |a: i64, b: i64| {
            neighbours.node([left as i64 + a, low as i64 + b]).map_or(f64::NAN, |i| map.heights()[i])
        };
        sum += (1.0 - v) * ((1.0 - u) * node(0, 0) + u * node(1, 0))
            + v * ((1.0 - u) * node(0, 1) + u * node(1, 1));
    }
    sum.is_finite().then(|| sum / points as f64)
}
