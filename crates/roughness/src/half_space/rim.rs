//! The rim of a contact as edges of pixels, and how far such a rim may lie from the true one.

use crate::HeightMap;
use crate::surface::height_map::chunks;
use std::collections::BTreeMap;

/// Directions of straight rims whose pixels repeat so soon that they err together. A rim along (p, q) lies on
/// lines of the grid 1/√(p² + q²) of a pixel apart; along others the errors of its pixels cancel.
const DIRECTIONS: [[i32; 2]; 20] = [
    [1, 0],
    [0, 1],
    [1, 1],
    [1, -1],
    [2, 1],
    [2, -1],
    [1, 2],
    [1, -2],
    [3, 1],
    [3, -1],
    [1, 3],
    [1, -3],
    [3, 2],
    [3, -2],
    [2, 3],
    [2, -3],
    [4, 1],
    [4, -1],
    [1, 4],
    [1, -4],
];

/// p + q of a direction: the edges of a period of a straight rim along it.
fn periods([p, q]: [i32; 2]) -> i32 {
    p.abs() + q.abs()
}

/// Error of a contact area because pixels of its rim err together.
pub(super) struct Doubt {
    /// Variance, in pixels squared.
    pub variance: f64,
    /// Edges of straight pieces that cross the whole map.
    pub crossing: usize,
}

/// The edges of a rim across one axis.
struct Edges<'a> {
    /// Of each pixel the step to the next.
    steps: &'a [i8],
    /// The pixels with one.
    edges: Vec<usize>,
    /// The place of a pixel among those.
    places: Vec<u32>,
}

/// The straight piece of a rim that an edge belongs to.
#[derive(Clone, Copy, Default)]
struct Piece {
    /// Periods over the edges of a period.
    length: f32,
    /// Its direction, where it crosses the whole map.
    along: Option<[i32; 2]>,
}

/// The edges between pixels with contact on one side, of a map of contacts.
pub(super) struct Rim {
    nodes: [usize; 2],
    periodic: bool,
    /// Of each pixel the step of the contact to the next along x, and to the next along y: 1, 0 or -1.
    steps: [Vec<i8>; 2],
}

impl Rim {
    /// That of the pixels under pressure. Beside a point without a height there is none: contact ends there
    /// because the map does.
    pub fn new(map: &HeightMap, pressures: &[f32]) -> Rim {
        let nodes @ [nx, ny] = [map.columns(), map.rows()];
        let loaded = |i: usize| i8::from(pressures[i] > 0.0);
        let step = |axis: usize, [x, y]: [usize; 2]| {
            let next = [x + 1 - axis, y + axis];
            let inside = next[axis] < nodes[axis];
            let [own, other] = [y * nx + x, next[1] % ny * nx + next[0] % nx];
            let known = || [own, other].iter().all(|i| !map.heights()[*i].is_nan());
            if (inside || map.periodic()) && known() { loaded(other) - loaded(own) } else { 0 }
        };
        let steps = [0, 1].map(|axis| {
            let rows = chunks(ny, |rows| {
                rows.flat_map(|y| (0..nx).map(move |x| step(axis, [x, y]))).collect::<Vec<_>>()
            });
            rows.concat()
        });
        Rim { nodes, periodic: map.periodic(), steps }
    }

    /// Number of edges.
    pub fn edges(&self) -> usize {
        self.steps.iter().flatten().filter(|step| **step != 0).count()
    }

    /// Sides of the pixels of contact over those whose other side has a height: what the number of edges is
    /// to be multiplied by, as a side towards a missing point is one of the rim as often as others are.
    pub fn hidden(map: &HeightMap, pressures: &[f32]) -> f64 {
        let [nx, ny] = [map.columns(), map.rows()];
        let (mut known, mut all) = (0_usize, 0_usize);
        for i in (0..pressures.len()).filter(|i| map.missing() > 0 && pressures[*i] > 0.0) {
            let (x, y) = (i % nx, i / nx);
            let beside = [(x + 1, y), (x + nx - 1, y), (x, y + 1), (x, y + ny - 1)];
            let inside = [x + 1 < nx, x > 0, y + 1 < ny, y > 0];
            for ((x, y), inside) in beside.into_iter().zip(inside) {
                if inside || map.periodic() {
                    all += 1;
                    known += usize::from(!map.heights()[y % ny * nx + x % nx].is_nan());
                }
            }
        }
        if known > 0 { all as f64 / known as f64 } else { 1.0 }
    }

    /// Error of the area inside the rim because its pixels err together.
    ///
    /// A straight piece along (p, q) of m periods may lie anywhere between two lines of the grid, which is
    /// one pixel of area a period: its variance is m²/12. It is p + q chains of m edges, each of which
    /// repeats at the distance (p, q); an edge that belongs to several chains counts in the one that says
    /// most. Pieces err each for itself, but those that cross the whole map beside a contact equally wide:
    /// regular grooves are copies of each other, and err alike.
    pub fn doubt(&self) -> Doubt {
        let mut doubt = Doubt { variance: 0.0, crossing: 0 };
        for axis in [0, 1] {
            let steps = &self.steps[axis];
            let edges: Vec<usize> = (0..steps.len()).filter(|i| steps[*i] != 0).collect();
            let mut places = vec![0u32; steps.len()];
            edges.iter().zip(0..).for_each(|(i, place)| places[*i] = place);
            let edges = Edges { steps, edges, places };
            let mut pieces = vec![Piece::default(); edges.edges.len()];
            for direction in DIRECTIONS {
                self.lengthen(&edges, direction, &mut pieces);
            }
            let mut copies: BTreeMap<([i32; 2], i8, usize), f64> = BTreeMap::new();
            for (i, Piece { length, along }) in edges.edges.iter().copied().zip(pieces) {
                match along {
                    None => doubt.variance += f64::from(length) / 12.0,
                    Some(along) => {
                        doubt.crossing += 1;
                        let key = (along, steps[i], self.width(axis, i));
                        *copies.entry(key).or_default() += 1.0 / f64::from(periods(along));
                    }
                }
            }
            doubt.variance += copies.values().map(|length| length * length / 12.0).sum::<f64>();
        }
        doubt
    }

    /// Raises the pieces of the edges to those of every chain along `direction` that say more.
    fn lengthen(&self, rim: &Edges, direction: [i32; 2], pieces: &mut [Piece]) {
        let Edges { steps, edges, places } = rim;
        let next = |i: usize, sign: i32| {
            let to = self.neighbour(i, direction.map(|d| sign * d))?;
            (steps[to] == steps[i]).then_some(to)
        };
        let leaves = |i: usize, sign: i32| self.neighbour(i, direction.map(|d| sign * d)).is_none();
        let mut seen = vec![false; edges.len()];
        let place = |i: usize| places[i] as usize;
        let mut chain = Vec::new();
        // chains with a beginning, then those that are rings
        for ring in [false, true] {
            for first in edges.iter().copied() {
                if seen[place(first)] || (!ring && next(first, -1).is_some()) {
                    continue;
                }
                chain.clear();
                let mut at = Some(first);
                while let Some(i) = at.filter(|i| !std::mem::replace(&mut seen[place(*i)], true)) {
                    chain.push(i);
                    at = next(i, 1);
                }
                let last = chain[chain.len() - 1];
                let crosses = ring || (leaves(first, -1) && leaves(last, 1));
                let length = chain.len() as f32 / periods(direction) as f32;
                let piece = Piece { length, along: crosses.then_some(direction) };
                for i in chain.iter().map(|i| place(*i)) {
                    if length > pieces[i].length {
                        pieces[i] = piece;
                    }
                }
            }
        }
    }

    /// Pixels of contact along `axis` from edge `i` to the next.
    fn width(&self, axis: usize, i: usize) -> usize {
        let steps = &self.steps[axis];
        let sign = i32::from(steps[i]);
        let by = if axis == 0 { [sign, 0] } else { [0, sign] };
        let mut at = i;
        (1..=self.nodes[axis])
            .find(|_| match self.neighbour(at, by) {
                Some(next) => {
                    at = next;
                    steps[next] != 0
                }
                None => true,
            })
            .unwrap_or(self.nodes[axis])
    }

    /// The pixel `by` pixels from pixel `i`, where there is one.
    fn neighbour(&self, i: usize, by: [i32; 2]) -> Option<usize> {
        let at = [i % self.nodes[0], i / self.nodes[0]];
        let [x, y] = [0, 1].map(|axis| {
            let (to, n) = (at[axis] as i64 + i64::from(by[axis]), self.nodes[axis] as i64);
            if self.periodic { Some(to.rem_euclid(n)) } else { (0..n).contains(&to).then_some(to) }
        });
        Some(y? as usize * self.nodes[0] + x? as usize)
    }
}
