//! The flat grid that a mesh is sheared from: blocks, the shells that wrap them, columns beside them, and the
//! named sides.

use crate::{Edge, Sides};

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rectangle {
    pub left: f64,
    pub right: f64,
    pub depth: f64,
}

/// Corner nodes in the flat plane, cells of four corners, and the sides found so far.
#[derive(Default)]
pub struct Grid {
    pub nodes: Vec<[f64; 2]>,
    pub cells: Vec<[u32; 4]>,
    pub sides: Sides,
}

impl Grid {
    pub fn node(&mut self, x: [f64; 2]) -> u32 {
        self.nodes.push(x);
        (self.nodes.len() - 1) as u32
    }

    /// A block of columns and rows (depths, downward from 0); returns its nodes `[column][row]`.
    pub fn block(&mut self, columns: &[f64], rows: &[f64]) -> Vec<Vec<u32>> {
        let nodes: Vec<Vec<u32>> =
            columns.iter().map(|&x| rows.iter().map(|&d| self.node([x, -d])).collect()).collect();
        for i in 0..columns.len() - 1 {
            for j in 0..rows.len() - 1 {
                if j == 0 {
                    self.sides.surface.push(Edge { cell: self.cells.len() as u32, side: 2 });
                }
                self.cells.push([nodes[i][j + 1], nodes[i + 1][j + 1], nodes[i + 1][j], nodes[i][j]]);
            }
        }
        nodes
    }
}

/// The wrapped sides of a block, counterclockwise: down the left, along the bottom, up the right.
pub struct Ring {
    pub ids: Vec<u32>,
    /// Number of edges on the left, at the bottom, on the right.
    pub edges: [usize; 3],
    pub rectangle: Rectangle,
}

/// Wraps `ring` in shells up to each of `rectangles`; sides of the `body` are named where the last one
/// reaches them.
pub fn wrap(grid: &mut Grid, mut ring: Ring, rectangles: &[Rectangle], body: Option<Rectangle>) -> Ring {
    let [left, bottom, right] = ring.edges;
    let inner = ring.rectangle;
    // places on the sides of the inner rectangle as shares, kept by every shell
    let shares: Vec<[f64; 2]> = ring
        .ids
        .iter()
        .map(|&id| {
            let [x, z] = grid.nodes[id as usize];
            [(x - inner.left) / (inner.right - inner.left), z / inner.depth]
        })
        .collect();
    for to in rectangles {
        let next: Vec<u32> = shares
            .iter()
            .map(|[s, t]| grid.node([to.left + s * (to.right - to.left), t * to.depth]))
            .collect();
        for s in 0..next.len() - 1 {
            let cell = grid.cells.len() as u32;
            grid.cells.push([next[s], next[s + 1], ring.ids[s + 1], ring.ids[s]]);
            if s == 0 {
                let side = if left > 0 { &mut grid.sides.surface } else { &mut grid.sides.axis };
                side.push(Edge { cell, side: 3 });
            }
            if s + 2 == next.len() {
                let side = if right > 0 { &mut grid.sides.surface } else { &mut grid.sides.outer };
                side.push(Edge { cell, side: 1 });
            }
            if let Some(body) = body.filter(|_| Some(to) == rectangles.last()) {
                let edge = Edge { cell, side: 0 };
                if s < left && to.left == body.left {
                    grid.sides.axis.push(edge);
                } else if s >= left && s < left + bottom && to.depth == body.depth {
                    grid.sides.base.push(edge);
                } else if s >= left + bottom && to.right == body.right {
                    grid.sides.outer.push(edge);
                }
            }
        }
        ring.ids = next;
        ring.rectangle = *to;
    }
    ring
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    Left,
    Right,
}

/// Columns of cells at the places `columns`, from the nodes `inner` (from the surface down to the base)
/// outward; on the `side` of them.
pub fn add_columns(grid: &mut Grid, inner: &[u32], columns: &[f64], side: Side) {
    let mut before = inner.to_vec();
    for (index, &x) in columns.iter().enumerate() {
        let next: Vec<u32> = before
            .iter()
            .map(|&id| {
                let depth = grid.nodes[id as usize][1];
                grid.node([x, depth])
            })
            .collect();
        let (left, right) = match side {
            Side::Right => (&before, &next),
            Side::Left => (&next, &before),
        };
        let rows = next.len() - 1;
        for j in 0..rows {
            let cell = grid.cells.len() as u32;
            grid.cells.push([left[j + 1], right[j + 1], right[j], left[j]]);
            if j == 0 {
                grid.sides.surface.push(Edge { cell, side: 2 });
            }
            if j + 1 == rows {
                grid.sides.base.push(Edge { cell, side: 0 });
            }
            if index + 1 == columns.len() {
                match side {
                    Side::Right => grid.sides.outer.push(Edge { cell, side: 1 }),
                    Side::Left => grid.sides.axis.push(Edge { cell, side: 3 }),
                }
            }
        }
        before = next;
    }
}

/// Orders the surface edges from index `start` on by their place.
pub fn sort_surface(grid: &mut Grid, start: usize) {
    let middle = |edge: &Edge| {
        let cell = grid.cells[edge.cell as usize];
        let k = usize::from(edge.side);
        grid.nodes[cell[k] as usize][0] + grid.nodes[cell[(k + 1) % 4] as usize][0]
    };
    let mut keyed: Vec<(f64, Edge)> = grid.sides.surface[start..].iter().map(|e| (middle(e), *e)).collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (slot, (_, edge)) in grid.sides.surface[start..].iter_mut().zip(keyed) {
        *slot = edge;
    }
}

/// Names the edges between consecutive `nodes` as a side of the body.
pub fn name_side(grid: &mut Grid, nodes: &[u32], side: impl Fn(&mut Grid) -> &mut Vec<Edge>) {
    for pair in nodes.windows(2) {
        let found = grid.cells.iter().enumerate().find_map(|(cell, corners)| {
            (0..4)
                .find(|&k| {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    (a, b) == (pair[0], pair[1]) || (a, b) == (pair[1], pair[0])
                })
                .map(|k| Edge { cell: cell as u32, side: k as u8 })
        });
        side(grid).extend(found);
    }
}
