//! Loading again a body that was unloaded.

use super::{Goal, Observer, Path, Stop};
use crate::run::record::Phase;

/// Retreats after which a tool is taken away whatever it still bears.
const MOST_RETREATS: usize = 500;

/// Share of the peak travel that may be left when the tool is taken away, which is one increment however far the metal
/// then flows: from further off it sprang back beyond its first summit.
const LAST_RETREAT: f64 = 0.02;

impl Path<'_> {
    /// Goes on unloading down to `force` where metal flows in reverse and gives way more than elastic metal does: each
    /// step takes off a share of the force that the slope foretells, `steps` of which would take off all; and further while
    /// metal that has little force left still has far to go.
    pub(super) fn retreat_from_reverse_flow(
        &mut self,
        force: f64,
        steps: usize,
        observer: &mut Observer<'_>,
    ) -> Result<(), Stop> {
        let peak = self.way_back.first().copied().unwrap_or(self.travel);
        for _ in 0..MOST_RETREATS {
            let slope = self.slope.unwrap_or(0.0);
            let left = 1.25 * self.force / slope;
            if slope <= 0.0 || (self.force <= force && left <= LAST_RETREAT * peak) {
                break;
            }
            let travel = self.travel - left / steps as f64;
            let sums = self.reach(travel, Phase::Unload, false, observer)?;
            if sums.force <= 0.0 {
                break;
            }
            self.accept(travel, Phase::Unload, observer)?;
            self.way_back.push(travel);
        }
        Ok(())
    }

    /// Goes back to `goal`, the end of the first loading, along the travels of the last unloading in reverse: metal that
    /// stays elastic then passes through the same states, and what its work differs by is hysteresis alone.
    pub fn reload(&mut self, goal: Goal, observer: &mut Observer<'_>) -> Result<(), Stop> {
        let mut travels = std::mem::take(&mut self.way_back);
        let peak = if travels.is_empty() { self.travel } else { travels.remove(0) };
        for travel in travels.into_iter().rev() {
            // metal that flows while it is unloaded may leave the summit above the last of them
            if travel <= self.travel {
                continue;
            }
            self.reach(travel, Phase::Reload, true, observer)?;
            self.accept(travel, Phase::Reload, observer)?;
        }
        let sums = self.reach(peak, Phase::Reload, true, observer)?;
        let travel = self.home_in(goal, peak, sums)?;
        self.accept(travel, Phase::Reload, observer).map(|_| ())
    }
}
