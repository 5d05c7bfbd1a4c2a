//! Work and energies along a path, from increment to increment.

use super::increment::Energies;
use crate::record::rows::Phase;
use asperity_solver::body::energy::{
    FIRST_TOUCH_EXPONENTS, SEPARATION_EXPONENTS, work, work_by_parabola, work_by_power, work_by_slopes,
};

/// A force, and its slope over the travel where that is known.
pub(super) type SlopedForce = (f64, Option<f64>);

/// What the tool has spent so far, and what the body held before.
pub(super) struct EnergyAccount {
    external_work: f64,
    /// Elastic energy that earlier loads left.
    stored_before: f64,
    /// Force at the start of the last increment, and its length.
    earlier: Option<[f64; 2]>,
    /// Share of the work that went into flow while the body was loaded first: see
    /// [`asperity_solver::contact::penalty_correction`].
    plastic_share: f64,
}

impl EnergyAccount {
    /// Of a body that already stores the elastic energy `stored_before`.
    pub fn new(stored_before: f64) -> EnergyAccount {
        EnergyAccount { external_work: 0.0, stored_before, earlier: None, plastic_share: 0.0 }
    }

    /// Share of the work that went into flow while the body was loaded first.
    pub fn plastic_share(&self) -> f64 {
        self.plastic_share
    }

    /// The increment to come is no continuation of the last one.
    pub fn forget_earlier(&mut self) {
        self.earlier = None;
    }

    /// Adds the work of an increment over `step` between two forces.
    pub fn add_work(&mut self, [(before, from), (after, to)]: [SlopedForce; 2], step: f64) {
        self.external_work += match (from, to) {
            (_, Some(to)) if before <= 0.0 => work_by_power(after, to, step, FIRST_TOUCH_EXPONENTS),
            (Some(from), _) if after <= 0.0 => work_by_power(before, from, step, SEPARATION_EXPONENTS),
            (Some(from), Some(to)) => work_by_slopes([before, after], [from, to], step),
            _ => match self.earlier {
                Some([earlier, last]) if last * step > 0.0 => {
                    work_by_parabola([earlier, before, after], [last, step])
                }
                _ => work([before, after], step),
            },
        };
        self.earlier = Some([before, step]);
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
