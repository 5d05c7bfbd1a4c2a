//! The converged state of a body, and the increment that is tried from it.

use crate::body::discrete_body::Body;
use crate::body::energy::{dissipated, stored};
use crate::contact::edge::{ContactEdge, EdgeContact, NOTHING, Parts};
use crate::point::bdf2::{PlasticIncrement, extrapolate, extrapolation_factor};
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
    pub(super) remeasured: [f64; 2],
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
