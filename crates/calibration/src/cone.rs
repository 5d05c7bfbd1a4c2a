//! The path of a cone: force, contact radius and penetration against depth.

use crate::body::Body;
use crate::case::Case;
use crate::resolution::{FIT_FROM, Resolution};
use asperity_solver::energy::contact_sums;
use asperity_solver::kinematics::Symmetry;
use asperity_solver::model::Model;
use asperity_solver::newton::{Failure, Settings, solve};

/// Share of the last increment that is the first guess of the next.
const GUESS: f64 = 0.7;

/// Halvings of increments, all together, after which a case is given up.
const MAX_HALVINGS: usize = 24;

/// Depth that a clamped substrate of size L takes away from an elastic half space is this times F/(E* L). Measured on
/// crushed cones at L/a = 150 and 600: 0.37 to 0.40.
const FAR_FIELD: f64 = 0.39;

/// One converged step. Lengths in units of the final depth, E = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Travel of the tool from first touch, less the penetration, plus what the far field would add.
    pub depth: f64,
    /// Force of the full body of revolution.
    pub force: f64,
    /// Contact radius.
    pub radius: f64,
}

/// The loading curve of a cone.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The steps in order.
    pub points: Vec<Point>,
    /// Size of the elements under the contact.
    pub element: f64,
    /// Converged increments, halved ones included.
    pub increments: usize,
    /// Newton iterations, failed ones included.
    pub iterations: usize,
}

/// Why a case has no K.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum CaseError {
    /// The equations could not be solved.
    #[error("stopped at {share:.2} of the depth: {cause}")]
    Solver {
        /// Depth reached, in units of the final depth.
        share: f64,
        /// What the solver said last.
        cause: Failure,
    },
    /// The curve is no parabola.
    #[error("the force grows with depth to the {0:.3}, not 2")]
    NotSimilar(f64),
}

/// Travels of the tool: long steps to the depth where the fit begins, then equal ones.
fn travels(r: &Resolution) -> Vec<f64> {
    let lead = (1..=r.lead_steps).map(|i| FIT_FROM * i as f64 / r.lead_steps as f64);
    let rest = (1..=r.steps).map(|i| FIT_FROM + (1.0 - FIT_FROM) * i as f64 / r.steps as f64);
    lead.chain(rest).map(|depth| depth + r.penetration).collect()
}

/// Crushes (or indents) `case`.
///
/// # Errors
/// The increment that would not converge however small.
pub fn crush(case: &Case, resolution: &Resolution) -> Result<Curve, CaseError> {
    let body = Body::new(case, resolution);
    let far = FAR_FIELD / (case.elastic().reduced_modulus() * body.domain);
    let at = |share: f64| move |cause: Failure| CaseError::Solver { share, cause };
    let held = |node: usize| body.held[node];
    let mut model = Model::new(&body.mesh, Symmetry::Axisymmetric, body.metal, held, Some(body.contact))
        .map_err(at(0.0))?;
    let settings = Settings { tolerance: resolution.tolerance, max_iterations: 30 };
    let mut curve = Curve { points: Vec::new(), element: body.element, increments: 0, iterations: 0 };
    let (mut travel, mut last_step, mut halvings) = (0.0, 0.0, 0);
    for target in travels(resolution) {
        let mut next = target;
        let mut guess = GUESS;
        while travel < target {
            let step = next - travel;
            let ratio = if last_step > 0.0 { step / last_step } else { 0.0 };
            let last = model.accepted_increment().to_vec();
            model.begin(-next, resolution.carry * ratio, |node| last[node].map(|u| guess * ratio * u));
            let outcome = solve(&mut model, &settings);
            curve.iterations += outcome.as_ref().map_or_else(|(_, spent)| *spent, |done| done.iterations);
            match outcome {
                Ok(_) => {
                    model.accept().map_err(at(travel))?;
                    if resolution.cauchy {
                        model.weigh_by_current_volume();
                    }
                    curve.increments += 1;
                    (travel, last_step) = (next, step);
                    // the rest in steps as long as the one that went
                    next = if target - next <= 1.01 * step { target } else { next + step };
                }
                Err((cause, _)) => {
                    halvings += 1;
                    if halvings > MAX_HALVINGS {
                        return Err(at(travel)(cause));
                    }
                    next = 0.5 * (travel + next);
                    guess = 0.0;
                }
            }
        }
        let sums = contact_sums(model.contacts().iter(), Symmetry::Axisymmetric);
        let depth = travel - sums.penetration + far * sums.force;
        curve.points.push(Point { depth, force: sums.force, radius: sums.radius });
    }
    Ok(curve)
}
