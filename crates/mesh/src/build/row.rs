//! Contacts side by side: a cell under each, plain blocks between them, and the shells around the whole row.

use super::contact_core::{add_core, shell_limit};
use super::grid::{Grid, Rectangle, Ring, name_side, sort_surface, wrap};
use super::plan::{Contact, Plan, contact_size, core_half_width, kinks_from, power};
use crate::grading::{Grading, divide, divide_geometric};
use std::collections::HashMap;

/// The rectangle of a row: as deep as the geometric mean of the half widths of its cells.
pub fn rectangle(plan: &Plan) -> Rectangle {
    let contacts = &plan.contacts;
    // logarithms of ratios: those of lengths would depend on their unit
    let depths = || contacts.iter().map(|c| c.foot * c.depth_ratio());
    let first = depths().next().unwrap_or(1.0);
    let mean =
        first * (depths().map(|depth| (depth / first).ln()).sum::<f64>() / contacts.len() as f64).exp();
    Rectangle { left: plan.row[0], right: plan.row[1], depth: mean.min(0.5 * plan.depth) }
}

/// The sides of the blocks of a row so far: nodes down the left, along the bottom and down the right.
#[derive(Default)]
struct Sides {
    left: Vec<u32>,
    bottom: Vec<u32>,
    right: Vec<u32>,
}

impl Sides {
    /// Takes the sides of a block into the row: its left side is welded to the right side of the block
    /// before.
    fn join(&mut self, grid: &mut Grid, [left, bottom, right]: &[Vec<u32>; 3]) {
        if self.right.is_empty() {
            self.left.clone_from(left);
            self.bottom.clone_from(bottom);
        } else {
            let alias: HashMap<u32, u32> = left.iter().copied().zip(self.right.iter().copied()).collect();
            for node in grid.cells.iter_mut().flatten() {
                if let Some(&other) = alias.get(node) {
                    *node = other;
                }
            }
            self.bottom.extend_from_slice(&bottom[1..]);
        }
        self.right.clone_from(right);
    }

    /// The ring around the row; the sides on the edges of the body get their names.
    fn ring(self, grid: &mut Grid, plan: &Plan, rectangle: Rectangle, rows: usize) -> Ring {
        let Sides { left, bottom, right } = self;
        let on_left = rectangle.left > plan.width[0];
        let on_right = rectangle.right < plan.width[1];
        if !on_left && plan.contacts[0].centre != plan.width[0] {
            name_side(grid, &left, |grid| &mut grid.sides.axis);
        }
        if !on_right {
            name_side(grid, &right, |grid| &mut grid.sides.outer);
        }
        let mut ids: Vec<u32> = if on_left { left[..rows].to_vec() } else { Vec::new() };
        let columns = bottom.len() - 1;
        ids.extend(bottom);
        if on_right {
            ids.extend(right[..rows].iter().rev());
        }
        let edges = [if on_left { rows } else { 0 }, columns, if on_right { rows } else { 0 }];
        Ring { ids, edges, rectangle }
    }
}

/// Cells side by side with plain blocks between them; returns the ring around the whole row.
pub fn add(grid: &mut Grid, plan: &Plan) -> Ring {
    let rectangle = rectangle(plan);
    let depths: Vec<f64> = plan.grading.rows(plan.kind).iter().map(|t| t * rectangle.depth).collect();
    let mut sides = Sides::default();
    let mut edge = rectangle.left;
    for (index, contact) in plan.contacts.iter().enumerate() {
        let halved = index == 0 && contact.centre == plan.width[0];
        let [cell_left, cell_right] =
            [0, 1].map(|i| contact.centre + [-1.0, 1.0][i] * contact.foot * contact.sides[i]);
        let cell_left = if halved { contact.centre } else { cell_left };
        if let Some(nodes) = plain_block(grid, plan, [edge, cell_left], &depths) {
            sides.join(grid, &nodes);
        }
        let cell = cell(grid, plan, contact, halved, rectangle.depth);
        sides.join(grid, &cell);
        edge = cell_right;
    }
    if let Some(nodes) = plain_block(grid, plan, [edge, rectangle.right], &depths) {
        sides.join(grid, &nodes);
    }
    sides.ring(grid, plan, rectangle, depths.len() - 1)
}

/// The cell under one contact, as deep as the row: a core and the shells around it. Its nodes down the left,
/// along the bottom and down the right.
fn cell(grid: &mut Grid, plan: &Plan, contact: &Contact, halved: bool, row_depth: f64) -> [Vec<u32>; 3] {
    let half = core_half_width(plan, contact);
    let core = Rectangle {
        left: if halved { contact.centre } else { contact.centre - half },
        right: contact.centre + half,
        depth: (half * contact.depth_ratio()).min(0.6 * row_depth),
    };
    let start = grid.sides.surface.len();
    let ring = add_core(grid, plan, contact, core);
    let shells = shells(plan, contact, halved, half, [core.depth, row_depth]);
    let ring = wrap(grid, ring, &shells, None);
    sort_surface(grid, start);
    let [l, b, _] = ring.edges;
    let down: Vec<u32> = ring.ids[..=l].to_vec();
    let up: Vec<u32> = ring.ids[l + b..].iter().rev().copied().collect();
    [down, ring.ids[l..=l + b].to_vec(), up]
}

/// The shells of a cell from the `half` width of its core to its foot, with the `depths` of core and row.
fn shells(plan: &Plan, contact: &Contact, halved: bool, half: f64, depths: [f64; 2]) -> Vec<Rectangle> {
    let grading = if contact.is_resolved() {
        plan.grading
    } else {
        Grading { fineness: 0.5, far: 0.5, ..plan.grading }
    };
    let kinks: Vec<f64> =
        kinks_from(plan, contact.centre).into_iter().filter(|&k| k < contact.foot).collect();
    let stations = divide_geometric(half, contact.foot, &kinks, |x| grading.size(x, contact_size(contact)));
    let shell = |&x: &f64| {
        let [left, right] = contact.shell(half, x);
        Rectangle {
            left: if halved { contact.centre } else { left },
            right,
            depth: power([half, depths[0]], [contact.foot, depths[1]], x),
        }
    };
    stations[1..].iter().map(shell).collect()
}

/// A block of plain columns over [from, to], its nodes down the left, along the bottom and down the right;
/// nothing if the interval is empty. Columns widen from the feet of cells at its ends; between two cells its
/// middle is a node, so that the two halves are the blocks that symmetric sides would leave.
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

/// The rectangles around a row of cells, out to where shells end. Next to the row, where all its loads add
/// up, they are as fine as the grading asks for.
pub fn rectangles_around(plan: &Plan, inner: Rectangle) -> Vec<Rectangle> {
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

#[cfg(test)]
mod tests {
    use crate::ElementKind;
    use crate::build::{Contact, Plan, build};
    use crate::grading::Grading;
    use crate::profile::{Asperity, Profile, Shape};

    /// Three ridges far from 0, of which the first is touched.
    fn row(second: f64, third: f64) -> Plan {
        let centres = [1000.0, 1020.0, 1040.0];
        let ridge = |centre| Asperity {
            shape: Shape::Cone { tan_slope: 0.1, tip_radius: 0.0 },
            height: 1.0,
            centre,
            valley_radius: 0.0,
        };
        let contact =
            |(centre, half_width)| Contact { centre, half_width, foot: 10.0, sides: [1.0; 2], slope: 0.1 };
        Plan {
            profile: Profile { asperities: centres.map(ridge).to_vec(), line: None },
            contacts: centres.into_iter().zip([1.0, second, third]).map(contact).collect(),
            row: [990.0, 1050.0],
            width: [900.0, 1140.0],
            depth: 200.0,
            grading: Grading { fineness: 0.2, start: 0.7, fine: 1.6, far: 0.4 },
            kind: ElementKind::Quad8,
        }
    }

    /// Half widths below the rounding of a place, up to what the columns of a core can still tell apart.
    #[test]
    fn a_contact_as_wide_as_a_rounding_is_meshed_as_an_untouched_one() {
        let untouched = build(&row(0.0, 0.0));
        assert!(untouched.quality().unwrap().min_scaled_jacobian > 0.1);
        for width in [f64::MIN_POSITIVE, 1e-14, 1e-10, 9e-6] {
            assert_eq!(build(&row(width, 0.0)), untouched, "{width}");
            assert_eq!(build(&row(0.0, width)), untouched, "{width}");
        }
        let touched = build(&row(1.1e-5, 0.0));
        assert!(touched.cell_count() > untouched.cell_count());
        assert!(touched.quality().unwrap().min_scaled_jacobian > 0.1, "{:?}", touched.quality());
    }
}
