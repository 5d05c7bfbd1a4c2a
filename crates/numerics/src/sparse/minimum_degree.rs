//! Orders of elimination and elimination trees, found by faer.

use crate::sparse::failure::FactorError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use faer::sparse::linalg::cholesky::simplicial;

/// For each vertex of a graph (compressed columns without the diagonal) its place in an order of approximate
/// minimum degree.
///
/// # Errors
/// More edges than can be counted.
pub fn minimum_degree(starts: &[usize], neighbours: &[usize]) -> Result<Vec<usize>, FactorError> {
    let size = starts.len() - 1;
    let (mut order, mut place) = (vec![0; size], vec![0; size]);
    let mut memory = MemBuffer::new(amd::order_scratch::<usize>(size, neighbours.len()));
    let pattern = SymbolicSparseColMatRef::new_checked(size, size, starts, None, neighbours);
    amd::order(&mut order, &mut place, pattern, amd::Control::default(), MemStack::new(&mut memory))
        .map_err(|_| FactorError::Singular)?;
    Ok(place)
}

/// The elimination tree of a symmetric matrix, of which the upper triangle counts (compressed columns, with
/// its diagonal or without).
pub struct EliminationTree {
    /// Parent of each column; `None`: a root.
    pub parent: Vec<Option<usize>>,
    /// Entries of each column of the Cholesky factor, its diagonal included.
    pub count: Vec<usize>,
}

/// The elimination tree of the pattern whose columns start at `starts` and have the rows `neighbours`.
pub fn elimination_tree(starts: &[usize], neighbours: &[usize]) -> EliminationTree {
    let size = starts.len() - 1;
    let (mut tree, mut counts) = (vec![0_isize; size], vec![0_usize; size]);
    let request = simplicial::prefactorize_symbolic_cholesky_scratch::<usize>(size, neighbours.len());
    let mut memory = MemBuffer::new(request);
    let pattern = SymbolicSparseColMatRef::new_checked(size, size, starts, None, neighbours);
    simplicial::prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, MemStack::new(&mut memory));
    let parent = tree.into_iter().map(|parent| usize::try_from(parent).ok()).collect();
    EliminationTree { parent, count: counts }
}
