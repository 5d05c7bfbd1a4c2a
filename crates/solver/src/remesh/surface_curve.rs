//! The free surface as a curve of its arc length.

use crate::contact::edge::ContactEdge;
use crate::contact::projection::intersection;

/// Straight pieces that a curved edge is measured in.
const PIECES_PER_EDGE: usize = 8;

/// Arc length of a lip over its thickness from which on it is cut off: 4 is a wedge of 29°.
const LIP_SLENDERNESS: f64 = 4.0;

/// A surface, from its inner end outward.
#[derive(Clone, Debug)]
pub(super) struct SurfaceCurve<'a> {
    edges: &'a [ContactEdge],
    position: &'a [[f64; 2]],
    /// Pieces that an edge is measured in.
    pieces: usize,
    /// Ends of all pieces.
    ends: Vec<[f64; 2]>,
    /// Arc length up to each of them.
    arc: Vec<f64>,
    /// True for each piece where a lip was cut off.
    cut: Vec<bool>,
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// Arc length up to each of the `points`.
fn arc_lengths(points: &[[f64; 2]]) -> Vec<f64> {
    let mut arc = vec![0.0];
    for pair in points.windows(2) {
        arc.push(arc.last().copied().unwrap_or(0.0) + distance(pair[0], pair[1]));
    }
    arc
}

/// True where a part of a surface that returns to its start encloses metal, which lies on its right.
fn encloses_metal(points: &[[f64; 2]]) -> bool {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() < 0.0
}

impl<'a> SurfaceCurve<'a> {
    /// Of `edges`, each of which begins where the one before ends, with the nodes at `position`.
    pub fn new(edges: &'a [ContactEdge], position: &'a [[f64; 2]]) -> SurfaceCurve<'a> {
        let pieces = if edges.iter().any(|edge| edge.quadratic) { PIECES_PER_EDGE } else { 1 };
        let mut curve =
            SurfaceCurve { edges, position, pieces, ends: Vec::new(), arc: Vec::new(), cut: Vec::new() };
        for edge in 0..edges.len() {
            let first = usize::from(edge > 0);
            for piece in first..=pieces {
                curve.ends.push(curve.on_edge(edge, piece as f64));
            }
        }
        curve.cut = vec![false; edges.len() * pieces];
        curve.arc = arc_lengths(&curve.ends);
        curve
    }

    /// The place on an edge after some of its pieces. Its coordinate falls from 1 at the inner end to -1 at
    /// the outer one.
    fn on_edge(&self, edge: usize, pieces: f64) -> [f64; 2] {
        let edge = &self.edges[edge];
        let nodes = edge.nodes.map(|node| self.position[node as usize]);
        edge.point(&nodes, 1.0 - 2.0 * pieces / self.pieces as f64)
    }

    /// Arc lengths of the outer end, the inner end and the middle of an edge: the order of its nodes.
    pub fn arcs(&self, edge: usize) -> [f64; 3] {
        let first = edge * self.pieces;
        [first + self.pieces, first, first + self.pieces / 2].map(|end| self.arc[end])
    }

    /// The place at arc length `s`; the nearest end beyond its own.
    pub fn point(&self, s: f64) -> [f64; 2] {
        let piece = self.arc.partition_point(|end| *end < s).clamp(1, self.cut.len()) - 1;
        let [from, to] = [self.arc[piece], self.arc[piece + 1]];
        let share = if to > from { ((s - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        if self.cut[piece] {
            let [a, b] = [self.ends[piece], self.ends[piece + 1]];
            return [0, 1].map(|i| a[i] + share * (b[i] - a[i]));
        }
        self.on_edge(piece / self.pieces, (piece % self.pieces) as f64 + share)
    }

    /// The end of a part of the curve between `from` and `to` to be cut off that begins at `start`.
    fn lip(&self, start: usize, [_, to]: [usize; 2], thickness: f64) -> Option<usize> {
        (start + 2..=to).rev().find(|&end| {
            let across = distance(self.ends[start], self.ends[end]);
            let along = self.arc[end] - self.arc[start];
            across <= thickness && along > LIP_SLENDERNESS * across && encloses_metal(&self.ends[start..=end])
        })
    }

    /// The end of a loop between `from` and `to` that begins at `start`.
    fn crossing(&self, start: usize, [from, to]: [usize; 2]) -> Option<usize> {
        let piece = |end: usize| [self.ends[end - 1], self.ends[end]];
        let inside = start >= from;
        (start + 3..=to).rev().find(|&end| inside && intersection(piece(start + 1), piece(end)).is_some())
    }

    /// Cuts off lips within `around` where a straight line no longer than `thickness` removes them, and
    /// loops within the `contact`, where nodes slid past their neighbours along the tool: no cell fits in
    /// there. Both are arc lengths.
    pub fn cut_lips(&mut self, around: [f64; 2], contact: [f64; 2], thickness: f64) {
        let ends =
            |arcs: [f64; 2]| arcs.map(|s| self.arc.partition_point(|end| *end < s).min(self.ends.len() - 1));
        let (around, contact) = (ends(around), ends(contact));
        let mut start = around[0];
        while start < around[1] {
            let lip = self.lip(start, around, thickness).max(self.crossing(start, contact));
            if let Some(end) = lip {
                let [a, b] = [self.ends[start], self.ends[end]];
                let [from, to] = [self.arc[start], self.arc[end]];
                for piece in start..end {
                    let share = (self.arc[piece] - from) / (to - from);
                    self.ends[piece] = [0, 1].map(|i| a[i] + share * (b[i] - a[i]));
                    self.cut[piece] = true;
                }
                start = end;
            } else {
                start += 1;
            }
        }
        self.arc = arc_lengths(&self.ends);
    }
}
