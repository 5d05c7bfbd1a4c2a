//! Frictionless penalty contact of the free surface with itself: flanks that meet, flanks that lie down on
//! the base.
//!
//! Energy ∫ ½ (ε/2) d² dA over the surface. ε is `PENALTY_RATIO` times the tool's penalty, d the depth of a
//! surface point behind the nearest of the edges that it faces, A the area of the last converged state as for
//! the tool. Each side presses the other with half the penalty, so that two faces press with ε d. The force
//! is the gradient of this energy, the tangent its second derivative. Integration points lie between the
//! places where nodes of the other side were, so that two meshes that do not match carry a uniform pressure
//! exactly.
//!
//! Points and the edges that they face are found once an increment, from the converged state: a point inside
//! thin metal lies behind its other side as well, and only its past tells the two apart. An edge is faced if
//! the two normals part by more than 60° and the point lay outside of it or less than `LARGEST_OVERLAP` of a
//! piece behind. Pieces are the straight lines between neighbouring nodes.

use crate::contact::edge::{ContactEdge, GAUSS4};
use crate::contact::projection::{Depth, NODES_OF_TWO_EDGES, Placed, intersection};

/// Share of the length of a piece up to which a point may lie behind it: more would be the other side of thin
/// metal.
const LARGEST_OVERLAP: f64 = 0.25;

/// The penalty over that of the tool, which is softer than the metal by an order of magnitude so that Newton
/// follows a front that runs over many edges; a fold grows slowly, and lies where elements are as coarse as
/// the tool's penetration is deep.
const PENALTY_RATIO: f64 = 4.0;

/// The same for an edge that the piece faced before: there is no doubt which side it came from.
const LARGEST_OVERLAP_OF_FACED: f64 = 2.0;

/// Cosine between outward normals from which on two pieces do not face each other.
const FACING_COSINE: f64 = 0.5;

/// Displacements of the last increment within which the next one may bring two pieces together.
const REACH_IN_DISPLACEMENTS: f64 = 3.0;

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
    /// The edges that it faces.
    faced: Vec<usize>,
}

/// The points of a surface that face other parts of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Facing {
    points: Vec<FacingPoint>,
}

/// Force and stiffness of a point that lies behind a piece.
#[derive(Clone, Copy, Debug)]
pub struct Pressed {
    /// Nodes: those of the edge of the point, then those of the other edge.
    pub nodes: [u32; NODES_OF_TWO_EDGES],
    /// Number of them.
    pub count: usize,
    /// Energy.
    pub energy: f64,
    /// Nodal forces, the gradient of the energy.
    pub force: [[f64; 2]; NODES_OF_TWO_EDGES],
    /// Second derivative of the energy, `[node a][i][node b][j]`.
    pub stiffness: [[[[f64; 2]; NODES_OF_TWO_EDGES]; 2]; NODES_OF_TWO_EDGES],
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

    /// True where the two normals part so far that the pieces may press each other.
    fn faces(&self, other: &Piece) -> bool {
        let (s, t) = (self.direction(), other.direction());
        !self.touches(other) && s[0] * t[0] + s[1] * t[1] < FACING_COSINE
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

/// Pairs of pieces that `count` and whose boxes, `margin` wider than they, overlap: swept along r, so that
/// only neighbours are compared.
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
    /// The points of `edges` that face other parts of the surface, which faced each other as in `before`.
    /// Nodes are at `position`, in the last increment they moved by `displacement`.
    pub fn new(
        edges: &[ContactEdge],
        position: &[[f64; 2]],
        displacement: &[[f64; 2]],
        before: &Facing,
    ) -> Facing {
        let pieces = pieces(edges, position);
        let nodes = edges.iter().flat_map(|edge| edge.nodes);
        let moved = nodes.map(|n| displacement[n as usize]).fold(0.0, |m: f64, [r, z]| m.max(r.hypot(z)));
        let mut partners: Vec<Vec<usize>> = vec![Vec::new(); pieces.len()];
        for [a, b] in close_pairs(&pieces, REACH_IN_DISPLACEMENTS * moved, Piece::faces) {
            partners[a].push(b);
            partners[b].push(a);
        }
        let placed = |edge: usize| {
            let edge = &edges[edge];
            Placed { edge, x: edge.nodes.map(|node| position[node as usize]) }
        };
        let mut points = Vec::new();
        for (piece, partners) in pieces.iter().zip(partners).filter(|(_, partners)| !partners.is_empty()) {
            let own = placed(piece.edge);
            let mut others: Vec<usize> = partners.iter().map(|&other| pieces[other].edge).collect();
            others.sort_unstable();
            others.dedup();
            let nodes = others.iter().flat_map(|&other| placed(other).x);
            for [from, to] in parts(&own, piece.interval, nodes) {
                for [abscissa, weight] in GAUSS4 {
                    let half = 0.5 * (to - from);
                    let xi = from + half * (1.0 + abscissa);
                    let outside = |&&other: &&usize| {
                        let nearest = placed(other).nearest(own.point(xi));
                        let share = if before.knows(piece, other) {
                            LARGEST_OVERLAP_OF_FACED
                        } else {
                            LARGEST_OVERLAP
                        };
                        let limit = share * piece.length().min(0.5 * placed(other).length());
                        !nearest.behind || (nearest.end.is_none() && nearest.distance < limit)
                    };
                    let faced: Vec<usize> = others.iter().filter(outside).copied().collect();
                    if !faced.is_empty() {
                        let weight = weight * half * own.edge.measure(xi);
                        points.push(FacingPoint { edge: piece.edge, xi, weight, faced });
                    }
                }
            }
        }
        Facing { points }
    }

    /// The place where the surface of `edges`, whose nodes are at `position`, passed through itself: pieces
    /// cross that do not face each other.
    pub fn fold(&self, edges: &[ContactEdge], position: &[[f64; 2]]) -> Option<[f64; 2]> {
        let pieces = pieces(edges, position);
        let pairs = close_pairs(&pieces, 0.0, |a, b| !a.touches(b));
        pairs.into_iter().find_map(|[a, b]| {
            let (a, b) = (&pieces[a], &pieces[b]);
            let crossing = intersection(a.ends, b.ends)?;
            (!self.knows(a, b.edge) && !self.knows(b, a.edge)).then_some(crossing)
        })
    }

    /// True where a point of the piece faces the edge.
    fn knows(&self, piece: &Piece, edge: usize) -> bool {
        let [from, to] = piece.interval;
        self.points
            .iter()
            .any(|p| p.edge == piece.edge && (from..=to).contains(&p.xi) && p.faced.contains(&edge))
    }

    /// True where nothing faces anything.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Nodes that may press each other: those of the edge of a point with those of another edge.
    pub fn couplings<'a>(
        &'a self,
        edges: &'a [ContactEdge],
    ) -> impl Iterator<Item = ([u32; NODES_OF_TWO_EDGES], usize)> + 'a {
        self.points.iter().flat_map(move |point| {
            point.faced.iter().map(move |&other| together(&edges[point.edge], &edges[other]))
        })
    }

    /// The edges that press each other with the nodes at `position`, the smaller number first.
    pub fn pressed_edges(&self, edges: &[ContactEdge], position: &[[f64; 2]]) -> Vec<[usize; 2]> {
        let x = |node: u32| position[node as usize];
        let pair = |point: &FacingPoint| {
            let own = Placed { edge: &edges[point.edge], x: edges[point.edge].nodes.map(x) };
            let (other, _) = point.depth(edges, &own, x)?;
            Some([point.edge.min(other), point.edge.max(other)])
        };
        self.points.iter().filter_map(pair).collect()
    }

    /// The pressed points where the nodes are at `x(node)`, with `penalty` ε, one entry for each point behind
    /// an edge.
    pub fn press<'a>(
        &'a self,
        edges: &'a [ContactEdge],
        penalty: f64,
        x: impl Fn(u32) -> [f64; 2] + Copy + 'a,
    ) -> impl Iterator<Item = Pressed> + 'a {
        self.points.iter().filter_map(move |point| point.press(edges, 0.5 * PENALTY_RATIO * penalty, x))
    }
}

/// The interval of an edge between its ends and the places of `nodes` of the other side.
fn parts(own: &Placed<'_>, [from, to]: [f64; 2], nodes: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    // a part of a thousandth of the piece adds nothing but points
    let shortest = 1e-3 * (to - from);
    let mut places: Vec<f64> = nodes.map(|node| own.nearest(node).xi).collect();
    places.push(to);
    places.sort_by(f64::total_cmp);
    let mut parts: Vec<[f64; 2]> = Vec::new();
    let mut start = from;
    for place in places.into_iter().filter(|place| *place <= to) {
        if place - start > shortest && (place == to || to - place > shortest) {
            parts.push([start, place]);
            start = place;
        }
    }
    parts
}

/// The nodes of two edges, and how many they are.
fn together(edge: &ContactEdge, other: &ContactEdge) -> ([u32; NODES_OF_TWO_EDGES], usize) {
    let (own, others) = (edge.node_count(), other.node_count());
    let mut nodes = [0; NODES_OF_TWO_EDGES];
    nodes[..own].copy_from_slice(&edge.nodes[..own]);
    nodes[own..own + others].copy_from_slice(&other.nodes[..others]);
    (nodes, own + others)
}

impl FacingPoint {
    /// The edge nearest to the point and the depth behind it, if the point lies behind the surface.
    fn depth(
        &self,
        edges: &[ContactEdge],
        own: &Placed<'_>,
        x: impl Fn(u32) -> [f64; 2] + Copy,
    ) -> Option<(usize, Depth)> {
        let here = own.point(self.xi);
        let placed = |edge: usize| Placed { edge: &edges[edge], x: edges[edge].nodes.map(x) };
        // a neighbour whose nearest point is the node that it shares with this edge is no other surface
        let shared = |edge: usize, end: usize| own.edge.nodes[..2].contains(&edges[edge].nodes[end]);
        let found = self
            .faced
            .iter()
            .map(|&edge| (edge, placed(edge).nearest(here)))
            .filter(|(edge, nearest)| !nearest.end.is_some_and(|end| shared(*edge, end)));
        let (edge, nearest) = found.min_by(|a, b| a.1.distance.total_cmp(&b.1.distance))?;
        if !nearest.behind {
            return None;
        }
        if let Some(end) = nearest.end {
            // behind an end only if behind both edges that meet there: beyond the end of a chain nothing is
            // known
            let node = edges[edge].nodes[end];
            let other = self.faced.iter().find(|&&other| edges[other].nodes[1 - end] == node)?;
            if !placed(*other).nearest(here).behind {
                return None;
            }
        }
        Some((edge, own.depth_behind(self.xi, &placed(edge), &nearest)))
    }

    fn press(
        &self,
        edges: &[ContactEdge],
        penalty: f64,
        x: impl Fn(u32) -> [f64; 2] + Copy,
    ) -> Option<Pressed> {
        let edge = &edges[self.edge];
        let own = Placed { edge, x: edge.nodes.map(x) };
        let (other, Depth { depth, slope, curvature }) = self.depth(edges, &own, x)?;
        let (nodes, count) = together(edge, &edges[other]);
        let pressure = self.weight * penalty;
        let mut pressed = Pressed {
            nodes,
            count,
            energy: 0.5 * pressure * depth * depth,
            force: slope.map(|slope| slope.map(|slope| pressure * depth * slope)),
            stiffness: curvature,
        };
        for (a, rows) in pressed.stiffness.iter_mut().enumerate() {
            for (i, row) in rows.iter_mut().enumerate() {
                for (entries, other) in row.iter_mut().zip(&slope) {
                    for (entry, other) in entries.iter_mut().zip(other) {
                        *entry = pressure * (depth * *entry + slope[a][i] * other);
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

    /// Two quadratic edges, one above the other, that overlap a little: the upper side of a body and the
    /// lower side of another.
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
    fn faces_press_each_other_whichever_way_they_stand() {
        let (edges, position) = two_faces();
        let found = |angle: f64| {
            let (sine, cosine) = angle.to_radians().sin_cos();
            let turned: Vec<_> =
                position.iter().map(|[r, z]| [5.0 + cosine * r - sine * z, sine * r + cosine * z]).collect();
            let edges: Vec<_> = edges
                .iter()
                .map(|edge| {
                    let [first, last, middle] = edge.nodes;
                    let place = |n: u32| turned[n as usize];
                    ContactEdge::new([first, last], Some(middle), place, Symmetry::PlaneStrain)
                })
                .collect();
            let facing = Facing::new(&edges, &turned, &[[0.1; 2]; 6], &Facing::default());
            energy(&facing, &edges, &turned)
        };
        let facing = Facing::new(&edges, &position, &[[0.1; 2]; 6], &Facing::default());
        let twice: f64 = facing.press(&edges, 6.0, |n| position[n as usize]).map(|p| p.energy).sum();
        assert!((twice / energy(&facing, &edges, &position) - 2.0).abs() < 1e-12, "by the penalty: {twice}");
        let level = found(0.0);
        for angle in [30.0, 45.0, 90.0, 135.0, 220.0] {
            assert!(level > 0.0 && (found(angle) / level - 1.0).abs() < 1e-9, "{angle}: {level}");
        }
    }

    #[test]
    fn force_and_tangent_are_derivatives_of_the_energy() {
        let (edges, position) = two_faces();
        let facing = Facing::new(&edges, &position, &[[0.1; 2]; 6], &Facing::default());
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

    /// The forces on both sides are opposite and their moment vanishes: a pair of flanks is in equilibrium by
    /// itself.
    #[test]
    fn forces_are_in_equilibrium() {
        let (edges, position) = two_faces();
        let facing = Facing::new(&edges, &position, &[[0.1; 2]; 6], &Facing::default());
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

    /// The two sides of a plate a third of a piece thick do not press each other, neighbours on a convex
    /// surface neither.
    #[test]
    fn the_other_side_of_thin_metal_is_not_faced() {
        let (edges, mut position) = two_faces();
        for x in &mut position[..3] {
            x[1] += 0.2;
        }
        assert!(Facing::new(&edges, &position, &[[0.1; 2]; 6], &Facing::default()).is_empty());
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
        assert!(Facing::new(&edges, &round, &[[0.3; 2]; 17], &Facing::default()).is_empty());
    }
}
