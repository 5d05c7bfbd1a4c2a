//! Work and energies along a path, from increment to increment.

use super::increment::Energies;
use crate::record::rows::Phase;
use asperity_solver::body::energy::{
    FIRST_TOUCH_EXPONENTS, SEPARATION_EXPONENTS, work, work_by_parabola, work_by_power, work_by_slopes,
};

/// A force, and its slope over the travel where that is known.
pub(super) type SlopedForce = (f64, Option<f64>);

/// Plastic work of an increment for which there is no energy, over the work so far, from which on the
/// increment is a leap.
const LARGEST_EXCESS: f64 = 0.01;

/// Work of the tool so far, and energy of the body before.
pub(super) struct EnergyAccount {
    external_work: f64,
    /// The largest work so far.
    largest_work: f64,
    /// Elastic energy that earlier loads left.
    stored_before: f64,
    /// Force at the start of the last increment, and its length.
    earlier: Option<[f64; 2]>,
    /// Share of the work that went into flow while the body was loaded first: see
    /// [`asperity_solver::contact::depth_correction`].
    plastic_share: f64,
}

impl EnergyAccount {
    /// Of a body that already stores the elastic energy `stored_before`.
    pub fn new(stored_before: f64) -> EnergyAccount {
        EnergyAccount {
            external_work: 0.0,
            largest_work: 0.0,
            stored_before,
            earlier: None,
            plastic_share: 0.0,
        }
    }

    /// Share of the work that went into flow while the body was loaded first.
    pub fn plastic_share(&self) -> f64 {
        self.plastic_share
    }

    /// The largest work so far.
    pub fn largest_work(&self) -> f64 {
        self.largest_work
    }

    /// The increment to come is no continuation of the last one.
    pub fn forget_earlier(&mut self) {
        self.earlier = None;
    }

    /// Work of an increment over `step` between two forces.
    fn work_of(&self, [(before, from), (after, to)]: [SlopedForce; 2], step: f64) -> f64 {
        match (from, to) {
            (_, Some(to)) if before <= 0.0 => work_by_power(after, to, step, FIRST_TOUCH_EXPONENTS),
            (Some(from), _) if after <= 0.0 => work_by_power(before, from, step, SEPARATION_EXPONENTS),
            (Some(from), Some(to)) => work_by_slopes([before, after], [from, to], step),
            _ => match self.earlier {
                Some([earlier, last]) if last * step > 0.0 => {
                    work_by_parabola([earlier, before, after], [last, step])
                }
                _ => work([before, after], step),
            },
        }
    }

    /// Adds the work of an increment over `step` between two forces.
    pub fn add_work(&mut self, forces: [SlopedForce; 2], step: f64) {
        self.external_work += self.work_of(forces, step);
        self.largest_work = self.largest_work.max(self.external_work);
        self.earlier = Some([forces[0].0, step]);
    }

    /// True where an increment over `step` between two forces, with this `plastic` work, does more of it than
    /// there is energy for: more than the tool does, and than the body and its contacts give up, by more than
    /// [`LARGEST_EXCESS`] of the work so far. No path of the metal leads there. `released` is asked for
    /// only where the work of the tool alone is not enough.
    pub fn leaps(
        &self,
        plastic: f64,
        released: impl FnOnce() -> f64,
        forces: [SlopedForce; 2],
        step: f64,
    ) -> bool {
        let [before, after] = forces.map(|(force, _)| force.max(0.0));
        // a contact that has just begun may bear its force from the start
        let most = if before > 0.0 { 0.5 * (before + after) } else { after };
        let work = self.work_of(forces, step).max(most * step);
        let allowed = LARGEST_EXCESS * self.largest_work.max(self.external_work + work);
        plastic > allowed + work.max(0.0) && plastic > allowed + (work + released()).max(0.0)
    }

    /// Energies since first touch of a body that holds `elastic` and has dissipated `plastic` energy, `near`
    /// of the first beside its contacts were it all elastic.
    pub fn balance(&mut self, [elastic, plastic]: [f64; 2], near: f64, phase: Phase) -> Energies {
        if phase == Phase::Load && plastic > 0.0 {
            self.plastic_share = plastic / (near + plastic);
        }
        Energies { external_work: self.external_work, elastic: elastic - self.stored_before, plastic }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A force of 1 over a travel of 10, then a step of 0.1.
    fn account() -> EnergyAccount {
        let mut account = EnergyAccount::new(0.0);
        account.add_work([(0.0, None), (1.0, None)], 0.0);
        account.add_work([(1.0, None), (1.0, None)], 10.0);
        account
    }

    #[test]
    fn plastic_work_that_nothing_pays_for_is_a_leap() {
        let leaps = |plastic: f64, released: f64, after: f64, step: f64| {
            account().leaps(plastic, || released, [(1.0, None), (after, None)], step)
        };
        // the tool pays 0.1, and 1 % of the work is 0.101
        assert!(!leaps(0.2, 0.0, 1.0, 0.1) && leaps(0.203, 0.0, 1.0, 0.1));
        assert!(!leaps(0.203, 0.01, 1.0, 0.1) && leaps(0.22, 0.01, 1.0, 0.1));
        // on the way back the body pays for both
        assert!(!leaps(0.05, 0.15, 1.0, -0.1) && leaps(0.2, 0.15, 1.0, -0.1));
        // no flow is a leap, whatever is left of the work
        assert!(!leaps(0.0, 0.0, 0.0, -0.1));
    }

    /// Metal that flows at once under a force of 1 over 0.1 dissipates three times the work of a parabola.
    #[test]
    fn a_first_touch_that_bears_at_once_is_no_leap() {
        let account = EnergyAccount::new(0.0);
        assert!(!account.leaps(0.1, || 0.0, [(0.0, None), (1.0, None)], 0.1));
        assert!(account.leaps(0.102, || 0.0, [(0.0, None), (1.0, None)], 0.1));
    }
}
