//! Frictionless penalty contact of the free surface with itself: flanks that meet, flanks that lie down on the base.
//!
//! The surface is taken as a chain of straight pieces between neighbouring nodes. Energy ∫ ½ (ε/2) d² dA over the surface, with d
//! the depth of a surface point behind the nearest of the pieces that it faces, and A the area of the last converged state as
//! for the tool: each side presses the other with half the penalty ε, so that two flat faces press with ε d. The force is the
//! gradient of this energy, the tangent its second derivative.
//!
//! Which points face which pieces is found once an increment, from the converged state: a point inside thin metal lies behind
//! its other side as well, and only its past tells the two apart. A piece is faced if the two normals part by more than 60° and the
//! point lay outside of it or less than [`DEEPEST`] of a piece behind.

use crate::contact::edge::ContactEdge;
use crate::contact::piece::{Depth, Ends, Nearest, behind_end, behind_line, intersection, nearest};

/// Share of the length of a piece up to which a point may lie behind it: more would be the other side of thin metal.
const DEEPEST: f64 = 0.25;

/// Cosine between outward normals from which on two pieces do not face each other.
const FACING: f64 = 0.5;

/// Displacements of the last increment within which the next one may bring two pieces together.
const REACH: f64 = 3.0;

/// Integration points of each piece: abscissa in [0, 1] and weight.
const GAUSS: [[f64; 2]; 4] = [
    [0.069_431_844_202_973_7, 0.173_927_422_568_726_93],
    [0.330_009_478_207_571_9, 0.326_072_577_431_273_07],
    [0.669_990_521_792_428_1, 0.326_072_577_431_273_07],
    [0.930_568_155_797_026_3, 0.173_927_422_568_726_93],
];

/// A straight piece of the surface between two neighbouring nodes, the body on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    nodes: [u32; 2],
    /// The edge it belongs to, and its interval of that edge's coordinate.
    edge: usize,
    interval: [f64; 2],
    ends: [[f64; 2]; 2],
}

/// A point of the surface and the pieces that it faces.
#[derive(Clone, Debug, PartialEq)]
pub struct FacingPoint {
    /// The edge it lies on, and its coordinate there.
    edge: usize,
    xi: f64,
    /// Its reference area.
    weight: f64,
    /// The pieces, by their nodes.
    pieces: Vec<[u32; 2]>,
}

/// The points of a surface that face other parts of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facing {
    points: Vec<FacingPoint>,
}

/// What a point that lies behind a piece adds.
#[derive(Clone, Copy, Debug)]
pub struct Pressed {
    /// Nodes: those of the edge of the point, then the two of the piece.
    pub nodes: [u32; 5],
    /// How many of them there are.
    pub count: usize,
    /// Energy.
    pub energy: f64,
    /// Nodal forces, the gradient of the energy.
    pub force: [[f64; 2]; 5],
    /// Second derivative of the energy, `[node a][i][node b][j]`.
    pub stiffness: [[[[f64; 2]; 5]; 2]; 5],
}

impl Piece {
    fn direction(&self) -> [f64; 2] {
        let [a, b] = self.ends;
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0].hypot(along[1]);
        along.map(|along| along / length)
    }

    fn length(&self) -> f64 {
        let [a, b] = self.ends;
        (b[0] - a[0]).hypot(b[1] - a[1])
    }

    /// Least and greatest coordinate of the piece with `margin` around it.
    fn span(&self, axis: usize, margin: f64) -> [f64; 2] {
        let (a, b) = (self.ends[0][axis], self.ends[1][axis]);
        [a.min(b) - margin, a.max(b) + margin]
    }

    fn touches(&self, other: &Piece) -> bool {
        self.edge == other.edge || self.nodes.iter().any(|node| other.nodes.contains(node))
    }

    /// Whether the two normals part so far that the pieces may press each other.
    fn faces(&self, other: &Piece) -> bool {
        let (s, t) = (self.direction(), other.direction());
        !self.touches(other) && s[0] * t[0] + s[1] * t[1] < FACING
    }
}

/// The pieces of `edges`, whose nodes are at `position`.
fn pieces(edges: &[ContactEdge], position: &[[f64; 2]]) -> Vec<Piece> {
    let mut pieces = Vec::with_capacity(2 * edges.len());
    for (number, edge) in edges.iter().enumerate() {
        let [first, last, middle] = edge.nodes;
        let mut add = |nodes: [u32; 2], interval| {
            pieces.push(Piece { nodes, edge: number, interval, ends: nodes.map(|n| position[n as usize]) });
        };
        if edge.quadratic {
            add([first, middle], [-1.0, 0.0]);
            add([middle, last], [0.0, 1.0]);
        } else {
            add([first, last], [-1.0, 1.0]);
        }
    }
    pieces
}

/// Pairs of pieces that `count` and whose boxes, `margin` wider than they, overlap: swept along r, so that only neighbours are
/// compared.
fn close_pairs(pieces: &[Piece], margin: f64, count: impl Fn(&Piece, &Piece) -> bool) -> Vec<[usize; 2]> {
    let spans: Vec<_> = pieces.iter().map(|piece| [0, 1].map(|axis| piece.span(axis, margin))).collect();
    let mut order: Vec<usize> = (0..pieces.len()).collect();
    order.sort_unstable_by(|&a, &b| spans[a][0][0].total_cmp(&spans[b][0][0]));
    let mut pairs = Vec::new();
    for (i, &a) in order.iter().enumerate() {
        for &b in order[i + 1..].iter().take_while(|&&b| spans[b][0][0] <= spans[a][0][1]) {
            let overlap = spans[a][1][0] <= spans[b][1][1] && spans[b][1][0] <= spans[a][1][1];
            if overlap && count(&pieces[a], &pieces[b]) {
                pairs.push([a, b]);
            }
        }
    }
    pairs
}

impl Facing {
    /// The points of `edges` that face other parts of the surface. Nodes are at `position`, in the last increment they moved by
    /// `displacement`.
    pub fn new(edges: &[ContactEdge], position: &[[f64; 2]], displacement: &[[f64; 2]]) -> Facing {
        let pieces = pieces(edges, position);
        let nodes = edges.iter().flat_map(|edge| edge.nodes);
        let moved = nodes.map(|n| displacement[n as usize]).fold(0.0, |m: f64, [r, z]| m.max(r.hypot(z)));
        let mut partners: Vec<Vec<usize>> = vec![Vec::new(); pieces.len()];
        for [a, b] in close_pairs(&pieces, REACH * moved, Piece::faces) {
            partners[a].push(b);
            partners[b].push(a);
        }
        let mut points = Vec::new();
        for (piece, mut partners) in pieces.iter().zip(partners) {
            partners.sort_unstable();
            let edge = &edges[piece.edge];
            let x = edge.nodes.map(|node| position[node as usize]);
            let [from, to] = piece.interval;
            for [share, weight] in GAUSS {
                let xi = from + (to - from) * share;
                let here = edge.point(&x, xi);
                let outside = |other: &&usize| {
                    let other = &pieces[**other];
                    let [a, b] = other.ends;
                    let (distance, behind, place) = nearest([here, a, b]);
                    let limit = DEEPEST * piece.length().min(other.length());
                    !behind || (place == Nearest::Between && distance < limit)
                };
                let faced: Vec<_> =
                    partners.iter().filter(outside).map(|&other| pieces[other].nodes).collect();
                if !faced.is_empty() {
                    let weight = weight * (to - from) * edge.measure(xi);
                    points.push(FacingPoint { edge: piece.edge, xi, weight, pieces: faced });
                }
            }
        }
        Facing { points }
    }

    /// Where the surface of `edges`, whose nodes are at `position`, passed through itself: pieces cross that do not face each other.
    pub fn fold(&self, edges: &[ContactEdge], position: &[[f64; 2]]) -> Option<[f64; 2]> {
        let pieces = pieces(edges, position);
        let pairs = close_pairs(&pieces, 0.0, |a, b| !a.touches(b));
        pairs.into_iter().find_map(|[a, b]| {
            let (a, b) = (&pieces[a], &pieces[b]);
            let crossing = intersection(a.ends, b.ends)?;
            (!self.know(a, b) && !self.know(b, a)).then_some(crossing)
        })
    }

    /// Whether a point of one piece faces the other.
    fn know(&self, piece: &Piece, other: &Piece) -> bool {
        let [from, to] = piece.interval;
        self.points
            .iter()
            .any(|p| p.edge == piece.edge && (from..=to).contains(&p.xi) && p.pieces.contains(&other.nodes))
    }

    /// Whether nothing faces anything.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Nodes that may press each other: those of the edge of a point with those of a piece.
    pub fn couplings<'a>(&'a self, edges: &'a [ContactEdge]) -> impl Iterator<Item = ([u32; 5], usize)> + 'a {
        self.points
            .iter()
            .flat_map(move |point| point.pieces.iter().map(move |&piece| together(&edges[point.edge], piece)))
    }

    /// What presses where the nodes are at `x(node)`, with `penalty` ε, one entry for each point behind a piece.
    pub fn press<'a>(
        &'a self,
        edges: &'a [ContactEdge],
        penalty: f64,
        x: impl Fn(u32) -> [f64; 2] + Copy + 'a,
    ) -> impl Iterator<Item = Pressed> + 'a {
        self.points.iter().filter_map(move |point| point.press(&edges[point.edge], 0.5 * penalty, x))
    }
}

/// The nodes of an edge and of a piece, and how many they are.
fn together(edge: &ContactEdge, piece: [u32; 2]) -> ([u32; 5], usize) {
    let count = edge.node_count();
    let mut nodes = [0; 5];
    nodes[..count].copy_from_slice(&edge.nodes[..count]);
    nodes[count..count + 2].copy_from_slice(&piece);
    (nodes, count + 2)
}

impl FacingPoint {
    /// The piece nearest to the point at `here` and the depth behind it, if the point lies behind the surface.
    fn depth(&self, here: [f64; 2], x: impl Fn(u32) -> [f64; 2]) -> Option<([u32; 2], Depth)> {
        let ends = |piece: &[u32; 2]| -> Ends { [here, x(piece[0]), x(piece[1])] };
        let found = self.pieces.iter().map(|piece| (piece, nearest(ends(piece))));
        let (piece, (_, behind, place)) = found.min_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
        match place {
            Nearest::Between => behind.then(|| (*piece, behind_line(ends(piece)))),
            // behind an end only if behind both pieces that meet there: beyond the end of a chain nothing is known
            Nearest::End(end) => {
                let other = self.pieces.iter().find(|other| other[1 - end] == piece[end])?;
                let both = behind && nearest(ends(other)).1;
                both.then(|| (*piece, behind_end(ends(piece), end)))
            }
        }
    }

    fn press(&self, edge: &ContactEdge, penalty: f64, x: impl Fn(u32) -> [f64; 2] + Copy) -> Option<Pressed> {
        let here = edge.point(&edge.nodes.map(x), self.xi);
        let (piece, depth) = self.depth(here, x)?;
        let (nodes, count) = together(edge, piece);
        let mut pressed = Pressed {
            nodes,
            count,
            energy: 0.5 * self.weight * penalty * depth.depth * depth.depth,
            force: [[0.0; 2]; 5],
            stiffness: [[[[0.0; 2]; 5]; 2]; 5],
        };
        // (x, a, b) are shares of the nodes: x of those of the edge, a and b nodes themselves
        let shape = edge.shape(self.xi);
        let place = |node: usize| match node.checked_sub(count - 2) {
            None => (0, shape[node]),
            Some(end) => (2 + 2 * end, 1.0),
        };
        for a in 0..count {
            let (i0, share) = place(a);
            for i in 0..2 {
                let slope = share * depth.slope[i0 + i];
                pressed.force[a][i] = self.weight * penalty * depth.depth * slope;
                for b in 0..count {
                    let (j0, other) = place(b);
                    for j in 0..2 {
                        pressed.stiffness[a][i][b][j] = self.weight
                            * penalty
                            * (slope * other * depth.slope[j0 + j]
                                + depth.depth * share * other * depth.curvature[i0 + i][j0 + j]);
                    }
                }
            }
        }
        Some(pressed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::point::kinematics::Symmetry;

    /// Two quadratic edges, one above the other, that overlap a little: the upper side of a body and the lower side of another.
    fn two_faces() -> (Vec<ContactEdge>, Vec<[f64; 2]>) {
        let position = vec![
            [1.0, 0.02],
            [0.0, -0.01],
            [0.45, 0.01], // upper side, towards the axis
            [0.2, 0.0],
            [1.3, -0.01],
            [0.8, 0.005], // lower side, away from it
        ];
        let edge = |nodes: [u32; 2], middle| {
            ContactEdge::new(nodes, Some(middle), |n| position[n as usize], Symmetry::Axisymmetric)
        };
        (vec![edge([0, 1], 2), edge([3, 4], 5)], position)
    }

    fn energy(facing: &Facing, edges: &[ContactEdge], position: &[[f64; 2]]) -> f64 {
        facing.press(edges, 3.0, |n| position[n as usize]).map(|p| p.energy).sum()
    }

    #[test]
    fn force_and_tangent_are_derivatives_of_the_energy() {
        let (edges, position) = two_faces();
        let facing = Facing::new(&edges, &position, &vec![[0.1; 2]; 6]);
        assert!(!facing.is_empty() && energy(&facing, &edges, &position) > 0.0);
        let (mut force, mut stiffness) = ([0.0; 12], [[0.0; 12]; 12]);
        for pressed in facing.press(&edges, 3.0, |n| position[n as usize]) {
            for a in 0..pressed.count {
                for i in 0..2 {
                    let row = 2 * pressed.nodes[a] as usize + i;
                    force[row] += pressed.force[a][i];
                    for b in 0..pressed.count {
                        for j in 0..2 {
                            stiffness[row][2 * pressed.nodes[b] as usize + j] +=
                                pressed.stiffness[a][i][b][j];
                        }
                    }
                }
            }
        }
        let step = 1e-6;
        for i in 0..12 {
            let moved = |by: f64| {
                let mut moved = position.clone();
                moved[i / 2][i % 2] += by;
                moved
            };
            let (after, before) = (moved(step), moved(-step));
            let slope = (energy(&facing, &edges, &after) - energy(&facing, &edges, &before)) / (2.0 * step);
            // central differences: rounding 1e-10 of an energy of 1e-3
            assert!((force[i] - slope).abs() < 1e-9, "force {i}: {} {slope}", force[i]);
            for j in 0..12 {
                let at = |position: &[[f64; 2]]| -> f64 {
                    let pressed = facing.press(&edges, 3.0, |n| position[n as usize]);
                    pressed
                        .flat_map(|p| (0..p.count).map(move |a| (p.nodes[a], p.force[a])))
                        .filter(|(node, _)| *node as usize == j / 2)
                        .map(|(_, force)| force[j % 2])
                        .sum()
                };
                let slope = (at(&after) - at(&before)) / (2.0 * step);
                assert!((stiffness[i][j] - slope).abs() < 1e-7, "{i} {j}: {} {slope}", stiffness[i][j]);
                assert!((stiffness[i][j] - stiffness[j][i]).abs() < 1e-15);
            }
        }
    }

    /// What one side receives the other gives, and the moment vanishes as well: the force on a pair of flanks is their own affair.
    #[test]
    fn forces_are_in_equilibrium() {
        let (edges, position) = two_faces();
        let facing = Facing::new(&edges, &position, &vec![[0.1; 2]; 6]);
        for pressed in facing.press(&edges, 3.0, |n| position[n as usize]) {
            let nodes = || pressed.nodes[..pressed.count].iter().zip(&pressed.force);
            let sum = |i: usize| nodes().map(|(_, f)| f[i]).sum::<f64>();
            let moment: f64 =
                nodes().map(|(&n, f)| position[n as usize][0] * f[1] - position[n as usize][1] * f[0]).sum();
            assert!(sum(0).abs() < 1e-16 && sum(1).abs() < 1e-16 && moment.abs() < 1e-16);
        }
    }

    #[test]
    fn a_loop_folds_and_a_zigzag_does_not() {
        let fold = |points: &[[f64; 2]]| {
            let node = |n: u32| points[n as usize];
            let edges: Vec<_> = (1..points.len() as u32)
                .map(|n| ContactEdge::new([n - 1, n], None, node, Symmetry::PlaneStrain))
                .collect();
            Facing::default().fold(&edges, points)
        };
        assert_eq!(fold(&[[0.0, 0.0], [1.0, 1.0], [0.5, 2.0], [1.5, 3.0], [2.0, 0.0]]), None);
        assert_eq!(fold(&[[0.0, 0.0], [2.0, 1.0], [2.0, 0.0], [0.0, 1.0]]), Some([1.0, 0.5]));
    }

    /// The two sides of a plate a third of a piece thick do not press each other, neighbours on a convex surface neither.
    #[test]
    fn the_other_side_of_thin_metal_is_not_faced() {
        let (edges, mut position) = two_faces();
        for x in &mut position[..3] {
            x[1] += 0.2;
        }
        assert!(Facing::new(&edges, &position, &vec![[0.1; 2]; 6]).is_empty());
        let round: Vec<[f64; 2]> = (0..17)
            .map(|i| f64::from(i) / 16.0 * std::f64::consts::PI)
            .map(|angle| [2.0 + angle.cos(), angle.sin()])
            .collect();
        let edges: Vec<_> = (0..8)
            .map(|e| {
                let node = |n: u32| round[n as usize];
                ContactEdge::new([2 * e, 2 * e + 2], Some(2 * e + 1), node, Symmetry::PlaneStrain)
            })
            .collect();
        assert!(Facing::new(&edges, &round, &vec![[0.3; 2]; 17]).is_empty());
    }
}
