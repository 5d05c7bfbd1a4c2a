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
use crate::{Edge, ElementKind, Mesh, Sides};
use std::collections::HashMap;

/// A contact to be resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Its centre.
    pub centre: f64,
    /// Its half width at the peak; 0 if the asperity stays untouched.
    pub half_width: f64,
    /// Half width of the foot of the asperity: that of its cell.
    pub foot: f64,
    /// Steepest slope (tangent) of the profile over it.
    pub slope: f64,
}

impl Contact {
    /// Depth over half width of the core. The diagonals on which shells turn must stay steeper than the flank, or
    /// the shear under the profile turns their cells inside out.
    fn depth_ratio(&self) -> f64 {
        (1.7 * self.slope).max(1.0)
    }
}

/// What to mesh. Any unit of length.
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
        let contact = plan.contacts[0];
        let centre = contact.centre;
        let half = core_half_width(plan, &contact).min(0.4 * plan.depth).min(0.4 * (plan.width[1] - centre));
        let core = Rectangle {
            left: centre,
            right: centre + half,
            depth: (half * contact.depth_ratio()).min(0.6 * plan.depth),
        };
        let row = add_core(&mut grid, plan, &contact, core);
        let size = |x: f64| plan.grading.size(x, contact_size(&contact));
        let end = shell_limit(plan, Rectangle { left: centre, right: centre, depth: 0.0 });
        let right = divide_geometric(half, end.right - centre, &kinks_from(plan, centre), size);
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
        let rectangles: Vec<Rectangle> = right[1..]
            .iter()
            .map(|&x| Rectangle { left: centre, right: centre + x, depth: depth(x) })
            .collect();
        let ring = wrap(&mut grid, row, &rectangles, Some(plan));
        extend(&mut grid, ring, plan, size);
    } else {
        let row = add_row(&mut grid, plan);
        let inner = row.rectangle;
        let ring = wrap(&mut grid, row, &outer_rectangles(plan, inner), Some(plan));
        let reach = ring.rectangle.right;
        extend(&mut grid, ring, plan, |x| plan.grading.far * (x - reach + inner.depth));
    }
    finish(plan, grid)
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
        wrap(grid, below, &rectangles, Some(plan));
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

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Left,
    Right,
}

/// Columns of cells at the places `columns`, from the nodes `inner` (from the surface down to the base) outward;
/// on the `side` of them.
fn add_columns(grid: &mut Grid, inner: &[u32], columns: &[f64], side: Side) {
    let mut before = inner.to_vec();
    for (index, &x) in columns.iter().enumerate() {
        let next: Vec<u32> = before
            .iter()
            .map(|&id| {
                let depth = grid.nodes[id as usize][1];
                grid.node([x, depth])
            })
            .collect();
        let (left, right) = match side {
            Side::Right => (&before, &next),
            Side::Left => (&next, &before),
        };
        let rows = next.len() - 1;
        for j in 0..rows {
            let cell = grid.cells.len() as u32;
            grid.cells.push([left[j + 1], right[j + 1], right[j], left[j]]);
            if j == 0 {
                grid.surface.push(Edge { cell, side: 2 });
            }
            if j + 1 == rows {
                grid.base.push(Edge { cell, side: 0 });
            }
            if index + 1 == columns.len() {
                match side {
                    Side::Right => grid.outer.push(Edge { cell, side: 1 }),
                    Side::Left => grid.axis.push(Edge { cell, side: 3 }),
                }
            }
        }
        before = next;
    }
}

/// Half width that the sizes around a contact follow: an untouched asperity is meshed coarsely after its foot.
fn contact_size(contact: &Contact) -> f64 {
    if contact.half_width > 0.0 { contact.half_width } else { 0.1 * contact.foot }
}

fn core_half_width(plan: &Plan, contact: &Contact) -> f64 {
    let wish =
        if contact.half_width > 0.0 { plan.grading.start * contact.half_width } else { 0.3 * contact.foot };
    wish.min(0.6 * contact.foot)
}

/// Distances of the kinks of the profile to the right of `centre`.
fn kinks_from(plan: &Plan, centre: f64) -> Vec<f64> {
    plan.profile.kinks().into_iter().filter(|&k| k > centre).map(|k| k - centre).collect()
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Rectangle {
    left: f64,
    right: f64,
    depth: f64,
}

/// Corner nodes in the flat plane, cells of four corners, and the sides found so far.
#[derive(Default)]
struct Grid {
    nodes: Vec<[f64; 2]>,
    cells: Vec<[u32; 4]>,
    surface: Vec<Edge>,
    axis: Vec<Edge>,
    outer: Vec<Edge>,
    base: Vec<Edge>,
}

impl Grid {
    fn node(&mut self, x: [f64; 2]) -> u32 {
        self.nodes.push(x);
        (self.nodes.len() - 1) as u32
    }

    /// A block of columns and rows (depths, downward from 0); returns its nodes `[column][row]`.
    fn block(&mut self, columns: &[f64], rows: &[f64]) -> Vec<Vec<u32>> {
        let nodes: Vec<Vec<u32>> =
            columns.iter().map(|&x| rows.iter().map(|&d| self.node([x, -d])).collect()).collect();
        for i in 0..columns.len() - 1 {
            for j in 0..rows.len() - 1 {
                if j == 0 {
                    self.surface.push(Edge { cell: self.cells.len() as u32, side: 2 });
                }
                self.cells.push([nodes[i][j + 1], nodes[i + 1][j + 1], nodes[i + 1][j], nodes[i][j]]);
            }
        }
        nodes
    }
}

/// The wrapped sides of a block, counterclockwise: down the left, along the bottom, up the right.
struct Ring {
    ids: Vec<u32>,
    /// Number of edges on the left, at the bottom, on the right.
    edges: [usize; 3],
    rectangle: Rectangle,
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
        grid.axis.extend((0..elements).map(|j| Edge { cell: (first + j) as u32, side: 3 }));
    }
    let left = if halved { 0 } else { elements };
    let mut ids: Vec<u32> = nodes[0][..left].to_vec();
    ids.extend(nodes.iter().map(|column| column[elements]));
    ids.extend(nodes[last][..elements].iter().rev());
    Ring { ids, edges: [left, last, elements], rectangle }
}

/// Wraps `ring` in shells up to each of `rectangles`; sides of the `body` are named where the last one reaches them.
fn wrap(grid: &mut Grid, mut ring: Ring, rectangles: &[Rectangle], body: Option<&Plan>) -> Ring {
    let [left, bottom, right] = ring.edges;
    let inner = ring.rectangle;
    // places on the sides of the inner rectangle as shares, kept by every shell
    let shares: Vec<[f64; 2]> = ring
        .ids
        .iter()
        .map(|&id| {
            let [x, z] = grid.nodes[id as usize];
            [(x - inner.left) / (inner.right - inner.left), z / inner.depth]
        })
        .collect();
    for to in rectangles {
        let next: Vec<u32> = shares
            .iter()
            .map(|[s, t]| grid.node([to.left + s * (to.right - to.left), t * to.depth]))
            .collect();
        for s in 0..next.len() - 1 {
            let cell = grid.cells.len() as u32;
            grid.cells.push([next[s], next[s + 1], ring.ids[s + 1], ring.ids[s]]);
            if s == 0 {
                let side = if left > 0 { &mut grid.surface } else { &mut grid.axis };
                side.push(Edge { cell, side: 3 });
            }
            if s + 2 == next.len() {
                let side = if right > 0 { &mut grid.surface } else { &mut grid.outer };
                side.push(Edge { cell, side: 1 });
            }
            if let Some(plan) = body.filter(|_| Some(to) == rectangles.last()) {
                let edge = Edge { cell, side: 0 };
                if s < left && to.left == plan.width[0] {
                    grid.axis.push(edge);
                } else if s >= left && s < left + bottom && to.depth == plan.depth {
                    grid.base.push(edge);
                } else if s >= left + bottom && to.right == plan.width[1] {
                    grid.outer.push(edge);
                }
            }
        }
        ring.ids = next;
        ring.rectangle = *to;
    }
    ring
}

/// The rectangle of a row: as deep as the geometric mean of the half widths of its cells.
fn row_rectangle(plan: &Plan) -> Rectangle {
    let contacts = &plan.contacts;
    let logs = contacts.iter().map(|c| (c.foot * c.depth_ratio()).ln());
    let mean = (logs.sum::<f64>() / contacts.len() as f64).exp();
    Rectangle { left: plan.row[0], right: plan.row[1], depth: mean.min(0.5 * plan.depth) }
}

/// Cells side by side with plain blocks between them; returns the ring around the whole row.
fn add_row(grid: &mut Grid, plan: &Plan) -> Ring {
    let rectangle = row_rectangle(plan);
    let depths: Vec<f64> = plan.grading.rows(plan.kind).iter().map(|t| t * rectangle.depth).collect();
    let rows = depths.len() - 1;
    let (mut left, mut bottom, mut right): (Vec<u32>, Vec<u32>, Vec<u32>) =
        (Vec::new(), Vec::new(), Vec::new());
    // takes the sides of a block into the row: its left side is welded to the right side of the block before
    let mut join = |grid: &mut Grid, [block_left, block_bottom, block_right]: &[Vec<u32>; 3]| {
        if right.is_empty() {
            left.clone_from(block_left);
            bottom.clone_from(block_bottom);
        } else {
            let alias: HashMap<u32, u32> = block_left.iter().copied().zip(right.iter().copied()).collect();
            for node in grid.cells.iter_mut().flatten() {
                if let Some(&other) = alias.get(node) {
                    *node = other;
                }
            }
            bottom.extend_from_slice(&block_bottom[1..]);
        }
        right.clone_from(block_right);
    };
    let mut edge = rectangle.left;
    for (index, contact) in plan.contacts.iter().enumerate() {
        let halved = index == 0 && contact.centre == plan.width[0];
        let cell_left = if halved { contact.centre } else { contact.centre - contact.foot };
        if let Some(nodes) = plain_block(grid, plan, [edge, cell_left], &depths) {
            join(grid, &nodes);
        }
        let half = core_half_width(plan, contact);
        let core = Rectangle {
            left: if halved { contact.centre } else { contact.centre - half },
            right: contact.centre + half,
            depth: (half * contact.depth_ratio()).min(0.6 * rectangle.depth),
        };
        let start = grid.surface.len();
        let ring = add_core(grid, plan, contact, core);
        let grading = if contact.half_width > 0.0 {
            plan.grading
        } else {
            Grading { fineness: 0.5, far: 0.5, ..plan.grading }
        };
        let kinks: Vec<f64> =
            kinks_from(plan, contact.centre).into_iter().filter(|&k| k < contact.foot).collect();
        let stations =
            divide_geometric(half, contact.foot, &kinks, |x| grading.size(x, contact_size(contact)));
        let shells: Vec<Rectangle> = stations[1..]
            .iter()
            .map(|&x| Rectangle {
                left: if halved { contact.centre } else { contact.centre - x },
                right: contact.centre + x,
                depth: power([half, core.depth], [contact.foot, rectangle.depth], x),
            })
            .collect();
        let ring = wrap(grid, ring, &shells, None);
        sort_surface(grid, start);
        let [l, b, _] = ring.edges;
        let down: Vec<u32> = ring.ids[..=l].to_vec();
        let up: Vec<u32> = ring.ids[l + b..].iter().rev().copied().collect();
        join(grid, &[down, ring.ids[l..=l + b].to_vec(), up]);
        edge = contact.centre + contact.foot;
    }
    if let Some(nodes) = plain_block(grid, plan, [edge, rectangle.right], &depths) {
        join(grid, &nodes);
    }
    let on_left = rectangle.left > plan.width[0];
    let on_right = rectangle.right < plan.width[1];
    if !on_left && plan.contacts[0].centre != plan.width[0] {
        name_side(grid, &left, |grid| &mut grid.axis);
    }
    if !on_right {
        name_side(grid, &right, |grid| &mut grid.outer);
    }
    let mut ids: Vec<u32> = if on_left { left[..rows].to_vec() } else { Vec::new() };
    let columns = bottom.len() - 1;
    ids.extend(bottom);
    if on_right {
        ids.extend(right[..rows].iter().rev());
    }
    Ring { ids, edges: [if on_left { rows } else { 0 }, columns, if on_right { rows } else { 0 }], rectangle }
}

/// A block of plain columns over [from, to], its nodes down the left, along the bottom and down the right; nothing if
/// the interval is empty. Columns widen from the feet of cells at its ends; between two cells its middle is a node, so
/// that the two halves are the blocks that symmetric sides would leave.
fn plain_block(grid: &mut Grid, plan: &Plan, [from, to]: [f64; 2], depths: &[f64]) -> Option<[Vec<u32>; 3]> {
    let width = to - from;
    if width <= 1e-9 * (plan.row[1] - plan.row[0]) {
        return None;
    }
    let size = |distance: f64| depths[1] - depths[0] + plan.grading.far * distance;
    let kinks = plan.profile.kinks();
    let columns = if from == plan.row[0] {
        divide(from, to, &kinks, |x| size(to - x))
    } else if to == plan.row[1] {
        divide(from, to, &kinks, |x| size(x - from))
    } else {
        let middle = 0.5 * (from + to);
        let mut columns = divide(from, middle, &kinks, |x| size(x - from));
        columns.pop();
        columns.extend(divide(middle, to, &kinks, |x| size(to - x)));
        columns
    };
    let nodes = grid.block(&columns, depths);
    let under = nodes.iter().map(|column| column[depths.len() - 1]).collect();
    Some([nodes[0].clone(), under, nodes[columns.len() - 1].clone()])
}

/// Names the edges between consecutive `nodes` as a side of the body.
fn name_side(grid: &mut Grid, nodes: &[u32], side: impl Fn(&mut Grid) -> &mut Vec<Edge>) {
    for pair in nodes.windows(2) {
        let found = grid.cells.iter().enumerate().find_map(|(cell, corners)| {
            (0..4)
                .find(|&k| {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    (a, b) == (pair[0], pair[1]) || (a, b) == (pair[1], pair[0])
                })
                .map(|k| Edge { cell: cell as u32, side: k as u8 })
        });
        side(grid).extend(found);
    }
}

/// Orders the surface edges from index `start` on by their place.
fn sort_surface(grid: &mut Grid, start: usize) {
    let middle = |edge: &Edge| {
        let cell = grid.cells[edge.cell as usize];
        let k = usize::from(edge.side);
        grid.nodes[cell[k] as usize][0] + grid.nodes[cell[(k + 1) % 4] as usize][0]
    };
    let mut keyed: Vec<(f64, Edge)> = grid.surface[start..].iter().map(|e| (middle(e), *e)).collect();
    keyed.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (slot, (_, edge)) in grid.surface[start..].iter_mut().zip(keyed) {
        *slot = edge;
    }
}

/// The rectangles around a row of cells, out to where shells end. Next to the row, where all its loads add up, they are
/// as fine as the grading asks for.
fn outer_rectangles(plan: &Plan, inner: Rectangle) -> Vec<Rectangle> {
    let end = shell_limit(plan, inner);
    let stations =
        divide_geometric(inner.depth, end.depth, &[], |x| plan.grading.size_around_row(x / inner.depth) * x);
    let last = stations.len() - 1;
    let rectangle = |(k, &depth): (usize, &f64)| {
        if k + 1 == last {
            return end;
        }
        let share = (depth - inner.depth) / (end.depth - inner.depth);
        Rectangle {
            left: inner.left + share * (end.left - inner.left),
            right: inner.right + share * (end.right - inner.right),
            depth,
        }
    };
    stations[1..].iter().enumerate().map(rectangle).collect()
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
    (1.5 * row_rectangle(plan).depth).max(2.0 * plan.profile.height()).min(plan.depth)
}

/// Shears the flat grid under the profile, drops welded nodes and adds mid-side nodes.
fn finish(plan: &Plan, mut grid: Grid) -> Mesh {
    sort_surface(&mut grid, 0);
    let fade = fade_depth(plan);
    let mut number: Vec<Option<u32>> = vec![None; grid.nodes.len()];
    let mut nodes: Vec<[f64; 2]> = Vec::with_capacity(grid.nodes.len());
    for node in grid.cells.iter_mut().flatten() {
        let id = *node as usize;
        *node = *number[id].get_or_insert_with(|| {
            let [r, zeta] = grid.nodes[id];
            // flat depth ζ in [-fade, 0] goes to [-fade, z_s(r)], linearly
            nodes.push([r, zeta + plan.profile.z(r) * (1.0 + zeta / fade).max(0.0)]);
            (nodes.len() - 1) as u32
        });
    }
    let sides = Sides { axis: grid.axis, base: grid.base, surface: grid.surface, outer: grid.outer };
    if plan.kind == ElementKind::Quad4 {
        return Mesh { kind: plan.kind, nodes, cells: grid.cells.into_flattened(), sides };
    }
    let mut middle: HashMap<(u32, u32), u32> = HashMap::new();
    let mut cells = Vec::with_capacity(8 * grid.cells.len());
    for cell in &grid.cells {
        cells.extend_from_slice(cell);
        for k in 0..4 {
            let (a, b) = (cell[k], cell[(k + 1) % 4]);
            let id = *middle.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let (p, q) = (nodes[a as usize], nodes[b as usize]);
                nodes.push([0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])]);
                (nodes.len() - 1) as u32
            });
            cells.push(id);
        }
    }
    let mut mesh = Mesh { kind: plan.kind, nodes, cells, sides };
    for edge in mesh.sides.surface.clone() {
        if let (_, Some(node)) = mesh.edge_nodes(edge) {
            let r = mesh.nodes[node as usize][0];
            mesh.nodes[node as usize][1] = plan.profile.z(r);
        }
    }
    mesh
}
