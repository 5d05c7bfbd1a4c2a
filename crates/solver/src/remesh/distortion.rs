//! Better places for the nodes of a distorted mesh: the same cells, laid under the surface as it is now.
//!
//! A tool that digs in draws out the metal under its tip: one edge of the surface may come to cover most of
//! the contact, while the metal that others stand for piles up beside it, in a lip that may hang over. Around
//! the contact the nodes of the surface are spread along it in the proportions of its first arc length,
//!   s = s_now + w (s_a + (s_b - s_a) (S - S_a)/(S_b - S_a) - s_now),
//! with s the arc length now and S the first one, a and b the nearest nodes that stay (where w is 0, at kinks
//! of the first surface and at its ends), and w from 1 around the contact to 0. A node of the surface stays
//! on it, except where a lip is thinner than an element: it is cut off. Nodes below go where cells have the
//! best shape.

use crate::body::discrete_body::Body;
use crate::body::state::State;
use crate::contact::edge::ContactEdge;
use crate::contact::parts::NOTHING;
use crate::remesh::surface_curve::SurfaceCurve;
use asperity_mesh::Mesh;
use asperity_mesh::smoothing::{Freedom, improve, straighten};

/// Widths of the contact beside it within which nodes are spread all the way, and beyond which they stay.
const WIDTHS_BESIDE: [f64; 2] = [1.5, 4.0];

/// Widths of the contact, and its edges if that is more, down to which nodes move.
const WIDTHS_BELOW: [f64; 2] = [4.0, 6.0];

/// Cosine of the turn from edge to edge of the first surface beyond which the node between them stays: 10°.
const KINK_COSINE: f64 = 0.985;

/// Shares of the bulge of an edge of the surface that are tried, and the smallest scaled Jacobian of its cell
/// that is room for it.
const BULGE_SHARES: [f64; 4] = [1.0, 0.67, 0.33, 0.0];
const LEAST_JACOBIAN: f64 = 0.2;

/// Limits of the distortion of a mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Length of an edge of the surface in the contact over its first length.
    drawn_out: f64,
    /// Smallest scaled Jacobian of a corner.
    sharpest: f64,
}

/// Length of an edge over its first length, and its share of the contact, beyond which the contact has too
/// few edges.
const LARGEST_EDGE_STRETCH: f64 = 4.0;
const LARGEST_EDGE_SHARE: f64 = 0.3;

/// While the tool advances. Each transfer takes some tenths of a percent of the force away for some
/// increments, and metal drawn out smoothly costs less than that (50° half apex, n = 0.1: 0.05 % up to here).
pub const LIMITS_WHILE_LOADING: Limits = Limits { drawn_out: 10.0, sharpest: 0.02 };

/// Before the tool retreats, when it no longer presses a distorted mesh flat.
pub const LIMITS_BEFORE_UNLOADING: Limits = Limits { drawn_out: 3.0, sharpest: 0.1 };

/// From 1 at `from` to 0 at `to`, with level ends.
fn fall([from, to]: [f64; 2], at: f64) -> f64 {
    let t = ((to - at) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

fn length(position: &[[f64; 2]], edge: &ContactEdge) -> f64 {
    let [a, b] = [0, 1].map(|end| position[edge.nodes[end] as usize]);
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// True where a corner of a cell has become sharper than a scaled Jacobian of `sharpest`, and than it was.
fn has_sharper_corner(mesh: &Mesh, position: &[[f64; 2]], sharpest: f64) -> bool {
    (0..mesh.cell_count()).any(|cell| {
        let now = mesh.sharpest_corner(position, cell);
        now < sharpest && now < mesh.sharpest_corner(&mesh.nodes, cell)
    })
}

/// True where edges in the contact are drawn out, or corners of cells become sharper, than the `limits`
/// allow.
pub fn is_distorted(body: &Body<'_>, state: &State, limits: Limits) -> bool {
    let touching = state.edges.iter().zip(&state.contact).filter(|(_, contact)| contact.parts != NOTHING);
    let lengths: Vec<[f64; 2]> =
        touching.map(|(edge, _)| [length(&state.position, edge), length(&body.mesh.nodes, edge)]).collect();
    let whole: f64 = lengths.iter().map(|[now, _]| now).sum();
    lengths.iter().any(|[now, first]| {
        let stretch = now / first;
        stretch > limits.drawn_out || stretch > LARGEST_EDGE_STRETCH && *now > LARGEST_EDGE_SHARE * whole
    }) || has_sharper_corner(body.mesh, &state.position, limits.sharpest)
}

/// True for each edge at whose inner end the surface turns sharply.
fn kinks(edges: &[ContactEdge], position: &[[f64; 2]]) -> Vec<bool> {
    let direction = |edge: &ContactEdge, xi: f64| {
        let t = edge.tangent(&edge.nodes.map(|node| position[node as usize]), xi);
        let length = t[0].hypot(t[1]);
        t.map(|t| t / length)
    };
    let turns = edges.windows(2).map(|pair| {
        let (a, b) = (direction(&pair[0], -1.0), direction(&pair[1], 1.0));
        a[0] * b[0] + a[1] * b[1] < KINK_COSINE
    });
    std::iter::once(true).chain(turns).collect()
}

/// New arc lengths of the nodes of each edge on the curve `now`, in the proportions of the curve `first`,
/// with the weight of that at an arc length of `now`. `None` if they are not in order.
fn spread(
    first: &SurfaceCurve<'_>,
    now: &SurfaceCurve<'_>,
    kinks: &[bool],
    weight: impl Fn(f64) -> f64,
) -> Option<Vec<[f64; 3]>> {
    let count = kinks.len();
    // inner ends of all edges and the outer end of the last one
    let arcs = |curve: &SurfaceCurve<'_>, end: usize| {
        if end < count { curve.arcs(end)[1] } else { curve.arcs(count - 1)[0] }
    };
    let stays = |end: usize| end == count || kinks[end] || weight(arcs(now, end)) == 0.0;
    let anchors: Vec<usize> = (0..=count).filter(|&end| stays(end)).collect();
    let mut wanted = Vec::with_capacity(count);
    for pair in anchors.windows(2) {
        let [[from, to], [first_from, first_to]] =
            [now, first].map(|curve| [pair[0], pair[1]].map(|end| arcs(curve, end)));
        let stretch = (to - from) / (first_to - first_from);
        for edge in pair[0]..pair[1] {
            let (s, first_s) = (now.arcs(edge), first.arcs(edge));
            wanted.push([0, 1, 2].map(|node| {
                let even = from + stretch * (first_s[node] - first_from);
                s[node] + weight(s[node]) * (even - s[node])
            }));
        }
    }
    let in_order = wanted
        .iter()
        .all(|[outer, inner, middle]| inner < middle && middle < outer || inner < outer && inner == middle);
    in_order.then_some(wanted)
}

/// Better places of the nodes of the converged `state`, in touch with its tool; `None` where there are none:
/// no cells of a better shape were found.
pub fn smoothed_places(body: &Body<'_>, state: &State) -> Option<Vec<[f64; 2]>> {
    let mesh = body.mesh;
    let first = SurfaceCurve::new(&state.edges, &mesh.nodes);
    let mut now = SurfaceCurve::new(&state.edges, &state.position);
    let touching: Vec<usize> =
        (0..state.edges.len()).filter(|&edge| state.contact[edge].parts != NOTHING).collect();
    let (inmost, outmost) = (*touching.first()?, *touching.last()?);
    let element =
        touching.iter().map(|&edge| length(&mesh.nodes, &state.edges[edge])).fold(f64::INFINITY, f64::min);
    let contact = |curve: &SurfaceCurve<'_>| [curve.arcs(inmost)[1], curve.arcs(outmost)[0]];
    let [left, right] = contact(&now);
    let reach = WIDTHS_BESIDE[1] * (right - left);
    now.cut_lips([left - reach, right + reach], [left, right], element);
    let [left, right] = contact(&now);
    let width = right - left;
    let weight = |s: f64| fall(WIDTHS_BESIDE, (s - right).max(left - s).max(0.0) / width);
    let arcs = spread(&first, &now, &kinks(&state.edges, &mesh.nodes), weight)?;

    // the surface
    let mut places = state.position.clone();
    let mut on_surface = vec![false; mesh.nodes.len()];
    for (edge, s) in state.edges.iter().zip(&arcs) {
        for (&node, &s) in edge.nodes.iter().zip(s).take(edge.node_count()) {
            on_surface[node as usize] = true;
            places[node as usize] = now.point(s);
        }
    }
    // what lies below
    let below = (WIDTHS_BELOW[0] * width).max(WIDTHS_BELOW[1] * element);
    let sides = mesh.extent().map(|corner| corner[0]);
    let moved = |node: u32| places[node as usize] != state.position[node as usize];
    let freedom: Vec<Freedom> = mesh
        .nodes
        .iter()
        .enumerate()
        .map(|(node, x)| {
            let edge = &state.edges[edge_over(&state.edges, &mesh.nodes, x[0])];
            let [outer, inner, _] = edge.nodes;
            let depth = mesh.nodes[outer as usize][1].min(mesh.nodes[inner as usize][1]) - x[1];
            if on_surface[node] || depth >= below || !(moved(outer) || moved(inner)) {
                Freedom::None
            } else if !sides.contains(&x[0]) {
                Freedom::Full
            } else if state.position[node][0] == x[0] {
                Freedom::Axial
            } else {
                Freedom::None
            }
        })
        .collect();
    improve(mesh, &mut places, &freedom);
    straighten(mesh, &state.position, &on_surface, &mut places);
    flatten(mesh, &state.position, &mut places);
    let changed = |cell: &usize| {
        mesh.cell(*cell).iter().any(|&node| places[node as usize] != state.position[node as usize])
    };
    let sharpest = |position: &[[f64; 2]]| {
        let cells = (0..mesh.cell_count()).filter(changed);
        cells.map(|cell| mesh.sharpest_corner(position, cell)).fold(f64::INFINITY, f64::min)
    };
    let (before, after) = (sharpest(&state.position), sharpest(&places));
    (after > before.clamp(LIMITS_BEFORE_UNLOADING.sharpest, 0.3)).then_some(places)
}

/// The edge above `r` on a surface that is a function of r; the nearest one beyond its end.
fn edge_over(edges: &[ContactEdge], position: &[[f64; 2]], r: f64) -> usize {
    edges.partition_point(|edge| position[edge.nodes[0] as usize][0] < r).min(edges.len() - 1)
}

/// Moves the mid-side nodes of the surface that left their places `before` towards the straight line where
/// their cells have no room for the bulge: of a lip that turns round within one edge.
fn flatten(mesh: &Mesh, before: &[[f64; 2]], places: &mut [[f64; 2]]) {
    for edge in &mesh.sides.surface {
        let (ends, Some(middle)) = mesh.edge_nodes(*edge) else { continue };
        let middle = middle as usize;
        if places[middle] == before[middle] {
            continue;
        }
        let straight = [0, 1].map(|i| 0.5 * ends.iter().map(|&node| places[node as usize][i]).sum::<f64>());
        let bulge = [0, 1].map(|i| places[middle][i] - straight[i]);
        for share in BULGE_SHARES {
            places[middle] = [0, 1].map(|i| straight[i] + share * bulge[i]);
            if mesh.sharpest_corner(places, edge.cell as usize) > LEAST_JACOBIAN {
                break;
            }
        }
    }
}
