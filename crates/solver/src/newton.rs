//! Newton-Raphson with a line search, for any system that can say how far from zero it is.

/// Why an iterate or a solve failed. The caller takes a smaller step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Failure {
    /// An element turned inside out or a material point could not be updated.
    #[error("an element turned inside out")]
    Inverted,
    /// The matrix could not be factorised in any of the ways tried.
    #[error("the tangent is singular")]
    Singular,
    /// The iterations ran out.
    #[error("the iterations did not converge")]
    NotConverged,
    /// A number overflowed.
    #[error("a residual is not finite")]
    NotFinite,
}

/// How far an iterate is from a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assessment {
    /// Norm of the residual.
    pub residual: f64,
    /// What it is to be compared with, in the same unit.
    pub scale: f64,
    /// Whether anything discrete changed since the last iterate: then a small residual is not yet convergence.
    pub changed: bool,
}

/// A nonlinear system with a current iterate.
pub trait System {
    /// Residual and tangent at the iterate.
    fn assess(&mut self) -> Result<Assessment, Failure>;
    /// Solves for the Newton direction at the last assessed iterate.
    fn find_direction(&mut self) -> Result<(), Failure>;
    /// Derivative of the potential along the direction at the last assessed iterate: residual · direction.
    fn slope(&self) -> f64;
    /// Moves the iterate by `fraction` of the direction from where the direction was found.
    fn advance(&mut self, fraction: f64);
}

/// Settings of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Residual over scale at which a solve is done.
    pub tolerance: f64,
    /// Iterations after which it is given up.
    pub max_iterations: usize,
}

/// A converged solve.
#[derive(Clone, Debug, PartialEq)]
pub struct Converged {
    /// Directions found.
    pub iterations: usize,
    /// Residual over scale of each assessed iterate that was kept.
    pub history: Vec<f64>,
}

/// An iterate is too far along its direction when the slope of the potential there is this share of the slope at the
/// start, with the opposite sign.
const TOLERATED_OVERSHOOT: f64 = 0.6;

/// Fractions below which the line search gives up looking for a better one.
const SMALLEST_FRACTION: f64 = 0.03;

/// Solves `system`; also returns the iterations spent when it fails.
///
/// 1. assess; converged when residual ≤ tolerance × scale and nothing discrete changed;
/// 2. find the direction;
/// 3. full step, shortened by regula falsi on the slope of the potential while it overshoots, halved while the
///    iterate fails. Not after the first iteration, in which the system may still be a simplified one.
pub fn solve(system: &mut impl System, settings: &Settings) -> Result<Converged, (Failure, usize)> {
    let mut last = system.assess().map_err(|f| (f, 0))?;
    let mut history = vec![last.residual / last.scale];
    for iteration in 1..=settings.max_iterations {
        if !last.residual.is_finite() {
            return Err((Failure::NotFinite, iteration));
        }
        system.find_direction().map_err(|f| (f, iteration))?;
        let start = system.slope();
        let mut fraction = 1.0;
        last = loop {
            system.advance(fraction);
            let outcome = system.assess();
            let shorter = match &outcome {
                Ok(_) if iteration == 1 => None,
                Ok(next) if next.residual.is_finite() => {
                    let end = system.slope();
                    let overshoots = start < 0.0 && end > -TOLERATED_OVERSHOOT * start;
                    overshoots.then(|| (start / (start - end)).clamp(0.1, 0.7))
                }
                _ => Some(0.5),
            };
            match shorter {
                Some(factor) if fraction * factor > SMALLEST_FRACTION => fraction *= factor,
                _ => break outcome.map_err(|f| (f, iteration))?,
            }
        };
        history.push(last.residual / last.scale);
        if last.residual <= settings.tolerance * last.scale && !last.changed {
            return Ok(Converged { iterations: iteration, history });
        }
    }
    Err((Failure::NotConverged, settings.max_iterations))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x² = 2 from x = 3, and a kink that must not count as converged while the branch changes.
    struct Root {
        x: f64,
        base: f64,
        direction: f64,
        branch: bool,
    }

    impl System for Root {
        fn assess(&mut self) -> Result<Assessment, Failure> {
            let branch = self.x < 1.5;
            let changed = branch != self.branch;
            self.branch = branch;
            if self.x < 0.0 {
                return Err(Failure::Inverted);
            }
            Ok(Assessment { residual: (self.x * self.x - 2.0).abs(), scale: 1.0, changed })
        }
        fn find_direction(&mut self) -> Result<(), Failure> {
            self.base = self.x;
            self.direction = -(self.x * self.x - 2.0) / (2.0 * self.x);
            Ok(())
        }
        fn slope(&self) -> f64 {
            (self.x * self.x - 2.0) * self.direction
        }
        fn advance(&mut self, fraction: f64) {
            self.x = self.base + fraction * self.direction;
        }
    }

    #[test]
    fn converges_quadratically_and_backs_off_from_failing_iterates() {
        let settings = Settings { tolerance: 1e-14, max_iterations: 20 };
        for start in [3.0, 0.1] {
            let mut root = Root { x: start, base: 0.0, direction: 0.0, branch: false };
            let done = solve(&mut root, &settings).unwrap();
            assert!((root.x - 2f64.sqrt()).abs() < 1e-14);
            assert!(done.iterations < 9);
        }
    }
}
