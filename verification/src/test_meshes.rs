//! Small meshes for the tests: a grid of the unit square mapped anywhere.

use asperity_mesh::{Edge, ElementKind, Mesh, Sides};
use std::f64::consts::FRAC_PI_2;

/// `counts` cells of the unit square (s, t), placed by `place`, mid-side nodes at the images of their own (s,
/// t).
///
/// Sides: `axis` s = 0, `base` t = 0, `outer` s = 1, `surface` t = 1. `place` must keep the orientation.
pub fn mapped(kind: ElementKind, counts: [usize; 2], place: impl Fn([f64; 2]) -> [f64; 2]) -> Mesh {
    let [m, n] = counts;
    let at = |i: usize, j: usize| place([i as f64 / (2 * m) as f64, j as f64 / (2 * n) as f64]);
    let mut nodes: Vec<[f64; 2]> = Vec::new();
    // half steps of the grid; only those of the element are given a node
    let mut ids = vec![u32::MAX; (2 * m + 1) * (2 * n + 1)];
    let id = |i: usize, j: usize| j * (2 * m + 1) + i;
    for j in 0..=2 * n {
        for i in 0..=2 * m {
            let corner = i % 2 == 0 && j % 2 == 0;
            let middle = (i + j) % 2 == 1 && kind == ElementKind::Quad8;
            if corner || middle {
                ids[id(i, j)] = nodes.len() as u32;
                nodes.push(at(i, j));
            }
        }
    }
    let mut cells = Vec::new();
    for j in 0..n {
        for i in 0..m {
            let (x, y) = (2 * i, 2 * j);
            let all = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]];
            cells.extend(all[..kind.nodes()].iter().map(|[p, q]| ids[id(x + p, y + q)]));
        }
    }
    let cell = |i: usize, j: usize| (j * m + i) as u32;
    let sides = Sides {
        axis: (0..n).map(|j| Edge { cell: cell(0, j), side: 3 }).collect(),
        base: (0..m).map(|i| Edge { cell: cell(i, 0), side: 0 }).collect(),
        outer: (0..n).map(|j| Edge { cell: cell(m - 1, j), side: 1 }).collect(),
        surface: (0..m).map(|i| Edge { cell: cell(i, n - 1), side: 2 }).collect(),
    };
    Mesh { kind, nodes, cells, sides }
}

/// The unit square in 4 × 4 cells whose inner corners are pushed about by up to a quarter of a cell, sides
/// straight.
pub fn distorted_square(kind: ElementKind) -> Mesh {
    let mut mesh = mapped(kind, [4, 4], |x| x);
    for (k, x) in mesh.nodes.iter_mut().enumerate() {
        if x.iter().all(|s| *s > 0.0 && *s < 1.0) {
            let phase = k as f64;
            x[0] += 0.06 * (2.3 * phase).sin();
            x[1] += 0.06 * (1.7 * phase + 1.0).cos();
        }
    }
    straighten(&mut mesh);
    mesh
}

/// Puts mid-side nodes at the middle of their sides.
pub fn straighten(mesh: &mut Mesh) {
    for cell in 0..mesh.cell_count() {
        let nodes = mesh.cell(cell).to_vec();
        for (k, &middle) in nodes.iter().skip(4).enumerate() {
            let (a, b) = (mesh.nodes[nodes[k] as usize], mesh.nodes[nodes[(k + 1) % 4] as usize]);
            mesh.nodes[middle as usize] = [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])];
        }
    }
}

/// A quarter of an annulus, or of a hollow sphere in axisymmetry: radii `inner` to `outer`, s along the
/// radius and t along the angle from z = 0 to r = 0. `axis` is the inner surface, `outer` the outer one,
/// `base` z = 0, `surface` r = 0.
pub fn quarter_ring(kind: ElementKind, counts: [usize; 2], inner: f64, outer: f64) -> Mesh {
    mapped(kind, counts, |[s, t]| {
        // constant ratio of successive radii: elements keep their shape
        let radius = inner * (outer / inner).powf(s);
        let (sine, cosine) = (FRAC_PI_2 * t).sin_cos();
        // exactly on the axis at the end
        [if t == 1.0 { 0.0 } else { radius * cosine }, radius * sine]
    })
}

/// A flat block 0 ≤ r ≤ `size`, -`size` ≤ z ≤ 0 whose surface has `across` equal elements on 0 ≤ r ≤ 1, as
/// fine beyond to r = 1.5; from there outward, and from the surface downward, elements grow by a constant
/// factor.
pub fn punch_block(kind: ElementKind, across: usize, size: f64) -> Mesh {
    let fine = across + across / 2;
    let h = 1.0 / across as f64;
    let mut r: Vec<f64> = (0..=fine).map(|i| i as f64 * h).collect();
    grow(&mut r, h, 1.3, size);
    let mut depth = vec![0.0];
    grow(&mut depth, h, 1.1, size);
    depth.reverse();
    let along = |stations: &[f64], share: f64| {
        let x = share * (stations.len() - 1) as f64;
        let i = (x as usize).min(stations.len() - 2);
        stations[i] + (x - i as f64) * (stations[i + 1] - stations[i])
    };
    mapped(kind, [r.len() - 1, depth.len() - 1], |[s, t]| [along(&r, s), -along(&depth, t)])
}

/// Adds stations to `size`, each step `factor` times the last, the first `step` long; the last step fills
/// the remainder.
fn grow(stations: &mut Vec<f64>, mut step: f64, factor: f64, size: f64) {
    let mut x = stations[stations.len() - 1];
    while x + 1.5 * step < size {
        x += step;
        stations.push(x);
        step *= factor;
    }
    stations.push(size);
}

/// The nodes of some edges, each once.
pub fn nodes_of(mesh: &Mesh, edges: &[Edge]) -> Vec<usize> {
    let mut nodes: Vec<usize> = edges
        .iter()
        .flat_map(|&edge| {
            let (corners, middle) = mesh.edge_nodes(edge);
            corners.into_iter().chain(middle)
        })
        .map(|node| node as usize)
        .collect();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// For each node, whether it lies on the boundary.
pub fn boundary(mesh: &Mesh) -> Vec<bool> {
    let mut on = vec![false; mesh.nodes.len()];
    let sides = &mesh.sides;
    for edges in [&sides.axis, &sides.base, &sides.outer, &sides.surface] {
        for node in nodes_of(mesh, edges) {
            on[node] = true;
        }
    }
    on
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners counterclockwise, every node used, four sides that close the boundary.
    #[test]
    fn meshes_are_sound() {
        for kind in [ElementKind::Quad4, ElementKind::Quad8] {
            for mesh in [
                mapped(kind, [3, 2], |x| x),
                distorted_square(kind),
                quarter_ring(kind, [4, 6], 1.0, 2.0),
                punch_block(kind, 6, 5.0),
            ] {
                for cell in 0..mesh.cell_count() {
                    let x: Vec<[f64; 2]> =
                        mesh.cell(cell)[..4].iter().map(|&n| mesh.nodes[n as usize]).collect();
                    let area: f64 =
                        (0..4).map(|k| x[k][0] * x[(k + 1) % 4][1] - x[(k + 1) % 4][0] * x[k][1]).sum();
                    assert!(area > 0.0);
                }
                let mut used = vec![false; mesh.nodes.len()];
                mesh.cells.iter().for_each(|&n| used[n as usize] = true);
                assert!(used.iter().all(|u| *u));
                assert!(boundary(&mesh).iter().any(|b| !b));
            }
        }
    }

    #[test]
    fn a_punch_edge_is_a_node() {
        for kind in [ElementKind::Quad4, ElementKind::Quad8] {
            let mesh = punch_block(kind, 18, 5.0);
            assert!(mesh.nodes.iter().any(|x| (x[0] - 1.0).abs() < 1e-9 && x[1] == 0.0));
        }
    }
}
