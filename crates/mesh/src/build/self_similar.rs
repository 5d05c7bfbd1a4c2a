//! A sharp cone on its substrate, or the flat body under a cone: columns of one width under the contact, so
//! that the force ripples with one period, and shells around them that grow to the far boundary.

use super::finish;
use super::grid::{Grid, Rectangle, Ring, wrap};
use crate::grading::divide;
use crate::grading::divide_geometric;
use crate::{Edge, ElementKind, Mesh};

/// Sizes of a self-similar mesh, lengths in units of the radius of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sizes {
    /// The number of columns, from the axis, that are one wide column.
    pub at_axis: usize,
    /// Width of the part with columns of one size: beyond the contact by what it may be exceeded.
    pub core: f64,
    /// Depth of that part.
    pub core_depth: f64,
    /// Growth of its rows with depth.
    pub row_growth: f64,
    /// Width of the first shell around it, in columns.
    pub first_shell: f64,
    /// Width of the far shells as a share of the distance.
    pub growth: f64,
    /// Base radius of the cone.
    pub foot: f64,
    /// Radius over which the summit of the cone is rounded, to a hyperboloid; 0: sharp.
    pub rounding: f64,
}

/// A self-similar body to mesh. Any unit of length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfSimilar {
    /// Slope (tangent) of the cone; 0 for a flat body.
    pub slope: f64,
    /// Radius of the contact.
    pub radius: f64,
    /// Columns across it.
    pub elements: usize,
    /// Radius and depth of the substrate.
    pub domain: f64,
    /// Sizes in units of the radius.
    pub sizes: Sizes,
    /// Kind of element.
    pub kind: ElementKind,
}

/// Meshes a cone, its summit at height 0, or a flat body.
pub fn self_similar(plan: &SelfSimilar) -> Mesh {
    let SelfSimilar { slope, radius, elements, domain, sizes, kind } = *plan;
    let element = radius / elements as f64;
    let count = (sizes.core * elements as f64).round() as usize;
    let core = count as f64 * element;
    let (foot, rounding) = (sizes.foot * radius, sizes.rounding * radius);
    let depth = domain + slope * foot;
    // the diagonals on which the shells turn stay steeper than the flank
    let row_depth = (sizes.core_depth * radius).max(1.5 * slope * core);
    let columns: Vec<f64> =
        std::iter::once(0).chain(sizes.at_axis.max(1)..=count).map(|i| i as f64 * element).collect();
    let rows = divide(0.0, row_depth, &[], |d| element + sizes.row_growth * d);
    let (near, far) = (sizes.first_shell * element / core, sizes.growth);
    let kinks = if slope > 0.0 { vec![foot] } else { Vec::new() };
    let stations = divide_geometric(core, domain, &kinks, |x| x * (near + (far - near) * (1.0 - core / x)));

    let mut grid = Grid::default();
    let nodes = grid.block(&columns, &rows);
    let (right, bottom) = (columns.len() - 1, rows.len() - 1);
    grid.sides.axis.extend((0..bottom).map(|j| Edge { cell: j as u32, side: 3 }));
    let mut ids: Vec<u32> = nodes.iter().map(|column| column[bottom]).collect();
    ids.extend(nodes[right][..bottom].iter().rev());
    let inner = Rectangle { left: 0.0, right: core, depth: row_depth };
    let reach = (domain / core).ln();
    let shell = |&x: &f64| {
        let share = (x / core).ln() / reach;
        let deeper = row_depth * (depth / row_depth).powf(share);
        Rectangle { left: 0.0, right: x, depth: if x == domain { depth } else { deeper } }
    };
    let shells: Vec<Rectangle> = stations[1..].iter().map(shell).collect();
    let body = Rectangle { left: 0.0, right: domain, depth };
    wrap(&mut grid, Ring { ids, edges: [0, right, bottom], rectangle: inner }, &shells, Some(body));
    let below = |r: f64| -slope * (r.hypot(rounding) - rounding);
    finish(grid, kind, depth, |r| below(r.min(foot)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cones_of_all_slopes_and_flat_bodies_have_sound_cells() {
        for (slope, core_depth) in [(0.0, 0.4), (0.017, 0.4), (0.176, 0.4), (0.577, 1.0)] {
            let sizes = Sizes {
                at_axis: 1,
                core: 1.1,
                core_depth,
                row_growth: 0.5,
                first_shell: 1.0,
                growth: 0.4,
                foot: 8.0,
                rounding: 0.0,
            };
            let kind = ElementKind::Quad8;
            let mesh =
                self_similar(&SelfSimilar { slope, radius: 1.0, elements: 10, domain: 100.0, sizes, kind });
            assert!(mesh.quality().unwrap().min_scaled_jacobian > 0.15, "{slope} {:?}", mesh.quality());
            let radius = |edge: &Edge| {
                let ([a, b], _) = mesh.edge_nodes(*edge);
                mesh.nodes[a as usize][0].max(mesh.nodes[b as usize][0])
            };
            let ends: Vec<f64> = mesh.sides.surface.iter().map(radius).collect();
            assert!(ends.windows(2).all(|w| w[0] < w[1]) && (ends[10] - 1.1).abs() < 1e-12);
        }
    }
}
