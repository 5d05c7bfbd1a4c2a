//! What the points of a model remember beside their states where the metal has a back stress.

use super::Model;
use crate::body::energy::{dissipated, stored};
use crate::element::kernel::POINTS;
use crate::point::bdf2::Flowed;
use crate::point::kinematic_hardening::{Memory, carry_on, elastic_energy, settle};

/// Memories of all points; a model of a metal without back stress has none.
pub(super) struct BackStress {
    /// Of the last converged state.
    pub old: Vec<Memory>,
    /// What the increment under way starts from.
    pub start: Vec<Memory>,
    /// At the iterate.
    pub new: Vec<Memory>,
}

impl BackStress {
    /// `count` points that remember nothing.
    pub fn new(count: usize) -> BackStress {
        let virgin = vec![Memory::default(); count];
        BackStress { old: virgin.clone(), start: virgin.clone(), new: virgin }
    }
}

impl Model<'_> {
    /// Starts an increment of a metal with a back stress; `false`: it has none.
    pub(super) fn carry_back_stress_on(&mut self, factor: f64) -> bool {
        let Some(back) = &mut self.back_stress else { return false };
        for q in 0..self.start.len() {
            (self.start[q], back.start[q]) =
                carry_on(&self.metal, &self.old[q], &back.old[q], &self.flowed[q], factor);
        }
        true
    }

    /// Completes the flow of a converged increment of a metal with a back stress; `false`: it has none.
    pub(super) fn settle_back_stress(&mut self) -> bool {
        let Some(back) = &mut self.back_stress else { return false };
        for q in 0..self.new.len() {
            let before = (&self.old[q], &back.old[q]);
            let flowed = settle(&self.metal, before, (&mut self.new[q], &mut back.new[q]));
            // as without back stress: what no longer flows is not carried on a second time
            let still = Flowed { strain: [0.0; 4], accumulated: 0.0 };
            self.flowed[q] = if self.flowing[q / POINTS] { flowed } else { still };
        }
        back.old.clone_from(&back.new);
        true
    }

    /// Stored elastic energy and plastic work of the converged state.
    pub fn energies(&self) -> [f64; 2] {
        match &self.back_stress {
            None => [
                stored(&self.metal, &self.old, &self.volume),
                dissipated(&self.metal, &self.old, &self.volume),
            ],
            Some(back) => {
                let points = || back.old.iter().zip(&self.volume);
                [
                    points().map(|(memory, v)| v * elastic_energy(&self.metal.elastic, memory)).sum(),
                    points().map(|(memory, v)| v * memory.plastic_work).sum(),
                ]
            }
        }
    }
}
