//! Hills: the parts of a map from which the steepest way up leads to the same summit (ISO 25178-2), the low
//! ones pruned.
//!
//! The nodes are taken from the highest down. One without a higher neighbour founds a hill; every other one
//! belongs to the hill of its steepest way up. Where parts that were apart meet, the node is the saddle
//! between them: the part with the lower summit ends there, and if it rises by less than the threshold, its
//! hill goes to the hill beyond the saddle. This is the pruning of Wolf (1991) on the tree of summits and
//! saddles, lowest branch first, done in one pass.

use super::NO_ASPERITY;
use crate::surface::height_map::HeightMap;
use rayon::prelude::*;

/// The neighbours of a node: columns, rows, and distance in metres.
pub(super) struct Neighbours {
    size: [usize; 2],
    periodic: bool,
    steps: [([i64; 2], f64); 8],
}

impl Neighbours {
    /// Those of `map`, diagonal ones too, beyond the edges of a periodic one.
    pub fn new(map: &HeightMap) -> Neighbours {
        let [dx, dy] = map.pixel();
        let step = |x: i64, y: i64| ([x, y], (x as f64 * dx).hypot(y as f64 * dy));
        let steps = [
            step(1, 0),
            step(-1, 0),
            step(0, 1),
            step(0, -1),
            step(1, 1),
            step(-1, 1),
            step(1, -1),
            step(-1, -1),
        ];
        Neighbours { size: [map.columns(), map.rows()], periodic: map.periodic(), steps }
    }

    /// The node at a step from column `x` and row `y`; `None` beyond the edge.
    pub fn node(&self, [x, y]: [i64; 2]) -> Option<usize> {
        let [nx, ny] = self.size.map(|n| n as i64);
        let [x, y] = if self.periodic { [x.rem_euclid(nx), y.rem_euclid(ny)] } else { [x, y] };
        ((0..nx).contains(&x) && (0..ny).contains(&y)).then(|| (y * nx + x) as usize)
    }

    /// Neighbours of `node` and how far they are; `None` for one beyond the edge.
    pub fn around_node(&self, node: usize) -> impl Iterator<Item = (Option<usize>, f64)> {
        let (x, y) = ((node % self.size[0]) as i64, (node / self.size[0]) as i64);
        self.steps.iter().map(move |([a, b], distance)| (self.node([x + a, y + b]), *distance))
    }
}

/// Sets of summits; the root of a set is the one that stands for it.
struct Forest(Vec<u32>);

impl Forest {
    fn root(&mut self, mut k: u32) -> u32 {
        while self.0[k as usize] != k {
            self.0[k as usize] = self.0[self.0[k as usize] as usize];
            k = self.0[k as usize];
        }
        k
    }

    fn found(&mut self) -> u32 {
        let k = self.0.len() as u32;
        self.0.push(k);
        k
    }

    /// The set of `child` goes to that of `root`.
    fn join(&mut self, child: u32, root: u32) {
        let (child, root) = (self.root(child), self.root(root));
        self.0[child as usize] = root;
    }
}

/// The hill of each node, numbered from the highest summit down, [`NO_ASPERITY`] where nothing was measured;
/// a hill rises by at least `least` (m) above the highest saddle to a higher one.
pub(super) fn labels(map: &HeightMap, least: f64) -> Vec<u32> {
    let z = map.heights();
    let mut order: Vec<u32> = (0..z.len() as u32).filter(|i| !z[*i as usize].is_nan()).collect();
    order.par_sort_unstable_by(|a, b| z[*b as usize].total_cmp(&z[*a as usize]).then(a.cmp(b)));
    let neighbours = Neighbours::new(map);
    let mut label = vec![NO_ASPERITY; z.len()];
    // summits are founded from the highest down: of two the lower number is the higher summit
    let (mut hills, mut parts, mut summit) = (Forest(Vec::new()), Forest(Vec::new()), Vec::new());
    for &node in &order {
        let height = z[node as usize];
        let higher: Vec<(u32, f64)> = neighbours
            .around_node(node as usize)
            .filter_map(|(n, distance)| {
                let n = n?;
                (label[n] != NO_ASPERITY).then(|| (label[n], (z[n] - height) / distance))
            })
            .collect();
        let Some(&(own, _)) = higher.iter().reduce(|best, one| if one.1 > best.1 { one } else { best })
        else {
            label[node as usize] = hills.found();
            parts.found();
            summit.push(height);
            continue;
        };
        label[node as usize] = own;
        for &(other, _) in &higher {
            let (a, b) = (parts.root(own), parts.root(other));
            if a == b {
                continue;
            }
            let (lower, upper) = (a.max(b), a.min(b));
            // a part that rises by so little is a single hill: those within it would have been pruned before
            if summit[lower as usize] - height < least {
                hills.join(lower, if lower == a { other } else { own });
            }
            parts.join(lower, upper);
        }
    }
    numbered(label, hills)
}

/// Labels of what each joined to, without gaps.
fn numbered(mut label: Vec<u32>, mut hills: Forest) -> Vec<u32> {
    let mut number = vec![NO_ASPERITY; hills.0.len()];
    let mut next = 0;
    for k in 0..hills.0.len() as u32 {
        let root = hills.root(k) as usize;
        if number[root] == NO_ASPERITY {
            number[root] = next;
            next += 1;
        }
        number[k as usize] = number[root];
    }
    label.par_iter_mut().filter(|l| **l != NO_ASPERITY).for_each(|l| *l = number[*l as usize]);
    label
}
