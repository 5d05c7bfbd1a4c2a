//! What each setting misses the scene's own converged values by, and which settings nothing beats.

use super::case::{Finished, Measured};
use super::settings::Setting;
use asperity_solver::run::curve::Smooth;

/// The converged values of a scene.
#[derive(Clone, Copy, Debug)]
pub struct Converged {
    peak: f64,
    force: Smooth,
    area: Smooth,
    residual_depth: Option<f64>,
    elastic_fraction: Option<f64>,
    /// Half of what the forces of the two runs differ by, relative.
    pub doubt: f64,
}

impl Converged {
    /// From two runs finer than every level: the force of each, smoothed over depth, averaged.
    pub fn new(a: &Measured, b: &Measured) -> Converged {
        let [forces, areas] = [[a.force(), b.force()], [a.area(), b.area()]];
        let peak = forces[0].end().min(forces[1].end());
        let mean = |x: Option<f64>, y: Option<f64>| Some(0.5 * (x? + y?));
        let [first, second] = forces.map(|curve| curve.smooth(peak));
        let apart = (0..=8).map(|i| peak * (0.2 + 0.1 * f64::from(i)));
        let doubt = apart.map(|h| 0.5 * (first.at(h) / second.at(h) - 1.0).abs()).fold(0.0, f64::max);
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
}

/// The errors of one setting; what needs unloading is absent without it.
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

impl Errors {
    /// The errors of a run.
    pub fn of(run: &Measured, converged: &Converged) -> Errors {
        let (force, area) = (run.force(), run.area());
        let peak = force.end().min(converged.peak);
        let off = |x: Option<f64>, y: Option<f64>| Some((x? - y?).abs());
        Errors {
            force: force.worst_difference(|h| converged.force.at(h), peak),
            area: area.worst_difference(|h| converged.area.at(h), peak),
            residual_depth: off(run.residual_depth, converged.residual_depth).map(|e| e / converged.peak),
            elastic_fraction: off(run.elastic_fraction, converged.elastic_fraction),
        }
    }
}

/// A line of the table.
#[derive(Clone, Debug)]
pub struct Row {
    /// The setting.
    pub setting: Setting,
    /// What it gave with its errors, or why nothing.
    pub outcome: Result<(Measured, Errors), String>,
    /// Whether no other setting has a smaller error of the force at no higher cost.
    pub on_front: bool,
}

/// The rows of a trade, in the order of `finished`.
pub fn rows(finished: &[Finished], converged: &Converged) -> Vec<Row> {
    let row = |f: &Finished| Row {
        setting: f.setting,
        outcome: f.outcome.clone().map(|run| {
            let errors = Errors::of(&run, converged);
            (run, errors)
        }),
        on_front: false,
    };
    let mut rows: Vec<Row> = finished.iter().map(row).collect();
    let point = |row: &Row| row.outcome.as_ref().ok().map(|(run, errors)| [run.core_s, errors.force]);
    for index in front(&rows.iter().map(point).collect::<Vec<_>>()) {
        rows[index].on_front = true;
    }
    rows
}

/// The Pareto front of points (cost, error), cheapest first: each point of it has a smaller error than every point that
/// costs as much or less. Points that are absent or not finite are not on it.
pub fn front(points: &[Option<[f64; 2]>]) -> Vec<usize> {
    let finite = |p: &[f64; 2]| p.iter().all(|x| x.is_finite());
    let mut order: Vec<(usize, [f64; 2])> =
        points.iter().enumerate().filter_map(|(i, p)| Some((i, p.filter(finite)?))).collect();
    order.sort_by(|(_, a), (_, b)| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut best = f64::INFINITY;
    order.retain(|(_, p)| {
        let better = p[1] < best;
        best = best.min(p[1]);
        better
    });
    order.into_iter().map(|(i, _)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_is_what_nothing_beats() {
        let points = [[1.0, 0.05], [2.0, 0.06], [2.0, 0.01], [3.0, 0.01], [9.0, 0.002], [0.5, f64::NAN]];
        let mut points: Vec<Option<[f64; 2]>> = points.into_iter().map(Some).collect();
        points.push(None);
        assert_eq!(front(&points), [0, 2, 4]);
        assert!(front(&[]).is_empty());
        // every point is on the front or beaten by one that is
        let on = front(&points);
        for p in points.iter().flatten().filter(|p| p[1].is_finite()) {
            assert!(on.iter().filter_map(|&i| points[i]).any(|q| q[0] <= p[0] && q[1] <= p[1]));
        }
    }
}
