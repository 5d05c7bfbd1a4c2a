//! Kick's law of a cone, F = K h²: its constant, its contact radius and their error from a loading curve.

use crate::case::Case;
use crate::cone::{CaseError, Curve, crush};
use asperity_law::least_squares::Line;
use asperity_solver::run::discretisation::{ConeDiscretisation, FIT_FROM};
use asperity_solver::run::load_path::Increment;

/// The result of a case.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadingCurvature {
    /// K/E = F/(E h²), from the slope of √F against h over whole periods of the mesh.
    pub k_over_e: f64,
    /// Relative 95 % bound of K.
    pub error: f64,
    /// a tan β/h, from the slope of the contact radius against h over the same periods.
    pub contact_ratio: f64,
    /// Converged increments.
    pub increments: usize,
    /// Newton iterations.
    pub iterations: usize,
}

/// Exponents farther from 2 than this are no sharp cone: something other than the depth gave a length.
const EXPONENT_TOLERANCE: f64 = 0.06;

/// Solves `case` and fits it.
///
/// # Errors
/// No equilibrium, or a force that is no parabola of the depth.
pub fn solve(case: &Case, discretisation: &ConeDiscretisation) -> Result<LoadingCurvature, CaseError> {
    let curve = crush(case, discretisation)?;
    let window = whole_periods(&curve);
    let line =
        |point: fn(&Increment) -> [f64; 2]| Line::through(&window.iter().map(point).collect::<Vec<_>>());
    let root = line(|p| [p.depth, p.contact.force.max(0.0).sqrt()]);
    let radius = line(|p| [p.depth, p.contact.radius]);
    let exponent = line(|p| [p.depth.ln(), p.contact.force.max(0.0).ln()]).slope;
    // a rounded summit shifts h, which the slope of √F does not notice and the exponent does
    let sharp = discretisation.sizes.rounding == 0.0;
    if exponent.is_nan() || sharp && (exponent - 2.0).abs() > EXPONENT_TOLERANCE {
        return Err(CaseError::NotSimilar(exponent));
    }
    let ripple = 2.0 * 2.0 * root.slope_error / root.slope; // K is the square; two standard deviations
    Ok(LoadingCurvature {
        k_over_e: root.slope * root.slope,
        error: discretisation.bias.hypot(ripple),
        contact_ratio: radius.slope * case.tan_beta(),
        increments: curve.increments,
        iterations: curve.iterations,
    })
}

/// The last points of the curve, over which the contact radius has grown by a whole number of elements: the force
/// ripples with that period, and half a period too much tilts the line.
fn whole_periods(curve: &Curve) -> &[Increment] {
    let points = &curve.points;
    let end = points.last().map_or(0.0, |p| p.contact.radius);
    let off = |i: &usize| {
        let periods = (end - points[*i].contact.radius) / curve.element;
        (periods - periods.round()).abs()
    };
    let first = points.iter().position(|p| p.depth >= 0.95 * FIT_FROM).unwrap_or(0);
    let candidates = first..(first + 4).min(points.len());
    let start = candidates.min_by(|i, j| off(i).total_cmp(&off(j))).unwrap_or(first);
    &points[start..]
}
