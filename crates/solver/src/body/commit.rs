//! Acceptance of a converged increment: the only place where a load changes the state of a body (remeshing
//! transfers it).

use crate::body::assembly::Response;
use crate::body::discrete_body::Body;
use crate::body::failure::Failure;
use crate::body::flow::Flows;
use crate::body::state::{Points, State, Trial};
use crate::contact::self_contact::Facing;
use crate::element::kernel::POINTS;
use crate::point::bdf2::PlasticIncrement;
use crate::point::kinematic_hardening::plastic_increment;
use crate::point::material::{plastic_work, volume_ratio};

impl State {
    /// Accepts the converged `trial` with its `response`, whose points are taken over; it holds no valid
    /// points afterwards.
    ///
    /// # Errors
    /// A point whose elastic trial from the old state fails; the state is then as it was in part and must not
    /// be used.
    pub fn commit(&mut self, body: &Body<'_>, trial: &Trial, response: &mut Response) -> Result<(), Failure> {
        self.note_flow(body, trial, response)?;
        for (x, du) in self.position.iter_mut().zip(&trial.displacement) {
            x[0] += du[0];
            x[1] += du[1];
        }
        self.displacement.clone_from(&trial.displacement);
        self.ledger.remeasured[1] = self.work_of_changes(trial.penalty, response);
        self.penalty = trial.penalty;
        self.contact.clone_from(&response.contact);
        self.tip = trial.tip;
        self.ledger.friction_work += self.contact.iter().map(|share| share.friction_work).sum::<f64>();
        self.slip(body, trial);
        self.remeasure_contact(body);
        self.face_anew(response);
        self.yielding.clone_from(&response.yielding);
        std::mem::swap(&mut self.points, &mut response.points);
        self.load_scale = self.load_scale.max(self.load().abs());
        Ok(())
    }

    /// Contact energy added along this increment by the change of the penalty to `penalty` and of the area
    /// since the last increment: the mean of the values at its start and at its end.
    fn work_of_changes(&self, penalty: f64, response: &Response) -> f64 {
        let before =
            self.contact.iter().map(|share| share.penalty_energy).sum::<f64>() + self.ledger.self_contact;
        let after = response.contact.iter().map(|share| share.penalty_energy).sum::<f64>()
            + response.pressed.iter().map(|point| point.energy).sum::<f64>();
        let remeasured = self.ledger.remeasured[1];
        if before <= 0.0 || before + remeasured <= 0.0 {
            return remeasured;
        }
        // ∫ E d(ln κ) of a contact energy E whose stiffness κ grows by this factor, by the trapezoidal rule:
        // a spring that nearly vanishes gives up what it holds, not that divided by next to nothing
        let larger = (1.0 + remeasured / before) * penalty / self.penalty;
        0.5 * (before + after) * larger.ln()
    }

    /// Plastic work from this state to the points of a trial.
    pub fn plastic_work_to(&self, body: &Body<'_>, points: &Points) -> f64 {
        let Some(hardening) = &body.material.hardening else { return 0.0 };
        let mut work = 0.0;
        for (q, volume) in body.volume.iter().enumerate() {
            let (old, new) = (&self.points.states[q], &points.states[q]);
            if new.plastic_strain <= old.plastic_strain {
                continue;
            }
            work += volume
                * match (self.points.history.get(q), points.history.get(q)) {
                    (Some(before), Some(after)) => {
                        plastic_increment(&body.material, (old, before), (new, after)).1
                    }
                    _ => plastic_work(hardening, old, new),
                };
        }
        work
    }

    /// Takes down the plastic increment of each point, its work, and the change of its volume ratio.
    fn note_flow(&mut self, body: &Body<'_>, trial: &Trial, response: &Response) -> Result<(), Failure> {
        for (change, (old, new)) in
            self.volume_change.iter_mut().zip(self.points.states.iter().zip(&response.points.states))
        {
            *change = volume_ratio(&new.b_minus_i) - volume_ratio(&old.b_minus_i);
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
        self.ledger.plastic_work += work;
        Ok(())
    }

    /// Finds anew which parts of the surface face each other. What the new points and their areas add to the
    /// energy is no work of the tool.
    fn face_anew(&mut self, response: &Response) {
        let before: f64 = response.pressed.iter().map(|point| point.energy).sum();
        self.facing = Facing::new(&self.edges, &self.position, &self.displacement, &self.facing);
        let x = |node: u32| self.position[node as usize];
        let after: f64 = self.facing.press(&self.edges, self.penalty, x).map(|point| point.energy).sum();
        self.ledger.self_contact = before;
        self.ledger.remeasured[1] += after - before;
    }

    /// Takes down the elastic slip along the surface.
    fn slip(&mut self, body: &Body<'_>, trial: &Trial) {
        let Some(contact) = body.contact.as_ref().filter(|contact| contact.friction.is_some()) else {
            return;
        };
        let context = contact.context_from(trial.tip_before, trial.tip, trial.penalty, body.symmetry);
        for edge in &mut self.edges {
            let (slip, lost) =
                edge.slip_after(&context, &edge.nodes.map(|node| self.position[node as usize]));
            edge.slip = slip;
            self.ledger.friction_work += lost;
        }
    }

    /// Takes the contact energy over the surface as it is now, which the tool has stretched; what that adds
    /// to the energy is no work of the tool and is kept apart.
    fn remeasure_contact(&mut self, body: &Body<'_>) {
        let Some(contact) = &body.contact else { return };
        let context = contact.context(self.tip, self.penalty, body.symmetry);
        let mut change = 0.0;
        for (edge, share) in self.edges.iter_mut().zip(&self.contact) {
            edge.reference = edge.nodes.map(|node| self.position[node as usize]);
            let anew = edge.integrate(&context, share.parts, &edge.reference);
            change += anew.penalty_energy - share.penalty_energy;
        }
        // the sums of this increment are still over the old area
        self.ledger.remeasured = [self.remeasured_energy() + self.ledger.remeasured[1], change];
    }
}
