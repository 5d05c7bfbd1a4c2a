//! Possible leaks: gaps between contacts, and regions that never yielded among the asperities.

use crate::body::discrete_body::Body;
use crate::body::fields::fields;
use crate::body::state::State;
use crate::body::surface::Surface;
use crate::contact::parts::NOTHING;
use crate::point::kinematics::Symmetry;
use asperity_mesh::regions::{Region, regions_below_zero};
use asperity_mesh::{Edge, Mesh};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeSet, HashSet};

/// An untouched stretch of surface between two contacts, or one that flanks enclose which press each other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gap {
    /// End of the contact before it; the least place of an enclosed one.
    pub left: f64,
    /// Beginning of the contact after it; the greatest place of an enclosed one.
    pub right: f64,
    /// Largest distance from the tool in between; from the lowest to the highest point of an enclosed one.
    pub height: f64,
    /// True where the surface itself closes it off from the tool.
    pub enclosed: bool,
}

/// Section of a pore over the square of its circumference up to which it is closed: a circle has 0.08, a slit
/// of 1:100 0.0025.
const CLOSED_PORE_SECTION: f64 = 0.0025;

/// A connected region that never yielded, enclosed by material that did or standing above the substrate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Island {
    /// Centroid (r, z) of its section before the crush.
    pub place: [f64; 2],
    /// Area of its section before the crush.
    pub area: f64,
    /// Volume-weighted mean hydrostatic pressure, positive in compression.
    pub mean_pressure: f64,
    /// Volume-weighted mean von Mises stress: far below the pressure where confinement keeps the material
    /// elastic.
    pub mean_von_mises: f64,
    /// True where it hangs together with the elastic bulk of the substrate.
    pub reaches_substrate: bool,
    /// True where it holds a part of the free surface.
    pub reaches_surface: bool,
}

/// The gaps of a converged state: between contacts with the tool, from the axis (left side) outward, then
/// those that flanks enclose.
pub fn gaps(body: &Body<'_>, state: &State) -> Vec<Gap> {
    let surface = Surface::of_state(body, state);
    let pressed = state.facing.pressed_edges(&state.edges, &state.position);
    let closed_off = closed_off(&pressed, state.edges.len());
    let mut gaps = between_contacts(&surface, |edge| closed_off[edge].is_none());
    let pores: BTreeSet<usize> = closed_off.iter().flatten().copied().collect();
    gaps.extend(pores.into_iter().filter_map(|pore| {
        let own = closed_off.iter().zip(&state.edges).filter(|(of, _)| **of == Some(pore));
        enclosed(own.map(|(_, edge)| edge.nodes.map(|node| surface.position(node))))
    }));
    gaps
}

/// The pore that each edge of a surface of `count` edges is part of, where flanks that press each other
/// (`pressed`, the smaller number first) close it off: named by the narrowest pair around it. Edges that
/// press are part of none.
fn closed_off(pressed: &[[usize; 2]], count: usize) -> Vec<Option<usize>> {
    let mut around = vec![None; count];
    let mut pairs: Vec<usize> = (0..pressed.len()).collect();
    // from the widest to the narrowest
    pairs.sort_by_key(|&pair| std::cmp::Reverse(pressed[pair][1] - pressed[pair][0]));
    for pair in pairs {
        let [first, last] = pressed[pair];
        around[first + 1..last].fill(Some(pair));
    }
    for edge in pressed.iter().flatten() {
        around[*edge] = None;
    }
    around
}

/// A pore with these edges in its wall; `None` where nothing is left of it, as between points of flanks that
/// press each other.
fn enclosed(edges: impl Iterator<Item = [[f64; 2]; 3]>) -> Option<Gap> {
    let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
    let (mut twice_area, mut length) = (0.0, 0.0);
    let mut wall: Vec<[f64; 2]> = Vec::new();
    for [a, b, middle] in edges {
        wall.extend([a, middle, b]);
    }
    for (i, p) in wall.iter().enumerate() {
        let q = wall[(i + 1) % wall.len()];
        twice_area += p[0] * q[1] - q[0] * p[1];
        length += (q[0] - p[0]).hypot(q[1] - p[1]);
        for (end, x) in ends.iter_mut().zip(p) {
            *end = [end[0].min(*x), end[1].max(*x)];
        }
    }
    let [[left, right], [low, high]] = ends;
    let open = 0.5 * twice_area.abs() > CLOSED_PORE_SECTION * length * length;
    open.then_some(Gap { left, right, height: high - low, enclosed: true })
}

/// The gaps between contacts with the tool over the edges that `count`.
fn between_contacts(surface: &Surface<'_>, count: impl Fn(usize) -> bool) -> Vec<Gap> {
    let mut gaps = Vec::new();
    let mut open: Option<Gap> = None; // since the last contact
    for (number, (edge, contact)) in surface.edges.iter().zip(surface.contact).enumerate() {
        let x = edge.nodes.map(|node| surface.position(node));
        // surface edges run inward: their second corner is the inner one
        let heights = x.map(|x| -surface.penetration_of(x));
        if contact.parts == NOTHING {
            if let Some(gap) = open.as_mut().filter(|_| count(number)) {
                gap.height = heights.into_iter().fold(gap.height, f64::max);
            }
            continue;
        }
        if let Some(gap) = open.take() {
            let right = contact.reach[0];
            // two touching edges that share a node leave no gap
            let height = gap.height.max(heights[1]);
            if right - gap.left > 1e-9 * right.abs().max(gap.left.abs()) && height > 0.0 {
                gaps.push(Gap { right, height, ..gap });
            }
        }
        if let [Some([_, first_end]), Some([second_start, _])] = contact.parts {
            // both ends of a quadratic edge touch, its middle does not
            let (right, left) = (edge.point(&x, first_end)[0], edge.point(&x, second_start)[0]);
            let height = -surface.penetration_of(edge.point(&x, 0.5 * (first_end + second_start)));
            gaps.push(Gap { left: left.min(right), right: left.max(right), height, enclosed: false });
        }
        open = Some(Gap {
            left: contact.reach[1],
            right: f64::NAN,
            height: heights[0].max(0.0),
            enclosed: false,
        });
    }
    gaps
}

/// Regions where `values` at the nodes are below zero that do not hang together with the base of the body.
pub fn enclosed_regions(mesh: &Mesh, places: &[[f64; 2]], values: &[f64]) -> Vec<Region> {
    let on_base = nodes_along(mesh, &mesh.sides.base);
    let mut regions = regions_below_zero(mesh, places, values, |_| true);
    regions.retain(|region| !reaches(region, &on_base));
    regions
}

/// True where a region holds one of the nodes.
fn reaches(region: &Region, nodes: &HashSet<u32>) -> bool {
    region.weights.keys().any(|node| nodes.contains(node))
}

/// Regions of metal that never yielded whose centroid lies within `extent` along r before the crush: those
/// enclosed by yielded metal at any depth, and of the elastic bulk what lay above `floor`. They end where
/// [`Fields::first_yield`](crate::body::fields::Fields::first_yield) passes zero.
pub fn islands(body: &Body<'_>, state: &State, floor: f64, extent: [f64; 2]) -> Vec<Island> {
    let mesh = body.mesh;
    let fields = fields(body, state);
    let first_yield = &fields.first_yield;
    let within = |r: f64| r > extent[0] && r < extent[1];
    let on_base = nodes_along(mesh, &mesh.sides.base);
    let regions = regions_below_zero(mesh, &state.origin, first_yield, |_| true);
    let (bulk, enclosed): (Vec<_>, Vec<_>) = regions.iter().partition(|region| reaches(region, &on_base));
    let standing = |cell: usize| {
        let [r, z] = centre(mesh, state, cell);
        z > floor && within(r)
    };
    let mut above = regions_below_zero(mesh, &state.origin, first_yield, standing);
    above.retain(|part| bulk.iter().any(|whole| part.weights.keys().all(|n| whole.weights.contains_key(n))));
    let on_surface = nodes_along(mesh, &mesh.sides.surface);
    let described = |(region, reaches_substrate): (&Region, bool)| {
        let measure = |node: u32| match body.symmetry {
            Symmetry::Axisymmetric => state.origin[node as usize][0],
            Symmetry::PlaneStrain => 1.0,
        };
        Island {
            place: region.centre,
            area: region.area,
            mean_pressure: region.mean(&fields.pressure, measure),
            mean_von_mises: region.mean(&fields.von_mises, measure),
            reaches_substrate,
            reaches_surface: reaches(region, &on_surface),
        }
    };
    let enclosed = enclosed.into_iter().map(|region| (region, false));
    let islands = enclosed.chain(above.iter().map(|region| (region, true))).map(described);
    islands.filter(|island| within(island.place[0])).collect()
}

/// The corners of the cells along these edges that lie on them.
fn nodes_along(mesh: &Mesh, edges: &[Edge]) -> HashSet<u32> {
    edges.iter().flat_map(|&edge| mesh.edge_nodes(edge).0).collect()
}

/// Mean of the corners of a cell before the crush.
fn centre(mesh: &Mesh, state: &State, cell: usize) -> [f64; 2] {
    let corners = &mesh.cell(cell)[..4];
    [0, 1].map(|i| corners.iter().map(|&n| state.origin[n as usize][i]).sum::<f64>() / 4.0)
}

/// Extent along r in which islands are searched: the asperities, from the axis or from the left foot.
pub fn extent(symmetry: Symmetry, feet: [f64; 2]) -> [f64; 2] {
    match symmetry {
        Symmetry::Axisymmetric => [0.0, feet[1]],
        Symmetry::PlaneStrain => feet,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flanks_that_press_each_other_close_off_what_lies_between_them() {
        // edges 2 and 9 press each other, 3 and 8 too; 5 and 6 touch further down
        let around = closed_off(&[[2, 9], [3, 8], [5, 6]], 12);
        assert_eq!(around[4], around[7]);
        assert!(around[4].is_some());
        assert!([0, 1, 2, 3, 5, 6, 8, 9, 10, 11].iter().all(|&edge| around[edge].is_none()), "{around:?}");
        let wall = |points: &[[f64; 2]]| {
            let next = |i: usize| points[(i + 1) % points.len()];
            let edge = |i: usize| [points[i], next(i), [0, 1].map(|k| 0.5 * (points[i][k] + next(i)[k]))];
            enclosed((0..points.len()).map(edge))
        };
        let pore = wall(&[[1.0, 0.0], [2.0, -1.0], [3.0, 0.0]]).unwrap();
        assert_eq!(pore, Gap { left: 1.0, right: 3.0, height: 1.0, enclosed: true });
        assert_eq!(wall(&[[1.0, 0.0], [2.0, -1.0], [1.001, 0.0]]), None);
    }
}
