//! Analysis of the topology of a mesh, before any number is known: the order of elimination, the numbers of
//! the unknowns, the pattern of the stiffness and the fronts of its factorisation.
//!
//! To analyse a mesh takes a twentieth of a crush at `standard`. The cases of a sweep are meshes of few
//! topologies: its owner keeps the last [`Analyses`] and hands them from case to case, so that each is made
//! once.

use crate::body::dofs::Dofs;
use crate::body::stiffness::Stiffness;
use asperity_numerics::sparse::failure::FactorError;
use asperity_numerics::sparse::fill_ordering::elimination_order;
use asperity_numerics::sparse::front_tree::FrontTree;
use std::sync::{Arc, Mutex, PoisonError};

/// Analyses kept for each thread: those of a run and its companion, and of the two before.
const KEPT_PER_THREAD: usize = 4;

/// Numbers of nodes in cells up to which an analysis is kept: with more, it takes memory, and little of the
/// time of a run.
const KEPT_NODES: usize = 40_000;

/// A mesh without its geometry.
#[derive(Clone, Debug, PartialEq)]
struct Topology {
    cells: Vec<u32>,
    nodes_per_cell: usize,
    /// Components of each node that are prescribed.
    fixed: Vec<[bool; 2]>,
}

/// Consequences of the topology.
#[derive(Debug)]
pub struct Analysis {
    /// Numbers of the unknowns, in the order of elimination: the matrix is never permuted again.
    pub dofs: Dofs,
    /// The stiffness, all values zero.
    pub stiffness: Stiffness,
    /// Fronts of its factorisation.
    pub fronts: Arc<FrontTree>,
}

/// The last analyses that were made, newest first.
type Last = Vec<(Topology, Arc<Analysis>)>;

/// The last few analyses, for meshes of the same topology. Clones share them, on any number of threads; a
/// result does not depend on what they hold.
#[derive(Clone, Debug)]
pub struct Analyses {
    last: Arc<Mutex<Last>>,
    /// So many are kept.
    most: usize,
}

impl Default for Analyses {
    fn default() -> Analyses {
        Analyses::for_threads(1)
    }
}

impl Analyses {
    /// Enough of them for runs on so many `threads` at a time, none made yet.
    pub fn for_threads(threads: usize) -> Analyses {
        Analyses { last: Arc::default(), most: KEPT_PER_THREAD * threads }
    }

    /// That of `cells` with `nodes_per_cell` nodes each, whose displacement components named by `fixed` for
    /// each node are prescribed.
    ///
    /// # Errors
    /// A pattern with more entries than can be counted.
    pub fn analyse(
        &self,
        cells: &[u32],
        nodes_per_cell: usize,
        fixed: &[[bool; 2]],
    ) -> Result<Arc<Analysis>, FactorError> {
        let matches = |topology: &Topology| {
            topology.nodes_per_cell == nodes_per_cell && topology.cells == cells && topology.fixed == fixed
        };
        // what a thread that panicked left is whole
        let last = || self.last.lock().unwrap_or_else(PoisonError::into_inner);
        let known = last().iter().find(|(topology, _)| matches(topology)).map(|(_, known)| known.clone());
        if let Some(analysis) = known {
            return Ok(analysis);
        }
        let analysis = Arc::new(Analysis::new(cells, nodes_per_cell, fixed)?);
        if cells.len() <= KEPT_NODES {
            let topology = Topology { cells: cells.to_vec(), nodes_per_cell, fixed: fixed.to_vec() };
            let mut last = last();
            last.insert(0, (topology, analysis.clone()));
            last.truncate(self.most);
        }
        Ok(analysis)
    }
}

impl Analysis {
    fn new(cells: &[u32], nodes_per_cell: usize, fixed: &[[bool; 2]]) -> Result<Analysis, FactorError> {
        // nodes that no element uses have no stiffness
        let mut used = vec![false; fixed.len()];
        cells.iter().for_each(|&node| used[node as usize] = true);
        let fixed = |node: usize| if used[node] { fixed[node] } else { [true; 2] };
        let free: Vec<bool> = (0..used.len()).map(|node| fixed(node) != [true; 2]).collect();
        let order = elimination_order(cells, nodes_per_cell, &free)?;
        let dofs = Dofs::new(used.len(), &order, fixed);
        let stiffness = Stiffness::new(cells, nodes_per_cell, &dofs);
        let fronts = Arc::new(FrontTree::new(&stiffness.matrix));
        Ok(Analysis { dofs, stiffness, fronts })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two four-node elements side by side.
    const CELLS: [u32; 8] = [0, 1, 4, 3, 1, 2, 5, 4];

    #[test]
    fn a_topology_is_analysed_once() {
        let (free, analyses) = ([[false; 2]; 6], Analyses::default());
        let first = analyses.analyse(&CELLS, 4, &free).unwrap();
        assert!(Arc::ptr_eq(&first, &analyses.clone().analyse(&CELLS, 4, &free).unwrap()));
        let other = Analyses::default().analyse(&CELLS, 4, &free).unwrap();
        assert!(!Arc::ptr_eq(&first, &other) && first.dofs.number == other.dofs.number);
        assert_eq!(first.dofs.count, 12);
    }

    #[test]
    fn other_cells_and_other_fixed_components_are_analysed_anew() {
        let (free, analyses) = ([[false; 2]; 6], Analyses::default());
        let first = analyses.analyse(&CELLS, 4, &free).unwrap();
        let held: [[bool; 2]; 6] = std::array::from_fn(|node| [node == 0, node < 3]);
        let other = analyses.analyse(&CELLS, 4, &held).unwrap();
        assert_eq!((first.dofs.count, other.dofs.count), (12, 8));
        let one = analyses.analyse(&CELLS[..4], 4, &free).unwrap();
        // two of the six nodes belong to no element
        assert_eq!(one.dofs.count, 8);
        (0..KEPT_PER_THREAD as u32)
            .for_each(|i| drop(analyses.analyse(&[i, i + 1, i + 2, i + 3], 4, &[[false; 2]; 9])));
        let again = analyses.analyse(&CELLS, 4, &free).unwrap();
        assert!(!Arc::ptr_eq(&first, &again) && again.dofs.number == first.dofs.number);
    }
}
