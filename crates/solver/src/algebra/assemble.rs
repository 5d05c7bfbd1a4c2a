//! The pattern of the stiffness matrix (lower triangle, compressed columns) and where each element's entries go.

use crate::algebra::dofs::{Dofs, FIXED};
use sprs::{CsMat, TriMat};

/// No place: the row or column is fixed.
const NOWHERE: u32 = u32::MAX;

/// A symmetric sparse matrix with the places of all element entries.
#[derive(Clone, Debug)]
pub struct Stiffness {
    /// Lower triangle in compressed columns.
    pub matrix: CsMat<f64>,
    /// For each element, column by column of its lower triangle, the value index of entry (2a + i, 2b + j).
    places: Vec<u32>,
    /// 2N.
    size: usize,
}

/// Numbers of the components of a cell, node by node.
fn numbers_of(cell: &[u32], dofs: &Dofs) -> Vec<u32> {
    cell.iter().flat_map(|&node| dofs.number[node as usize]).collect()
}

/// The lower triangle of a matrix of zeros where `groups` of nodes couple unknowns.
fn pattern<'a>(groups: impl Iterator<Item = &'a [u32]>, dofs: &Dofs) -> CsMat<f64> {
    let mut pattern = TriMat::new((dofs.count, dofs.count));
    for group in groups {
        let numbers = numbers_of(group, dofs);
        for &col in &numbers {
            for &row in &numbers {
                if row != FIXED && col != FIXED && row >= col {
                    pattern.add_triplet(row as usize, col as usize, 0.0);
                }
            }
        }
    }
    pattern.to_csc()
}

impl Stiffness {
    /// Analyses elements of `nodes_per_cell` nodes.
    pub fn new(cells: &[u32], nodes_per_cell: usize, dofs: &Dofs) -> Stiffness {
        Stiffness::coupled(cells, nodes_per_cell, &[], dofs)
    }

    /// Analyses elements of `nodes_per_cell` nodes and further groups of nodes that act on each other.
    pub fn coupled(cells: &[u32], nodes_per_cell: usize, groups: &[Vec<u32>], dofs: &Dofs) -> Stiffness {
        let size = 2 * nodes_per_cell;
        let matrix =
            pattern(cells.chunks_exact(nodes_per_cell).chain(groups.iter().map(Vec::as_slice)), dofs);
        let mut places = Vec::with_capacity(cells.len() * (size + 1));
        for cell in cells.chunks_exact(nodes_per_cell) {
            let numbers = numbers_of(cell, dofs);
            for (first, &col) in numbers.iter().enumerate() {
                for &row in &numbers[first..] {
                    let (row, col) = (row.max(col), row.min(col));
                    let place = matrix.nnz_index(row as usize, col as usize).filter(|_| row != FIXED);
                    places.push(place.map_or(NOWHERE, |i| i.0 as u32));
                }
            }
        }
        Stiffness { matrix, places, size }
    }

    /// Adds to every diagonal entry `share` of its size.
    pub fn stiffen(&mut self, share: f64) {
        for mut column in self.matrix.outer_iterator_mut() {
            // the diagonal is the first entry of each column of a lower triangle
            if let Some((_, diagonal)) = column.iter_mut().next() {
                *diagonal += share * diagonal.abs();
            }
        }
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        self.matrix.data_mut().fill(0.0);
    }

    /// Adds the lower triangle of the symmetric stiffness of element `cell`, column by column.
    pub fn add(&mut self, cell: usize, stiffness: &[f64]) {
        let length = self.size * (self.size + 1) / 2;
        let values = self.matrix.data_mut();
        for (&place, &entry) in self.places[cell * length..(cell + 1) * length].iter().zip(stiffness) {
            if place != NOWHERE {
                values[place as usize] += entry;
            }
        }
    }

    /// Whether the pattern couples these nodes.
    pub fn couples(&self, nodes: &[u32], dofs: &Dofs) -> bool {
        let numbers = numbers_of(nodes, dofs);
        let free = || numbers.iter().copied().filter(|&number| number != FIXED);
        free().all(|row| {
            free().all(|col| row < col || self.matrix.nnz_index(row as usize, col as usize).is_some())
        })
    }

    /// Adds `value` at (row, col) of two components in the same element; entries above the diagonal are skipped.
    pub fn add_entry(&mut self, row: u32, col: u32, value: f64) {
        if row == FIXED || col == FIXED || row < col {
            return;
        }
        if let Some(place) = self.matrix.nnz_index(row as usize, col as usize) {
            self.matrix.data_mut()[place.0] += value;
        }
    }
}
