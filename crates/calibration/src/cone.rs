//! The path of a cone: force, contact radius and penetration against depth.

use crate::body::Body;
use crate::case::{Case, YieldMeasure};
use crate::resolution::{FIT_FROM, Resolution};
use asperity_solver::algebra::newton::{Failure, KEEP, Settings, solve};
use asperity_solver::body::discrete_body::Body as Discrete;
use asperity_solver::body::energy::contact_sums;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::run::equilibrium::{Equilibrium, SolveFailure};

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
        cause: SolveFailure,
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

/// A cone under way: its model and what the steps so far have cost.
struct Path<'m> {
    model: Equilibrium<'m>,
    resolution: &'m Resolution,
    stress: YieldMeasure,
    /// Relative to E and the final depth 1: what the far field takes away per force.
    far: f64,
    travel: f64,
    last_step: f64,
    halvings: usize,
    increments: usize,
    iterations: usize,
}

impl<'m> Path<'m> {
    fn new(case: &Case, body: &'m Body, resolution: &'m Resolution) -> Result<Path<'m>, CaseError> {
        let far = FAR_FIELD / (case.elastic().reduced_modulus() * body.domain);
        let held = |node: usize| body.held[node];
        let model =
            Discrete::new(&body.mesh, Symmetry::Axisymmetric, body.metal.clone(), held, Some(body.contact))
                .and_then(Equilibrium::new)
                .map_err(|cause| CaseError::Solver { share: 0.0, cause: cause.into() })?;
        let (travel, last_step) = (0.0, 0.0);
        let stress = case.stress;
        Ok(Path {
            model,
            resolution,
            stress,
            far,
            travel,
            last_step,
            halvings: 0,
            increments: 0,
            iterations: 0,
        })
    }

    /// Moves the tool to `target`, in one step or, where that does not converge, in shorter ones.
    fn go_to(&mut self, target: f64) -> Result<Point, CaseError> {
        let settings = Settings { tolerance: self.resolution.tolerance, max_iterations: 40, keep: KEEP };
        let mut next = target;
        let mut guess = GUESS;
        while self.travel != target {
            let step = next - self.travel;
            // nothing of the last increment is carried on where the tool turns back
            let ratio = if self.last_step * step > 0.0 { step / self.last_step } else { 0.0 };
            let last = self.model.state().displacement.clone();
            let carry = self.resolution.carry * ratio;
            self.model.begin(-next, carry, |node| last[node].map(|u| guess * ratio * u));
            let outcome = solve(&mut self.model, &settings);
            self.iterations += outcome.as_ref().map_or_else(|(_, spent)| *spent, |done| done.iterations);
            let stopped = |cause: SolveFailure| CaseError::Solver { share: self.travel, cause };
            match outcome {
                Ok(_) => {
                    self.model.accept().map_err(|cause| stopped(cause.into()))?;
                    if self.stress == YieldMeasure::Cauchy {
                        self.model.weigh_by_current_volume();
                    }
                    self.increments += 1;
                    (self.travel, self.last_step) = (next, step);
                    // the rest in steps as long as the one that went
                    next = if (target - next) / step <= 1.01 { target } else { next + step };
                }
                Err((cause, _)) => {
                    self.halvings += 1;
                    if self.halvings > MAX_HALVINGS {
                        return Err(stopped(cause));
                    }
                    next = 0.5 * (self.travel + next);
                    guess = 0.0;
                }
            }
        }
        let sums = contact_sums(self.model.contacts().iter(), Symmetry::Axisymmetric);
        let depth = self.travel - sums.penetration + self.far * sums.force;
        Ok(Point { depth, force: sums.force, radius: sums.radius })
    }

    fn load(&mut self) -> Result<Vec<Point>, CaseError> {
        travels(self.resolution).into_iter().map(|target| self.go_to(target)).collect()
    }
}

/// Crushes (or indents) `case`.
///
/// # Errors
/// The increment that would not converge however small.
pub fn crush(case: &Case, resolution: &Resolution) -> Result<Curve, CaseError> {
    let body = Body::new(case, resolution);
    let mut path = Path::new(case, &body, resolution)?;
    let points = path.load()?;
    Ok(Curve { points, element: body.element, increments: path.increments, iterations: path.iterations })
}

/// Share of the peak force at which unloading ends; what is left of the way is extrapolated.
const LIFTED: f64 = 0.02;

/// Exponent m of the unloading curve F = F_j (1 - u/u_j)^m whose slope at the peak is that of a punch of the contact
/// radius, 2E* a: m = 2E* a u_j/F_j, with u_j the way from the peak to the end of contact. 2 of an elastic cone, 1 of a
/// flat punch.
///
/// # Errors
/// The increment that would not converge however small.
pub fn unloading_exponent(case: &Case, resolution: &Resolution) -> Result<f64, CaseError> {
    let body = Body::new(case, resolution);
    let mut path = Path::new(case, &body, resolution)?;
    let mut last = Point { depth: 0.0, force: 0.0, radius: 0.0 };
    for point in path.load()? {
        last = point;
    }
    let peak = last;
    let stiffness = 2.0 * case.elastic().reduced_modulus() * peak.radius;
    // in (F/F_j)^(1/m) the way is nearly a straight line: m of a flat punch is 1, of a cone 2, of flattened ones 1.2
    let straight = |force: f64| (force / peak.force).powf(1.0 / 1.25);
    // a fifth of the way that the punch would take, then half of what the line through the last two points leaves
    let mut lift = 0.2 * peak.force / stiffness;
    loop {
        let before = last;
        last = path.go_to(path.travel - lift)?;
        let fallen = straight(before.force) - straight(last.force);
        let left = (before.depth - last.depth) * straight(last.force) / fallen;
        if last.force <= LIFTED * peak.force {
            // the rest of the way along the curve of the exponent itself
            let (f0, f1) = (before.force / peak.force, last.force / peak.force);
            let mut m: f64 = 1.25;
            for _ in 0..30 {
                let rest = (before.depth - last.depth) / ((f0 / f1).powf(1.0 / m) - 1.0);
                m = stiffness * (peak.depth - last.depth + rest) / peak.force;
            }
            return Ok(m);
        }
        if !(left.is_finite() && left > 0.0) {
            return Err(CaseError::Solver { share: path.travel, cause: Failure::NotConverged });
        }
        lift = 0.5 * left;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Tool;
    use asperity_solver::scene::Accuracy;

    /// Sneddon's cone unloads along F = (2/π) E* h²/tan β with a = 2h/(π tan β): m = 2. 5 %, the accuracy claimed for m:
    /// the radius of a soft penalty contact is 1.3 % too large, and at the end less than two elements touch (carried on
    /// from there with the exponent 1.25 instead of m itself, 2.08 becomes 1.96).
    #[test]
    fn an_elastic_cone_unloads_with_the_exponent_two() {
        let case = Case {
            beta_deg: 2.0,
            yielding: None,
            poissons_ratio: 0.3,
            tool: Tool::Plane,
            stress: YieldMeasure::Kirchhoff,
        };
        let m = unloading_exponent(&case, &Resolution::of(&case, Accuracy::Standard)).unwrap();
        assert!((m / 2.0 - 1.0).abs() < 0.05, "{m}");
    }
}
