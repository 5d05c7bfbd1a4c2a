//! The narrowest place of the widest path through a gap.

use super::gap::{Axis, Gap};
use std::collections::BinaryHeap;

/// The critical constriction: all of a flow must pass a gap no higher than this one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constriction {
    /// Its gap, in metres.
    pub gap: f64,
    /// Its width, in metres: of the open stretches through its pixel along x, along y and both diagonals the
    /// shortest, which is the one from wall to wall.
    pub width: f64,
    /// Its pixel along x and y.
    pub at: [usize; 2],
}

/// The critical constriction along `axis`; None where no open path crosses the map.
///
/// The map is flooded from its entry through gaps no narrower than the narrowest that had to be passed yet;
/// where the flood ends, it goes on through the widest pixel at its shore. Each pixel is met once.
pub fn constriction(gap: &Gap, axis: Axis) -> Option<Constriction> {
    let map = Lines::new(gap, axis);
    let mut seen = vec![false; gap.values.len()];
    let mut inside: Vec<u32> = Vec::new();
    let mut shore: BinaryHeap<u64> = (0..map.wide).filter_map(|line| map.width(map.index(0, line))).collect();
    (0..map.wide).for_each(|line| seen[map.index(0, line)] = true);
    let mut narrowest = u64::MAX;
    loop {
        let i = match inside.pop() {
            Some(i) => i as usize,
            None => {
                narrowest = shore.pop()?;
                place(narrowest)
            }
        };
        let [along, line] = map.along_and_line(i);
        if along + 1 == map.long {
            let i = place(narrowest);
            let at = [i % gap.nodes[0], i / gap.nodes[0]];
            return Some(Constriction { gap: f64::from(gap.values[i]), width: width(gap, at), at });
        }
        // the last one is looked at first: ahead
        for j in map.neighbours(along, line).into_iter().flatten() {
            if std::mem::replace(&mut seen[j], true) {
                continue;
            }
            match map.width(j) {
                Some(width) if width > narrowest => inside.push(j as u32),
                Some(width) => shore.push(width),
                None => {}
            }
        }
    }
}

/// The shortest straight open stretch through the pixel `at`, in metres; it ends at walls, at points without
/// a height and at the edges of a map that does not repeat.
fn width(gap: &Gap, at: [usize; 2]) -> f64 {
    let nodes = gap.nodes.map(|n| n as i64);
    let open = |step: [i64; 2], k: i64| {
        let to = [0, 1].map(|axis| at[axis] as i64 + k * step[axis]);
        let inside = gap.periodic || (0..2).all(|axis| (0..nodes[axis]).contains(&to[axis]));
        let [x, y] = [0, 1].map(|axis| to[axis].rem_euclid(nodes[axis]) as usize);
        inside && gap.values[y * gap.nodes[0] + x] > 0.0
    };
    let stretch = |step: [i64; 2]| {
        // around a map that repeats at most once
        let most = nodes[0].max(nodes[1]);
        let ahead = (1..most).take_while(|k| open(step, *k)).count();
        let behind = (1..most - ahead as i64).take_while(|k| open(step, -k)).count();
        let length = (step[0] as f64 * gap.pixel[0]).hypot(step[1] as f64 * gap.pixel[1]);
        (1 + ahead + behind) as f64 * length
    };
    [[1, 0], [0, 1], [1, 1], [1, -1]].map(stretch).into_iter().fold(f64::INFINITY, f64::min)
}

/// The pixel of a [`Lines::width`].
fn place(width: u64) -> usize {
    (u32::MAX - width as u32) as usize
}

/// A map of gaps as lines along a flow.
struct Lines<'a> {
    values: &'a [f32],
    periodic: bool,
    /// Pixels along the flow, and lines beside each other.
    long: usize,
    wide: usize,
    /// Pixels of a row of the map, and whether the flow goes along it.
    row: usize,
    along_rows: bool,
}

impl<'a> Lines<'a> {
    fn new(gap: &Gap<'a>, axis: Axis) -> Lines<'a> {
        let ([nx, ny], along_rows) = (gap.nodes, axis == Axis::X);
        let (long, wide) = if along_rows { (nx, ny) } else { (ny, nx) };
        Lines { values: gap.values, periodic: gap.periodic, long, wide, row: nx, along_rows }
    }

    fn index(&self, along: usize, line: usize) -> usize {
        if self.along_rows { line * self.row + along } else { along * self.row + line }
    }

    fn along_and_line(&self, i: usize) -> [usize; 2] {
        let (x, y) = (i % self.row, i / self.row);
        if self.along_rows { [x, y] } else { [y, x] }
    }

    /// A number that is the greater the wider the gap, and of equal gaps the earlier the pixel: they never
    /// tie, so that the answer depends on nothing else. None of a pixel that is closed or was not measured.
    fn width(&self, i: usize) -> Option<u64> {
        // the bits of positive numbers rise with them
        (self.values[i] > 0.0)
            .then(|| u64::from(self.values[i].to_bits()) << 32 | u64::from(u32::MAX - i as u32))
    }

    /// The pixels around one: behind, beside, ahead.
    fn neighbours(&self, along: usize, line: usize) -> [Option<usize>; 4] {
        let ring = self.periodic && self.wide > 1;
        let before = if line > 0 { Some(line - 1) } else { ring.then(|| self.wide - 1) };
        let after = if line + 1 < self.wide { Some(line + 1) } else { ring.then_some(0) };
        [
            along.checked_sub(1).map(|along| self.index(along, line)),
            before.map(|line| self.index(along, line)),
            after.map(|line| self.index(along, line)),
            (along + 1 < self.long).then(|| self.index(along + 1, line)),
        ]
    }
}
