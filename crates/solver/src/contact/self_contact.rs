//! Detects a free surface that has folded onto itself: a flank that meets another flank is contact which is not modelled.

use crate::contact::edge::ContactEdge;

/// A piece of the surface between two nodes.
#[derive(Clone, Copy, Debug)]
struct Segment {
    ends: [[f64; 2]; 2],
    nodes: [u32; 2],
}

/// Where the surface of `edges`, whose nodes are at `position`, crosses itself; edges are taken as straight between
/// neighbouring nodes.
pub fn fold(edges: &[ContactEdge], position: &[[f64; 2]]) -> Option<[f64; 2]> {
    let mut segments = Vec::with_capacity(2 * edges.len());
    for edge in edges {
        let [first, last, middle] = edge.nodes;
        let mut add = |a: u32, b: u32| {
            segments.push(Segment { ends: [a, b].map(|n| position[n as usize]), nodes: [a, b] });
        };
        if edge.quadratic {
            add(first, middle);
            add(middle, last);
        } else {
            add(first, last);
        }
    }
    crossing(&mut segments)
}

/// The first crossing of two segments that share no node: swept along r, so that only neighbours are compared.
fn crossing(segments: &mut [Segment]) -> Option<[f64; 2]> {
    let left = |s: &Segment| s.ends[0][0].min(s.ends[1][0]);
    let right = |s: &Segment| s.ends[0][0].max(s.ends[1][0]);
    segments.sort_by(|a, b| left(a).total_cmp(&left(b)));
    segments.iter().enumerate().find_map(|(i, a)| {
        let end = right(a);
        segments[i + 1..]
            .iter()
            .take_while(|b| left(b) <= end)
            .filter(|b| !a.nodes.iter().any(|n| b.nodes.contains(n)))
            .find_map(|b| intersection(a, b))
    })
}

/// The point that two segments have in common, if they cross.
fn intersection(a: &Segment, b: &Segment) -> Option<[f64; 2]> {
    let [p, q] = a.ends;
    let [r, s] = b.ends;
    let (u, v, w) = ([q[0] - p[0], q[1] - p[1]], [s[0] - r[0], s[1] - r[1]], [r[0] - p[0], r[1] - p[1]]);
    let cross = |x: [f64; 2], y: [f64; 2]| x[0] * y[1] - x[1] * y[0];
    let determinant = cross(u, v);
    // parallel pieces that overlap are crossed by their neighbours
    let (along_a, along_b) = (cross(w, v) / determinant, cross(w, u) / determinant);
    let inside = |t: f64| (0.0..=1.0).contains(&t);
    (inside(along_a) && inside(along_b)).then(|| [p[0] + along_a * u[0], p[1] + along_a * u[1]])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(points: &[[f64; 2]]) -> Vec<Segment> {
        points
            .windows(2)
            .enumerate()
            .map(|(i, p)| Segment { ends: [p[0], p[1]], nodes: [i as u32, i as u32 + 1] })
            .collect()
    }

    #[test]
    fn a_loop_crosses_and_a_zigzag_does_not() {
        let mut zigzag = chain(&[[0.0, 0.0], [1.0, 1.0], [0.5, 2.0], [1.5, 3.0], [2.0, 0.0]]);
        assert_eq!(crossing(&mut zigzag), None);
        let mut looped = chain(&[[0.0, 0.0], [2.0, 1.0], [2.0, 0.0], [0.0, 1.0]]);
        assert_eq!(crossing(&mut looped), Some([1.0, 0.5]));
    }
}
