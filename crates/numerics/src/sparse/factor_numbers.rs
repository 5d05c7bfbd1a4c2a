//! The numbers of a factorisation, in single or in double precision.

use crate::sparse::front::{Pivots, eliminate};
use crate::sparse::front_size::{Number, padded};
use crate::sparse::front_solve::{solve_backward, solve_forward};
use crate::sparse::front_tree::{Front, FrontTree, Part};
use pulp::Arch;
use rayon::prelude::*;

/// Numbers of every part of a tree, and work space.
pub struct FactorNumbers<T> {
    parts: Vec<PartNumbers<T>>,
    /// Work space of one column of a front.
    local: Vec<T>,
    /// Work space: a right-hand side in the order of elimination.
    ordered: Vec<T>,
}

/// Numbers of one part of the tree.
struct PartNumbers<T> {
    /// The panels of its fronts.
    values: Vec<T>,
    /// Updates of fronts whose parent is still to come, by parity.
    stacks: [Vec<T>; 2],
    /// Work space of one panel.
    scaled: Vec<T>,
}

/// Adds those columns of the update of a child which are pivots of its parent to the panel there: row i of
/// the child has the place `places[i]` in the parent.
fn add_to_panel<T: Number>(child: &[T], places: &[u32], front: &Front, panel: &mut [T]) {
    let stride = padded(places.len());
    let column_length = front.size.panel_column();
    for (j, &column) in places.iter().enumerate() {
        if column as usize >= front.size.pivots {
            break;
        }
        let from = &child[j * stride + j..][..places.len() - j];
        let to = &mut panel[column as usize * column_length..][..column_length];
        from.iter().zip(&places[j..]).for_each(|(&value, &row)| to[row as usize] += value);
    }
}

/// Adds the columns that [`add_to_panel`] leaves to the update of the parent.
fn add_to_update<T: Number>(child: &[T], places: &[u32], front: &Front, update: &mut [T]) {
    let stride = padded(places.len());
    let pivots = front.size.pivots;
    let update_length = padded(front.size.below);
    let first = places.partition_point(|&place| (place as usize) < pivots);
    for (j, &column) in places.iter().enumerate().skip(first) {
        let from = &child[j * stride + j..][..places.len() - j];
        let to = &mut update[(column as usize - pivots) * update_length..][..update_length];
        from.iter().zip(&places[j..]).for_each(|(&value, &row)| to[row as usize - pivots] += value);
    }
}

impl<T: Number> PartNumbers<T> {
    /// Eliminates the fronts of part `part`, whose children are in it or in `branches`. Returns the number of
    /// negative pivots, nothing where a pivot is not accepted.
    fn eliminate(
        &mut self,
        arch: Arch,
        tree: &FrontTree,
        part: usize,
        branches: &[PartNumbers<T>],
        matrix: &[f64],
        pivots: Pivots,
    ) -> Option<usize> {
        let [even, odd] = &mut self.stacks;
        let mut negative = 0;
        for &front in &tree.parts[part].fronts {
            let front = &tree.fronts[front as usize];
            let (own, others) = if front.parity == 0 { (&mut *even, &*odd) } else { (&mut *odd, &*even) };
            let panel = &mut self.values[front.panel..][..front.size.panel()];
            let update = &mut own[front.update..][..front.size.update()];
            panel.fill(T::default());
            for entry in &tree.entries[front.entries.clone()] {
                panel[entry.place as usize] = T::nearest(matrix[entry.value as usize]);
            }
            let children = || {
                tree.children[front.children.clone()].iter().map(|&child| {
                    let child = &tree.fronts[child as usize];
                    let stack =
                        if child.part == part { others } else { &branches[child.part].stacks[child.parity] };
                    (&stack[child.update..][..child.size.update()], &tree.places[child.rows.clone()])
                })
            };
            for (left, places) in children() {
                add_to_panel(left, places, front, panel);
            }
            negative += eliminate(arch, front.size, [panel, &mut *update, &mut self.scaled], pivots)?;
            for (left, places) in children() {
                add_to_update(left, places, front, update);
            }
        }
        Some(negative)
    }
}

impl<T: Number> FactorNumbers<T> {
    /// Those of `tree`, all zero.
    pub fn new(tree: &FrontTree) -> FactorNumbers<T> {
        let zeros = |length: usize| vec![T::default(); length];
        let numbers = |part: &Part| PartNumbers {
            values: zeros(part.factor),
            stacks: part.stacks.map(zeros),
            scaled: zeros(part.panel),
        };
        FactorNumbers {
            parts: tree.parts.iter().map(numbers).collect(),
            local: zeros(tree.longest_column()),
            ordered: zeros(tree.number.len()),
        }
    }

    /// Factorises; returns the number of negative pivots, nothing where a pivot is not accepted.
    pub fn factorise(
        &mut self,
        arch: Arch,
        tree: &FrontTree,
        matrix: &[f64],
        pivots: Pivots,
    ) -> Option<usize> {
        let (trunk, branches) = self.parts.split_last_mut()?;
        let negative: usize = branches
            .par_iter_mut()
            .enumerate()
            .map(|(part, numbers)| numbers.eliminate(arch, tree, part, &[], matrix, pivots))
            .sum::<Option<usize>>()?;
        let last = branches.len();
        Some(negative + trunk.eliminate(arch, tree, last, branches, matrix, pivots)?)
    }

    /// Solves in place with the last factorisation.
    pub fn solve(&mut self, arch: Arch, tree: &FrontTree, rhs: &mut [f64]) {
        let FactorNumbers { parts, local, ordered } = self;
        // no entry leaves the range of the factors' numbers
        let largest = rhs.iter().fold(f64::MIN_POSITIVE, |m, x| m.max(x.abs()));
        rhs.iter()
            .zip(&tree.number)
            .for_each(|(&value, &number)| ordered[number] = T::nearest(value / largest));
        for front in &tree.fronts {
            let panel = &parts[front.part].values[front.panel..][..front.size.panel()];
            let rows = &tree.rows[front.rows.clone()];
            let (column, pivots) = (front.size.panel_column(), front.size.pivots);
            let local = &mut local[..column];
            local[pivots..].fill(T::default());
            local[..pivots].copy_from_slice(&ordered[front.first..][..pivots]);
            solve_forward(arch, front.size, panel, local);
            for j in 0..pivots {
                ordered[front.first + j] = local[j];
            }
            rows.iter().zip(&local[pivots..]).for_each(|(&row, &taken)| ordered[row as usize] += taken);
        }
        for front in tree.fronts.iter().rev() {
            let panel = &parts[front.part].values[front.panel..][..front.size.panel()];
            let rows = &tree.rows[front.rows.clone()];
            let (column, pivots) = (front.size.panel_column(), front.size.pivots);
            let local = &mut local[..column];
            local[pivots..].fill(T::default());
            for j in 0..pivots {
                local[j] = ordered[front.first + j] / panel[j * column + j];
            }
            local[pivots..].iter_mut().zip(rows).for_each(|(value, &row)| *value = ordered[row as usize]);
            solve_backward(arch, front.size, panel, local);
            ordered[front.first..][..pivots].copy_from_slice(&local[..pivots]);
        }
        rhs.iter_mut()
            .zip(&tree.number)
            .for_each(|(value, &number)| *value = ordered[number].double() * largest);
    }
}
