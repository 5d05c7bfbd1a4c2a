//! Connected regions of a mesh where a field is below zero, bounded by the line on which it passes zero.

use crate::Mesh;
use std::collections::BTreeMap;

/// A connected region in which a field is below zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Area of its section.
    pub area: f64,
    /// Centroid of its section.
    pub centre: [f64; 2],
    /// Its nodes, and how much of its area each stands for: their sum is the area, and the sum of weight
    /// times value the integral of a field that is linear between the corners of a cell and its centre.
    pub weights: BTreeMap<u32, f64>,
}

impl Region {
    /// Mean of a field at the nodes over the region, the place (r, z) of each node counting `measure` times.
    pub fn mean(&self, values: &[f64], measure: impl Fn(u32) -> f64) -> f64 {
        let (mut sum, mut all) = (0.0, 0.0);
        for (&node, weight) in &self.weights {
            let weight = weight * measure(node);
            sum += weight * values[node as usize];
            all += weight;
        }
        sum / all
    }

    /// Adds the part of a triangle in which `heights` of its corners, linear between them, are below zero;
    /// `shares` tells which nodes a corner is the mean of.
    fn add(&mut self, corners: [[f64; 2]; 3], heights: [f64; 3], shares: &[&[u32]; 3]) {
        let mut part: Vec<[f64; 3]> = Vec::with_capacity(4);
        for i in 0..3 {
            let j = (i + 1) % 3;
            let (a, b) = (heights[i], heights[j]);
            if a < 0.0 {
                part.push(corner(i, 1.0, j));
            }
            if (a < 0.0) != (b < 0.0) {
                part.push(corner(i, b / (b - a), j));
            }
        }
        let [a, b, c] = corners;
        let area = 0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])).abs();
        for k in 1..part.len().max(1) - 1 {
            let (p, q, s) = (part[0], part[k], part[k + 1]);
            let determinant = p[0] * (q[1] * s[2] - q[2] * s[1]) - p[1] * (q[0] * s[2] - q[2] * s[0])
                + p[2] * (q[0] * s[1] - q[1] * s[0]);
            let area = area * determinant.abs();
            self.area += area;
            for i in 0..3 {
                let weight = area * (p[i] + q[i] + s[i]) / 3.0;
                self.centre = [0, 1].map(|k| self.centre[k] + weight * corners[i][k]);
                for &node in shares[i] {
                    *self.weights.entry(node).or_default() += weight / shares[i].len() as f64;
                }
            }
        }
    }
}

/// The point of the side from corner `i` to corner `j` of a triangle, `share` of it corner `i`.
fn corner(i: usize, share: f64, j: usize) -> [f64; 3] {
    let mut point = [0.0; 3];
    point[i] = share;
    point[j] += 1.0 - share;
    point
}

/// The connected regions, over the cells that are `inside`, where the `values` at the corners are below zero,
/// in the order of their first node. `places` are the positions of the nodes.
///
/// A cell is four triangles around its centre, whose value is the mean of its corners: there is no cell that
/// a region takes whole or not at all, so that its area converges with the square of the size of the cells.
pub fn regions_below_zero(
    mesh: &Mesh,
    places: &[[f64; 2]],
    values: &[f64],
    inside: impl Fn(usize) -> bool,
) -> Vec<Region> {
    let below = |node: u32| values[node as usize] < 0.0;
    let cells = || (0..mesh.cell_count()).filter(|cell| inside(*cell)).map(|cell| &mesh.cell(cell)[..4]);
    let centre_value = |cell: &[u32]| cell.iter().map(|n| values[*n as usize]).sum::<f64>() / 4.0;
    let mut groups = Groups::new(places.len());
    for cell in cells() {
        for k in 0..4 {
            let (a, b) = (cell[k], cell[(k + 1) % 4]);
            if below(a) && below(b) {
                groups.join(a, b);
            }
        }
        if centre_value(cell) < 0.0 {
            let mut own = cell.iter().copied().filter(|n| below(*n));
            if let Some(first) = own.next() {
                own.for_each(|other| groups.join(first, other));
            }
        }
    }
    let mut regions: BTreeMap<u32, Region> = BTreeMap::new();
    for cell in cells() {
        let Some(any) = cell.iter().copied().find(|n| below(*n)) else { continue };
        let corners = |k: usize| places[cell[k] as usize];
        let centre = [0, 1].map(|i| (0..4).map(|k| corners(k)[i]).sum::<f64>() / 4.0);
        for k in 0..4 {
            let next = (k + 1) % 4;
            let (a, b) = (cell[k], cell[next]);
            let heights = [values[a as usize], values[b as usize], centre_value(cell)];
            let Some(owner) = [a, b].into_iter().find(|n| below(*n)).or((heights[2] < 0.0).then_some(any))
            else {
                continue;
            };
            let empty = Region { area: 0.0, centre: [0.0; 2], weights: BTreeMap::new() };
            let region = regions.entry(groups.first(owner)).or_insert(empty);
            region.add([corners(k), corners(next), centre], heights, &[&[a], &[b], cell]);
        }
    }
    let mut regions: Vec<Region> = regions.into_values().filter(|region| region.area > 0.0).collect();
    for region in &mut regions {
        region.centre = region.centre.map(|x| x / region.area);
    }
    regions
}

/// Nodes that hang together, each group named by its first node.
struct Groups(Vec<u32>);

impl Groups {
    fn new(nodes: usize) -> Groups {
        Groups((0..nodes as u32).collect())
    }

    /// The first node of the group of `node`.
    fn first(&mut self, mut node: u32) -> u32 {
        while self.0[node as usize] != node {
            let above = self.0[self.0[node as usize] as usize];
            self.0[node as usize] = above;
            node = above;
        }
        node
    }

    fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.first(a), self.first(b));
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ElementKind, Sides};
    use std::f64::consts::PI;

    /// `count` by `count` squares over [0, 4] by [0, 4].
    fn squares(count: usize) -> Mesh {
        let width = 4.0 / count as f64;
        let node = |i: usize, j: usize| (j * (count + 1) + i) as u32;
        let place = |k: usize| [(k % (count + 1)) as f64 * width, (k / (count + 1)) as f64 * width];
        Mesh {
            kind: ElementKind::Quad4,
            nodes: (0..(count + 1) * (count + 1)).map(place).collect(),
            cells: (0..count * count)
                .flat_map(|k| {
                    let (i, j) = (k % count, k / count);
                    [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
                })
                .collect(),
            sides: Sides::default(),
        }
    }

    /// Two discs, their areas, centroids and the mean of a field over them: a line between nodes errs by the
    /// square of the width of a cell. Blocks of whole cells would err by the width: 25 % at eight cells.
    #[test]
    fn discs_have_their_area_centroid_and_mean_to_second_order() {
        let discs = [([1.1, 1.2], 0.8), ([2.9, 2.7], 0.9)];
        let mut errors = Vec::new();
        for count in [16, 32, 64] {
            let mesh = squares(count);
            let level = |p: &[f64; 2]| {
                let of = |(c, r): &([f64; 2], f64)| (p[0] - c[0]).hypot(p[1] - c[1]) - r;
                discs.iter().map(of).fold(f64::INFINITY, f64::min)
            };
            let values: Vec<f64> = mesh.nodes.iter().map(level).collect();
            let found = regions_below_zero(&mesh, &mesh.nodes, &values, |_| true);
            assert_eq!(found.len(), 2);
            let field: Vec<f64> = mesh.nodes.iter().map(|p| 2.0 + 3.0 * p[0] - p[1]).collect();
            let mut worst: f64 = 0.0;
            for (region, (centre, radius)) in found.iter().zip(discs) {
                worst = worst.max((region.area / (PI * radius * radius) - 1.0).abs());
                for i in 0..2 {
                    assert!((region.centre[i] - centre[i]).abs() < 4.0 / count as f64 / 20.0);
                }
                let mean = 2.0 + 3.0 * centre[0] - centre[1];
                assert!((region.mean(&field, |_| 1.0) / mean - 1.0).abs() < 0.01);
            }
            errors.push(worst);
        }
        assert!(errors[0] < 0.04 && errors[1] < 0.3 * errors[0] && errors[2] < 0.3 * errors[1], "{errors:?}");
    }

    #[test]
    fn a_region_ends_where_the_cells_that_count_end_and_nodes_alone_are_regions() {
        let mesh = squares(4);
        let all = regions_below_zero(&mesh, &mesh.nodes, &[-1.0; 25], |_| true);
        assert!(all.len() == 1 && (all[0].area - 16.0).abs() < 1e-12, "{all:?}");
        let half = regions_below_zero(&mesh, &mesh.nodes, &[-1.0; 25], |cell| cell % 4 < 2);
        assert!((half[0].area - 8.0).abs() < 1e-12 && (half[0].centre[0] - 1.0).abs() < 1e-12);
        // one node below its eight neighbours: a square of half the width of a cell on its tip
        let mut values = [1.0; 25];
        values[12] = -1.0;
        let one = regions_below_zero(&mesh, &mesh.nodes, &values, |_| true);
        assert!(one.len() == 1 && (one[0].area - 0.5).abs() < 0.26, "{one:?}");
        // two nodes across a cell whose centre is above zero do not hang together
        values[6] = -1.0;
        values[12] = -0.5;
        assert_eq!(regions_below_zero(&mesh, &mesh.nodes, &values, |_| true).len(), 2);
    }
}
