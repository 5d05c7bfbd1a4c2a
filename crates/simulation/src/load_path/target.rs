//! The last increment of a loading: the travel at which the depth or the force is the one that was asked for.

use super::increment::Stop;
use super::path::{ContactLoad, FIRST_GUESS_SHARE, GOAL_DISTANCE, Path};
use crate::setup::problem::Goal;
use asperity_solver::body::energy::ContactSums;

/// Relative residual of the increments of the secant iteration for a goal, which the depth then follows to
/// [`GOAL_DISTANCE`].
pub(super) const GOAL_TOLERANCE: f64 = 1e-8;

/// Increments of the secant iteration for a goal; it takes three or four.
const MOST_TRIES: usize = 24;

/// Share of an increment by which the next try may differ to be the same increment.
const SAME_INCREMENT_SHARE: f64 = 0.05;

/// Distance to which a goal is to be met by increments that are solved to the tolerance of the run.
const LOOSE_GOAL_DISTANCE: f64 = 1e-7;

/// Tries after which the interval around the goal is halved instead: the response leaps.
const MOST_SECANTS: usize = 6;

impl Path<'_> {
    /// Distance of a travel from `goal`, relative to it; of a force the root.
    fn miss(&self, goal: Goal, travel: f64, contact_load: ContactLoad) -> f64 {
        match goal {
            Goal::Travel(asked) => travel / asked - 1.0,
            Goal::Depth(asked) => self.depth(travel, contact_load) / asked - 1.0,
            Goal::Force { force: asked, .. } => (contact_load.force.max(0.0) / asked).sqrt() - 1.0,
        }
    }

    /// Moves the attempted increment until the goal is met to [`GOAL_DISTANCE`] (secant, held between travels
    /// on either side of the goal; each try starts from the converged state).
    ///
    /// Metal that hardly hardens may not come so close to equilibrium that the force is known to that, or may
    /// leap over the goal from one state to another: then the goal is met to the tolerance of the run.
    pub(super) fn solve_for_goal(&mut self, goal: Goal, travel: f64, sums: ContactSums) -> Result<f64, Stop> {
        let settings = self.settings;
        self.settings.tolerance = settings.tolerance.min(GOAL_TOLERANCE);
        // travel and miss: of the last tries, and of the nearest on either side of the goal; the converged
        // state is the first of them for a force, while the depth follows the travel closely from the start
        let mut now = (travel, self.miss(goal, travel, ContactLoad::from_sums(&sums)));
        let mut last = match goal {
            Goal::Travel(depth) | Goal::Depth(depth) => (travel - depth, now.1 - 1.0),
            Goal::Force { .. } => (self.stand.travel, self.miss(goal, self.stand.travel, self.stand.contact)),
        };
        let mut short = matches!(goal, Goal::Force { .. }).then_some(last);
        let mut beyond: Option<(f64, f64)> = None;
        let loosely = settings.tolerance.max(GOAL_DISTANCE);
        let mut met = GOAL_DISTANCE;
        for tried in 0..MOST_TRIES {
            if now.1.abs() <= met {
                break;
            }
            if now.1 < 0.0 {
                short = Some(now);
            } else {
                beyond = Some(now);
            }
            let secant = now.0 - now.1 * (now.0 - last.0) / (now.1 - last.1);
            let next = match (short, beyond) {
                (Some((a, _)), Some((b, _)))
                    if tried >= MOST_SECANTS || !(a.min(b)..=a.max(b)).contains(&secant) =>
                {
                    0.5 * (a + b)
                }
                _ => secant,
            };
            let near = (next - now.0).abs() <= SAME_INCREMENT_SHARE * (now.0 - self.stand.travel).abs();
            let exact =
                if near { self.attempt_again(next) } else { self.attempt(next, true, FIRST_GUESS_SHARE) };
            let exact = exact.or_else(|_| self.attempt(next, true, 0.0));
            let found = exact.or_else(|_| {
                met = LOOSE_GOAL_DISTANCE;
                self.settings = settings;
                self.attempt(next, true, FIRST_GUESS_SHARE)
            });
            let Ok(sums) = found else {
                self.settings = settings;
                return Err(Stop::NoEquilibrium);
            };
            last = now;
            now = (next, self.miss(goal, next, ContactLoad::from_sums(&sums)));
        }
        self.settings = settings;
        if now.1.abs() <= loosely { Ok(now.0) } else { Err(Stop::NoEquilibrium) }
    }
}
