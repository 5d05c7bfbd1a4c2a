//! The mesh of a sharp cone: columns of one width under the contact, so that the force ripples with one period, and
//! shells around them that grow to the far boundary.

use asperity_mesh::grading::divide;
use asperity_mesh::{Edge, ElementKind, Mesh, Sides};
use std::collections::HashMap;

/// What to mesh, any unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Width of a column under the contact.
    pub element: f64,
    /// Number of such columns that fit under the contact.
    pub columns: usize,
    /// How many of them, from the axis, are one wide column.
    pub at_axis: usize,
    /// Depth of the rows under them, and what their height grows by per depth.
    pub row_depth: f64,
    /// Growth of the rows with depth.
    pub row_growth: f64,
    /// Width of the first shell, in columns.
    pub first_shell: f64,
    /// Size of the far shells as a share of the distance.
    pub growth: f64,
    /// Radius and depth of the substrate.
    pub domain: f64,
    /// Slope (tangent) of the cone and its height above the substrate; zeros for a flat body.
    pub cone: [f64; 2],
    /// Radius over which the summit is rounded, to a hyperboloid.
    pub rounding: f64,
    /// Kind of element.
    pub kind: ElementKind,
}

impl Layout {
    /// Height of the surface at radius r, 0 at the summit.
    fn surface(&self, r: f64) -> f64 {
        let [slope, height] = self.cone;
        let below = |r: f64| slope * (r.hypot(self.rounding) - self.rounding);
        if r * slope < height { -below(r) } else { -below(self.foot()) }
    }

    /// Base radius of the cone, 0 for a flat body.
    fn foot(&self) -> f64 {
        let [slope, height] = self.cone;
        if slope > 0.0 { height / slope } else { 0.0 }
    }

    /// Builds the mesh.
    pub fn mesh(&self) -> Mesh {
        let core = self.columns as f64 * self.element;
        let columns: Vec<f64> = std::iter::once(0)
            .chain(self.at_axis.max(1)..=self.columns)
            .map(|i| i as f64 * self.element)
            .collect();
        let rows = divide(0.0, self.row_depth, &[], |d| self.element + self.row_growth * d);
        let (near, far) = (self.first_shell * self.element / core, self.growth);
        // in the logarithm of the radius, with a node where the cone ends
        let foot = if self.cone[0] > 0.0 { vec![self.foot().ln()] } else { Vec::new() };
        let shells: Vec<f64> =
            divide(core.ln(), self.domain.ln(), &foot, |l| near + (far - near) * (1.0 - core / l.exp()));
        let depth = self.domain + self.cone[1];
        let mut nodes: Vec<[f64; 2]> = Vec::new();
        let mut cells: Vec<[u32; 4]> = Vec::new();
        let mut sides = Sides::default();
        let (width, height) = (columns.len(), rows.len());
        let id = |i: usize, j: usize| (i * height + j) as u32;
        for &r in &columns {
            nodes.extend(rows.iter().map(|&d| [r, -d]));
        }
        for i in 0..width - 1 {
            for j in 0..height - 1 {
                let cell = cells.len() as u32;
                cells.push([id(i, j + 1), id(i + 1, j + 1), id(i + 1, j), id(i, j)]);
                if j == 0 {
                    sides.surface.push(Edge { cell, side: 2 });
                }
                if i == 0 {
                    sides.axis.push(Edge { cell, side: 3 });
                }
            }
        }
        // what the shells wrap: along the bottom from the axis, then up the right side
        let bottom = width - 1;
        let mut ring: Vec<u32> = (0..width).map(|i| id(i, height - 1)).collect();
        ring.extend((0..height - 1).rev().map(|j| id(width - 1, j)));
        let inner: Vec<[f64; 2]> = ring.iter().map(|&k| nodes[k as usize]).collect();
        for (k, log) in shells.iter().enumerate().skip(1) {
            let share = (log - shells[0]) / (shells[shells.len() - 1] - shells[0]);
            let (r, d) = (log.exp() / core, (depth / self.row_depth).powf(share));
            let first = nodes.len() as u32;
            nodes.extend(inner.iter().map(|p| [p[0] * r, p[1] * d]));
            for s in 0..ring.len() - 1 {
                let cell = cells.len() as u32;
                cells.push([first + s as u32, first + s as u32 + 1, ring[s + 1], ring[s]]);
                if s == 0 {
                    sides.axis.push(Edge { cell, side: 3 });
                }
                if s + 2 == ring.len() {
                    sides.surface.push(Edge { cell, side: 1 });
                }
                if k + 1 == shells.len() {
                    let side = if s < bottom { &mut sides.base } else { &mut sides.outer };
                    side.push(Edge { cell, side: 0 });
                }
            }
            ring = (first..first + ring.len() as u32).collect();
        }
        // the flat grid is sheared under the surface, less and less down to the base
        for node in &mut nodes {
            node[1] += self.surface(node[0]) * (1.0 + node[1] / depth);
        }
        match self.kind {
            ElementKind::Quad4 => {
                Mesh { kind: self.kind, nodes, cells: cells.into_iter().flatten().collect(), sides }
            }
            ElementKind::Quad8 => quadratic(nodes, &cells, sides),
        }
    }
}

/// Adds mid-side nodes on straight sides.
fn quadratic(mut nodes: Vec<[f64; 2]>, corners: &[[u32; 4]], sides: Sides) -> Mesh {
    let mut middle: HashMap<(u32, u32), u32> = HashMap::new();
    let mut cells = Vec::with_capacity(8 * corners.len());
    for cell in corners {
        cells.extend_from_slice(cell);
        for k in 0..4 {
            let (a, b) = (cell[k], cell[(k + 1) % 4]);
            cells.push(*middle.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let (p, q) = (nodes[a as usize], nodes[b as usize]);
                nodes.push([0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]);
                (nodes.len() - 1) as u32
            }));
        }
    }
    Mesh { kind: ElementKind::Quad8, nodes, cells, sides }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_of_all_slopes_and_flat_bodies_have_sound_cells() {
        for (slope, depth) in [(0.0, 0.4), (0.017, 0.4), (0.176, 0.4), (0.577, 1.0)] {
            let layout = Layout {
                element: 0.1,
                columns: 11,
                at_axis: 1,
                row_depth: depth,
                row_growth: 0.5,
                first_shell: 1.0,
                growth: 0.4,
                domain: 100.0,
                cone: [slope, 8.0 * slope],
                rounding: 0.0,
                kind: ElementKind::Quad8,
            };
            let mesh = layout.mesh();
            assert!(mesh.quality().unwrap().min_scaled_jacobian > 0.15, "{slope} {:?}", mesh.quality());
            let radius = |edge: &Edge| {
                let ([a, b], _) = mesh.edge_nodes(*edge);
                mesh.nodes[a as usize][0].max(mesh.nodes[b as usize][0])
            };
            let ends: Vec<f64> = mesh.sides.surface.iter().map(radius).collect();
            assert!(ends.windows(2).all(|w| w[0] < w[1]) && (ends[10] - 1.1).abs() < 1e-12);
        }
    }
}
