//! Graded quadrilaterals under a profile: a fine core under every contact, shells around it that grow
//! outward.
//!
//! ```text
//!   axis                                           In the flat plane (ζ ≤ 0 below the surface) a core is a rectangle
//!   +--+--+---+-----+----------+  surface          of rows and columns and every shell the space between two
//!   +--+--+   |     |          |                   rectangles; the whole is then sheared so that its top follows the
//!   +--+--+   |     |          |                   profile. Each shell has as many elements as the sides of the
//!   |     \   |     |          |                   core that it wraps, so their size grows with the distance: the
//!   +------\--+     |          |                   far field costs a logarithm.
//!   |        \      |          |
//!   +---------\-----+          |  outer            One asperity on the axis is one core whose shells reach the far
//!   |           \              |                   boundary. Several stand side by side, each in a cell of its own as
//!   +------------\-------------+                   wide as its foot, with plain blocks between them; shells around
//!   base                                           the whole row lead to the far boundary.
//! ```

use crate::grading::divide_geometric;
use crate::smoothing::{Freedom, improve};
use crate::{Edge, ElementKind, Mesh};
use std::collections::HashSet;

mod contact_core;
mod grid;
mod plan;
mod row;
mod self_similar;

pub use plan::{Contact, Plan};
pub use self_similar::{SelfSimilar, Sizes, self_similar};

use contact_core::{add_core, shell_limit};
use grid::{Grid, Rectangle, Ring, Side, add_columns, sort_surface, wrap};
use plan::{contact_size, core_half_width, kinks_from, power};

/// True where there is one contact, halved by the axis: its shells reach the far boundary.
fn stands_alone(plan: &Plan) -> bool {
    plan.contacts.len() == 1 && plan.contacts[0].centre == plan.width[0]
}

/// Builds the mesh of `plan`.
pub fn build(plan: &Plan) -> Mesh {
    let mut grid = Grid::default();
    if stands_alone(plan) {
        add_lone_contact(&mut grid, plan);
    } else {
        let row = row::add(&mut grid, plan);
        let inner = row.rectangle;
        let ring = wrap(&mut grid, row, &row::rectangles_around(plan, inner), Some(body(plan)));
        let reach = ring.rectangle.right;
        extend(&mut grid, ring, plan, |x| plan.grading.far * (x - reach + inner.depth));
    }
    sort_surface(&mut grid, 0);
    finish(grid, plan.kind, fade_depth(plan), |r| plan.profile.z(r))
}

/// The rectangle of the whole body in the flat plane.
fn body(plan: &Plan) -> Rectangle {
    Rectangle { left: plan.width[0], right: plan.width[1], depth: plan.depth }
}

/// The contact on the axis, its shells and what they leave of the body.
fn add_lone_contact(grid: &mut Grid, plan: &Plan) {
    let contact = plan.contacts[0];
    let centre = contact.centre;
    let half = core_half_width(plan, &contact).min(0.4 * plan.depth).min(0.4 * (plan.width[1] - centre));
    let core = Rectangle {
        left: centre,
        right: centre + half,
        depth: (half * contact.depth_ratio()).min(0.6 * plan.depth),
    };
    let size = |x: f64| plan.grading.size(x, contact_size(&contact));
    let end = shell_limit(plan, Rectangle { left: centre, right: centre, depth: 0.0 });
    // a steep flank keeps the shells under it as deep for their width as the core, as far as the body allows
    let inner = [half, core.depth];
    let outer = [end.right - centre, end.depth];
    let foot = [contact.foot, (contact.foot * core.depth / half).min(0.8 * outer[1])];
    let turns = contact.depth_ratio() > 1.0 && foot[0] > half && foot[0] < 0.8 * outer[0];
    let depth = |x: f64| {
        if x == outer[0] {
            outer[1]
        } else if !turns {
            power(inner, outer, x)
        } else if x < foot[0] {
            power(inner, foot, x)
        } else {
            power(foot, outer, x)
        }
    };
    let shells: Vec<Rectangle> = divide_geometric(half, outer[0], &kinks_from(plan, centre), size)[1..]
        .iter()
        .map(|&x| Rectangle { left: centre, right: centre + x, depth: depth(x) })
        .collect();
    let ring = add_core(grid, plan, &contact, core);
    let ring = wrap(grid, ring, &shells, Some(body(plan)));
    extend(grid, ring, plan, size);
}

/// Fills what the shells left of the body: columns beside them, or rows below them. `size` is the wanted size
/// at a distance to the right of 0.
fn extend(grid: &mut Grid, ring: Ring, plan: &Plan, size: impl Fn(f64) -> f64) {
    let Ring { ids, edges: [left, bottom, _], rectangle } = ring;
    if rectangle.depth < plan.depth {
        let below = Ring { ids: ids[left..=left + bottom].to_vec(), edges: [0, bottom, 0], rectangle };
        let width = rectangle.right - rectangle.left;
        let stations =
            divide_geometric(width, width + plan.depth - rectangle.depth, &[], |x| plan.grading.far * x);
        let last = stations.len() - 1;
        let deeper = |(k, station): (usize, &f64)| Rectangle {
            depth: if k + 1 == last { plan.depth } else { rectangle.depth + station - width },
            ..rectangle
        };
        let rectangles: Vec<Rectangle> = stations[1..].iter().enumerate().map(deeper).collect();
        wrap(grid, below, &rectangles, Some(body(plan)));
    }
    if rectangle.right < plan.width[1] {
        let inner: Vec<u32> = ids[left + bottom..].iter().rev().copied().collect();
        let columns = divide_geometric(rectangle.right, plan.width[1], &plan.profile.kinks(), &size);
        add_columns(grid, &inner, &columns[1..], Side::Right);
    }
    if rectangle.left > plan.width[0] {
        // the left side mirrors the right one
        let [from, to] = [rectangle.right, rectangle.right + rectangle.left - plan.width[0]];
        let columns: Vec<f64> = divide_geometric(from, to, &[], &size)[1..]
            .iter()
            .map(|x| if *x == to { plan.width[0] } else { rectangle.left - (x - from) })
            .collect();
        add_columns(grid, &ids[..=left], &columns, Side::Left);
    }
}

/// Flanks steeper than this (tangent) are not followed by the mesh far below a row.
const STEEP_SLOPE: f64 = 0.75;

/// Depth at which the mesh no longer follows the profile: that of the body; below a row of steep flanks
/// sooner, for there the shells around the row spread sideways, and cells sheared by more than they spread
/// turn inside out. Deep enough that cells below a valley keep half their height.
fn fade_depth(plan: &Plan) -> f64 {
    let steepest = plan.contacts.iter().fold(0.0, |m: f64, c| m.max(c.slope));
    if stands_alone(plan) || steepest < STEEP_SLOPE {
        return plan.depth;
    }
    (1.5 * row::rectangle(plan).depth).max(2.0 * plan.profile.height()).min(plan.depth)
}

/// Smallest scaled Jacobian of a corner below which the nodes around are moved.
const SOUND_JACOBIAN: f64 = 0.02;

/// Rings of cells around a corner that is sharper, whose nodes may move.
const RINGS: usize = 3;

/// A mesh of four-node cells whose corners the shear under a steep flank may have turned inside out, with the
/// inner nodes around them where the cells have better shapes.
fn sound(mesh: Mesh) -> Mesh {
    let is_sharp = |cell: &usize| mesh.sharpest_corner(&mesh.nodes, *cell) < SOUND_JACOBIAN;
    let nodes_of = |cells: &[usize]| -> HashSet<u32> {
        cells.iter().flat_map(|&cell| mesh.cell(cell)).copied().collect()
    };
    let mut cells: Vec<usize> = (0..mesh.cell_count()).filter(is_sharp).collect();
    if cells.is_empty() {
        return mesh;
    }
    for _ in 0..RINGS {
        let nodes = nodes_of(&cells);
        cells = (0..mesh.cell_count())
            .filter(|&cell| mesh.cell(cell).iter().any(|node| nodes.contains(node)))
            .collect();
    }
    let mut freedom = vec![Freedom::None; mesh.nodes.len()];
    for node in nodes_of(&cells) {
        freedom[node as usize] = Freedom::Full;
    }
    let mut limit = |edges: &[Edge], to: Freedom| {
        for node in edges.iter().flat_map(|&edge| mesh.edge_nodes(edge).0) {
            let freedom = &mut freedom[node as usize];
            *freedom = if *freedom == Freedom::None { Freedom::None } else { to };
        }
    };
    limit(&mesh.sides.axis, Freedom::Axial);
    [&mesh.sides.outer, &mesh.sides.base, &mesh.sides.surface]
        .iter()
        .for_each(|edges| limit(edges, Freedom::None));
    let mut places = mesh.nodes.clone();
    improve(&mesh, &mut places, &freedom);
    Mesh { nodes: places, ..mesh }
}

/// Shears the flat grid under a surface of the height `z(r)`, less and less down to the depth `fade`, drops
/// welded nodes and adds mid-side nodes.
fn finish(mut grid: Grid, kind: ElementKind, fade: f64, z: impl Fn(f64) -> f64) -> Mesh {
    let mut number: Vec<Option<u32>> = vec![None; grid.nodes.len()];
    let mut nodes: Vec<[f64; 2]> = Vec::with_capacity(grid.nodes.len());
    for node in grid.cells.iter_mut().flatten() {
        let id = *node as usize;
        *node = *number[id].get_or_insert_with(|| {
            let [r, zeta] = grid.nodes[id];
            // flat depth ζ in [-fade, 0] goes to [-fade, z_s(r)], linearly
            nodes.push([r, zeta + z(r) * (1.0 + zeta / fade).max(0.0)]);
            (nodes.len() - 1) as u32
        });
    }
    let corners = sound(Mesh {
        kind: ElementKind::Quad4,
        nodes,
        cells: grid.cells.into_flattened(),
        sides: grid.sides,
    });
    if kind == ElementKind::Quad4 {
        return corners;
    }
    let mut mesh = corners.with_other_element();
    for edge in mesh.sides.surface.clone() {
        if let (_, Some(node)) = mesh.edge_nodes(edge) {
            let r = mesh.nodes[node as usize][0];
            mesh.nodes[node as usize][1] = z(r);
        }
    }
    mesh
}
