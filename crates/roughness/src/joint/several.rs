//! One joint of several maps of the same surface: their mean, and how far they differ.

use super::path::{JointPath, JointPoint};
use crate::half_space::Stiffness;

/// Standard deviations of a spread: about 95 % of the maps lie within.
const DEVIATIONS: f64 = 2.0;

impl JointPath {
    /// The mean of `paths`, whose loads are the same, with their repeatability; None of no path. The
    /// unloading goes over the loads that all have.
    pub fn mean(paths: &[JointPath]) -> Option<JointPath> {
        let first = paths.first()?;
        if paths.len() == 1 {
            return Some(first.clone());
        }
        let phase = |of: fn(&JointPath) -> &Vec<JointPoint>| {
            let rows = paths.iter().map(|path| of(path).len()).min().unwrap_or(0);
            (0..rows).map(|i| mean_point(&paths.iter().map(|path| of(path)[i]).collect::<Vec<_>>())).collect()
        };
        Some(JointPath {
            loading: phase(|path| &path.loading),
            unloading: phase(|path| &path.unloading),
            nominal_area: first.nominal_area,
            stopped: paths.iter().any(|path| path.stopped),
        })
    }
}

fn mean_point(points: &[JointPoint]) -> JointPoint {
    let count = points.len() as f64;
    let mean = |of: &dyn Fn(&JointPoint) -> f64| points.iter().map(of).sum::<f64>() / count;
    // a number that one map lacks is none of the mean
    let mean_some = |of: &dyn Fn(&JointPoint) -> Option<f64>| {
        let found: Vec<f64> = points.iter().filter_map(of).collect();
        (found.len() == points.len()).then(|| found.iter().sum::<f64>() / count)
    };
    let stiffness = mean_some(&|p| p.elastic.map(|s| s.gap));
    let squares = stiffness.map(|m| mean(&|p| p.elastic.map_or(0.0, |s| (s.gap / m - 1.0).powi(2))));
    let plane = mean_some(&|p| p.elastic.map(|s| s.plane));
    let mut area = points[0].area;
    (area.ratio, area.corrected) = (mean(&|p| p.area.ratio), mean(&|p| p.area.corrected));
    area.error = mean(&|p| p.area.error);
    JointPoint {
        pressure: mean(&|p| p.pressure),
        separation: mean(&|p| p.separation),
        mean_gap: mean(&|p| p.mean_gap),
        approach: mean(&|p| p.approach),
        area,
        largest_pressure: points.iter().map(|p| p.largest_pressure).fold(0.0, f64::max),
        limited_share: mean(&|p| p.limited_share),
        stiffness: mean_some(&|p| p.stiffness),
        elastic: stiffness.zip(plane).map(|(gap, plane)| Stiffness { gap, plane }),
        elastic_work: mean(&|p| p.elastic_work),
        error: mean_some(&|p| p.error),
        repeatability: squares.map(|s| DEVIATIONS * (s * count / (count - 1.0)).sqrt()),
    }
}
