//! The error estimate of a run: a bound of |F/F* - 1| for 0.2 ≤ h/h_peak ≤ 1, from its discretisation and its own curve.
//!
//! The force is too small by what the load steps leave, and too large by what a held base and the penetration leave:
//! the larger of the two counts. What the mesh leaves comes on top. With s the exponent of F ∝ h^s, φ the plastic share
//! of the work, n the hardening exponent, m the quadratic elements across the contact radius:
//! * load step: c (ln h_{i+1}/h_i)² φ^1.5 (1 - n)² (s/2)², second order (see `point::bdf2`): the more of the metal flows, the
//!   less it hardens, and the faster the contact grows, the more the direction of flow turns within a step;
//! * substrate of automatic size L: the missing compliance below a held base, δ ∝ F/(E* L), against the depth;
//! * penalty: what is left of the penetration p after its correction, c p^1.5 (p of 0.016, 0.004, 0.002 and 0.001 leave 2, 0.27,
//!   0.10 and 0.03 % on sharp cones);
//! * mesh: the ripple of the contact front that crosses element after element, which the curve itself shows against
//!   its own smooth fit, and, with what the load steps leave, a bias c φ/m: second order in the height of the rows, which
//!   follows the root of the width of the shells. Linear elements are too stiff besides, c/m.
//!
//! The constants are bounds of what refinement of the first 200 scenes of the verification battery showed, part by part;
//! the published coverage is that of other scenes.

use crate::point::kinematics::Symmetry;
use crate::run::curve::{COUNTS_FROM, Curve};
use crate::run::discretisation::Discretisation;
use crate::run::problem::Problem;
use crate::run::record::CurveRow;
use crate::scene::{ContactMethod, ElementChoice};
use asperity_mesh::grading::LINEAR;

/// Constant of the load step.
const STEP: f64 = 2.5;

/// Constant of the substrate: ½ F/(E* L) is a sixth above the depth that the base takes away.
const DOMAIN: f64 = 0.53;

/// Constant of the penalty.
const PENALTY: f64 = 10.6;

/// Constant of the mesh, without its ripple: too little force where metal flows through rows of finite height, which grow
/// with the root of the shells.
const BIAS: f64 = 0.07;

/// Constant of a mesh of linear elements, without its ripple: too much force.
const LINEAR_BIAS: f64 = 0.2;

/// Loading increments below which a curve does not show its ripple.
const SHOWS_RIPPLE: usize = 16;

/// The exponent of F(h) of a sharp cone.
const CONE: f64 = 2.0;

/// Beyond this the error of the load step grows with the first power of the exponent only: there flat metal comes into
/// contact, and the direction of flow turns no faster.
const STEEP: f64 = 1.25 * CONE;

/// Estimated error of the force of a run of `problem` whose first loading is `loading`, up to its peak; `force` and `depth`
/// are those of the peak, dimensionless. A substrate that the program did not size is part of the scene and no error.
pub fn force_error(problem: &Problem, loading: &[CurveRow], [force, depth]: [f64; 2]) -> f64 {
    let numbers = &problem.numbers;
    let curve = Curve::force(loading);
    // too few increments show no exponent
    let shown = curve.steepness();
    let steepness = if shown > 0.0 { shown / CONE } else { 1.0 };
    // an error of the depth is one of the force times the exponent
    let lever = steepness.max(1.0);
    let flow = problem.metal.hardening.as_ref().map_or(Flow::default(), |hardening| Flow {
        share: loading
            .last()
            .filter(|r| r.external_work > 0.0)
            .map_or(0.0, |r| (r.plastic_work / r.external_work).clamp(0.0, 1.0)),
        softness: (1.0 - hardening.exponent(1.0)).powi(2),
    });
    let turning = steepness * steepness.min(STEEP / CONE);
    let step = STEP * largest_step(numbers).powi(2) * flow.share.powf(1.5) * flow.softness * turning;
    let domain = match problem.automatic_size {
        Some(size) if problem.symmetry == Symmetry::Axisymmetric && depth > 0.0 => {
            DOMAIN * force / (problem.metal.elastic.reduced_modulus() * depth * size)
        }
        _ => 0.0,
    };
    let penalty =
        if numbers.contact == ContactMethod::Penalty { PENALTY * numbers.penetration.powf(1.5) } else { 0.0 };
    let (quadratic, stiff) = match numbers.element {
        ElementChoice::Q8r => (numbers.elements_in_contact as f64, 0.0),
        ElementChoice::Q4 => (numbers.elements_in_contact as f64 / LINEAR, LINEAR_BIAS),
    };
    let expected = flow.ripple() * lever / quadratic;
    let ripple = shown_ripple(&curve, loading.len()).map_or(expected, |shown| shown.min(expected));
    let soft = step + BIAS * flow.share * lever / quadratic;
    soft.max((domain + penalty + stiff / quadratic) * lever) + ripple
}

/// How much of the metal flows, and how little it hardens.
#[derive(Clone, Copy, Debug, Default)]
struct Flow {
    /// Plastic share of the work.
    share: f64,
    /// (1 - n)².
    softness: f64,
}

impl Flow {
    /// Largest ripple of the force times the elements across the contact radius.
    fn ripple(&self) -> f64 {
        0.1 + 0.55 * self.share.powi(2) * self.softness
    }
}

/// Largest difference of the force from its own smooth fit. A curve with kinks (asperities that come into contact one
/// after the other) is not smooth, and differs by more than its ripple.
fn shown_ripple(curve: &Curve, increments: usize) -> Option<f64> {
    let smooth = curve.smooth(curve.end());
    let ripple = curve.worst_difference(|h| smooth.at(h), curve.end());
    (increments >= SHOWS_RIPPLE && ripple.is_finite()).then_some(ripple)
}

/// Largest ln(h_{i+1}/h_i) from 0.2 of the peak on.
fn largest_step(numbers: &Discretisation) -> f64 {
    let depths = numbers.schedule();
    let ratio = |pair: &[f64]| (pair[1] / pair[0]).ln();
    depths
        .windows(2)
        .filter(|pair| pair[1] > COUNTS_FROM)
        .map(ratio)
        .fold(0.0, f64::max)
        .max(if depths.len() < 2 { 1.0 } else { 0.0 })
}
