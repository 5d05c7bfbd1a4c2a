//! Symbolic analysis of a sparse symmetric matrix: which unknowns are eliminated together, in which dense
//! front, and which front takes what each leaves (the multifrontal method; Duff and Reid 1983, Liu 1992).
//!
//! Unknowns whose columns of the factor have the same rows form a front. Small fronts are merged with the
//! front that takes what they leave, where a few zeros more cost less than a front of its own
//! (`Size::seconds`).

use crate::sparse::front_size::Size;
use crate::sparse::minimum_degree::{EliminationTree, elimination_tree};
use sprs::CsMat;
use std::ops::Range;

/// No front, group or part yet.
const NO_INDEX: usize = usize::MAX;

/// Share of the work that a branch has at most: so many that two to eight threads are busy to the end.
const MAX_BRANCH_SHARE: f64 = 0.07;

/// Seconds of work (as [`Size::seconds`] guesses) from which a matrix has branches: on smaller ones a second
/// thread has more to do with the companion of the run.
const WORTH_BRANCHES: f64 = 3e-3;

/// Seconds of work from which a subtree is a branch; smaller ones are left to the trunk.
const WORTH_A_TASK: f64 = 15e-6;

/// One front. Unknowns are numbered in the order of elimination.
#[derive(Clone, Debug, PartialEq)]
pub struct Front {
    /// Its pivots: unknowns `first..first + size.pivots`.
    pub first: usize,
    /// Pivots and rows below.
    pub size: Size,
    /// Its place in [`FrontTree::rows`]: the unknowns below, growing.
    pub rows: Range<usize>,
    /// Its place in [`FrontTree::entries`].
    pub entries: Range<usize>,
    /// Fronts whose updates it takes: places in [`FrontTree::children`].
    pub children: Range<usize>,
    /// The one of [`FrontTree::parts`] that it belongs to.
    pub part: usize,
    /// The place of its panel in the factor of its part.
    pub panel: usize,
    /// The place of its update in its part's stack of its parity.
    pub update: usize,
    /// Fronts between it and the root, odd or even: children find their parent in the other stack.
    pub parity: usize,
}

/// An entry of the matrix and where it stands in the panel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Index among the values of the matrix.
    pub value: u32,
    /// Index in the panel of the front.
    pub place: u32,
}

/// Fronts that can be eliminated without those of other parts, and what they store.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Part {
    /// The fronts, children before parents.
    pub fronts: Vec<u32>,
    /// Numbers in its panels.
    pub factor: usize,
    /// Numbers in its two stacks of updates at most.
    pub stacks: [usize; 2],
    /// Numbers in its largest panel.
    pub panel: usize,
}

/// The fronts of a matrix, children before parents.
#[derive(Clone, Debug, PartialEq)]
pub struct FrontTree {
    /// The fronts in the order of elimination.
    pub fronts: Vec<Front>,
    /// Number in the order of elimination of each unknown of the matrix.
    pub number: Vec<usize>,
    /// Rows below the pivots of every front.
    pub rows: Vec<u32>,
    /// For each of these its place in the parent's front.
    pub places: Vec<u32>,
    /// Entries of the matrix, front by front.
    pub entries: Vec<Entry>,
    /// Children of every front, first eliminated first.
    pub children: Vec<u32>,
    /// Branches, which need nothing of each other, and last the trunk, which takes what they leave.
    pub parts: Vec<Part>,
}

/// Unknowns that are eliminated together, before fronts are numbered.
#[derive(Clone, Debug)]
struct Group {
    columns: Vec<usize>,
    size: Size,
    children: Vec<usize>,
}

impl Size {
    /// Seconds of a front: to set it up, per entry that is cleared and added to its parent, per operation.
    /// Measured on one core; only their ratios count.
    fn seconds(self) -> f64 {
        let (k, n) = (self.pivots as f64, self.below as f64);
        let panel = k * (n + 0.5 * k);
        let operations = k * k * k / 3.0 + k * k * n + k * n * n;
        120e-9 + 0.35e-9 * (panel + n * n) + 0.03e-9 * operations
    }
}

/// Children of every node.
fn children_of(parent: &[Option<usize>]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); parent.len()];
    for (node, parent) in parent.iter().enumerate() {
        if let Some(parent) = *parent {
            children[parent].push(node);
        }
    }
    children
}

/// The nodes of a forest, children before parents.
fn postorder(children: &[Vec<usize>], roots: impl Iterator<Item = usize>) -> Vec<usize> {
    let mut order = Vec::with_capacity(children.len());
    let mut open: Vec<(usize, usize)> = Vec::new();
    for root in roots {
        open.push((root, 0));
        while let Some((node, next)) = open.last_mut() {
            match children[*node].get(*next) {
                Some(&child) => {
                    *next += 1;
                    open.push((child, 0));
                }
                None => {
                    order.push(*node);
                    open.pop();
                }
            }
        }
    }
    order
}

/// Groups of columns with the same rows, children before parents, and the roots among them.
fn groups_of(matrix: &CsMat<f64>) -> (Vec<Group>, Vec<usize>) {
    let upper = matrix.transpose_view().to_csc();
    let EliminationTree { parent, count } = elimination_tree(&upper.proper_indptr(), upper.indices());
    let children = children_of(&parent);
    let roots = (0..parent.len()).filter(|&node| parent[node].is_none());
    let order = postorder(&children, roots);
    let mut group_of = vec![NO_INDEX; parent.len()];
    let mut groups: Vec<Group> = Vec::new();
    for &column in &order {
        // the only column below it whose rows are this column and its rows
        let same = children[column].iter().copied().find(|&child| count[child] == count[column] + 1);
        let joined = same.map(|child| group_of[child]);
        let group = joined.unwrap_or(groups.len());
        if joined.is_none() {
            groups.push(Group { columns: vec![], size: Size { pivots: 0, below: 0 }, children: vec![] });
        }
        group_of[column] = group;
        groups[group].columns.push(column);
        groups[group].size = Size { pivots: groups[group].columns.len(), below: count[column] - 1 };
        let others: Vec<usize> =
            children[column].iter().map(|&child| group_of[child]).filter(|&child| child != group).collect();
        groups[group].children.extend(others);
    }
    let mut is_root = vec![true; groups.len()];
    groups.iter().for_each(|g| g.children.iter().for_each(|&child| is_root[child] = false));
    let roots = (0..groups.len()).filter(|&g| is_root[g]).collect();
    (groups, roots)
}

/// Merges children with their parents where that is cheaper.
fn merge(groups: &mut [Group], roots: &[usize]) {
    let children: Vec<Vec<usize>> = groups.iter().map(|g| g.children.clone()).collect();
    for parent in postorder(&children, roots.iter().copied()) {
        loop {
            let size = groups[parent].size;
            let with =
                |child: usize| Size { pivots: size.pivots + groups[child].size.pivots, below: size.below };
            let gain = |child: usize| size.seconds() + groups[child].size.seconds() - with(child).seconds();
            let best = groups[parent].children.iter().copied().max_by(|&a, &b| gain(a).total_cmp(&gain(b)));
            let Some(child) = best.filter(|&child| gain(child) > 0.0) else { break };
            groups[parent].size = with(child);
            let columns = std::mem::take(&mut groups[child].columns);
            let adopted = std::mem::take(&mut groups[child].children);
            let family = &mut groups[parent];
            family.columns.splice(0..0, columns);
            family.children.retain(|&c| c != child);
            family.children.extend(adopted);
        }
    }
}

impl FrontTree {
    /// Analyses the lower triangle `matrix`, whose unknowns stand in an order of little fill.
    pub fn new(matrix: &CsMat<f64>) -> FrontTree {
        let (mut groups, roots) = groups_of(matrix);
        merge(&mut groups, &roots);
        let children: Vec<Vec<usize>> = groups.iter().map(|g| g.children.clone()).collect();
        let order = postorder(&children, roots.iter().copied());
        let mut tree = FrontTree {
            fronts: Vec::with_capacity(order.len()),
            number: vec![0; matrix.cols()],
            rows: vec![],
            places: vec![],
            entries: Vec::with_capacity(matrix.nnz()),
            children: vec![],
            parts: vec![],
        };
        let mut unknown = Vec::with_capacity(matrix.cols());
        for &group in &order {
            unknown.extend(groups[group].columns.iter().copied());
        }
        unknown.iter().enumerate().for_each(|(number, &unknown)| tree.number[unknown] = number);
        let depth = depths(&children, &order);
        let mut front_of_group = vec![0; groups.len()];
        for (front, &group) in order.iter().enumerate() {
            front_of_group[group] = front;
            let start = tree.children.len();
            let family = children[group].iter().map(|&child| front_of_group[child] as u32);
            tree.children.extend(family);
            tree.children[start..].sort_unstable();
            tree.fronts.push(Front {
                first: 0,
                size: groups[group].size,
                rows: 0..0,
                entries: 0..0,
                children: start..tree.children.len(),
                part: 0,
                panel: 0,
                update: 0,
                parity: depth[group] % 2,
            });
        }
        tree.find_rows(matrix, &unknown);
        tree.find_parts();
        tree.place_storage();
        tree
    }

    /// Rows and entries of every front from those of its pivots and its children.
    fn find_rows(&mut self, matrix: &CsMat<f64>, unknown: &[usize]) {
        let full = Symmetric::new(matrix);
        let mut seen = vec![NO_INDEX; unknown.len()];
        let mut place = vec![0_u32; unknown.len()];
        let mut first = 0;
        for front in 0..self.fronts.len() {
            let end = first + self.fronts[front].size.pivots;
            let mut rows: Vec<u32> = Vec::new();
            let mut note = |row: usize| {
                if row >= end && seen[row] != front {
                    seen[row] = front;
                    rows.push(row as u32);
                }
            };
            for &column in &unknown[first..end] {
                full.entries(column).for_each(|(other, _)| note(self.number[other]));
            }
            for &child in &self.children[self.fronts[front].children.clone()] {
                self.rows[self.fronts[child as usize].rows.clone()]
                    .iter()
                    .for_each(|&row| note(row as usize));
            }
            rows.sort_unstable();
            let pivots = end - first;
            (first..end).enumerate().for_each(|(i, row)| place[row] = i as u32);
            rows.iter().enumerate().for_each(|(i, &row)| place[row as usize] = (pivots + i) as u32);
            for &child in &self.children[self.fronts[front].children.clone()] {
                for row in self.fronts[child as usize].rows.clone() {
                    self.places[row] = place[self.rows[row] as usize];
                }
            }
            let start = self.rows.len();
            self.rows.extend(&rows);
            self.places.resize(self.rows.len(), 0);
            let size = Size { pivots, below: rows.len() };
            let entry_start = self.entries.len();
            for (i, &column) in unknown[first..end].iter().enumerate() {
                for (other, value) in full.entries(column) {
                    let number = self.number[other];
                    if number >= first + i {
                        let place = place[number] as usize + i * size.panel_column();
                        self.entries.push(Entry { value, place: place as u32 });
                    }
                }
            }
            let front = &mut self.fronts[front];
            front.first = first;
            front.size = size;
            front.rows = start..self.rows.len();
            front.entries = entry_start..self.entries.len();
            first = end;
        }
    }

    /// Cuts the branches off the trunk: the largest subtrees of at most [`MAX_BRANCH_SHARE`] of the work, if
    /// they are worth a task.
    fn find_parts(&mut self) {
        let mut work: Vec<f64> = self.fronts.iter().map(|front| front.size.seconds()).collect();
        let mut first: Vec<usize> = (0..self.fronts.len()).collect();
        for front in 0..self.fronts.len() {
            for &child in &self.children[self.fronts[front].children.clone()] {
                work[front] += work[child as usize];
                first[front] = first[front].min(first[child as usize]);
            }
        }
        let total: f64 = self.fronts.iter().map(|front| front.size.seconds()).sum();
        let mut branches = 0;
        let mut front = self.fronts.len();
        let mut part = vec![NO_INDEX; front];
        // parents before children; a subtree is a range of fronts that ends at its root
        while let Some(root) = front.checked_sub(1) {
            let is_branch = total >= WORTH_BRANCHES && work[root] <= MAX_BRANCH_SHARE * total;
            front = root;
            if is_branch && work[root] >= WORTH_A_TASK {
                part[first[root]..=root].fill(branches);
                branches += 1;
                front = first[root];
            } else if is_branch {
                front = first[root];
            }
        }
        self.parts = vec![Part::default(); branches + 1];
        for (i, (front, part)) in self.fronts.iter_mut().zip(part).enumerate() {
            front.part = part.min(branches);
            self.parts[front.part].fronts.push(i as u32);
        }
    }

    /// Places of panels and updates. Updates of even and odd fronts form two stacks: those that a front takes
    /// lie on top of the one, its own is put on the other.
    fn place_storage(&mut self) {
        let mut tops = vec![[0; 2]; self.parts.len()];
        for front in 0..self.fronts.len() {
            let Front { size, parity, ref children, part, .. } = self.fronts[front];
            let taken = children.clone();
            let (top, store) = (&mut tops[part][parity], &mut self.parts[part]);
            self.fronts[front].panel = store.factor;
            self.fronts[front].update = *top;
            store.factor += size.panel();
            store.panel = store.panel.max(size.panel());
            *top += size.update();
            store.stacks[parity] = store.stacks[parity].max(*top);
            for &child in &self.children[taken] {
                let child = &self.fronts[child as usize];
                tops[child.part][child.parity] -= child.size.update();
            }
        }
    }

    /// The longest column of a panel.
    pub fn longest_column(&self) -> usize {
        self.fronts.iter().map(|front| front.size.panel_column()).max().unwrap_or(0)
    }
}

/// Nodes between each node of a forest and its root.
fn depths(children: &[Vec<usize>], postorder: &[usize]) -> Vec<usize> {
    let mut depth = vec![0; children.len()];
    for &node in postorder.iter().rev() {
        children[node].iter().for_each(|&child| depth[child] = depth[node] + 1);
    }
    depth
}

/// Both triangles of a symmetric matrix: the entries of a column with their index among the values of the
/// lower triangle.
struct Symmetric {
    starts: Vec<usize>,
    entries: Vec<(u32, u32)>,
}

impl Symmetric {
    fn new(lower: &CsMat<f64>) -> Symmetric {
        let mut starts = vec![0; lower.cols() + 1];
        let each = |visit: &mut dyn FnMut(usize, usize, usize)| {
            let mut index = 0;
            for (column, entries) in lower.outer_iterator().enumerate() {
                for (row, _) in entries.iter() {
                    visit(column, row, index);
                    if row != column {
                        visit(row, column, index);
                    }
                    index += 1;
                }
            }
        };
        each(&mut |column, _, _| starts[column + 1] += 1);
        (0..lower.cols()).for_each(|column| starts[column + 1] += starts[column]);
        let mut next = starts.clone();
        let mut entries = vec![(0, 0); starts[lower.cols()]];
        each(&mut |column, row, index| {
            entries[next[column]] = (row as u32, index as u32);
            next[column] += 1;
        });
        Symmetric { starts, entries }
    }

    /// Rows of the entries of a column and their indices.
    fn entries(&self, column: usize) -> impl Iterator<Item = (usize, u32)> + '_ {
        self.entries[self.starts[column]..self.starts[column + 1]]
            .iter()
            .map(|&(row, index)| (row as usize, index))
    }
}
