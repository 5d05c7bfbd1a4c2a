//! Contact of the surface with the tool: its loop over the edges, what it adds to the system, its energy and multipliers.

use super::{Model, current};
use crate::algebra::dofs::FIXED;
use crate::contact::edge::{NOTHING, Parts};

impl Model<'_> {
    /// Contact loop: forces of the touching edges; returns whether their set changed.
    pub(super) fn assemble_contact(&mut self) -> bool {
        self.edge_contact.clear();
        self.kept_contact = false;
        let Some(contact) = self.contact.filter(|_| self.tip.is_finite()) else { return false };
        let context = contact.at(self.tip, self.symmetry);
        let mut changed = false;
        for (index, edge) in self.edges.iter().enumerate() {
            let x = edge.nodes.map(|node| current(&self.position, &self.increment, node));
            let multiplier = edge.nodes.map(|node| self.multiplier[node as usize]);
            let parts =
                if self.keep_contact { self.parts[index] } else { edge.touching(&context, &x, &multiplier) };
            changed |= shape_of(&parts) != shape_of(&self.touching[index]);
            self.touching[index] = parts;
            let share = edge.integrate(&context, parts, &x, &multiplier);
            self.edge_contact.push(share);
        }
        self.add_contact_forces();
        self.kept_contact = std::mem::take(&mut self.keep_contact);
        changed || self.kept_contact
    }

    /// Adds the forces of the last contact loop to the residual.
    pub(super) fn add_contact_forces(&mut self) {
        for (edge, share) in self.edges.iter().zip(&self.edge_contact).filter(|(_, s)| s.parts != NOTHING) {
            for a in 0..edge.node_count() {
                let row = self.dofs.number[edge.nodes[a] as usize];
                for i in 0..2 {
                    if row[i] != FIXED {
                        self.residual[row[i] as usize] += share.force[a][i];
                    }
                }
            }
        }
    }

    /// Adds the stiffness of the last contact loop to that of the elements.
    pub(super) fn add_contact_stiffness(&mut self) {
        for (edge, share) in self.edges.iter().zip(&self.edge_contact).filter(|(_, s)| s.parts != NOTHING) {
            for a in 0..edge.node_count() {
                let row = self.dofs.number[edge.nodes[a] as usize];
                for b in 0..edge.node_count() {
                    let col = self.dofs.number[edge.nodes[b] as usize];
                    for i in 0..2 {
                        for j in 0..2 {
                            self.stiffness.add_entry(row[i], col[j], share.stiffness[a][i][b][j]);
                        }
                    }
                }
            }
        }
    }

    /// Takes the contact energy over the surface as it is now, under tools that stretch it; what that adds to the energy
    /// is no work of the tool and is kept apart.
    pub(super) fn measure_contact_anew(&mut self) {
        let Some(contact) = self.contact.filter(|c| c.tool.stretches_the_surface()) else { return };
        let context = contact.at(self.tip, self.symmetry);
        let mut change = 0.0;
        for (edge, share) in self.edges.iter_mut().zip(&self.edge_contact) {
            edge.reference = edge.nodes.map(|node| self.position[node as usize]);
            let multiplier = edge.nodes.map(|node| self.multiplier[node as usize]);
            let anew = edge.integrate(&context, share.parts, &edge.reference, &multiplier);
            change += anew.penalty_energy - share.penalty_energy;
        }
        // the sums of this increment are still over the old area
        self.remeasured_energy += std::mem::replace(&mut self.next_remeasured, change);
    }

    /// What the contact energy has changed by because the area it is taken over did.
    pub fn remeasured_energy(&self) -> f64 {
        self.remeasured_energy
    }

    /// Augmented Lagrange update at the nodes, λ ← max(0, λ + ε d), from the converged iterate.
    pub fn augment(&mut self) {
        let Some(contact) = self.contact else { return };
        for edge in &self.edges {
            for &node in &edge.nodes[..edge.node_count()] {
                let x = current(&self.position, &self.increment, node);
                let depth = contact.tool.penetration(x, self.tip).depth;
                self.trial_multiplier[node as usize] =
                    (self.multiplier[node as usize] + contact.penalty * depth).max(0.0);
            }
        }
        self.multiplier.clone_from(&self.trial_multiplier);
        self.keep_contact = false;
    }
}

/// What of an edge touches, as far as it is discrete.
fn shape_of(parts: &Parts) -> [bool; 2] {
    parts.map(|p| p.is_some())
}
