//! The converged state of a body, and the increment that is tried from it.

use crate::body::discrete_body::Body;
use crate::body::energy::stored;
use crate::contact::edge::{ContactEdge, EdgeContact};
use crate::contact::parts::{NOTHING, Parts};
use crate::contact::self_contact::Facing;
use crate::element::kernel::PointSlice;
use crate::point::bdf2::PlasticIncrement;
use crate::point::kinematic_hardening::{History, elastic_energy};
use crate::point::material::{Metal, PointState, Spectral};

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

    /// Elastic energy that they store.
    pub fn elastic_energy(&self, body: &Body<'_>) -> f64 {
        if self.history.is_empty() {
            return stored(&body.material, &self.states, &body.volume);
        }
        let of = |(history, v): (&History, &f64)| v * elastic_energy(&body.material.elastic, history);
        self.history.iter().zip(&body.volume).map(of).sum()
    }

    /// Those of one element.
    pub fn slice<'a>(&'a self, body: &'a Body<'_>, cell: usize) -> PointSlice<'a> {
        let range = Body::points_of(cell);
        PointSlice {
            states: &self.states[range.clone()],
            weight: &body.volume[range.clone()],
            history: self.history.get(range).unwrap_or_default(),
            updated: None,
        }
    }
}

/// A converged state: all that the next increment starts from.
#[derive(Clone, Debug)]
pub struct State {
    /// Place before loading of the metal that is at each node now.
    pub origin: Vec<[f64; 2]>,
    /// Node positions.
    pub position: Vec<[f64; 2]>,
    /// Displacements of the last increment.
    pub displacement: Vec<[f64; 2]>,
    /// Integration points.
    pub points: Points,
    /// Plastic increment of each point in the last increment; empty for an elastic body.
    pub plastic: Vec<PlasticIncrement>,
    /// Change of each point's volume ratio J in the last increment; empty where the yield stress does not
    /// depend on it.
    pub volume_change: Vec<f64>,
    /// True for each element that yielded in the last increment.
    pub yielding: Vec<bool>,
    /// Height of the tool's lowest point; infinite without a tool.
    pub tip: f64,
    /// Contact pressure per penetration.
    pub penalty: f64,
    /// The surface, with the positions over whose area the contact energy is taken.
    pub edges: Vec<ContactEdge>,
    /// Contact of each edge.
    pub contact: Vec<EdgeContact>,
    /// Points of the surface that face other parts of it.
    pub facing: Facing,
    /// Largest load so far.
    pub load_scale: f64,
    /// Energies that are counted along the way.
    pub ledger: Ledger,
}

/// Energies that no state alone tells: they are counted along the way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// Plastic work so far.
    pub plastic_work: f64,
    /// Energy of the contact of the surface with itself.
    pub self_contact: f64,
    /// Work that friction has taken so far.
    pub friction_work: f64,
    /// Change of the contact energy by that of the area it is taken over and of the penalty, up to the last
    /// increment and after it.
    pub remeasured: [f64; 2],
    /// Change of the stored energy, the plastic work and the contact energy by all transfers to better
    /// meshes.
    pub transferred: f64,
    /// Number of transfers.
    pub transfers: usize,
}

/// A body after its loads, the tool gone: shape, hardening, residual stress. Lengths in any unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Unloaded {
    /// Place before all loading of the metal that is at each node now.
    origin: Vec<[f64; 2]>,
    /// Node positions.
    pub position: Vec<[f64; 2]>,
    /// Integration points.
    pub points: Points,
    /// Reference volume of each of them.
    volume: Vec<f64>,
}

/// An increment that is tried from a converged state.
#[derive(Clone, Debug)]
pub struct Trial {
    /// Height of the tool's lowest point; infinite without a tool.
    pub tip: f64,
    /// The same at the converged state, or where the tool touches that first; of a smooth tool that is not
    /// asked for.
    pub tip_before: f64,
    /// Contact pressure per penetration.
    pub penalty: f64,
    /// Displacement of each node from the converged state.
    pub displacement: Vec<[f64; 2]>,
    /// States that the points start from: the converged ones with the last plastic increment extrapolated.
    pub start: Points,
    /// κ of that extrapolation.
    pub factor: f64,
}

impl State {
    /// The stress-free state of `body`.
    pub fn virgin(body: &Body<'_>) -> State {
        let count = body.volume.len();
        let yields = body.material.hardening.is_some() || body.material.has_back_stress();
        let (edges, still) = (body.surface(&body.mesh.nodes), vec![[0.0; 2]; body.mesh.nodes.len()]);
        State {
            facing: Facing::new(&edges, &body.mesh.nodes, &still, &Facing::default()),
            origin: body.mesh.nodes.clone(),
            position: body.mesh.nodes.clone(),
            displacement: still,
            points: Points::virgin(&body.material, count),
            plastic: vec![PlasticIncrement::NONE; if yields { count } else { 0 }],
            volume_change: vec![0.0; if yields && body.material.yields_by_true_stress() { count } else { 0 }],
            yielding: vec![false; body.mesh.cell_count()],
            tip: f64::INFINITY,
            penalty: body.contact.as_ref().map_or(0.0, |contact| contact.penalty),
            edges,
            contact: Vec::new(),
            load_scale: 0.0,
            ledger: Ledger::default(),
        }
    }

    /// The body after its loads, of a state without a tool.
    pub fn unloaded(&self, body: &Body<'_>) -> Unloaded {
        Unloaded {
            origin: self.origin.clone(),
            position: self.position.clone(),
            points: self.points.clone(),
            volume: body.volume.clone(),
        }
    }

    /// The body and its state out of contact, as earlier loads left it.
    pub fn of_unloaded<'m>(mut body: Body<'m>, left: &Unloaded) -> (Body<'m>, State) {
        body.volume.clone_from(&left.volume);
        let virgin = State::virgin(&body);
        let edges = body.surface(&left.position);
        let state = State {
            facing: Facing::new(&edges, &left.position, &virgin.displacement, &Facing::default()),
            origin: left.origin.clone(),
            position: left.position.clone(),
            points: left.points.clone(),
            edges,
            ..virgin
        };
        (body, state)
    }

    /// Parts of each edge that touch; nothing before the first increment.
    pub fn parts(&self) -> impl Iterator<Item = Parts> + '_ {
        (0..self.edges.len()).map(|i| self.contact.get(i).map_or(NOTHING, |c| c.parts))
    }

    /// An empty trial of this state's size.
    pub fn trial(&self) -> Trial {
        Trial {
            tip: f64::INFINITY,
            tip_before: self.tip,
            penalty: self.penalty,
            displacement: vec![[0.0; 2]; self.position.len()],
            start: self.points.clone(),
            factor: 0.0,
        }
    }

    /// Change of the contact energy that is no work of the tool: by that of the area it is taken over and of
    /// the penalty, up to the last increment.
    pub fn remeasured_energy(&self) -> f64 {
        self.ledger.remeasured[0]
    }

    /// Force on the tool along z, positive in compression.
    pub fn load(&self) -> f64 {
        self.contact.iter().map(|e| e.load).sum()
    }

    /// The largest elastic logarithmic strain in a principal direction, without its sign.
    pub fn largest_elastic_strain(&self) -> f64 {
        let elastic = self.points.states.iter().filter_map(|point| Spectral::new(&point.b_minus_i).ok());
        elastic
            .flat_map(|spectral| spectral.log_strain)
            .fold(0.0, |largest, strain| largest.max(strain.abs()))
    }

    /// Stored elastic energy and plastic work.
    pub fn energies(&self, body: &Body<'_>) -> [f64; 2] {
        [self.points.elastic_energy(body), self.ledger.plastic_work]
    }
}
