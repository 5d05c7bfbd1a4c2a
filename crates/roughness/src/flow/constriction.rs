//! The narrowest place of the widest path through a gap.

use super::gap::{Axis, Gap, Oriented};
use rayon::prelude::*;

/// The critical constriction: all of a flow must pass a gap no wider than this one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constriction {
    /// Its gap, in metres.
    pub gap: f64,
    /// Its pixel along x and y.
    pub at: [usize; 2],
}

/// The critical constriction along `axis`; None where no open path crosses the map.
///
/// Pixels are opened from the widest gap to the narrowest and joined with open neighbours over their sides; the pixel that
/// first joins both ends is the constriction.
pub fn constriction(gap: &Gap, axis: Axis) -> Option<Constriction> {
    let map = gap.along(axis);
    let mut order: Vec<u32> = (0..map.gaps.len() as u32).filter(|i| map.gaps[*i as usize] > 0.0).collect();
    // equal gaps in the order of the map, so that the answer does not depend on threads
    order.par_sort_unstable_by(|a, b| map.gaps[*b as usize].total_cmp(&map.gaps[*a as usize]).then(a.cmp(b)));
    let narrowest = first_crossing(&map, &order)?;
    let (along, line) = (narrowest % map.long, narrowest / map.long);
    let at = if axis == Axis::X { [along, line] } else { [line, along] };
    Some(Constriction { gap: map.gaps[narrowest], at })
}

/// The pixel of `order` with which the open ones first reach from end to end.
fn first_crossing(map: &Oriented, order: &[u32]) -> Option<usize> {
    let n = map.gaps.len();
    // two nodes more: the ends
    let (entry, exit) = (n, n + 1);
    let mut parent: Vec<u32> = (0..n as u32 + 2).collect();
    let mut open = vec![false; n];
    for &i in order {
        let i = i as usize;
        open[i] = true;
        let column = i % map.long;
        if column == 0 {
            join(&mut parent, i, entry);
        }
        if column + 1 == map.long {
            join(&mut parent, i, exit);
        }
        let before = [
            (column > 0).then(|| i.wrapping_sub(1)),
            if i >= map.long {
                Some(i - map.long)
            } else {
                (map.periodic && map.wide > 1).then(|| n - map.long + i)
            },
        ];
        for j in before.into_iter().chain([map.ahead(i), map.beside(i)]).flatten() {
            if open[j] {
                join(&mut parent, i, j);
            }
        }
        if root(&mut parent, entry) == root(&mut parent, exit) {
            return Some(i);
        }
    }
    None
}

/// The root of a node, links to it halved on the way.
fn root(parent: &mut [u32], mut i: usize) -> usize {
    while parent[i] as usize != i {
        parent[i] = parent[parent[i] as usize];
        i = parent[i] as usize;
    }
    i
}

fn join(parent: &mut [u32], a: usize, b: usize) {
    let (a, b) = (root(parent, a), root(parent, b));
    parent[a.max(b)] = a.min(b) as u32;
}
