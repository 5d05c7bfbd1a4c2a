//! Acceptance of a converged increment: with [`State::weigh`] the only place where the state of a body changes.

use crate::body::assembly::{Response, evaluate_cell};
use crate::body::discrete_body::Body;
use crate::body::failure::Failure;
use crate::body::state::{State, Trial};
use crate::element::kernel::{ElementContext, ElementOutput};
use crate::point::bdf2::{PlasticIncrement, plastic_increment};
use crate::point::j2::Tangent;
use crate::point::kinematic_hardening;

impl State {
    /// Accepts the converged `trial` with its `response`, whose points are taken over; it holds no valid points afterwards.
    ///
    /// # Errors
    /// A point whose elastic trial from the old state fails; the state is then as it was in part and must not be used.
    pub fn commit(&mut self, body: &Body<'_>, trial: &Trial, response: &mut Response) -> Result<(), Failure> {
        if self.points.history.is_empty() {
            self.complete_isotropic(body, trial, response)?;
        } else {
            self.complete_kinematic(body, response);
        }
        for (x, du) in self.position.iter_mut().zip(&trial.displacement) {
            x[0] += du[0];
            x[1] += du[1];
        }
        self.displacement.clone_from(&trial.displacement);
        self.contact.clone_from(&response.contact);
        self.tip = trial.tip;
        self.multiplier.clone_from(&trial.multiplier);
        self.remeasure_contact(body);
        self.yielding.clone_from(&response.yielding);
        std::mem::swap(&mut self.points, &mut response.points);
        self.load_scale = self.load_scale.max(self.load().abs());
        Ok(())
    }

    /// The plastic increment from the old state to the new one, whose accumulated strain is its length as a whole: the two
    /// pieces of the second-order formula would count a turn twice.
    fn complete_isotropic(
        &mut self,
        body: &Body<'_>,
        trial: &Trial,
        response: &mut Response,
    ) -> Result<(), Failure> {
        // the elastic trial from the old state: what the increment would have been without plasticity
        let elastic = body.material.elastic_part();
        let context = ElementContext { symmetry: body.symmetry, metal: &elastic, tangent: Tangent::None };
        let mut output = ElementOutput::new(body.material.virgin());
        for cell in 0..response.yielding.len() {
            let points = Body::points_of(cell);
            if !response.yielding[cell] {
                if let Some(plastic) = self.plastic.get_mut(points) {
                    plastic.fill(PlasticIncrement::NONE);
                }
                continue;
            }
            evaluate_cell(body, self, &trial.displacement, &self.points, cell, &context, &mut output)?;
            for (i, q) in points.enumerate() {
                self.plastic[q] = PlasticIncrement::NONE;
                let (old, new) = (&self.points.states[q], &mut response.points.states[q]);
                if new.plastic_strain > old.plastic_strain {
                    let plastic = plastic_increment(&output.states[i].stretch, new)
                        .map_err(|cause| Failure::Element { cell, cause })?;
                    new.plastic_strain = old.plastic_strain + plastic.accumulated;
                    if let Some(hardening) = &body.material.hardening {
                        new.yield_stress = hardening.flow(new.plastic_strain).yield_stress;
                    }
                    self.plastic[q] = plastic;
                }
            }
        }
        Ok(())
    }

    /// The same for a material with a back stress.
    fn complete_kinematic(&mut self, body: &Body<'_>, response: &mut Response) {
        for cell in 0..response.yielding.len() {
            for q in Body::points_of(cell) {
                let before = (&self.points.states[q], &self.points.history[q]);
                let after = (&mut response.points.states[q], &mut response.points.history[q]);
                let plastic = kinematic_hardening::settle(&body.material, before, after);
                // an element that no longer yields is not extrapolated a second time
                self.plastic[q] = if response.yielding[cell] { plastic } else { PlasticIncrement::NONE };
            }
        }
    }

    /// Takes the contact energy over the surface as it is now, under tools that stretch it; what that adds to the energy
    /// is no work of the tool and is kept apart.
    fn remeasure_contact(&mut self, body: &Body<'_>) {
        let Some(contact) = body.contact.filter(|c| c.tool.stretches_the_surface()) else { return };
        let context = contact.at(self.tip, body.symmetry);
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
