//! What a model shows of itself: contact, positions, states, the assembled system.

use super::{Model, current};
use crate::algebra::roofline::Operations;
use crate::contact::edge::{ContactEdge, EdgeContact};
use crate::contact::penalty_correction::{Punches, under_punches};
use crate::contact::tool::{Penetration, Tool};
use crate::point::kinematics::Symmetry;
use crate::point::material::{Metal, PointState};
use asperity_mesh::Mesh;

impl Model<'_> {
    /// Force on the tool along z at the iterate, positive in compression.
    pub fn load(&self) -> f64 {
        self.edge_contact.iter().map(|e| e.load).sum()
    }

    /// Contact of every surface edge at the iterate, in the order of the mesh.
    pub fn contacts(&self) -> &[EdgeContact] {
        &self.edge_contact
    }

    /// Position of a node at the iterate (the converged one once an increment is accepted).
    pub fn current_position(&self, node: u32) -> [f64; 2] {
        if self.settled {
            self.position[node as usize]
        } else {
            current(&self.position, &self.increment, node)
        }
    }

    /// Penetration of the point `x` into the tool where it stands; -∞ without a tool.
    pub fn penetration_of(&self, x: [f64; 2]) -> f64 {
        match self.contact {
            Some(contact) if self.tip.is_finite() => contact.tool.penetration(x, self.tip).depth,
            _ => f64::NEG_INFINITY,
        }
    }

    /// What the penetration takes of the depth if the metal is elastic, and the elastic energy near the contacts.
    pub fn under_punches(&self) -> Punches {
        under_punches(
            self.edges.iter().zip(&self.edge_contact),
            self.symmetry,
            |node| self.current_position(node),
            |x| self.penetration_of(x),
        )
    }

    /// The surface edges, in the order of the mesh.
    pub fn edges(&self) -> &[ContactEdge] {
        &self.edges
    }

    /// Whether cell `cell` flows in the increment under way, or flowed in the last one once that is accepted.
    pub fn flows(&self, cell: usize) -> bool {
        self.flowing[cell]
    }

    /// Contact pressure per current area at the node of `edge` that lies at ξ, negative off the contact.
    pub fn nodal_pressure(&self, edge: &ContactEdge, x: &[[f64; 2]; 3], node: u32, xi: f64) -> f64 {
        let Some(contact) = self.contact else { return 0.0 };
        let depth = contact.tool.penetration(edge.point(x, xi), self.tip).depth;
        (self.multiplier[node as usize] + contact.penalty * depth) / edge.stretch(x, xi)
    }

    /// What a factorisation of its stiffness and a solve take.
    pub fn operations(&self) -> Operations {
        self.factor.operations()
    }

    /// Last converged node positions.
    pub fn positions(&self) -> &[[f64; 2]] {
        &self.position
    }

    /// Last converged point states, four to an element.
    pub fn states(&self) -> &[PointState] {
        &self.old
    }

    /// Reference volumes of the points.
    pub fn volumes(&self) -> &[f64] {
        &self.volume
    }

    /// Displacements of the last accepted increment.
    pub fn accepted_increment(&self) -> &[[f64; 2]] {
        &self.accepted
    }

    /// How far the tool must travel down from height 0 to touch the converged surface.
    pub fn first_touch(&self) -> f64 {
        self.touch(|node| self.position[node as usize])
    }

    /// The same at the iterate.
    pub fn first_touch_at_iterate(&self) -> f64 {
        self.touch(|node| current(&self.position, &self.increment, node))
    }

    fn touch(&self, position: impl Fn(u32) -> [f64; 2]) -> f64 {
        let Some(contact) = self.contact else { return 0.0 };
        // the way along z to the flank, exact for planes and cones; repeated for round tools. A point beside the
        // widest place of a ball does not see it
        let along_z = |inside: Penetration| inside.depth / inside.slope[1].max(0.1);
        let mut travel = 0.0;
        for _ in 0..20 {
            let depth = self
                .edges
                .iter()
                .flat_map(|edge| edge.nodes)
                .map(|node| along_z(contact.tool.penetration(position(node), -travel)))
                .fold(f64::NEG_INFINITY, f64::max);
            travel -= depth;
            if contact.tool == Tool::Plane || depth.abs() <= 1e-15 {
                break;
            }
        }
        travel
    }

    /// Internal nodal forces at the iterate: reactions where a component is held.
    pub fn internal_forces(&self) -> &[[f64; 2]] {
        &self.internal
    }

    /// Out-of-balance forces at the iterate, by the numbers of the unknowns.
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Stiffness at the iterate: lower triangle, by the numbers of the unknowns.
    pub fn stiffness(&self) -> &sprs::CsMat<f64> {
        &self.stiffness.matrix
    }

    /// Numbers of the displacement components of each node, [`FIXED`] where held.
    pub fn numbers(&self) -> &[[u32; 2]] {
        &self.dofs.number
    }

    /// Whether each point flows at the iterate.
    pub fn flowing_points(&self) -> impl Iterator<Item = bool> + '_ {
        self.new.iter().zip(&self.start).map(|(new, start)| new.plastic_strain > start.plastic_strain)
    }

    /// The metal.
    pub fn metal(&self) -> &Metal {
        &self.metal
    }

    /// The mesh.
    pub fn mesh(&self) -> &Mesh {
        self.mesh
    }

    /// Axisymmetric or plane strain.
    pub fn symmetry(&self) -> Symmetry {
        self.symmetry
    }

    /// Number of unknowns.
    pub fn unknowns(&self) -> usize {
        self.dofs.count
    }
}
