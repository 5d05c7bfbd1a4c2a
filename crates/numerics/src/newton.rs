//! Newton-Raphson with a line search, for any system that can say how far from zero it is.

/// The reason why a solve failed. The caller takes a smaller step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NewtonError<E> {
    /// The system could not be assessed or its tangent not be factorised, however short the step.
    #[error("{0}")]
    System(E),
    /// The iterations ran out.
    #[error("the iterations did not converge")]
    NotConverged,
    /// A number overflowed.
    #[error("a residual is not finite")]
    NotFinite,
}

impl<E> From<E> for NewtonError<E> {
    fn from(error: E) -> Self {
        NewtonError::System(error)
    }
}

/// The distance of an iterate from a solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Assessment {
    /// Norm of the residual.
    pub residual: f64,
    /// Force that the residual is compared with, in the same unit.
    pub scale: f64,
    /// True where anything discrete changed since the last iterate: then a small residual is not yet
    /// convergence.
    pub changed: bool,
}

/// A nonlinear system with a current iterate.
pub trait System {
    /// The reason why an iterate cannot be assessed or its tangent not be factorised.
    type Error;
    /// Residual at the iterate; with `tangent` also what [`System::renew`] will need there, which is then
    /// cheaper.
    fn assess(&mut self, tangent: bool) -> Result<Assessment, Self::Error>;
    /// Factorises the tangent at the last assessed iterate.
    fn renew(&mut self) -> Result<(), Self::Error>;
    /// True where there are factors of an earlier iterate that are worth a try.
    fn has_factors(&self) -> bool;
    /// True where they are of another branch than that of the last assessed iterate: its tangent is not close
    /// to theirs, however near it lies.
    fn factors_are_stale(&self) -> bool;
    /// Drops them.
    fn forget(&mut self);
    /// Solves for the direction at the last assessed iterate with the factors at hand.
    fn find_direction(&mut self);
    /// Derivative of the potential along the direction at the last assessed iterate: residual · direction.
    fn slope(&self) -> f64;
    /// Moves the iterate by `fraction` of the direction from where the direction was found; 0 goes back
    /// there.
    fn advance(&mut self, fraction: f64);
}

/// Settings of a solve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Residual over scale at which a solve is done.
    pub tolerance: f64,
    /// Iterations after which it is given up.
    pub max_iterations: usize,
    /// Factors are kept while a step leaves at most this share of the residual and stays on their branch: an
    /// old tangent corrected by secants costs a fraction of a new one. 0: a new tangent in every iteration,
    /// Newton-Raphson in the strict sense.
    pub keep: f64,
}

/// A converged solve.
#[derive(Clone, Debug, PartialEq)]
pub struct Converged {
    /// Directions found.
    pub iterations: usize,
    /// Residual over scale of each assessed iterate that was kept.
    pub history: Vec<f64>,
}

/// [`Settings::keep`] of the runs of scenes and of calibrated cones: 0.1 to 0.7 take the same time within 2
/// %.
pub const KEPT_FACTORS_REDUCTION: f64 = 0.2;

/// The care with which a step looks for the least potential along its direction.
#[derive(Clone, Copy)]
struct LineSearch {
    /// An iterate is too far along the direction when the slope of the potential there is this share of the
    /// slope at the start, with the opposite sign.
    overshoot: f64,
    /// Fraction of the direction below which nothing better is looked for.
    smallest: f64,
}

/// Newton's steps are mostly good as they are: looking costs an assembly.
const LINE_SEARCH_LOOSE: LineSearch = LineSearch { overshoot: 0.6, smallest: 0.03 };

/// Loose steps jump between two branches for ever where each is entered and left again as a whole.
const LINE_SEARCH_CLOSE: LineSearch = LineSearch { overshoot: 0.05, smallest: 0.003 };

/// Iterations after which the line search is a close one. Sound increments take half of them.
const LINE_SEARCH_PATIENCE: usize = 15;

/// Solves `system`.
///
/// 1. assess; after one iteration at least, converged when residual ≤ tolerance × scale and nothing discrete
///    changed;
/// 2. factorise the tangent, unless the last step did well enough without (see [`Settings::keep`]); find the
///    direction;
/// 3. with a new tangent: full step, shortened by regula falsi on the slope of the potential while it
///    overshoots, halved while the iterate fails, and closely so once the iterations are many. Not after the
///    first iteration, in which the system may still be a simplified one;
/// 4. with a kept one: full step. If it overshoots or leaves a larger residual it is taken back, and from
///    there on every iteration has a new tangent, so that hard increments are solved by Newton-Raphson in the
///    strict sense.
///
/// # Errors
/// The reason why it failed, and the iterations spent on it.
pub fn solve<S: System>(
    system: &mut S,
    settings: &Settings,
) -> Result<Converged, (NewtonError<S::Error>, usize)> {
    let outcome = iterate(system, settings);
    if outcome.is_err() {
        // factors of a lost iterate
        system.forget();
    }
    outcome
}

fn iterate<S: System>(
    system: &mut S,
    settings: &Settings,
) -> Result<Converged, (NewtonError<S::Error>, usize)> {
    let mut keep = settings.keep;
    let mut renew = keep == 0.0 || !system.has_factors();
    let mut last = system.assess(renew).map_err(|f| (f.into(), 0))?;
    let mut history = vec![last.residual / last.scale];
    for iteration in 1..=settings.max_iterations {
        if !last.residual.is_finite() {
            return Err((NewtonError::NotFinite, iteration));
        }
        let line = match iteration {
            1 => None,
            _ if iteration <= LINE_SEARCH_PATIENCE => Some(LINE_SEARCH_LOOSE),
            _ => Some(LINE_SEARCH_CLOSE),
        };
        let step = if renew {
            system.renew().map_err(|f| (f.into(), iteration))?;
            search(system, line, keep == 0.0)
        } else {
            match try_whole(system, line, last.residual) {
                Some(step) => Ok(step),
                None => {
                    keep = 0.0;
                    system.advance(0.0);
                    system.assess(true).and_then(|_| system.renew()).map_err(|f| (f.into(), iteration))?;
                    search(system, line, true)
                }
            }
        };
        let before = last.residual;
        last = step.map_err(|f| (f.into(), iteration))?;
        history.push(last.residual / last.scale);
        if last.residual <= settings.tolerance * last.scale && !last.changed {
            return Ok(Converged { iterations: iteration, history });
        }
        renew = keep == 0.0 || last.residual > keep * before || system.factors_are_stale();
    }
    Err((NewtonError::NotConverged, settings.max_iterations))
}

impl LineSearch {
    /// Share of the step at which the potential would be least, if the step goes too far beyond it. `start`
    /// and `end` are the slopes of the potential at its ends.
    fn shorten(self, start: f64, end: f64) -> Option<f64> {
        (start < 0.0 && end > -self.overshoot * start).then(|| start / (start - end))
    }
}

/// A step along the direction of a new tangent, as long as the line search finds good, whole without one.
fn search<S: System>(
    system: &mut S,
    line: Option<LineSearch>,
    tangent: bool,
) -> Result<Assessment, S::Error> {
    system.find_direction();
    let start = system.slope();
    let mut fraction = 1.0;
    loop {
        system.advance(fraction);
        let outcome = system.assess(tangent);
        let shorter = match (&outcome, line) {
            (Ok(_), None) => None,
            (Ok(next), Some(line)) if next.residual.is_finite() => {
                line.shorten(start, system.slope()).map(|share| share.clamp(0.1, 0.7))
            }
            _ => Some(0.5),
        };
        let smallest = line.unwrap_or(LINE_SEARCH_LOOSE).smallest;
        match shorter {
            Some(factor) if fraction * factor > smallest => fraction *= factor,
            _ => return outcome,
        }
    }
}

/// The whole step along the direction of kept factors; `None` if a new tangent is needed.
fn try_whole(system: &mut impl System, line: Option<LineSearch>, before: f64) -> Option<Assessment> {
    system.find_direction();
    let start = system.slope();
    system.advance(1.0);
    let next = system.assess(false).ok()?;
    let too_far = line.is_some_and(|line| line.shorten(start, system.slope()).is_some());
    (next.residual <= before && !too_far).then_some(next)
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
        tangent: Option<f64>,
    }

    impl System for Root {
        type Error = ();
        fn assess(&mut self, _: bool) -> Result<Assessment, ()> {
            let branch = self.x < 1.5;
            let changed = branch != self.branch;
            self.branch = branch;
            if self.x < 0.0 {
                return Err(());
            }
            Ok(Assessment { residual: (self.x * self.x - 2.0).abs(), scale: 1.0, changed })
        }
        fn renew(&mut self) -> Result<(), ()> {
            self.tangent = Some(2.0 * self.x);
            Ok(())
        }
        fn has_factors(&self) -> bool {
            self.tangent.is_some()
        }
        fn factors_are_stale(&self) -> bool {
            false
        }
        fn forget(&mut self) {
            self.tangent = None;
        }
        fn find_direction(&mut self) {
            self.base = self.x;
            self.direction = -(self.x * self.x - 2.0) / self.tangent.unwrap();
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
        let settings = Settings { tolerance: 1e-14, max_iterations: 20, keep: 0.0 };
        for start in [3.0, 0.1] {
            let mut root = Root { x: start, base: 0.0, direction: 0.0, branch: false, tangent: None };
            let done = solve(&mut root, &settings).unwrap();
            assert!((root.x - 2f64.sqrt()).abs() < 1e-14);
            assert!(done.iterations < 9);
        }
    }

    #[test]
    fn a_kept_tangent_takes_more_iterations_to_the_same_root_and_a_lost_one_is_forgotten() {
        let mut root = Root { x: 3.0, base: 0.0, direction: 0.0, branch: false, tangent: Some(4.5) };
        let done = solve(&mut root, &Settings { tolerance: 1e-14, max_iterations: 60, keep: 0.7 }).unwrap();
        assert!((root.x - 2f64.sqrt()).abs() < 1e-14 && done.iterations > 7);
        assert!(solve(&mut root, &Settings { tolerance: -1.0, max_iterations: 3, keep: 0.7 }).is_err());
        assert!(!root.has_factors());
    }
}
