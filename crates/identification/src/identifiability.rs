//! Identifiability of the unknowns, and the null direction of the measurements.

use super::experiment::Experiment;
use super::objective::{Objective, curvature, slopes};
use super::parameters::{Parameter, Slot, Unknowns};
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
