//! Sums over the nodes and cells of each asperity.

use super::NO_ASPERITY;
use super::hills::Neighbours;
use crate::surface::cells::{self, Moments};
use crate::surface::height_map::HeightMap;

/// The nodes of an asperity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nodes {
    /// Its highest node.
    pub summit: usize,
    /// Their number.
    pub count: usize,
    /// True where it reaches the edge of the map or a point that was not measured.
    pub cut: bool,
    /// The highest way from it to another asperity, m; that to the lowest node where there is none.
    pub saddle: f64,
}

/// The nodes of each of `count` asperities.
pub(super) fn nodes(map: &HeightMap, labels: &[u32], count: usize) -> Vec<Option<Nodes>> {
    let z = map.heights();
    let neighbours = Neighbours::new(map);
    let mut found: Vec<Option<Nodes>> = vec![None; count];
    for (node, label) in labels.iter().enumerate().filter(|(_, label)| **label != NO_ASPERITY) {
        let start = Nodes { summit: node, count: 0, cut: false, saddle: f64::NEG_INFINITY };
        let sum = found[*label as usize].get_or_insert(start);
        sum.count += 1;
        if z[node] > z[sum.summit] {
            sum.summit = node;
        }
        for (beside, _) in neighbours.around_node(node) {
            match beside {
                Some(n) if !z[n].is_nan() => {
                    if labels[n] != *label && labels[n] != NO_ASPERITY {
                        sum.saddle = sum.saddle.max(z[n].min(z[node]));
                    }
                }
                _ => sum.cut = true,
            }
        }
    }
    found
}

/// Moments of the cells of each of `count` hills about its summit, in pixels: a corner takes a quarter of its
/// cells.
pub(super) fn moments(map: &HeightMap, labels: &[u32], nodes: &[Option<Nodes>]) -> Vec<Moments> {
    let (columns, rows) = (map.columns(), map.rows());
    let inverse_pixel = map.inverse_pixel();
    let mut sums = vec![Moments::default(); nodes.len()];
    // from the summit, the shorter way around a periodic map
    let away = |from: usize, to: usize, n: usize| {
        let d = to as f64 - from as f64;
        let n = n as f64;
        if map.periodic() { d - n * (d / n).round() } else { d }
    };
    for row in 0..map.cell_rows() {
        for column in 0..map.cell_columns() {
            let (right, above) = ((column + 1) % columns, (row + 1) % rows);
            let corner = [[column, row], [right, row], [right, above], [column, above]];
            let at = corner.map(|[x, y]| y * columns + x);
            let z = at.map(|i| map.heights()[i]);
            if z.iter().any(|z| z.is_nan()) {
                continue;
            }
            let slope = cells::mean_gradient(&z, inverse_pixel);
            for ([x, y], i) in corner.iter().zip(at) {
                let label = labels[i] as usize;
                let Some(Some(own)) = nodes.get(label) else { continue };
                let [sx, sy] = [own.summit % columns, own.summit / columns];
                let (dx, dy) = (away(sx, *x, columns), away(sy, *y, rows));
                let quarter = Moments {
                    area: 0.25,
                    slope_area: 0.25 * slope,
                    // about the node, as a whole pixel around it has them
                    xx: 0.25 / 12.0,
                    yy: 0.25 / 12.0,
                    ..Moments::default()
                };
                sums[label].add(&quarter.moved(dx, dy));
            }
        }
    }
    sums
}
