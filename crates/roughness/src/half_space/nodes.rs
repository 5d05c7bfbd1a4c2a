//! Some nodes of a map: a contact takes a few percent of it, and most of the work is about them alone.

use crate::half_space::float::{CHUNK, total};
use rayon::prelude::*;

/// Nodes by chunks of [`CHUNK`], in rising order.
pub(super) struct Nodes(Vec<Vec<u32>>);

impl Nodes {
    /// Those of a map of `n` nodes for which `holds`.
    pub fn select(n: usize, holds: impl Fn(usize) -> bool + Sync) -> Nodes {
        Nodes::select_with_sums(n, |i| (holds(i), [])).0
    }

    /// The same with sums over all nodes, the same for any number of threads.
    pub fn select_with_sums<const K: usize>(
        n: usize,
        of: impl Fn(usize) -> (bool, [f64; K]) + Sync,
    ) -> (Nodes, [f64; K]) {
        let chunk = |k: usize| chosen(k * CHUNK..((k + 1) * CHUNK).min(n), &of);
        gathered((0..n.div_ceil(CHUNK)).into_par_iter().map(chunk).collect())
    }

    /// Those of these for which `of` holds, with sums over all of these.
    pub fn those_with_sums<const K: usize>(
        &self,
        of: impl Fn(usize) -> (bool, [f64; K]) + Sync,
    ) -> (Nodes, [f64; K]) {
        let chunk = |nodes: &Vec<u32>| chosen(nodes.iter().map(|i| *i as usize), &of);
        gathered(self.0.par_iter().map(chunk).collect())
    }

    /// Those of these for which `holds`.
    pub fn those(&self, holds: impl Fn(usize) -> bool + Sync) -> Nodes {
        self.those_with_sums(|i| (holds(i), [])).0
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

    /// The same of two maps at once.
    pub fn set_both<T: Copy + Send + Sync>(
        &self,
        first: &mut [T],
        second: &mut [T],
        to: impl Fn(usize, [T; 2]) -> [T; 2] + Sync,
    ) {
        let chunks = first.par_chunks_mut(CHUNK).zip(second.par_chunks_mut(CHUNK));
        chunks.zip(&self.0).enumerate().for_each(|(k, ((first, second), nodes))| {
            for i in nodes {
                let at = *i as usize - k * CHUNK;
                [first[at], second[at]] = to(*i as usize, [first[at], second[at]]);
            }
        });
    }
}

/// Nodes of one chunk for which `of` holds, with sums over all that it was asked about.
fn chosen<const K: usize>(
    nodes: impl ExactSizeIterator<Item = usize>,
    of: impl Fn(usize) -> (bool, [f64; K]),
) -> (Vec<u32>, [f64; K]) {
    // written whether it holds or not: a branch is guessed wrong at every rim
    let mut list = vec![0; nodes.len()];
    let (mut count, mut sum) = (0, [0.0; K]);
    for i in nodes {
        let (holds, terms) = of(i);
        list[count] = i as u32;
        count += usize::from(holds);
        sum.iter_mut().zip(terms).for_each(|(a, b)| *a += b);
    }
    list.truncate(count);
    (list, sum)
}

fn gathered<const K: usize>(chunks: Vec<(Vec<u32>, [f64; K])>) -> (Nodes, [f64; K]) {
    let (lists, sums): (Vec<_>, Vec<_>) = chunks.into_iter().unzip();
    (Nodes(lists), total(&sums))
}
