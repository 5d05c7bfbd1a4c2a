//! When the tool touches the asperities that it has not touched yet.
//!
//! A curve has a kink where a contact begins, and an increment across it is wrong by what the contact gains
//! in it: by a fifth of the area where a ring began to carry at `standard`. So an increment ends where a
//! contact is about to begin, and those after it are short and grow.

use crate::setup::contact_estimate::area;
use crate::setup::problem::Problem;
use asperity_solver::body::surface::Surface;

/// Share of all contact at the peak that is expected of an asperity whose touch counts.
const LEAST_CONTACT_SHARE: f64 = 0.05;

/// Length of the first increment after a touch over the planned one, and that of each over the one before it.
const FIRST_STEP_SHARE: f64 = 0.125;
const STEP_GROWTH: f64 = 2.0;

/// Share of an increment within which a touch is at hand.
const TOUCH_STEP_SHARE: f64 = 0.5 * FIRST_STEP_SHARE;

/// An asperity that the tool has not touched yet.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Waiting {
    /// Left and right end of its foot.
    sides: [f64; 2],
    /// Way from the tool to its highest point.
    clearance: f64,
    /// Clearance lost per travel.
    rate: f64,
}

/// The asperities that the tool has not touched yet, and the length of the next increment after a touch.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Touches {
    waiting: Vec<Waiting>,
    travel: f64,
    short: Option<f64>,
}

impl Touches {
    /// Of `problem`, whose `surface` the tool has just touched first.
    pub fn new(problem: &Problem, surface: &Surface<'_>) -> Touches {
        let asperities = &problem.profile.asperities;
        if asperities.len() < 2 {
            return Touches::default();
        }
        let widths = problem.half_widths.iter();
        let areas: Vec<f64> =
            asperities.iter().zip(widths).map(|(a, w)| area(problem.symmetry, a.centre, *w)).collect();
        let least = LEAST_CONTACT_SHARE * areas.iter().sum::<f64>();
        let waiting = asperities.iter().zip(&areas).filter(|(_, area)| **area >= least).map(|(a, _)| {
            let [left, right] = a.feet();
            let sides = [a.centre - left, a.centre + right];
            Waiting { sides, clearance: surface.clearance(sides), rate: 1.0 }
        });
        Touches { waiting: waiting.filter(|w| w.clearance > 0.0).collect(), travel: 0.0, short: None }
    }

    /// Takes note of where the tool stands at `travel`; the next increment is planned to be `step` long.
    pub fn observe(&mut self, travel: f64, step: f64, surface: &Surface<'_>) {
        let way = travel - self.travel;
        self.short = self.short.map(|short| STEP_GROWTH * short).filter(|short| *short < step);
        for waiting in &mut self.waiting {
            let clearance = surface.clearance(waiting.sides);
            let rate = (waiting.clearance - clearance) / way;
            *waiting = Waiting { clearance, rate: if rate > 0.0 { rate } else { 1.0 }, ..*waiting };
        }
        let before = self.waiting.len();
        self.waiting.retain(|waiting| waiting.clearance > TOUCH_STEP_SHARE * step * waiting.rate);
        if self.waiting.len() < before {
            self.short = Some(FIRST_STEP_SHARE * step);
        }
        self.travel = travel;
    }

    /// Travel at which an increment from the travel noted last towards `wanted` is to end.
    pub fn stop_before(&self, wanted: f64) -> f64 {
        let touches = self.waiting.iter().map(|waiting| self.travel + waiting.clearance / waiting.rate);
        // of one that is as good as touched nothing is to be gained
        let touches = touches.filter(|touch| touch - self.travel > TOUCH_STEP_SHARE * (wanted - self.travel));
        let shortened = self.short.map(|short| self.travel + short);
        touches.chain(shortened).fold(wanted, f64::min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waiting(clearance: f64, rate: f64) -> Touches {
        Touches { waiting: vec![Waiting { sides: [0.0, 1.0], clearance, rate }], travel: 1.0, short: None }
    }

    #[test]
    fn an_increment_ends_at_the_touch_or_where_it_was_to_end() {
        assert_eq!(waiting(0.1, 0.5).stop_before(2.0), 1.2);
        assert_eq!(waiting(0.1, 0.5).stop_before(1.1), 1.1);
        let short = Touches { short: Some(0.25), ..waiting(0.4, 1.0) };
        assert_eq!(short.stop_before(2.0), 1.25);
    }
}
