//! The converged values of a scene, and the errors of a run against them.

use super::case::Measured;
use asperity_simulation::record::curve::Smooth;

/// The converged values of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Converged {
    peak: f64,
    force: Smooth,
    area: Smooth,
    residual_depth: Option<f64>,
    elastic_fraction: Option<f64>,
    /// Half of the difference between the forces of the two runs, relative.
    pub doubt: f64,
}

impl Converged {
    /// From two runs finer than every level: the force of each, smoothed over depth, averaged.
    pub fn new([a, b]: [&Measured; 2]) -> Converged {
        let [forces, areas] = [[a.force(), b.force()], [a.area(), b.area()]];
        let peak = forces[0].end().min(forces[1].end());
        let mean = |x: Option<f64>, y: Option<f64>| Some(0.5 * (x? + y?));
        let [first, second] = forces.map(|curve| curve.smooth(peak));
        let apart = (0..=8).map(|i| peak * (0.2 + 0.1 * f64::from(i)));
        let doubt = apart.map(|h| 0.5 * (first.value(h) / second.value(h) - 1.0).abs()).fold(0.0, f64::max);
        let [area_a, area_b] = areas.map(|curve| curve.smooth(peak));
        Converged {
            peak,
            force: Smooth::mean(&first, &second),
            area: Smooth::mean(&area_a, &area_b),
            residual_depth: mean(a.residual_depth, b.residual_depth),
            elastic_fraction: mean(a.elastic_fraction, b.elastic_fraction),
            doubt,
        }
    }

    /// The errors of a run.
    pub fn errors(&self, run: &Measured) -> Errors {
        let (force, area) = (run.force(), run.area());
        let peak = force.end().min(self.peak);
        let off = |x: Option<f64>, y: Option<f64>| Some((x? - y?).abs());
        Errors {
            force: force.worst_difference(|h| self.force.value(h), peak),
            area: area.worst_difference(|h| self.area.value(h), peak),
            residual_depth: off(run.residual_depth, self.residual_depth).map(|e| e / self.peak),
            elastic_fraction: off(run.elastic_fraction, self.elastic_fraction),
        }
    }
}

/// The errors of one setting; those that need unloading are absent without it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Largest of the force, relative, for 0.2 ≤ h/h_peak ≤ 1.
    pub force: f64,
    /// Largest of the contact area, relative, over the same depths.
    pub area: f64,
    /// Of the residual depth, relative to the peak depth.
    pub residual_depth: Option<f64>,
    /// Of the elastic fraction, absolute.
    pub elastic_fraction: Option<f64>,
}
