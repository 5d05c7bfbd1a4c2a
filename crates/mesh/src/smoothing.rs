//! Places of nodes that give the cells around them the best shape.
//!
//! Least sum over the corners of
//!   μ = |T|² / 2χ + ½ (χ + 1/χ),   T = [a/A  b/B],   χ = ½ (τ + √(τ² + 4δ²)),   τ = det T,
//! with a and b the sides that leave the corner, A and B their first lengths. The first part is least where
//! the sides are perpendicular and as long, one to the other, as they were first, the second where the cell
//! is as large. χ lets a corner that is inside out turn right again; δ falls to almost 0.
//!
//! Source: P. Knupp, Algebraic mesh quality metrics, SIAM J. Sci. Comput. 23 (2001); χ from J. Escobar et
//! al., Simultaneous untangling and smoothing of tetrahedral meshes, Comput. Methods Appl. Mech. Engrg. 192
//! (2003).

use crate::{ElementKind, Mesh};

/// δ of each round, and the sweeps over the nodes in it.
const ROUNDS: [(f64, usize); 5] = [(0.5, 10), (0.2, 10), (0.05, 20), (0.01, 20), (1e-3, 40)];

/// Halvings of a step that does not improve the cells.
const HALVINGS: usize = 12;

/// Shares of a side by which nodes still move when a round ends.
const SETTLED_MOVE: f64 = 0.02;

/// The way a node may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Not at all.
    None,
    /// Along z.
    Axial,
    /// Anywhere.
    Full,
}

/// A corner of a cell: its node, and those at the ends of the sides that leave it counterclockwise and
/// clockwise.
#[derive(Clone, Copy, Debug)]
struct Corner {
    nodes: [u32; 3],
    /// First lengths of the two sides.
    length: [f64; 2],
}

impl Corner {
    /// Value of μ and its derivative by the place of the corner's node `of` (0, 1 or 2).
    fn shape(&self, places: &[[f64; 2]], delta: f64, of: usize) -> (f64, [f64; 2]) {
        let x = self.nodes.map(|node| places[node as usize]);
        let side = |end: usize| [0, 1].map(|i| (x[end][i] - x[0][i]) / self.length[end - 1]);
        let (a, b) = (side(1), side(2));
        let square = a[0] * a[0] + a[1] * a[1] + b[0] * b[0] + b[1] * b[1];
        let tau = a[0] * b[1] - a[1] * b[0];
        let root = tau.hypot(2.0 * delta);
        // the sum of two numbers that cancel for τ < 0
        let chi = if tau > 0.0 { 0.5 * (tau + root) } else { 2.0 * delta * delta / (root - tau) };
        let by_tau = chi / root;
        // by a and b, then by the node
        let (m, t) = (1.0 / chi, 0.5 * ((square + 1.0) / (chi * chi) - 1.0) * by_tau);
        let by_a = [m * a[0] - t * b[1], m * a[1] + t * b[0]].map(|d| d / self.length[0]);
        let by_b = [m * b[0] + t * a[1], m * b[1] - t * a[0]].map(|d| d / self.length[1]);
        let gradient = match of {
            0 => [-by_a[0] - by_b[0], -by_a[1] - by_b[1]],
            1 => by_a,
            _ => by_b,
        };
        (0.5 * ((square + 1.0) / chi + chi), gradient)
    }
}

/// Corners that a node takes part in, and which of their nodes it is.
type Around = Vec<(Corner, usize)>;

/// Sum of μ over the corners around a node, and its gradient.
fn sum(around: &Around, places: &[[f64; 2]], delta: f64) -> (f64, [f64; 2]) {
    around.iter().fold((0.0, [0.0; 2]), |(value, gradient), (corner, of)| {
        let (more, by_place) = corner.shape(places, delta, *of);
        (value + more, [gradient[0] + by_place[0], gradient[1] + by_place[1]])
    })
}

/// A Newton step of the node towards the least sum, of the gradient `g`: down it where the sum is not convex.
fn step(
    around: &Around,
    places: &mut [[f64; 2]],
    (node, freedom): (usize, Freedom),
    delta: f64,
    size: f64,
    g: [f64; 2],
) -> [f64; 2] {
    let at = places[node];
    let h = 1e-5 * size;
    let mut hessian = [[0.0; 2]; 2];
    for i in 0..2 {
        let mut gradient = [[0.0; 2]; 2];
        for (gradient, sign) in gradient.iter_mut().zip([-1.0, 1.0]) {
            places[node][i] = at[i] + sign * h;
            *gradient = sum(around, places, delta).1;
        }
        places[node] = at;
        hessian[i] = [0, 1].map(|j| (gradient[1][j] - gradient[0][j]) / (2.0 * h));
    }
    let [[a, b], [_, d]] = hessian;
    let det = a * d - b * b;
    let newton = match freedom {
        Freedom::None => [0.0; 2],
        Freedom::Axial => [0.0, if d > 0.0 { -g[1] / d } else { -g[1].signum() * size }],
        Freedom::Full if a > 0.0 && det > 0.0 => [(b * g[1] - d * g[0]) / det, (b * g[0] - a * g[1]) / det],
        Freedom::Full => {
            let length = g[0].hypot(g[1]);
            if length > 0.0 { g.map(|g| -size * g / length) } else { [0.0; 2] }
        }
    };
    let far = newton[0].hypot(newton[1]);
    if far > size { newton.map(|x| x * size / far) } else { newton }
}

/// Moves the corner nodes that are free to where the cells of `mesh` have the best shape, beginning at
/// `places`; `freedom` is that of each node. Lengths in the unit of the mesh. Sides that were inside out may
/// stay so.
pub fn improve(mesh: &Mesh, places: &mut [[f64; 2]], freedom: &[Freedom]) {
    let mut around: Vec<Around> = vec![Vec::new(); mesh.nodes.len()];
    let length = |a: u32, b: u32| {
        let [a, b] = [a, b].map(|node| mesh.nodes[node as usize]);
        (b[0] - a[0]).hypot(b[1] - a[1])
    };
    for cell in 0..mesh.cell_count() {
        let nodes = mesh.cell(cell);
        for k in 0..4 {
            let nodes = [nodes[k], nodes[(k + 1) % 4], nodes[(k + 3) % 4]];
            let corner = Corner { nodes, length: [length(nodes[0], nodes[1]), length(nodes[0], nodes[2])] };
            for (of, &node) in nodes.iter().enumerate() {
                if freedom[node as usize] != Freedom::None {
                    around[node as usize].push((corner, of));
                }
            }
        }
    }
    let free: Vec<usize> = (0..around.len()).filter(|&node| !around[node].is_empty()).collect();
    for (delta, sweeps) in ROUNDS {
        for _ in 0..sweeps {
            let mut farthest: f64 = 0.0;
            for &node in &free {
                let around = &around[node];
                let lengths = around.iter().flat_map(|(corner, _)| corner.length);
                let size = lengths.fold(f64::INFINITY, f64::min);
                let at = places[node];
                let (value, gradient) = sum(around, places, delta);
                let way = step(around, places, (node, freedom[node]), delta, size, gradient);
                let mut share = 1.0;
                let better = (0..HALVINGS).any(|_| {
                    places[node] = [0, 1].map(|i| at[i] + share * way[i]);
                    share *= 0.5;
                    sum(around, places, delta).0 < value
                });
                if !better {
                    places[node] = at;
                }
                farthest = farthest.max((places[node][0] - at[0]).hypot(places[node][1] - at[1]) / size);
            }
            if farthest < SETTLED_MOVE {
                break;
            }
        }
    }
}

/// Puts the mid-side nodes of sides whose ends are no longer where they were `before` halfway between them,
/// except those of `on_surface`. All are by the number of the node.
pub fn straighten(mesh: &Mesh, before: &[[f64; 2]], on_surface: &[bool], places: &mut [[f64; 2]]) {
    if mesh.kind != ElementKind::Quad8 {
        return;
    }
    for cell in 0..mesh.cell_count() {
        let nodes = mesh.cell(cell);
        for k in 0..4 {
            let [a, b, middle] = [nodes[k], nodes[(k + 1) % 4], nodes[4 + k]].map(|node| node as usize);
            if on_surface[middle] {
                continue;
            }
            places[middle] = if places[a] == before[a] && places[b] == before[b] {
                before[middle]
            } else {
                [0, 1].map(|i| 0.5 * (places[a][i] + places[b][i]))
            };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sides;

    /// Four unit squares around node 4.
    fn squares() -> Mesh {
        let nodes = (0..9).map(|i| [f64::from(i % 3), f64::from(i / 3)]).collect();
        let cells = vec![0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7];
        Mesh { kind: ElementKind::Quad4, nodes, cells, sides: Sides::default() }
    }

    #[test]
    fn the_gradient_is_the_derivative_inside_out_and_not() {
        let corner = Corner { nodes: [0, 1, 2], length: [1.0, 2.0] };
        for places in [[[0.1, 0.2], [1.3, 0.1], [-0.2, 1.7]], [[0.1, 0.2], [1.3, 0.1], [0.3, -0.9]]] {
            for of in 0..3 {
                let (_, gradient) = corner.shape(&places, 0.1, of);
                for (i, exact) in gradient.into_iter().enumerate() {
                    let at = |step: f64| {
                        let mut moved = places;
                        moved[of][i] += step;
                        corner.shape(&moved, 0.1, of).0
                    };
                    let slope = (at(1e-6) - at(-1e-6)) / 2e-6;
                    // rounding of the difference
                    assert!((slope - exact).abs() < 1e-7 * exact.abs().max(1.0), "{of} {i}: {slope} {exact}");
                }
            }
        }
    }

    #[test]
    fn a_node_outside_of_its_cells_comes_back_to_their_middle() {
        let mesh = squares();
        let mut places = mesh.nodes.clone();
        places[4] = [2.6, 1.4];
        let mut freedom = [Freedom::None; 9];
        freedom[4] = Freedom::Full;
        improve(&mesh, &mut places, &freedom);
        let far = (places[4][0] - 1.0).hypot(places[4][1] - 1.0);
        assert!(far < SETTLED_MOVE, "{:?}", places[4]);
        assert_eq!(places[..4], mesh.nodes[..4]);
    }
}
