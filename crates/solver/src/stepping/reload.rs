//! Loading again a body that was unloaded.

use super::{Goal, Observer, Path, Stop};
use crate::record::Phase;

impl Path<'_> {
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
