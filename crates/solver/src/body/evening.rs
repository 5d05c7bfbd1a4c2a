//! Better places for the nodes of a distorted mesh: the same cells, laid under the surface as it is now as they were laid under the
//! first one.
//!
//! A tool that digs in draws out the metal under its tip: one edge of the surface may come to cover most of the contact, while
//! the metal that others stand for piles up beside it. Around the contact each node goes back to the radius of its place in the
//! first mesh and to the surface above that place, less and less so with the depth below it:
//!   x = X + (1 - w) u + w f S + (1 - w) f (S - u_s),   S = z_now(r) - Z_s,
//! with X the place in the first mesh, u the displacement since, u_s and Z_s those of the surface above it, f falling from 1 at the
//! surface to 0 at some depth, and w from 1 around the contact to 0, where nodes stay where they are. A node of the surface stays on it.

use crate::body::discrete_body::Body;
use crate::body::state::State;
use crate::contact::edge::{ContactEdge, NOTHING};

/// Widths of the contact beside it within which nodes go back all the way, and beyond which they stay.
const AROUND: [f64; 2] = [1.5, 4.0];

/// Widths of the contact down to which nodes follow the surface.
const BELOW: f64 = 4.0;

/// How far from a flank, in widths of the contact, nodes may lie that slid past their neighbours along it.
const PASSED_OVER: f64 = 0.03;

/// How distorted a mesh may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Length of an edge of the surface in the contact over its first length.
    drawn_out: f64,
    /// Smallest scaled Jacobian of a corner.
    sharpest: f64,
}

/// While the tool advances. Each transfer takes some tenths of a percent of the force away for some increments, and metal drawn out
/// smoothly costs less than that (50° half apex, n = 0.1: 0.05 % up to here).
pub const LOADED: Limits = Limits { drawn_out: 10.0, sharpest: 0.02 };

/// Before the tool retreats, when it no longer presses a distorted mesh flat.
pub const UNLOADED: Limits = Limits { drawn_out: 3.0, sharpest: 0.1 };

/// The surface as a function of r: parabolas from the axis outward, each through its outer end, its inner end and its middle.
struct Outline {
    pieces: Vec<[[f64; 2]; 3]>,
}

/// Point of a piece at ξ, from -1 at its outer end to 1 at its inner one.
fn point(x: &[[f64; 2]; 3], xi: f64) -> [f64; 2] {
    let n = [0.5 * xi * (xi - 1.0), 0.5 * xi * (xi + 1.0), 1.0 - xi * xi];
    [0, 1].map(|i| n[0] * x[0][i] + n[1] * x[1][i] + n[2] * x[2][i])
}

/// A straight piece.
fn straight(outer: [f64; 2], inner: [f64; 2]) -> [[f64; 2]; 3] {
    [outer, inner, [0, 1].map(|i| 0.5 * (outer[i] + inner[i]))]
}

impl Outline {
    /// Of the surface of `edges` with the nodes at `position`. Nodes that slid past their neighbours along a flank are passed over, if
    /// they lie on it to `tolerance`; `None` for a surface that folds over.
    fn of(edges: &[ContactEdge], position: &[[f64; 2]], tolerance: f64) -> Option<Outline> {
        let at = |node: u32| position[node as usize];
        let mut outline = Outline { pieces: Vec::with_capacity(edges.len()) };
        let mut start = at(edges.first()?.nodes[1]);
        for edge in edges {
            let [outer, inner, middle] = edge.nodes.map(at);
            if outer[0] <= start[0] {
                // behind what is there already
                if (outline.height(outer[0])? - outer[1]).abs() > tolerance {
                    return None;
                }
                continue;
            }
            // a parabola that runs backwards at an end gives way to the straight line
            let runs = [middle[0] - inner[0], outer[0] - middle[0]].map(|way| way / (outer[0] - inner[0]));
            let sound = edge.quadratic && inner == start && runs.iter().all(|share| *share > 0.26);
            outline.pieces.push(if sound { [outer, inner, middle] } else { straight(outer, start) });
            start = outer;
        }
        Some(outline)
    }

    /// The piece above `r` and its coordinate there; the nearest end beyond its own.
    fn find(&self, r: f64) -> Option<(usize, f64)> {
        let index = self.pieces.partition_point(|x| x[0][0] < r).min(self.pieces.len().checked_sub(1)?);
        let x = &self.pieces[index];
        // r falls with ξ
        let (mut low, mut high) = (-1.0, 1.0);
        for _ in 0..60 {
            let xi = 0.5 * (low + high);
            if point(x, xi)[0] > r { low = xi } else { high = xi }
        }
        Some((index, 0.5 * (low + high)))
    }

    /// Its height above `r`.
    fn height(&self, r: f64) -> Option<f64> {
        let (index, xi) = self.find(r)?;
        Some(point(&self.pieces[index], xi)[1])
    }
}

/// From 1 at `from` to 0 at `to`, with level ends.
fn fall([from, to]: [f64; 2], at: f64) -> f64 {
    let t = ((to - at) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Whether edges in the contact are drawn out, or corners of cells sharper, than the `limits` allow.
pub fn is_distorted(body: &Body<'_>, state: &State, limits: Limits) -> bool {
    let length = |position: &[[f64; 2]], edge: &ContactEdge| {
        let [a, b] = [0, 1].map(|end| position[edge.nodes[end] as usize]);
        (b[0] - a[0]).hypot(b[1] - a[1])
    };
    let touching = state.edges.iter().zip(&state.contact).filter(|(_, contact)| contact.parts != NOTHING);
    let drawn_out = |edge: &ContactEdge| {
        length(&state.position, edge) > limits.drawn_out * length(&body.mesh.nodes, edge)
    };
    touching.map(|(edge, _)| edge).any(drawn_out)
        || body.mesh.sharpest_corner(&state.position) < limits.sharpest
}

/// Better places of the nodes of the converged `state`, in touch with its tool; `None` where there are none: the surface folds over,
/// or the cells would be worse.
pub fn evened(body: &Body<'_>, state: &State) -> Option<Vec<[f64; 2]>> {
    let mesh = body.mesh;
    let reach = state.contact.iter().filter(|contact| contact.parts != NOTHING);
    let [left, right] = reach.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], contact| {
        [a.min(contact.reach[0]), b.max(contact.reach[1])]
    });
    let width = right - left;
    if width <= 0.0 {
        return None;
    }
    let first = Outline::of(&state.edges, &mesh.nodes, 0.0)?;
    let now = Outline::of(&state.edges, &state.position, PASSED_OVER * width)?;
    let mut on_surface = vec![false; mesh.nodes.len()];
    for edge in &state.edges {
        edge.nodes[..edge.node_count()].iter().for_each(|&node| on_surface[node as usize] = true);
    }
    let beside = |r: f64| (r - right).max(left - r).max(0.0) / width;
    let mut places = Vec::with_capacity(mesh.nodes.len());
    for (node, (x, place)) in mesh.nodes.iter().zip(&state.position).enumerate() {
        // edge for edge: nothing of the first surface is passed over
        let (index, xi) = first.find(x[0])?;
        let (summit, edge) = (point(&first.pieces[index], xi), state.edges.get(index)?);
        let lifted = edge.point(&edge.nodes.map(|node| state.position[node as usize]), xi);
        let depth = if on_surface[node] { 0.0 } else { (summit[1] - x[1]).max(0.0) / width };
        // the weight at the surface decides what the surface does there
        let at_surface = fall(AROUND, beside(x[0]));
        let weight = at_surface.min(fall(AROUND, depth));
        let follows = (1.0 - depth / BELOW).max(0.0);
        if at_surface == 0.0 || (weight == 0.0 && follows == 0.0) {
            places.push(*place);
            continue;
        }
        let moved = [0, 1].map(|i| place[i] - x[i]);
        let surface = [0, 1].map(|i| lifted[i] - summit[i]);
        let above = x[0] + (1.0 - at_surface) * surface[0];
        let rise = now.height(above)? - summit[1];
        let r = x[0] + (1.0 - weight) * moved[0];
        let z = x[1]
            + (1.0 - weight) * moved[1]
            + weight * follows * rise
            + (1.0 - weight) * follows * (rise - surface[1]);
        places.push(if on_surface[node] { [above, now.height(above)?] } else { [r, z] });
    }
    let better =
        mesh.sharpest_corner(&places) > mesh.sharpest_corner(&state.position).clamp(UNLOADED.sharpest, 0.3);
    better.then_some(places)
}
