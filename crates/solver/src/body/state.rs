//! The converged state of a body, and the increment that is tried from it.

use crate::body::assembly::{Response, evaluate_cell};
use crate::body::discrete_body::Body;
use crate::body::energy::{dissipated, stored};
use crate::body::failure::Failure;
use crate::contact::edge::{ContactEdge, EdgeContact, NOTHING, Parts};
use crate::element::kernel::{ElementContext, ElementOutput};
use crate::point::bdf2::{PlasticIncrement, extrapolate, extrapolation_factor, plastic_increment};
use crate::point::j2::Tangent;
use crate::point::kinematic_hardening::{self, History, elastic_energy};
use crate::point::material::{Metal, PointState, volume_ratio};

/// States of all integration points, four to an element.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// Elastic stretch, plastic strain, yield stress.
    pub states: Vec<PointState>,
    /// History variables of kinematic hardening; empty for a material without back stress.
    pub history: Vec<History>,
}

impl Points {
    /// `count` virgin points.
    pub fn virgin(material: &Metal, count: usize) -> Points {
        let with_history = if material.has_back_stress() { count } else { 0 };
        Points { states: vec![material.virgin(); count], history: vec![History::default(); with_history] }
    }
}

/// A converged state: all that the next increment starts from.
#[derive(Clone, Debug)]
pub struct State {
    /// Node positions.
    pub position: Vec<[f64; 2]>,
    /// Displacements of the last increment.
    pub displacement: Vec<[f64; 2]>,
    /// Integration points.
    pub points: Points,
    /// Weight of each point in the internal forces: its reference volume, or its current one (see [`State::weigh`]).
    pub weight: Vec<f64>,
    /// Plastic increment of each point in the last increment; empty for an elastic body.
    pub plastic: Vec<PlasticIncrement>,
    /// Whether each element yielded in the last increment.
    pub yielding: Vec<bool>,
    /// Height of the tool's lowest point; infinite without a tool.
    pub tip: f64,
    /// The surface, with the positions over whose area the contact energy is taken.
    pub edges: Vec<ContactEdge>,
    /// Contact of each edge.
    pub contact: Vec<EdgeContact>,
    /// Augmented Lagrange multipliers at the nodes.
    pub multiplier: Vec<f64>,
    /// Largest load so far.
    pub load_scale: f64,
    /// Change of the contact energy by that of the area it is taken over, before the last increment and in it.
    remeasured: [f64; 2],
}

/// An increment that is tried from a converged state.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Height of the tool's lowest point; infinite without a tool.
    pub tip: f64,
    /// Displacement of each node from the converged state.
    pub displacement: Vec<[f64; 2]>,
    /// Augmented Lagrange multipliers at the nodes.
    pub multiplier: Vec<f64>,
    /// States that the points start from: the converged ones with the last plastic increment extrapolated.
    pub start: Points,
}

impl State {
    /// The stress-free state of `body`.
    pub fn virgin(body: &Body<'_>) -> State {
        let (nodes, count) = (body.mesh.nodes.len(), body.volume.len());
        let yields = body.material.hardening.is_some() || body.material.has_back_stress();
        State {
            position: body.mesh.nodes.clone(),
            displacement: vec![[0.0; 2]; nodes],
            points: Points::virgin(&body.material, count),
            weight: body.volume.clone(),
            plastic: vec![PlasticIncrement::NONE; if yields { count } else { 0 }],
            yielding: vec![false; body.mesh.cell_count()],
            tip: f64::INFINITY,
            edges: body.surface(),
            contact: Vec::new(),
            multiplier: vec![0.0; nodes],
            load_scale: 0.0,
            remeasured: [0.0; 2],
        }
    }

    /// Parts of each edge that touch; nothing before the first increment.
    pub fn parts(&self) -> impl Iterator<Item = Parts> + '_ {
        (0..self.edges.len()).map(|i| self.contact.get(i).map_or(NOTHING, |c| c.parts))
    }

    /// Begins the trial with the tool's lowest point at `tip` (infinite: without a tool) and the first guess `guess` of the
    /// displacement, which fixed components keep. The last plastic increment is extrapolated as for a step `ratio` times the
    /// last one (0: not at all, as at the start of unloading).
    pub fn begin(
        &self,
        body: &Body<'_>,
        tip: f64,
        ratio: f64,
        guess: impl Fn(usize) -> [f64; 2],
        trial: &mut Trial,
    ) {
        trial.tip = tip;
        trial.multiplier.clone_from(&self.multiplier);
        if tip == f64::INFINITY {
            trial.multiplier.fill(0.0);
        }
        trial.displacement.iter_mut().enumerate().for_each(|(node, du)| *du = guess(node));
        let (factor, material, start) = (extrapolation_factor(ratio), &body.material, &mut trial.start);
        if !self.points.history.is_empty() {
            for q in 0..self.points.states.len() {
                let (state, history) = (&self.points.states[q], &self.points.history[q]);
                (start.states[q], start.history[q]) =
                    kinematic_hardening::extrapolate(material, state, history, &self.plastic[q], factor);
            }
        } else if self.plastic.is_empty() {
            start.states.clone_from(&self.points.states);
        } else {
            for ((start, state), plastic) in
                start.states.iter_mut().zip(&self.points.states).zip(&self.plastic)
            {
                *start = extrapolate(material, state, plastic, factor);
            }
        }
    }

    /// An empty trial of this state's size.
    pub fn trial(&self) -> Trial {
        Trial {
            tip: f64::INFINITY,
            displacement: vec![[0.0; 2]; self.position.len()],
            multiplier: vec![0.0; self.position.len()],
            start: self.points.clone(),
        }
    }

    /// Accepts the converged `trial` with its `response`: the only place where the state of a body changes. The response's
    /// points are taken over; it holds no valid points afterwards.
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

    /// Change of the contact energy by that of the area it is taken over, up to the start of the last increment.
    pub fn remeasured_energy(&self) -> f64 {
        self.remeasured[0]
    }

    /// Takes the stress of the law as Cauchy's instead of Kirchhoff's from here to the next call, with the volume change of
    /// this state: what codes that read the yield stress so would find. Where the material is squeezed hard (steep indenters,
    /// E/σ_y below 100) that is a few percent of the force.
    pub fn weigh(&mut self, body: &Body<'_>) {
        for ((weight, volume), state) in self.weight.iter_mut().zip(&body.volume).zip(&self.points.states) {
            *weight = volume * volume_ratio(&state.stretch);
        }
    }

    /// Force on the tool along z, positive in compression.
    pub fn load(&self) -> f64 {
        self.contact.iter().map(|e| e.load).sum()
    }

    /// Stored elastic energy and plastic work.
    pub fn energies(&self, body: &Body<'_>) -> [f64; 2] {
        let points = &self.points;
        if points.history.is_empty() {
            return [
                stored(&body.material, &points.states, &body.volume),
                dissipated(&body.material, &points.states, &body.volume),
            ];
        }
        let weighted = || points.history.iter().zip(&body.volume);
        [
            weighted().map(|(history, v)| v * elastic_energy(&body.material.elastic, history)).sum(),
            weighted().map(|(history, v)| v * history.plastic_work).sum(),
        ]
    }
}
