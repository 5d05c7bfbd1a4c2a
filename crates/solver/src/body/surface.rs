//! The free surface of a body and its contact, as a converged state or a trial shows them.

use crate::body::assembly::Response;
use crate::body::discrete_body::Body;
use crate::body::elements::current;
use crate::body::state::{State, Trial};
use crate::contact::depth_correction::{Punches, under_punches};
use crate::contact::edge::{ContactEdge, EdgeContact};
use crate::contact::tool::{Penetration, Tool};

/// Positions of the surface's nodes with the contact there.
pub struct Surface<'a> {
    body: &'a Body<'a>,
    /// The edges, in the order of the mesh.
    pub edges: &'a [ContactEdge],
    /// Contact of each edge; empty without a tool.
    pub contact: &'a [EdgeContact],
    position: &'a [[f64; 2]],
    /// Displacement beyond `position` in a trial.
    displacement: Option<&'a [[f64; 2]]>,
    tip: f64,
    penalty: f64,
}

impl<'a> Surface<'a> {
    /// Of a converged state.
    pub fn of_state(body: &'a Body<'a>, state: &'a State) -> Surface<'a> {
        Surface {
            body,
            edges: &state.edges,
            contact: &state.contact,
            position: &state.position,
            displacement: None,
            tip: state.tip,
            penalty: state.penalty,
        }
    }

    /// Of a trial that was assembled.
    pub fn of_trial(
        body: &'a Body<'a>,
        state: &'a State,
        trial: &'a Trial,
        response: &'a Response,
    ) -> Surface<'a> {
        Surface {
            contact: &response.contact,
            displacement: Some(&trial.displacement),
            tip: trial.tip,
            penalty: trial.penalty,
            ..Surface::of_state(body, state)
        }
    }

    /// Position of a node.
    pub fn position(&self, node: u32) -> [f64; 2] {
        match self.displacement {
            None => self.position[node as usize],
            Some(displacement) => current(self.position, displacement, node),
        }
    }

    /// The same surface under a tool whose lowest point is at height `tip`.
    #[must_use]
    pub fn under_tool_at(self, tip: f64) -> Surface<'a> {
        Surface { tip, ..self }
    }

    /// Way between the tool and the nearest node that lies between two `sides`: 0 or less where it touches.
    pub fn clearance(&self, [left, right]: [f64; 2]) -> f64 {
        let places = self.edges.iter().flat_map(|edge| edge.nodes).map(|node| self.position(node));
        let within = places.filter(|x| (left..=right).contains(&x[0]));
        within.map(|x| -self.penetration_of(x)).fold(f64::INFINITY, f64::min)
    }

    /// Penetration of the point `x` into the tool where it stands; -∞ without a tool.
    pub fn penetration_of(&self, x: [f64; 2]) -> f64 {
        match &self.body.contact {
            Some(contact) if self.tip.is_finite() => contact.tool.penetration(x, self.tip).depth,
            _ => f64::NEG_INFINITY,
        }
    }

    /// Penalty correction if the material is elastic, and the elastic energy near the contacts.
    pub fn under_punches(&self) -> Punches {
        under_punches(
            self.edges.iter().zip(self.contact),
            self.body.symmetry,
            |node| self.position(node),
            |x| self.penetration_of(x),
        )
    }

    /// Travel of the tool down from height 0 until it touches this surface.
    pub fn first_touch(&self) -> f64 {
        let Some(contact) = &self.body.contact else { return 0.0 };
        // the way along z to the flank, exact for planes and cones; repeated for round tools. A point beside
        // the widest place of a ball does not see it
        let along_z = |inside: Penetration| inside.depth / inside.slope[1].max(0.1);
        let ends = self.edges.iter().flat_map(|edge| edge.nodes);
        let size = ends.flat_map(|node| self.position(node)).fold(0.0, |most: f64, x| most.max(x.abs()));
        let mut travel = 0.0;
        for _ in 0..20 {
            let depth = self
                .edges
                .iter()
                .flat_map(|edge| edge.nodes)
                .map(|node| along_z(contact.tool.penetration(self.position(node), -travel)))
                .fold(f64::NEG_INFINITY, f64::max);
            travel -= depth;
            if contact.tool == Tool::Plane || depth.abs() <= f64::EPSILON * size {
                break;
            }
        }
        travel
    }

    /// Contact pressure per current area at ξ of `edge`, negative off the contact; 0 without a tool.
    pub fn nodal_pressure(&self, edge: &ContactEdge, xi: f64) -> f64 {
        let Some(contact) = &self.body.contact else { return 0.0 };
        let x = edge.nodes.map(|node| self.position(node));
        let depth = contact.tool.penetration(edge.point(&x, xi), self.tip).depth;
        self.penalty * depth / edge.stretch(&x, xi)
    }
}
