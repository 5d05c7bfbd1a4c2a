//! Graded quadrilaterals under a profile: a fine core under every contact, shells around it that grow outward.
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

use crate::grading::{Grading, divide};
use crate::profile::Profile;
use crate::smoothing::{Freedom, improve};
use crate::{Edge, ElementKind, Mesh};
use std::collections::HashSet;

mod grid;
mod row;
mod self_similar;

pub use self_similar::{SelfSimilar, Sizes, self_similar};

use grid::{Grid, Rectangle, Ring, Side, add_columns, sort_surface, wrap};

/// A contact to be resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Its centre.
    pub centre: f64,
    /// Its half width at the peak; 0 if the asperity stays untouched.
    pub half_width: f64,
    /// Half width of the foot of the asperity: that of its cell; the wider of two.
    pub foot: f64,
    /// Its left and right side over that.
    pub sides: [f64; 2],
    /// Steepest slope (tangent) of the profile over it.
    pub slope: f64,
}

impl Contact {
    /// Left and right end of the shell whose wider side is `x` away from the centre: shells around a core of the half width
    /// `half` grow towards the two feet.
    fn shell(&self, half: f64, x: f64) -> [f64; 2] {
        let side = |share: f64| {
            if share == 1.0 { x } else { power([half, half], [self.foot, share * self.foot], x) }
        };
        [self.centre - side(self.sides[0]), self.centre + side(self.sides[1])]
    }

    /// Half width of the narrower side of its foot.
    fn narrow(&self) -> f64 {
        self.foot * self.sides[0].min(self.sides[1])
    }

    /// Depth over half width of the core. The diagonals on which shells turn must stay steeper than the flank, or
    /// the shear under the profile turns their cells inside out.
    fn depth_ratio(&self) -> f64 {
        (1.7 * self.slope).max(1.0)
    }
}

/// A body to mesh. Any unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The surface.
    pub profile: Profile,
    /// The contacts from left to right, at least one. One on the left side at its own centre is halved by the axis.
    pub contacts: Vec<Contact>,
    /// Left and right end of the row of cells and blocks; beyond it shells lead to the sides of the body.
    pub row: [f64; 2],
    /// Left and right side of the body.
    pub width: [f64; 2],
    /// Depth of the body below its highest summit.
    pub depth: f64,
    /// Sizes.
    pub grading: Grading,
    /// Kind of element.
    pub kind: ElementKind,
}

/// Whether there is one contact, halved by the axis: its shells reach the far boundary.
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

/// The power of x through two points (x, y), at `x`.
fn power(from: [f64; 2], to: [f64; 2], x: f64) -> f64 {
    from[1] * (to[1] / from[1]).powf((x / from[0]).ln() / (to[0] / from[0]).ln())
}

/// Width of a body over its depth, or the reverse, up to which one family of shells fills it.
const STRETCH: f64 = 2.5;

/// How far shells around `inner` go: to the sides of the body, unless one is so much farther than the other that the
/// shells would become splinters; then as far in every direction as the nearer side.
fn shell_limit(plan: &Plan, inner: Rectangle) -> Rectangle {
    let gaps = [inner.left - plan.width[0], plan.width[1] - inner.right];
    let (sideways, down) = (gaps[0].max(gaps[1]), plan.depth - inner.depth);
    let (sideways, down) = if sideways > STRETCH * down {
        (down, down)
    } else if sideways > 0.0 && down > STRETCH * sideways {
        (sideways, sideways)
    } else {
        (sideways, down)
    };
    // the side itself where it is reached, not a rounded sum, beside which a splinter would be left
    let stops = |way: f64, gap: f64| way < (1.0 - 1e-9) * gap;
    let [left, right] = plan.width;
    Rectangle {
        left: if stops(sideways, gaps[0]) { inner.left - sideways } else { left },
        right: if stops(sideways, gaps[1]) { inner.right + sideways } else { right },
        depth: if stops(down, plan.depth - inner.depth) { inner.depth + down } else { plan.depth },
    }
}

/// Fills what the shells left of the body: columns beside them, or rows below them. `size` is the wanted size at a
/// distance to the right of 0.
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

/// Half width that the sizes around a contact follow: an untouched asperity is meshed coarsely after its foot.
fn contact_size(contact: &Contact) -> f64 {
    if contact.half_width > 0.0 { contact.half_width } else { 0.1 * contact.foot }
}

fn core_half_width(plan: &Plan, contact: &Contact) -> f64 {
    let wish =
        if contact.half_width > 0.0 { plan.grading.start * contact.half_width } else { 0.3 * contact.foot };
    wish.min(0.6 * contact.narrow())
}

/// Distances of the kinks of the profile to the right of `centre`.
fn kinks_from(plan: &Plan, centre: f64) -> Vec<f64> {
    plan.profile.kinks().into_iter().filter(|&k| k > centre).map(|k| k - centre).collect()
}

/// The core under a contact, `rectangle` in size; halved by the axis where its left end is the centre.
fn add_core(grid: &mut Grid, plan: &Plan, contact: &Contact, rectangle: Rectangle) -> Ring {
    let halved = rectangle.left == contact.centre;
    let to_right = plan.grading.columns(rectangle.right - contact.centre, &kinks_from(plan, contact.centre));
    let to_left = if halved { &[] } else { &to_right[1..] };
    let columns: Vec<f64> = to_left
        .iter()
        .rev()
        .map(|x| contact.centre - x)
        .chain(to_right.iter().map(|x| contact.centre + x))
        .collect();
    let rows: Vec<f64> = plan.grading.rows(plan.kind).iter().map(|t| t * rectangle.depth).collect();
    let (elements, last) = (rows.len() - 1, columns.len() - 1);
    let first = grid.cells.len();
    let nodes = grid.block(&columns, &rows);
    // graded at the surface, even at the bottom, whose cells the shells draw out
    for (i, column) in nodes.iter().enumerate() {
        let even = rectangle.left + (rectangle.right - rectangle.left) * i as f64 / last as f64;
        for (id, row) in column.iter().zip(&rows) {
            grid.nodes[*id as usize][0] += row / rectangle.depth * (even - columns[i]);
        }
    }
    if halved {
        grid.sides.axis.extend((0..elements).map(|j| Edge { cell: (first + j) as u32, side: 3 }));
    }
    let left = if halved { 0 } else { elements };
    let mut ids: Vec<u32> = nodes[0][..left].to_vec();
    ids.extend(nodes.iter().map(|column| column[elements]));
    ids.extend(nodes[last][..elements].iter().rev());
    Ring { ids, edges: [left, last, elements], rectangle }
}

/// Divides like `divide`, but integrates in the logarithm of the distance, so that decades are resolved.
fn divide_geometric(from: f64, to: f64, kinks: &[f64], size: impl Fn(f64) -> f64) -> Vec<f64> {
    let logs: Vec<f64> = kinks.iter().filter(|&&k| k > from && k < to).map(|k| k.ln()).collect();
    let mut nodes: Vec<f64> =
        divide(from.ln(), to.ln(), &logs, |l| size(l.exp()) / l.exp()).into_iter().map(f64::exp).collect();
    // kinks and ends exactly, not to the rounding of the logarithm
    for node in &mut nodes {
        for &stop in kinks.iter().chain([&from, &to]) {
            if (*node / stop - 1.0).abs() < 1e-12 {
                *node = stop;
            }
        }
    }
    nodes
}

/// Flanks steeper than this (tangent) are not followed by the mesh far below a row.
const STEEP: f64 = 0.75;

/// Depth at which the mesh no longer follows the profile: that of the body; below a row of steep flanks sooner, for there
/// the shells around the row spread sideways, and cells sheared by more than they spread turn inside out. Deep enough
/// that cells below a valley keep half their height.
fn fade_depth(plan: &Plan) -> f64 {
    let steepest = plan.contacts.iter().fold(0.0, |m: f64, c| m.max(c.slope));
    if stands_alone(plan) || steepest < STEEP {
        return plan.depth;
    }
    (1.5 * row::rectangle(plan).depth).max(2.0 * plan.profile.height()).min(plan.depth)
}

/// Smallest scaled Jacobian of a corner below which the nodes around are moved.
const SOUND: f64 = 0.02;

/// Rings of cells around a corner that is sharper, whose nodes may move.
const RINGS: usize = 3;

/// A mesh of four-node cells whose corners the shear under a steep flank may have turned inside out, with the inner nodes around them
/// where the cells have better shapes.
fn sound(mesh: Mesh) -> Mesh {
    let is_sharp = |cell: &usize| mesh.sharpest_corner(&mesh.nodes, *cell) < SOUND;
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

/// Shears the flat grid under a surface of the height `z(r)`, less and less down to the depth `fade`, drops welded nodes and
/// adds mid-side nodes.
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
