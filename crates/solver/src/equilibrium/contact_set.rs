//! Parts of the surface that touch the tool, from iterate to iterate.

use crate::body::assembly::Touching;
use crate::contact::edge::EdgeContact;
use crate::contact::parts::{NOTHING, Parts};

/// The parts that touched at the last assessed iterate, and whether they are kept at the next.
pub(super) struct ContactSet {
    touching: Vec<Parts>,
    /// True where the next assembly keeps the contact of the converged state.
    keep: bool,
    /// True where the last one did.
    kept: bool,
}

impl ContactSet {
    /// Of so many edges, none of which touches.
    pub fn new(edges: usize) -> ContactSet {
        ContactSet { touching: vec![NOTHING; edges], keep: false, kept: false }
    }

    /// The next assembly keeps the `parts` of the converged state, if any of them touches.
    pub fn keep(&mut self, parts: impl Iterator<Item = Parts>) {
        self.touching.fill(NOTHING);
        self.touching.iter_mut().zip(parts).for_each(|(touching, kept)| *touching = kept);
        self.keep = self.touching.iter().any(|p| *p != NOTHING);
    }

    /// Sets for the next assemblies whether the contact of the converged state is kept.
    pub fn set_keeping(&mut self, keep: bool) {
        self.keep = keep;
    }

    /// True where the last assembly kept it.
    pub fn was_kept(&self) -> bool {
        self.kept
    }

    /// The task of the next assembly.
    pub fn next(&self) -> Touching {
        if self.keep { Touching::Kept } else { Touching::Found }
    }

    /// Takes down the `contact` that was assembled; the one after it finds what touches. Whether the parts
    /// that touch changed since the last assessed iterate, or are still to be found.
    pub fn note(&mut self, contact: &[EdgeContact]) -> bool {
        self.kept = std::mem::take(&mut self.keep);
        let shape_of = |parts: &Parts| parts.map(|p| p.is_some());
        let mut changed = false;
        for (before, now) in self.touching.iter_mut().zip(contact) {
            changed |= shape_of(before) != shape_of(&now.parts);
            *before = now.parts;
        }
        changed || self.kept
    }
}
