//! Cutbacks: an increment that does not converge is tried with factors in double precision, with half its
//! length, on a new mesh, and with a tangent that is not stiffened, before the path ends.

use super::increment::{Observer, Stop};
use super::path::{ContactLoad, FIRST_GUESS_SHARE, Miss, Path};
use crate::record::rows::Phase;
use asperity_solver::body::energy::ContactSums;
use asperity_solver::body::failure::Failure as BodyFailure;
use asperity_solver::equilibrium::SolveFailure;

/// Halvings of an increment after which the run stops.
const MAX_HALVINGS: u32 = 7;

/// Halvings of an increment after which a new mesh is tried.
const HALVINGS_BEFORE_REMESHING: u32 = 3;

/// Depth and force at which an increment that is taken in parts ends early.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct StopAt {
    pub depth: f64,
    pub force: f64,
    /// True where the depth is that of the body, without the deflection of tool and machine.
    pub of_body: bool,
}

/// Every part is to be taken.
pub(super) const NO_EARLY_END: StopAt = StopAt { depth: f64::INFINITY, force: f64::INFINITY, of_body: false };

impl Path<'_> {
    /// The depth that is compared with that of `stop_at`.
    fn measured_for(&self, stop_at: &StopAt, travel: f64, sums: &ContactSums) -> f64 {
        if stop_at.of_body {
            self.body_depth(travel, sums.penetration, sums.force)
        } else {
            self.depth(travel, ContactLoad::from_sums(sums))
        }
    }

    /// Goes to `travel` in as few increments as converge; accepts all but the last, which is left attempted.
    /// That may be one before `travel` that already reaches `stop_at`: where an asperity vanishes into its
    /// base the penetration falls, and the travel planned with the one before would crush the base itself.
    pub(super) fn reach_depth(
        &mut self,
        travel: f64,
        stop_at: StopAt,
        phase: Phase,
        carry: bool,
        observer: &mut Observer<'_>,
    ) -> Result<(f64, ContactSums), Stop> {
        let mut halvings = 0;
        let (mut stiffens, mut leapt) = (true, false);
        self.model.stiffen(true);
        let mut next = travel;
        let mut guess = if carry { FIRST_GUESS_SHARE } else { 0.0 };
        loop {
            let attempt = self.attempt(next, carry, guess);
            leapt |= attempt == Err(Miss::Leap);
            match attempt {
                Ok(sums)
                    if self.area() > 0.0
                        && sums.area > self.rules().area_growth * self.area()
                        && halvings < MAX_HALVINGS =>
                {
                    halvings += 1;
                    next = 0.5 * (self.stand.travel + next);
                }
                Ok(sums)
                    if next == travel
                        || self.measured_for(&stop_at, next, &sums) >= stop_at.depth
                        || sums.force >= stop_at.force =>
                {
                    return Ok((next, sums));
                }
                Ok(_) => {
                    self.accept(next, phase, observer)?;
                    leapt = false;
                    // try to take the rest in steps as long as the one that went
                    let step = self.stand.last_step;
                    next = if (travel - next).abs() <= 1.01 * step.abs() { travel } else { next + step };
                }
                // the digits of the factors may have been too few
                Err(Miss::Failure(_)) if self.model.sharpen() => {}
                Err(_) if halvings == HALVINGS_BEFORE_REMESHING && self.remesh() => {
                    self.counts.cutbacks += 1;
                    halvings = 0;
                    next = travel;
                    guess = 0.0;
                }
                Err(_) if halvings >= MAX_HALVINGS && stiffens => {
                    // a stiffer tangent converges slowly, and can end in a place that no smaller increment
                    // leads out of
                    stiffens = false;
                    self.model.stiffen(false);
                    halvings = 0;
                    next = travel;
                }
                Err(miss) => {
                    if halvings >= MAX_HALVINGS {
                        // what was found before was the other state
                        return Err(self.stop(if leapt { &Miss::Leap } else { &miss }));
                    }
                    halvings += 1;
                    self.counts.cutbacks += 1;
                    next = 0.5 * (self.stand.travel + next);
                    guess = 0.0;
                }
            }
        }
    }

    /// The reason why the path ends where the smallest increment cannot be accepted.
    pub(super) fn stop(&self, miss: &Miss) -> Stop {
        self.because(match miss {
            Miss::Failure(SolveFailure::System(BodyFailure::Element { .. })) => Stop::Distorted,
            Miss::Failure(_) => Stop::NoEquilibrium,
            Miss::Leap => Stop::Leaps,
        })
    }

    /// [`Path::reach_depth`] all the way.
    pub(super) fn reach(
        &mut self,
        travel: f64,
        phase: Phase,
        carry: bool,
        observer: &mut Observer<'_>,
    ) -> Result<ContactSums, Stop> {
        self.reach_depth(travel, NO_EARLY_END, phase, carry, observer).map(|(_, sums)| sums)
    }
}
