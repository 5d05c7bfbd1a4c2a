//! Some nodes of a map: a contact takes a few percent of it, and most of the work is about them alone.

use crate::half_space::float::{CHUNK, total};
use rayon::prelude::*;

/// Nodes by chunks of [`CHUNK`], in rising order.
pub(super) struct Nodes(Vec<Vec<u32>>);

impl Nodes {
    /// Those of a map of `n` nodes for which `holds`.
    pub fn select(n: usize, holds: impl Fn(usize) -> bool + Sync) -> Nodes {
        let chunk = |k: usize| {
            let range = k * CHUNK..((k + 1) * CHUNK).min(n);
            range.filter(|i| holds(*i)).map(|i| i as u32).collect()
        };
        Nodes((0..n.div_ceil(CHUNK)).into_par_iter().map(chunk).collect())
    }

    /// Those of these for which `holds`.
    pub fn those(&self, holds: impl Fn(usize) -> bool + Sync) -> Nodes {
        let chunk = |nodes: &Vec<u32>| nodes.iter().copied().filter(|i| holds(*i as usize)).collect();
        Nodes(self.0.par_iter().map(chunk).collect())
    }

    /// Sums over the nodes, the same for any number of threads.
    pub fn sums<const K: usize>(&self, of: impl Fn(usize) -> [f64; K] + Sync) -> [f64; K] {
        let chunk = |nodes: &Vec<u32>| {
            nodes.iter().fold([0.0; K], |mut sum, i| {
                sum.iter_mut().zip(of(*i as usize)).for_each(|(a, b)| *a += b);
                sum
            })
        };
        let parts: Vec<[f64; K]> = self.0.par_iter().map(chunk).collect();
        total(&parts)
    }

    /// Sets the values of the nodes among those of the whole map, from what they are.
    pub fn set<T: Copy + Send + Sync>(&self, values: &mut [T], to: impl Fn(usize, T) -> T + Sync) {
        values.par_chunks_mut(CHUNK).zip(&self.0).enumerate().for_each(|(k, (values, nodes))| {
            for i in nodes {
                let value = &mut values[*i as usize - k * CHUNK];
                *value = to(*i as usize, *value);
            }
        });
    }
}
