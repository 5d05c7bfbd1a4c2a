//! Unloading, and loading again a body that was unloaded.

use super::increment::{Observer, Stop};
use super::path::Path;
use super::target::GOAL_TOLERANCE;
use crate::record::rows::Phase;
use crate::setup::problem::Goal;
use crate::setup::schedule::{UNLOADING_EXPONENT, unloading};
use asperity_solver::equilibrium::tool_stiffness::ToolStiffness;
use asperity_solver::remesh::distortion::LIMITS_BEFORE_UNLOADING;

/// Retreats after which a tool is taken away whatever load it still carries.
const MOST_RETREATS: usize = 500;

/// Share of the tolerance of the loading to which unloading increments are solved.
const UNLOADING_TOLERANCE_SHARE: f64 = 0.1;

/// Share of the peak travel that may be left when the tool is taken away, which is one increment however far
/// the metal then flows: from further off it sprang back beyond its first summit.
const LAST_RETREAT_SHARE: f64 = 0.02;

impl Path<'_> {
    /// Unloads to zero force in about `steps` increments, then removes the tool and finds the equilibrium of
    /// the body alone: there the force is zero and the depth that of its highest point. `stiffness` is that
    /// of the peak.
    ///
    /// Travels follow F ∝ (1 - u/u₀)^1.25 with u₀ = 1.25 F/S; the last few percent of the force are not
    /// chased.
    ///
    /// # Errors
    /// The reason why it stopped on its way.
    pub fn unload(
        &mut self,
        stiffness: ToolStiffness,
        steps: usize,
        observer: &mut Observer<'_>,
    ) -> Result<(), Stop> {
        if self.model.is_distorted(LIMITS_BEFORE_UNLOADING) {
            self.remesh_for_the_better();
        }
        let (peak_force, peak) = (self.stand.contact.force, self.stand.travel);
        let compliance = 1.0 / stiffness.depth + self.sums().penetration / peak_force;
        self.stand.slope = Some(stiffness.travel);
        // what is left of the work is the smaller, the further the tool retreats
        let settings = self.settings;
        self.settings.tolerance =
            (UNLOADING_TOLERANCE_SHARE * settings.tolerance).max(settings.tolerance.min(GOAL_TOLERANCE));
        let done = self.retreat_from([peak, peak_force], compliance, steps, observer);
        self.settings = settings;
        done
    }

    /// Unloads from the travel and force of `peak`, where depth and penetration have this `compliance`
    /// together.
    fn retreat_from(
        &mut self,
        [peak, peak_force]: [f64; 2],
        compliance: f64,
        steps: usize,
        observer: &mut Observer<'_>,
    ) -> Result<(), Stop> {
        let unloading_travels = UNLOADING_EXPONENT * peak_force * compliance;
        self.unloading_travels = vec![peak];
        for travel in unloading(peak, unloading_travels, steps, 0.3) {
            if travel >= self.stand.travel || self.stand.contact.force < 0.03 * peak_force {
                continue;
            }
            let sums = self.reach(travel, Phase::Unload, false, observer)?;
            if sums.force <= 0.0 {
                break; // beyond separation: the equilibrium without the tool comes next
            }
            self.accept(travel, Phase::Unload, observer)?;
            self.unloading_travels.push(travel);
        }
        if self.model.body().material.has_back_stress() {
            self.retreat_from_reverse_flow(0.03 * peak_force, steps, observer)?;
        }
        let separation = match self.take_away() {
            Err(_) if self.remesh() => self.take_away(),
            found => found,
        };
        let separation = separation.map_err(|miss| self.stop(&miss))?;
        self.accept(separation, Phase::Unload, observer).map(|_| ())
    }

    /// Goes on unloading down to `force` where metal flows in reverse and gives way more than elastic metal
    /// does: each step removes a share of the force, as the slope predicts it, `steps` of which would remove
    /// all; and further while metal that has little force left still has far to go.
    fn retreat_from_reverse_flow(
        &mut self,
        force: f64,
        steps: usize,
        observer: &mut Observer<'_>,
    ) -> Result<(), Stop> {
        let peak = self.unloading_travels.first().copied().unwrap_or(self.stand.travel);
        for _ in 0..MOST_RETREATS {
            let slope = self.stand.slope.unwrap_or(0.0);
            let left = UNLOADING_EXPONENT * self.stand.contact.force / slope;
            if slope <= 0.0 || (self.stand.contact.force <= force && left <= LAST_RETREAT_SHARE * peak) {
                break;
            }
            let travel = self.stand.travel - left / steps as f64;
            let sums = self.reach(travel, Phase::Unload, false, observer)?;
            if sums.force <= 0.0 {
                break;
            }
            self.accept(travel, Phase::Unload, observer)?;
            self.unloading_travels.push(travel);
        }
        Ok(())
    }

    /// Goes back to `goal`, the end of the first loading, along the travels of the last unloading in reverse:
    /// metal that stays elastic then passes through the same states, and what its work differs by is
    /// hysteresis alone.
    ///
    /// # Errors
    /// The reason why it stopped on its way.
    pub fn reload(&mut self, goal: Goal, observer: &mut Observer<'_>) -> Result<(), Stop> {
        let mut travels = std::mem::take(&mut self.unloading_travels);
        let peak = if travels.is_empty() { self.stand.travel } else { travels.remove(0) };
        for travel in travels.into_iter().rev() {
            // metal that flows while it is unloaded may leave the summit above the last of them
            if travel <= self.stand.travel {
                continue;
            }
            self.reach(travel, Phase::Reload, true, observer)?;
            self.accept(travel, Phase::Reload, observer)?;
        }
        let sums = self.reach(peak, Phase::Reload, true, observer)?;
        let travel = self.solve_for_goal(goal, peak, sums)?;
        self.accept(travel, Phase::Reload, observer).map(|_| ())
    }
}
