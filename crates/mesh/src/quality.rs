//! Shape quality of the cells of a mesh.

use crate::{ElementKind, Mesh};

/// Shape and size of the cells. Lengths in the unit of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// Smallest scaled Jacobian over all corners: 1 for a rectangle, 0 for a corner that is flat, below 0
    /// folded.
    pub min_scaled_jacobian: f64,
    /// Smallest angle at a corner, degrees.
    pub min_angle_deg: f64,
    /// Largest ratio of the longest to the shortest side of a cell.
    pub max_aspect: f64,
    /// Median of that ratio.
    pub median_aspect: f64,
    /// Shortest side of all cells.
    pub min_size: f64,
    /// Longest side of all cells.
    pub max_size: f64,
}

/// det[a b] and a·b of the two sides that leave a corner counterclockwise (`a`) and clockwise (`b`).
fn corner([a, b]: [[f64; 2]; 2]) -> [f64; 2] {
    [a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]]
}

/// Scaled Jacobian det[a b] / (|a| |b|) of a corner; 0 for a side without length.
fn scaled_jacobian(sides: [[f64; 2]; 2]) -> f64 {
    let lengths = sides.map(|side| side[0] * side[0] + side[1] * side[1]);
    let product = (lengths[0] * lengths[1]).sqrt();
    if product > 0.0 { corner(sides)[0] / product } else { 0.0 }
}

/// Angle of a corner, degrees; 0 for a side without length.
fn angle(sides: [[f64; 2]; 2]) -> f64 {
    let [det, dot] = corner(sides);
    det.atan2(dot).to_degrees()
}

impl Mesh {
    /// Direction in which side `k` of a cell leaves its first corner, and arrives at its second one; curved
    /// sides by the tangent of their parabola.
    fn side_tangents(&self, nodes: &[[f64; 2]], cell: &[u32], k: usize) -> ([f64; 2], [f64; 2]) {
        let at = |i: usize| nodes[cell[i] as usize];
        let (p, q) = (at(k), at((k + 1) % 4));
        match self.kind {
            ElementKind::Quad4 => {
                let d = [q[0] - p[0], q[1] - p[1]];
                (d, d)
            }
            ElementKind::Quad8 => {
                let m = at(4 + k);
                // x(s) = p + s(-3p + 4m - q) + 2s²(p - 2m + q), s from 0 to 1
                let leave = [0, 1].map(|i| 4.0 * (m[i] - p[i]) - (q[i] - p[i]));
                let arrive = [0, 1].map(|i| 4.0 * (q[i] - m[i]) - (q[i] - p[i]));
                (leave, arrive)
            }
        }
    }

    /// The two sides that leave each corner of a cell, as their directions there.
    fn corners(&self, nodes: &[[f64; 2]], cell: &[u32]) -> [[[f64; 2]; 2]; 4] {
        let tangents = [0, 1, 2, 3].map(|k| self.side_tangents(nodes, cell, k));
        [0, 1, 2, 3].map(|k| [tangents[k].0, tangents[(k + 3) % 4].1.map(|v| -v)])
    }

    /// Smallest scaled Jacobian of the corners of a cell with the nodes at `nodes` instead of their own
    /// places.
    pub fn sharpest_corner(&self, nodes: &[[f64; 2]], cell: usize) -> f64 {
        self.corners(nodes, self.cell(cell)).map(scaled_jacobian).into_iter().fold(f64::INFINITY, f64::min)
    }

    /// Shape and size of the cells; `None` for a mesh without cells.
    pub fn quality(&self) -> Option<Quality> {
        let distance = |a: u32, b: u32| {
            let (p, q) = (self.nodes[a as usize], self.nodes[b as usize]);
            (p[0] - q[0]).hypot(p[1] - q[1])
        };
        let mut aspects = Vec::with_capacity(self.cell_count());
        let mut quality = Quality {
            min_scaled_jacobian: f64::INFINITY,
            min_angle_deg: f64::INFINITY,
            max_aspect: 0.0,
            median_aspect: 0.0,
            min_size: f64::INFINITY,
            max_size: 0.0,
        };
        for cell in self.cells.chunks_exact(self.kind.nodes()) {
            let sizes = [0, 1, 2, 3].map(|k| distance(cell[k], cell[(k + 1) % 4]));
            let shortest = sizes.iter().copied().fold(f64::INFINITY, f64::min);
            let longest = sizes.iter().copied().fold(0.0, f64::max);
            aspects.push(longest / shortest);
            for corner in self.corners(&self.nodes, cell) {
                quality.min_scaled_jacobian = quality.min_scaled_jacobian.min(scaled_jacobian(corner));
                quality.min_angle_deg = quality.min_angle_deg.min(angle(corner));
            }
            quality.min_size = quality.min_size.min(shortest);
            quality.max_size = quality.max_size.max(longest);
        }
        aspects.sort_by(f64::total_cmp);
        quality.max_aspect = *aspects.last()?;
        quality.median_aspect = aspects[aspects.len() / 2];
        Some(quality)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sides;

    fn one_cell(kind: ElementKind, nodes: &[[f64; 2]]) -> Mesh {
        let cells = (0..nodes.len() as u32).collect();
        Mesh { kind, nodes: nodes.to_vec(), cells, sides: Sides::default() }
    }

    #[test]
    fn a_rectangle_is_perfect_but_for_its_aspect() {
        let q = one_cell(ElementKind::Quad4, &[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]])
            .quality()
            .unwrap();
        assert_eq!((q.min_scaled_jacobian, q.max_aspect, q.min_size, q.max_size), (1.0, 3.0, 1.0, 3.0));
        assert!((q.min_angle_deg - 90.0).abs() < 1e-12);
    }

    #[test]
    fn a_rhombus_of_30_degrees_has_a_scaled_jacobian_of_one_half() {
        let (s, c) = 30f64.to_radians().sin_cos();
        let q =
            one_cell(ElementKind::Quad4, &[[0.0, 0.0], [1.0, 0.0], [1.0 + c, s], [c, s]]).quality().unwrap();
        assert!((q.min_scaled_jacobian - 0.5).abs() < 1e-12 && (q.min_angle_deg - 30.0).abs() < 1e-9);
    }

    #[test]
    fn a_fold_or_a_mid_side_node_that_bends_a_corner_over_is_below_zero() {
        let arrow = one_cell(ElementKind::Quad4, &[[0.0, 0.0], [1.0, 0.0], [0.2, 0.2], [0.0, 1.0]]);
        assert!(arrow.quality().unwrap().min_scaled_jacobian < 0.0);
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let mids = [[0.5, 0.0], [1.0, 0.5], [0.5, 1.0], [0.0, 0.5]];
        let mut nodes = [square, mids].concat();
        assert_eq!(one_cell(ElementKind::Quad8, &nodes).quality().unwrap().min_scaled_jacobian, 1.0);
        nodes[4] = [0.02, 0.3]; // the bottom side first rises steeper than the left side stands
        nodes[7] = [0.3, 0.02];
        assert!(one_cell(ElementKind::Quad8, &nodes).quality().unwrap().min_scaled_jacobian < 0.0);
        assert!(one_cell(ElementKind::Quad4, &[]).quality().is_none());
    }
}
