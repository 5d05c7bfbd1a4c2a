//! The fine core under a contact, and how far shells around it go.

use super::grid::{Grid, Rectangle, Ring};
use super::plan::{Contact, Plan, kinks_from};
use crate::Edge;

/// Width of a body over its depth, or the reverse, up to which one family of shells fills it.
const STRETCH: f64 = 2.5;

/// Reach of the shells around `inner`: to the sides of the body, unless one is so much farther than the other
/// that the shells would become splinters; then as far in every direction as the nearer side.
pub(super) fn shell_limit(plan: &Plan, inner: Rectangle) -> Rectangle {
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

/// The core under a contact, `rectangle` in size; halved by the axis where its left end is the centre.
pub(super) fn add_core(grid: &mut Grid, plan: &Plan, contact: &Contact, rectangle: Rectangle) -> Ring {
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
