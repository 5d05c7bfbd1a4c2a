//! Loading: along a schedule of depths, or to a travel, a depth or a force at once.

use super::cutback::{NO_EARLY_END, StopAt};
use super::increment::{Increment, Observer, Stop};
use super::path::{ContactLoad, Path};
use super::touches::Touches;
use crate::record::rows::Phase;
use crate::setup::problem::Goal;
use asperity_solver::body::energy::ContactSums;

/// Times that the last increment is halved where it does not meet its goal.
const MOST_HALVINGS_AT_GOAL: usize = 3;

/// Travel at the end of the first increment at most over the travel at which the tool touches a tip that was
/// cut off.
const FIRST_TRAVEL_RATIO: f64 = 2.0;

/// Share of the tolerance that is left where nothing yields: all of the work is recovered, so that the little
/// of it that is left in the end shows each residual. Of a ridge that hardly yields 0.05 % of the work was
/// lost without it.
const ELASTIC_TOLERANCE_SHARE: f64 = 0.1;

/// Tolerance that is never made smaller.
const FINEST_TOLERANCE: f64 = 1e-6;

impl Path<'_> {
    /// Goes from the last converged increment to `goal`, in as few increments as converge, and returns the
    /// last one. The observer hears of each.
    ///
    /// To a travel in either direction; to a depth or a force beyond the present one. A force is looked for
    /// from its expected depth on, which is doubled until the force is exceeded.
    ///
    /// # Errors
    /// The reason why it could not: the path then stands at its last converged increment.
    pub fn advance_to(&mut self, goal: Goal, observer: &mut Observer<'_>) -> Result<Increment, Stop> {
        match goal {
            Goal::Travel(travel) => {
                let phase = if travel < self.stand.travel { Phase::Unload } else { Phase::Load };
                self.reach(travel, phase, phase == Phase::Load, observer)?;
                self.accept(travel, phase, observer)
            }
            _ => self.follow(goal, &[1.0], self.stand.contact.penetration, observer),
        }
    }

    /// Loads to the goal of the problem along its schedule.
    ///
    /// # Errors
    /// The reason why it stopped on its way.
    pub fn load(&mut self, observer: &mut Observer<'_>) -> Result<Increment, Stop> {
        let problem = self.problem;
        self.follow(problem.goal, &problem.numbers.schedule(), problem.expected_penetration(), observer)
    }

    /// Excess of the travel over the depth, as a share of the depth: of a goal that is a depth with all that
    /// gives way.
    fn share(&self, goal: Goal, travel: f64, sums: &ContactSums) -> f64 {
        if self.rules().compliance.is_none() || !matches!(goal, Goal::Depth(_)) {
            return sums.penetration / (travel - sums.penetration);
        }
        travel / self.depth(travel, ContactLoad::from_sums(sums)) - 1.0
    }

    /// Newton's tolerance while the body is loaded: that of the problem, down to [`ELASTIC_TOLERANCE_SHARE`]
    /// of it the smaller the share of the work that went into flow.
    fn tolerance(&self) -> f64 {
        let asked = self.problem.numbers.newton_tolerance;
        let share = ELASTIC_TOLERANCE_SHARE + (1.0 - ELASTIC_TOLERANCE_SHARE) * self.account.plastic_share();
        (share * asked).max(asked.min(FINEST_TOLERANCE))
    }

    /// Loads to `goal` along `fractions` of its depth; `penetration` is the expected one.
    fn follow(
        &mut self,
        goal: Goal,
        fractions: &[f64],
        penetration: f64,
        observer: &mut Observer<'_>,
    ) -> Result<Increment, Stop> {
        let (depth, limit, stop_at) = match goal {
            Goal::Travel(travel) => (travel, travel, NO_EARLY_END),
            Goal::Depth(depth) => (depth, depth, StopAt { depth, ..NO_EARLY_END }),
            Goal::Force { force, expected_depth, limit } => {
                (expected_depth, limit, StopAt { depth: limit, force, of_body: true })
            }
        };
        self.asked = if let Goal::Depth(depth) = goal { Some(depth) } else { None };
        let expects = !matches!(goal, Goal::Travel(_));
        // the penetration is a share of the depth
        let mut share = if expects { penetration / depth } else { 0.0 };
        let growth =
            fractions.last().copied().unwrap_or(1.0) / fractions.iter().rev().nth(1).copied().unwrap_or(0.5);
        let mut touches = if self.counts.increments == 0 && fractions.len() > 1 {
            let surface = self.model.converged_surface().under_tool_at(-self.touch);
            Touches::new(self.problem, &surface)
        } else {
            Touches::default()
        };
        let mut index = 0;
        let mut fraction = 0.0;
        loop {
            fraction = fractions.get(index).copied().unwrap_or(fraction * growth);
            let wanted = (fraction * depth).min(limit) * (1.0 + share);
            if wanted <= self.stand.travel && index + 1 < fractions.len() {
                index += 1;
                continue; // above a tip that was cut off, or where the penetration has become less than was expected
            }
            // such a tip is met by an increment that is short beside what was cut off
            let planned = if self.counts.increments == 0 && self.stand.travel > 0.0 {
                wanted.min(FIRST_TRAVEL_RATIO * self.stand.travel)
            } else {
                touches.stop_before(wanted)
            };
            index += usize::from(planned == wanted);
            self.settings.tolerance = self.tolerance();
            let (travel, sums) = self.reach_depth(planned, stop_at, Phase::Load, true, observer)?;
            let last = match goal {
                Goal::Travel(_) | Goal::Depth(_) => index == fractions.len() || travel != planned,
                Goal::Force { force, .. } => sums.force >= force,
            };
            if last {
                let travel = self.solve_for_goal_by_parts(goal, (travel, sums), stop_at, observer)?;
                return self.accept(travel, Phase::Load, observer);
            }
            share = if expects { self.share(goal, travel, &sums) } else { 0.0 };
            self.accept(travel, Phase::Load, observer)?;
            touches.observe(travel, (growth - 1.0) * travel, &self.model.converged_surface());
            let whole = planned == wanted;
            if (whole && fraction * depth >= limit || travel != planned) && matches!(goal, Goal::Force { .. })
            {
                return Err(Stop::ForceNotReached);
            }
        }
    }

    /// [`Path::solve_for_goal`]; where that finds no equilibrium beside the one at hand, half of the
    /// increment is taken first, on a better mesh if there is one.
    fn solve_for_goal_by_parts(
        &mut self,
        goal: Goal,
        (mut travel, mut sums): (f64, ContactSums),
        stop_at: StopAt,
        observer: &mut Observer<'_>,
    ) -> Result<f64, Stop> {
        for _ in 0..MOST_HALVINGS_AT_GOAL {
            match self.solve_for_goal(goal, travel, sums) {
                Err(Stop::NoEquilibrium) => {}
                met => return met,
            }
            self.remesh();
            let half = 0.5 * (self.stand.travel + travel);
            self.reach(half, Phase::Load, true, observer)?;
            self.accept(half, Phase::Load, observer)?;
            (travel, sums) = self.reach_depth(travel, stop_at, Phase::Load, true, observer)?;
        }
        self.solve_for_goal(goal, travel, sums)
    }
}
