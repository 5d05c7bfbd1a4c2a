//! Graded quadrilaterals under a profile: a core of rows and columns under the contact, and shells around it that
//! grow to the far boundary.
//!
//! ```text
//!   axis                                           In the flat plane (ζ ≤ 0 below the surface) the core is a
//!   +--+--+---+-----+----------+  surface          rectangle and every shell the space between two rectangles;
//!   +--+--+   |     |          |                   the whole is then sheared so that the top follows the profile.
//!   +--+--+   |     |          |                   Each shell has as many elements as the sides of the core that
//!   |     \   |     |          |                   it wraps have, so their size grows with the distance: the far
//!   +------\--+     |          |                   field costs a logarithm.
//!   |        \      |          |
//!   +---------\-----+          |  outer
//!   |           \              |
//!   +------------\-------------+
//!   base
//! ```

use crate::grading::divide;
use crate::profile::Profile;
use crate::{Edge, ElementKind, Mesh, Sides};
use std::collections::HashMap;

/// What to mesh. Any unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The surface.
    pub profile: Profile,
    /// Left and right end of the core; the left end is the axis if `left` equals it.
    pub core: [f64; 2],
    /// Depth of the core below the surface.
    pub core_depth: f64,
    /// Left and right end of the body. An end that equals that of the core gets no shells on that side.
    pub width: [f64; 2],
    /// Depth of the body below its highest summit.
    pub depth: f64,
    /// Kind of element.
    pub kind: ElementKind,
}

/// Builds the mesh of `plan`; `size(x)` is the wanted element size at the surface, `size_below(ζ)` at a depth, and
/// `growth` > 1 the growth of the shells from the core outward as a function of the distance in core sizes.
pub fn build(
    plan: &Plan,
    size: impl Fn(f64) -> f64,
    size_below: impl Fn(f64) -> f64,
    shell_size: impl Fn(f64) -> f64,
) -> Mesh {
    let kinks = plan.profile.kinks();
    let columns = divide(plan.core[0], plan.core[1], &kinks, &size);
    let rows: Vec<f64> = divide(0.0, plan.core_depth, &[], &size_below); // depths, downward
    let shells = Shells::new(plan, &kinks, &shell_size);
    let mut grid = Grid::default();
    // core: node (i, j) of column i and row j
    let core: Vec<Vec<u32>> =
        columns.iter().map(|&x| rows.iter().map(|&d| grid.node([x, -d])).collect()).collect();
    for i in 0..columns.len() - 1 {
        for j in 0..rows.len() - 1 {
            grid.cells.push([core[i][j + 1], core[i + 1][j + 1], core[i + 1][j], core[i][j]]);
        }
    }
    let mut surface_core: Vec<Edge> = Vec::new();
    for i in 0..columns.len() - 1 {
        surface_core.push(Edge { cell: (i * (rows.len() - 1)) as u32, side: 2 });
    }
    let (last_column, last_row) = (columns.len() - 1, rows.len() - 1);
    // the wrapped sides of the core, counterclockwise: down the left, along the bottom, up the right
    let mut ring: Vec<[f64; 2]> = Vec::new();
    let mut ids: Vec<u32> = Vec::new();
    let mut wrap = |i: usize, j: usize| {
        ring.push([columns[i], -rows[j]]);
        ids.push(core[i][j]);
    };
    if shells.left {
        (0..last_row).for_each(|j| wrap(0, j));
    }
    (0..=last_column).for_each(|i| wrap(i, last_row));
    if shells.right {
        (0..last_row).rev().for_each(|j| wrap(last_column, j));
    }
    let mut sides = Sides::default();
    if !shells.left {
        sides.axis.extend((0..last_row).map(|j| Edge { cell: j as u32, side: 3 }));
    }
    if !shells.right {
        let first = (last_column - 1) * last_row;
        sides.outer.extend((0..last_row).map(|j| Edge { cell: (first + j) as u32, side: 1 }));
    }
    let bottom = if shells.left { last_row } else { 0 }..if shells.left { last_row } else { 0 } + last_column;
    let (mut surface_left, mut surface_right) = (Vec::new(), Vec::new());
    for k in 0..shells.rectangles.len() {
        let next: Vec<u32> = ring.iter().map(|&p| grid.node(shells.place(plan, k, p))).collect();
        let outermost = k + 1 == shells.rectangles.len();
        for s in 0..ids.len() - 1 {
            // counterclockwise: outward ring first (the ring runs counterclockwise around the core)
            let cell = grid.cells.len() as u32;
            grid.cells.push([next[s], next[s + 1], ids[s + 1], ids[s]]);
            if s == 0 {
                if shells.left {
                    surface_left.push(Edge { cell, side: 3 })
                } else {
                    sides.axis.push(Edge { cell, side: 3 })
                }
            }
            if s + 2 == ids.len() {
                if shells.right {
                    surface_right.push(Edge { cell, side: 1 })
                } else {
                    sides.outer.push(Edge { cell, side: 1 })
                }
            }
            if outermost {
                let side = if bottom.contains(&s) {
                    &mut sides.base
                } else if s < bottom.start {
                    &mut sides.axis
                } else {
                    &mut sides.outer
                };
                side.push(Edge { cell, side: 0 });
            }
        }
        ids = next;
    }
    surface_left.reverse();
    sides.surface = surface_left.into_iter().chain(surface_core).chain(surface_right).collect();
    finish(plan, grid, sides)
}

/// Corner nodes in the flat plane and cells of four corners.
#[derive(Default)]
struct Grid {
    nodes: Vec<[f64; 2]>,
    cells: Vec<[u32; 4]>,
}

impl Grid {
    fn node(&mut self, x: [f64; 2]) -> u32 {
        self.nodes.push(x);
        (self.nodes.len() - 1) as u32
    }
}

/// The rectangles (left, right, depth) that bound the shells, from the first beyond the core outward.
struct Shells {
    left: bool,
    right: bool,
    rectangles: Vec<[f64; 3]>,
}

impl Shells {
    fn new(plan: &Plan, kinks: &[f64], shell_size: &impl Fn(f64) -> f64) -> Shells {
        let ([a, b], [left_end, right_end]) = (plan.core, plan.width);
        let (left, right) = (left_end < a, right_end > b);
        let far = plan.depth;
        // the distance that is divided: along the surface to the right if there are shells there, else downward
        let (from, to) = if right { (b, right_end) } else { (plan.core_depth, far) };
        let inner: Vec<f64> = if right { kinks.to_vec() } else { Vec::new() };
        let stations = divide_geometric(from, to, &inner, shell_size);
        let rectangles = stations[1..]
            .iter()
            .map(|&x| {
                // the same share of the logarithm on every side
                let t = if right && !left {
                    (x / from).ln() / (to / from).ln()
                } else {
                    ((x - from) / (to - from)).max(0.0)
                };
                let (l, r, d) = if right && !left {
                    (a, x, plan.core_depth * (far / plan.core_depth).powf(t))
                } else if right {
                    (a + t * (left_end - a), x, plan.core_depth + t * (far - plan.core_depth))
                } else {
                    (a + t * (left_end - a), b, x)
                };
                [l, r, d]
            })
            .collect();
        Shells { left, right, rectangles }
    }

    /// Where the core point `p` lands on rectangle `k`.
    fn place(&self, plan: &Plan, k: usize, p: [f64; 2]) -> [f64; 2] {
        let ([l, r, d], [a, b]) = (self.rectangles[k], plan.core);
        [l + (p[0] - a) / (b - a) * (r - l), p[1] / plan.core_depth * d]
    }
}

/// Divides like `divide`, but integrates in the logarithm of the distance, so that decades are resolved.
fn divide_geometric(from: f64, to: f64, kinks: &[f64], size: &impl Fn(f64) -> f64) -> Vec<f64> {
    let logs: Vec<f64> = kinks.iter().filter(|&&k| k > from && k < to).map(|k| k.ln()).collect();
    let mut nodes: Vec<f64> =
        divide(from.ln(), to.ln(), &logs, |l| size(l.exp()) / l.exp()).into_iter().map(f64::exp).collect();
    // kinks and ends exactly, not to the rounding of the logarithm
    for node in &mut nodes {
        for &stop in kinks.iter().chain([&from, &to]) {
            if (*node / stop - 1.0).abs() < 1e-12 {
                *node = stop;
            }
        }
    }
    nodes
}

/// Shears the flat grid under the profile and adds mid-side nodes.
fn finish(plan: &Plan, grid: Grid, sides: Sides) -> Mesh {
    // flat depth ζ in [-depth, 0] goes to [-depth, z_s(r)], linearly
    let mut nodes: Vec<[f64; 2]> = grid
        .nodes
        .iter()
        .map(|&[r, zeta]| [r, zeta + plan.profile.z(r) * (1.0 + zeta / plan.depth)])
        .collect();
    if plan.kind == ElementKind::Quad4 {
        return Mesh { kind: plan.kind, nodes, cells: grid.cells.into_flattened(), sides };
    }
    let mut middle: HashMap<(u32, u32), u32> = HashMap::new();
    let mut cells = Vec::with_capacity(8 * grid.cells.len());
    for cell in &grid.cells {
        cells.extend_from_slice(cell);
        for k in 0..4 {
            let (a, b) = (cell[k], cell[(k + 1) % 4]);
            let id = *middle.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let (p, q) = (nodes[a as usize], nodes[b as usize]);
                nodes.push([0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]);
                (nodes.len() - 1) as u32
            });
            cells.push(id);
        }
    }
    let mut mesh = Mesh { kind: plan.kind, nodes, cells, sides };
    for edge in mesh.sides.surface.clone() {
        if let (_, Some(node)) = mesh.edge_nodes(edge) {
            let r = mesh.nodes[node as usize][0];
            mesh.nodes[node as usize][1] = plan.profile.z(r);
        }
    }
    mesh
}
