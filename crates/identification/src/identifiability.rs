//! Identifiability of the unknowns, the null direction of the measurements, and the cone that would resolve
//! it best.

use super::emulator::by_the_atlas;
use super::experiment::{Data, Experiment};
use super::objective::{Objective, curvature, slopes};
use super::parameters::{Parameter, Slot, Unknowns};
use super::response::{DesignPoint, Geometry};
use crate::levenberg_marquardt::jacobian;
use crate::profile_likelihood::Interval;
use indexmap::IndexMap;
use nalgebra::{DMatrix, DVector};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Largest distance of an end of the interval from the value, relative of a stress, absolute of n, within
/// which a number counts as found.
const FOUND_HALF_WIDTHS: [f64; 2] = [0.15, 0.05];

/// Correlation of two unknowns from which a bound on the one decides the other.
const TIED_CORRELATION: f64 = 0.9;

/// True where a bound of the search, not the measurements, ends the interval of `parameter`. (n ≥ 0 and
/// friction ≥ 0 are no choice.)
fn is_cut(parameter: &Parameter, interval: &Interval) -> bool {
    let from_zero = matches!(parameter.slot, Slot::HardeningExponent | Slot::Friction(_));
    let natural = from_zero && interval.ends[0] <= 0.0;
    interval.bounded[1] || (interval.bounded[0] && !natural)
}

/// Share of the width of the bounds within which a best value sits at its bound.
const AT_BOUND_SHARE: f64 = 1e-3;

/// The unknowns that the measurements identify: those of narrow intervals that no bound cuts, neither their
/// own nor that of an unknown they are tied to. While an unknown of the `best` fit sits at a bound, another
/// metal beyond it would fit better, and none is identified.
pub fn identified(
    parameters: &[Parameter],
    best: &[f64],
    intervals: &[Interval],
    correlation: &[Vec<f64>],
) -> Vec<bool> {
    let cut = |j: usize| is_cut(&parameters[j], &intervals[j]);
    let sits = |j: usize| {
        let (p, x) = (&parameters[j], best[j]);
        cut(j) && (x - p.bounds[0]).min(p.bounds[1] - x) <= AT_BOUND_SHARE * p.width()
    };
    let count = parameters.len();
    let none = (0..count).any(sits);
    let tied = |i: usize| (0..count).any(|j| correlation[i][j].abs() > TIED_CORRELATION && cut(j));
    (0..count).map(|i| !none && is_narrow(&parameters[i], best[i], &intervals[i]) && !tied(i)).collect()
}

/// True where the interval of `parameter` is narrow about its `best` coordinate.
fn is_narrow(parameter: &Parameter, best: f64, interval: &Interval) -> bool {
    let value = parameter.value(best);
    let [below, above] = interval.ends.map(|end| (parameter.value(end) - value).abs());
    let allowed = match parameter.slot {
        Slot::HardeningExponent | Slot::PoissonsRatio | Slot::Friction(_) => FOUND_HALF_WIDTHS[1],
        Slot::ContactDepth(_) | Slot::Compliance(_) => 0.25 * parameter.width() * parameter.scale,
        _ => FOUND_HALF_WIDTHS[0] * value.abs(),
    };
    below.max(above) <= allowed
}

/// A change of the unknowns that the measurements do not notice.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct NullDirection {
    /// Names of the unknowns and their changes for a sum of squares that grows by 1: a factor of positive
    /// ones, else a difference.
    pub change: Vec<(String, f64)>,
    /// The same in words.
    pub text: String,
}

/// The direction that the measurements see least.
pub fn null_direction(
    objective: &Objective<'_>,
    unknowns: &Unknowns,
    point: &[f64],
) -> Option<NullDirection> {
    let seen = curvature(objective, point)?;
    let weakest = seen.eigenvalues.imin();
    let length = (1.0 / seen.eigenvalues[weakest].max(1e-12).sqrt()).min(0.5);
    let direction = seen.eigenvectors.column(weakest);
    let lead = direction.iamax();
    let sign = direction[lead].signum();
    let change: Vec<(String, f64)> = unknowns
        .parameters
        .iter()
        .zip(direction.iter())
        .map(|(p, d)| {
            let step = sign * length * d * p.width();
            (p.name.clone(), if p.logarithmic { step.exp() } else { step })
        })
        .collect();
    let words: Vec<String> = unknowns
        .parameters
        .iter()
        .zip(&change)
        .map(|(p, (name, by))| match p.logarithmic {
            true => format!("{name} times {by:.3}"),
            false => format!("{name} {by:+.3}{}{}", if p.unit.is_empty() { "" } else { " " }, p.unit),
        })
        .collect();
    Some(NullDirection { text: words.join(" with "), change })
}

/// Another experiment and what it would do.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct NextExperiment {
    /// Half apex angle of the sharp cone, degrees.
    pub half_apex_deg: f64,
    /// Quantities to be measured.
    pub features: Vec<String>,
    /// The unknown that it is for.
    pub parameter: String,
    /// Width of the interval of that unknown with it, over that without.
    pub interval_ratio: f64,
}

/// Half apex angles that are looked at.
const ANGLES: [f64; 8] = [45.0, 50.0, 55.0, 60.0, 65.0, 75.0, 80.0, 85.0];
/// Noise of a next experiment where no measurement states its own.
const NOISE: f64 = 0.01;
/// Angles nearer than this to one that was measured are no other experiment, degrees.
const MIN_ANGLE_DISTANCE: f64 = 4.0;

/// Names of the quantities of a curve, those that an experiment like the given ones would measure.
const FEATURES: [&str; 3] = ["loading_curvature", "unloading_slope", "plastic_work_ratio"];

/// Those of [`FEATURES`] that `experiments` measured: a next experiment is expected to measure no more.
fn measured_features(experiments: &[Experiment]) -> [bool; 3] {
    let of = |e: &Experiment| match &e.data {
        Data::Features { loading_curvature, unloading_slope, plastic_work_ratio } => {
            [loading_curvature.is_some(), unloading_slope.is_some(), plastic_work_ratio.is_some()]
        }
        Data::Curve(curve) => [true, !curve.unloading.is_empty(), !curve.unloading.is_empty()],
        Data::Imprint(_) | Data::ImprintNumbers(_) => [false; 3],
    };
    let all = experiments.iter().map(of).fold([false; 3], |a, b| [0, 1, 2].map(|k| a[k] || b[k]));
    if all == [false; 3] { [true; 3] } else { all }
}

/// The sharp cone that would narrow the interval of unknown `of` most by the quantities that the given
/// measurements have, by the atlas of cones.
pub fn next_experiment(
    objective: &Objective<'_>,
    experiments: &[Experiment],
    unknowns: &Unknowns,
    point: &[f64],
    of: usize,
) -> Option<NextExperiment> {
    let bounds = objective.bounds();
    let slopes = jacobian(objective, point, &bounds)?;
    // the bounds themselves are a weak measurement, without which nothing that is not seen had a width
    let mut normal = slopes.tr_mul(&slopes);
    for (i, parameter) in unknowns.parameters.iter().enumerate() {
        normal[(i, i)] += 12.0 / parameter.width().powi(2).max(1e-12);
    }
    let width = |matrix: &DMatrix<f64>| Some(matrix.clone().try_inverse()?[(of, of)].sqrt());
    let now = width(&normal)?;
    let features = measured_features(experiments);
    let first = experiments.first()?.design_point(unknowns, point)?;
    let noise = experiments.iter().map(|e| e.noise).fold(NOISE, f64::max);
    let measured = |angle: f64| {
        experiments.iter().any(|e| match e.geometry {
            Geometry::Sharp { slope_deg } => (90.0 - slope_deg - angle).abs() < MIN_ANGLE_DISTANCE,
            _ => false,
        })
    };
    let ratio = |angle: f64| {
        let slope_deg = 90.0 - angle;
        let at = |point: &[f64]| {
            let metal = unknowns.metal(point)?;
            let question = DesignPoint {
                geometry: Geometry::Sharp { slope_deg },
                imprint: false,
                friction: None,
                modulus: metal.elastic.youngs_modulus,
                metal,
                ..first.clone()
            };
            let logs = by_the_atlas(&question);
            let modulus = question.modulus.ln();
            let error = noise.hypot(0.01);
            let all =
                [(logs[0] + modulus) / error, (logs[1] + modulus) / (2.0 * error), logs[2] / (3.0 * error)];
            Some(all.into_iter().zip(features).filter(|(_, has)| *has).map(|(x, _)| x).collect::<Vec<_>>())
        };
        let more = jacobian(&at, point, &bounds)?;
        Some((angle, width(&(&normal + more.tr_mul(&more)))? / now))
    };
    let angles = ANGLES.iter().copied().filter(|a| !measured(*a));
    let best = angles.filter_map(ratio).min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some(NextExperiment {
        half_apex_deg: best.0,
        features: FEATURES
            .iter()
            .zip(features)
            .filter(|(_, has)| *has)
            .map(|(name, _)| name.to_string())
            .collect(),
        parameter: unknowns.parameters[of].name.clone(),
        interval_ratio: best.1,
    })
}

/// Changes of all coordinates at the minimum as coordinate `i` grows by one, by their `deviations` and
/// `correlation`.
pub fn along_coordinate(i: usize, deviations: &[f64], correlation: &[Vec<f64>]) -> Vec<f64> {
    correlation[i].iter().zip(deviations).map(|(c, deviation)| c * deviation / deviations[i]).collect()
}

/// Standard deviations of the coordinates and their correlations by the curvature at the minimum; a direction
/// that is not seen has the width of the bounds.
pub fn deviations(
    objective: &Objective<'_>,
    unknowns: &Unknowns,
    point: &[f64],
) -> (Vec<f64>, Vec<Vec<f64>>) {
    let count = unknowns.parameters.len();
    let widths = DVector::from_fn(count, |i, _| unknowns.parameters[i].width());
    let inverse = curvature(objective, point).map(|seen| {
        let values = seen.eigenvalues.map(|v| 1.0 / (v + 3.0));
        &seen.eigenvectors * DMatrix::from_diagonal(&values) * seen.eigenvectors.transpose()
    });
    let covariance = inverse.unwrap_or_else(|| DMatrix::identity(count, count));
    let deviation = |i: usize| covariance[(i, i)].max(1e-18).sqrt();
    let correlation = |i: usize, j: usize| covariance[(i, j)] / (deviation(i) * deviation(j));
    let rows = (0..count).map(|i| (0..count).map(|j| correlation(i, j)).collect()).collect();
    ((0..count).map(|i| deviation(i) * widths[i]).collect(), rows)
}

/// Narrowing of the intervals by one of several measurements: the width of every interval without it over
/// that with it, by the curvature at the best fit.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Decided {
    /// The measurement that is left out.
    pub measurement: String,
    /// Unknowns and the factors by which their intervals would widen.
    #[schemars(with = "BTreeMap<String, f64>")]
    pub widening: IndexMap<String, f64>,
}

/// Narrowing of the intervals by each of `experiments`; empty of one.
pub fn decided(
    objective: &Objective<'_>,
    experiments: &[Experiment],
    unknowns: &Unknowns,
    point: &[f64],
) -> Option<Vec<Decided>> {
    if experiments.len() < 2 {
        return Some(Vec::new());
    }
    let slopes = slopes(objective, point)?;
    let count = unknowns.parameters.len();
    // the bounds themselves are a weak measurement
    let information = |rows: &DMatrix<f64>| rows.tr_mul(rows) + 3.0 * DMatrix::<f64>::identity(count, count);
    let whole = information(&slopes).try_inverse()?;
    let mut first = 0;
    let each = experiments.iter().map(|experiment| {
        let size = experiment.differences(unknowns, point, false)?.len();
        let rest = slopes.clone().remove_rows(first, size);
        first += size;
        let without = information(&rest).try_inverse()?;
        let factor = |i: usize| (without[(i, i)] / whole[(i, i)]).sqrt();
        let widening = unknowns.parameters.iter().enumerate().map(|(i, p)| (p.name.clone(), factor(i)));
        Some(Decided { measurement: experiment.name.clone(), widening: widening.collect() })
    });
    each.collect()
}
