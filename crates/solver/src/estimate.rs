//! The error estimate of a run: a bound of |F/F* - 1| for 0.2 ≤ h/h_peak ≤ 1, from its discretisation.
//!
//! A sum of four parts, each of the form that refinement shows, with constants set above what refinement of the
//! single asperity measured (draft, standard and reference levels; see the verification tables):
//! * load step: c (ln h_{i+1}/h_i)², second order (see `history`); none for an elastic body, whose path leaves no trace;
//! * mesh: c/m with m quadratic elements across the contact radius: what remains of the ripple of the contact front.
//!   Perfect plasticity ripples 2.5 times more;
//! * substrate of automatic size L: the missing compliance below a held base, δ ≈ F/(2E* L), moves the force by 2δ/h;
//! * penalty: what is left of the penetration after its correction.
//!
//! Each is an error of the depth as much as of the force: where the force grows faster than the h² of a cone, the sum
//! grows with the exponent (an asperity that vanishes into its base, F ∝ h⁸ and more).

use crate::discretise::{Discretisation, Problem, automatic_size};
use crate::kinematics::Symmetry;
use crate::scene::{ContactMethod, ElementChoice};
use crate::stepping::schedule;

/// Constant of the load step.
const STEP: f64 = 0.7;

/// Constant of the mesh.
const MESH: f64 = 0.09;

/// Constant of the penalty.
const PENALTY: f64 = 0.3;

/// The exponent of F(h) for which the constants were measured.
const CONE: f64 = 2.0;

/// Estimated error of the force; `force` and `depth` are those of the peak, dimensionless, `automatic` says whether the
/// substrate was sized by the program (else it is part of the scene and no error), and `steepness` is the largest
/// exponent of F(h), see [`crate::curve::Curve::steepness`].
pub fn force_error(problem: &Problem, force: f64, depth: f64, automatic: bool, steepness: f64) -> f64 {
    let numbers = &problem.numbers;
    let hardening = problem.metal.hardening.as_ref();
    let step = hardening.map_or(0.0, |_| STEP * largest_step(numbers).powi(2));
    let quadratic = match numbers.element {
        ElementChoice::Q8r => numbers.elements_in_contact as f64,
        ElementChoice::Q4 => 0.375 * numbers.elements_in_contact as f64,
    };
    let ripple = hardening.map_or(1.0, |h| 1.0 + 1.5 * (1.0 - h.exponent(1.0) / 0.1).max(0.0));
    let mesh = MESH * ripple / quadratic;
    let size = automatic_size(numbers, &problem.profile, &problem.half_widths);
    let domain = if automatic && problem.symmetry == Symmetry::Axisymmetric && depth > 0.0 {
        force / (problem.metal.elastic.reduced_modulus() * depth * size)
    } else {
        0.0
    };
    let penalty = if numbers.contact == ContactMethod::Penalty { PENALTY * numbers.penetration } else { 0.0 };
    (step + mesh + domain + penalty) * (steepness / CONE).max(1.0)
}

/// Largest ln(h_{i+1}/h_i) from 0.2 of the peak on.
fn largest_step(numbers: &Discretisation) -> f64 {
    let depths = schedule(numbers.steps, numbers.geometric_from);
    let ratio = |pair: &[f64]| (pair[1] / pair[0]).ln();
    depths.windows(2).filter(|pair| pair[1] > 0.2).map(ratio).fold(0.0, f64::max).max(if depths.len() < 2 {
        1.0
    } else {
        0.0
    })
}
