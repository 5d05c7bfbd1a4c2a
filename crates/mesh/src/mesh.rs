//! A mesh of quadrilaterals in the (r, z) half plane, or (x, z) in plane strain, with named sides.

use std::collections::HashMap;

/// The kind of quadrilateral of the cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ElementKind {
    /// Four corner nodes.
    Quad4,
    /// Four corners and four mid-side nodes (serendipity).
    Quad8,
}

impl ElementKind {
    /// Nodes of one cell.
    pub fn nodes(self) -> usize {
        match self {
            ElementKind::Quad4 => 4,
            ElementKind::Quad8 => 8,
        }
    }
}

/// One side of one cell: side k runs from corner k to corner k+1, counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Edge {
    /// Index of the cell.
    pub cell: u32,
    /// The number of its side, 0 to 3.
    pub side: u8,
}

/// The boundary by name.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sides {
    /// On the axis of revolution r = 0, or the left side in plane strain.
    pub axis: Vec<Edge>,
    /// The bottom of the substrate.
    pub base: Vec<Edge>,
    /// The free surface a tool may touch, ordered from the axis outward.
    pub surface: Vec<Edge>,
    /// The lateral side far from the axis.
    pub outer: Vec<Edge>,
}

/// Quadrilaterals with their nodes and named sides. Any unit of length; z points up.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Kind of every cell.
    pub kind: ElementKind,
    /// Coordinates (r, z) of the nodes.
    pub nodes: Vec<[f64; 2]>,
    /// Node indices, `kind.nodes()` to a cell: corners counterclockwise, then the mid-side nodes of sides 0
    /// to 3.
    pub cells: Vec<u32>,
    /// Named sides.
    pub sides: Sides,
}

impl Mesh {
    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.cells.len() / self.kind.nodes()
    }

    /// The nodes of cell `cell`.
    #[inline]
    pub fn cell(&self, cell: usize) -> &[u32] {
        let n = self.kind.nodes();
        &self.cells[cell * n..(cell + 1) * n]
    }

    /// The same cells as the other element: mid-side nodes are left out, or put halfway between corners.
    #[must_use]
    pub fn with_other_element(&self) -> Mesh {
        let (n, mut nodes, mut cells) = (self.kind.nodes(), self.nodes.clone(), Vec::new());
        if self.kind == ElementKind::Quad8 {
            cells.extend(self.cells.chunks_exact(n).flat_map(|cell| &cell[..4]));
            return Mesh { kind: ElementKind::Quad4, nodes, cells, sides: self.sides.clone() };
        }
        let mut middles = HashMap::new();
        for cell in self.cells.chunks_exact(n) {
            cells.extend(cell);
            for k in 0..4 {
                let (a, b) = (cell[k], cell[(k + 1) % 4]);
                cells.push(*middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let [from, to] = [a, b].map(|node| nodes[node as usize]);
                    nodes.push([0, 1].map(|i| 0.5 * (from[i] + to[i])));
                    nodes.len() as u32 - 1
                }));
            }
        }
        Mesh { kind: ElementKind::Quad8, nodes, cells, sides: self.sides.clone() }
    }

    /// The mesh with its coordinates times `factor`.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Mesh {
        self.nodes.iter_mut().flatten().for_each(|x| *x *= factor);
        self
    }

    /// Every node of an edge, from corner to corner.
    pub(crate) fn nodes_along(&self, edge: Edge) -> impl Iterator<Item = u32> {
        let ([a, b], middle) = self.edge_nodes(edge);
        [Some(a), middle, Some(b)].into_iter().flatten()
    }

    /// Least and greatest of each coordinate over the nodes.
    pub fn extent(&self) -> [[f64; 2]; 2] {
        extent(self.nodes.iter().copied())
    }

    /// The nodes of an edge: its two corners counterclockwise around the cell, and its mid-side node if there
    /// is one.
    pub fn edge_nodes(&self, edge: Edge) -> ([u32; 2], Option<u32>) {
        let (cell, k) = (self.cell(edge.cell as usize), usize::from(edge.side));
        ([cell[k], cell[(k + 1) % 4]], cell.get(4 + k).copied())
    }
}

/// Numbers from 1 of some nodes, as files have them.
pub(crate) fn numbers(nodes: impl IntoIterator<Item = u32>) -> Vec<String> {
    nodes.into_iter().map(|node| (node + 1).to_string()).collect()
}

/// Least and greatest of each coordinate of some points.
pub(crate) fn extent(points: impl Iterator<Item = [f64; 2]>) -> [[f64; 2]; 2] {
    points.fold([[f64::INFINITY, f64::NEG_INFINITY]; 2], |ends, x| {
        [0, 1].map(|i| [ends[i][0].min(x[i]), ends[i][1].max(x[i])])
    })
}
