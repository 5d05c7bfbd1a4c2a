//! The pattern of the stiffness matrix (lower triangle, compressed columns) and where each element's entries
//! go.

use crate::body::dofs::{Dofs, FIXED};
use asperity_numerics::sparse::CsMat;

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

/// Index of the entry of row `row` and column `column` among those of a lower triangle of `size` columns,
/// column by column.
fn index_in_triangle(row: usize, column: usize, size: usize) -> usize {
    column * (2 * size - column - 1) / 2 + row
}

impl Stiffness {
    /// Analyses elements of `nodes_per_cell` nodes.
    pub fn new(cells: &[u32], nodes_per_cell: usize, dofs: &Dofs) -> Stiffness {
        Stiffness::coupled(cells, nodes_per_cell, &[], dofs)
    }

    /// Analyses elements of `nodes_per_cell` nodes and further groups of nodes that act on each other.
    pub fn coupled(cells: &[u32], nodes_per_cell: usize, groups: &[Vec<u32>], dofs: &Dofs) -> Stiffness {
        let size = 2 * nodes_per_cell;
        let length = size * (size + 1) / 2;
        let members: Vec<&[u32]> =
            cells.chunks_exact(nodes_per_cell).chain(groups.iter().map(Vec::as_slice)).collect();
        let (mut node_of, mut found_in) = (vec![0; dofs.count], vec![Vec::new(); dofs.number.len()]);
        for (node, numbers) in dofs.number.iter().enumerate() {
            numbers.iter().filter(|&&n| n != FIXED).for_each(|&n| node_of[n as usize] = node);
        }
        for (group, nodes) in members.iter().enumerate() {
            nodes.iter().for_each(|&node| found_in[node as usize].push(group));
        }
        let numbers: Vec<Vec<u32>> = members.iter().map(|nodes| numbers_of(nodes, dofs)).collect();
        let cell_count = cells.len() / nodes_per_cell;
        let mut places = vec![NOWHERE; cell_count * length];
        let (mut starts, mut indices) = (vec![0], Vec::new());
        // of each row the last column that has it, and its place there
        let mut seen = vec![(FIXED, NOWHERE); dofs.count];
        let mut rows = Vec::new();
        for column in 0..dofs.count as u32 {
            let groups = &found_in[node_of[column as usize]];
            rows.clear();
            for &group in groups {
                for &row in numbers[group].iter().filter(|&&row| row != FIXED && row >= column) {
                    if seen[row as usize].0 != column {
                        seen[row as usize].0 = column;
                        rows.push(row);
                    }
                }
            }
            rows.sort_unstable();
            for (place, &row) in (indices.len()..).zip(&rows) {
                seen[row as usize].1 = place as u32;
            }
            indices.extend(rows.iter().map(|&row| row as usize));
            starts.push(indices.len());
            for &cell in groups.iter().filter(|&&group| group < cell_count) {
                let Some(own) = numbers[cell].iter().position(|&n| n == column) else { continue };
                for (other, &row) in numbers[cell].iter().enumerate() {
                    if row != FIXED && row >= column {
                        let index = index_in_triangle(own.max(other), own.min(other), size);
                        places[cell * length + index] = seen[row as usize].1;
                    }
                }
            }
        }
        let values = vec![0.0; indices.len()];
        let matrix = CsMat::new_csc((dofs.count, dofs.count), starts, indices, values);
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

    /// True where the pattern couples these nodes.
    pub fn couples(&self, nodes: &[u32], dofs: &Dofs) -> bool {
        let numbers = numbers_of(nodes, dofs);
        let free = || numbers.iter().copied().filter(|&number| number != FIXED);
        free().all(|row| {
            free().all(|col| row < col || self.matrix.nnz_index(row as usize, col as usize).is_some())
        })
    }

    /// Adds `value` at (row, col) of two components in the same element; entries above the diagonal are
    /// skipped.
    pub fn add_entry(&mut self, row: u32, col: u32, value: f64) {
        if row == FIXED || col == FIXED || row < col {
            return;
        }
        if let Some(place) = self.matrix.nnz_index(row as usize, col as usize) {
            self.matrix.data_mut()[place.0] += value;
        }
    }
}
