//! Curvature of a summit.

use crate::surface::height_map::HeightMap;
use asperity_numerics::least_squares;

/// Nodes on each side of the summit that its curvature is taken from.
const REACH: i64 = 2;

/// Curvatures of a summit, from the least-squares paraboloid through its 5 × 5 nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip {
    /// Principal curvatures in 1/m, the smaller first; positive where the surface falls away.
    pub curvatures: [f64; 2],
}

impl Tip {
    /// The mean of the two, in 1/m (ISO 25178-2 takes its mean over all summits as Spc).
    pub fn mean_curvature(&self) -> f64 {
        0.5 * (self.curvatures[0] + self.curvatures[1])
    }

    /// 1 over the mean curvature, in metres; `None` where the surface does not fall away.
    pub fn radius(&self) -> Option<f64> {
        let curvature = self.mean_curvature();
        (curvature > 0.0).then(|| 1.0 / curvature)
    }

    /// At the node `summit` of `map`; `None` where too few nodes were measured around it.
    pub(super) fn fit(map: &HeightMap, summit: [usize; 2]) -> Option<Tip> {
        let [dx, dy] = map.pixel();
        let size = [map.columns() as i64, map.rows() as i64];
        let top = map.row(summit[1])[summit[0]];
        let around = (-REACH..=REACH).flat_map(|y| (-REACH..=REACH).map(move |x| [x, y]));
        let rows: Vec<([f64; 6], f64, f64)> = around
            .filter_map(|[a, b]| {
                let place = [summit[0] as i64 + a, summit[1] as i64 + b];
                let place = if map.periodic() { [0, 1].map(|k| place[k].rem_euclid(size[k])) } else { place };
                let inside = (0..2).all(|k| (0..size[k]).contains(&place[k]));
                let z = inside.then(|| map.row(place[1] as usize)[place[0] as usize])?;
                let (x, y) = (a as f64, b as f64);
                (!z.is_nan()).then_some(([1.0, x, y, 0.5 * x * x, x * y, 0.5 * y * y], z - top, 1.0))
            })
            .collect();
        let c = least_squares::solve(&rows)?;
        let (xx, xy, yy) = (-c[3] / (dx * dx), -c[4] / (dx * dy), -c[5] / (dy * dy));
        let (middle, spread) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
        Some(Tip { curvatures: [middle - spread, middle + spread] })
    }
}
