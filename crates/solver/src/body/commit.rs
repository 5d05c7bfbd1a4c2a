//! Acceptance of a converged increment: the only place where the state of a body changes.

use crate::body::assembly::Response;
use crate::body::discrete_body::Body;
use crate::body::failure::Failure;
use crate::body::flow::Flows;
use crate::body::state::{State, Trial};
use crate::element::kernel::POINTS;
use crate::point::bdf2::PlasticIncrement;
use crate::point::material::volume_ratio;

impl State {
    /// Accepts the converged `trial` with its `response`, whose points are taken over; it holds no valid points afterwards.
    ///
    /// # Errors
    /// A point whose elastic trial from the old state fails; the state is then as it was in part and must not be used.
    pub fn commit(&mut self, body: &Body<'_>, trial: &Trial, response: &mut Response) -> Result<(), Failure> {
        self.note_flow(body, trial, response)?;
        for (x, du) in self.position.iter_mut().zip(&trial.displacement) {
            x[0] += du[0];
            x[1] += du[1];
        }
        self.displacement.clone_from(&trial.displacement);
        // the increment began with the old contact under its own penalty
        let held = self.contact.iter().map(|share| share.penalty_energy).sum::<f64>() + self.remeasured[1];
        if self.penalty > 0.0 {
            self.remeasured[1] += (trial.penalty / self.penalty - 1.0) * held;
        }
        self.penalty = trial.penalty;
        self.contact.clone_from(&response.contact);
        self.tip = trial.tip;
        self.multiplier.clone_from(&trial.multiplier);
        self.remeasure_contact(body);
        self.yielding.clone_from(&response.yielding);
        std::mem::swap(&mut self.points, &mut response.points);
        self.load_scale = self.load_scale.max(self.load().abs());
        Ok(())
    }

    /// Takes down the plastic increment of each point, its work, and the change of its volume ratio.
    fn note_flow(&mut self, body: &Body<'_>, trial: &Trial, response: &Response) -> Result<(), Failure> {
        for (change, (old, new)) in
            self.volume_change.iter_mut().zip(self.points.states.iter().zip(&response.points.states))
        {
            *change = volume_ratio(&new.stretch) - volume_ratio(&old.stretch);
        }
        let (before, after) = (&self.points.states, &response.points.states);
        let yields = |q: usize| after[q].plastic_strain > before[q].plastic_strain;
        let (mut flows, mut work) = (Flows::new(body), 0.0);
        for cell in 0..self.plastic.len() / POINTS {
            let points = Body::points_of(cell);
            if points.clone().any(yields) {
                flows.find(self, trial, response, cell)?;
            }
            for (i, q) in points.enumerate() {
                self.plastic[q] = if yields(q) { flows.flow[i] } else { PlasticIncrement::NONE };
                work += if yields(q) { body.volume[q] * flows.work[i] } else { 0.0 };
            }
        }
        self.plastic_work += work;
        Ok(())
    }

    /// Takes the contact energy over the surface as it is now, which the tool has stretched; what that adds to the energy is no
    /// work of the tool and is kept apart.
    fn remeasure_contact(&mut self, body: &Body<'_>) {
        let Some(contact) = &body.contact else { return };
        let context = contact.at(self.tip, self.penalty, body.symmetry);
        let mut change = 0.0;
        for (edge, share) in self.edges.iter_mut().zip(&self.contact) {
            edge.reference = edge.nodes.map(|node| self.position[node as usize]);
            let multiplier = edge.nodes.map(|node| self.multiplier[node as usize]);
            let anew = edge.integrate(&context, share.parts, &edge.reference, &multiplier);
            change += anew.penalty_energy - share.penalty_energy;
        }
        // the sums of this increment are still over the old area
        self.remeasured = [self.remeasured_energy() + self.remeasured[1], change];
    }
}
