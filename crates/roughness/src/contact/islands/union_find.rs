//! Runs that meet are one island.

/// Two runs that meet, and how many periods the second lies from where its columns and rows say.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Meeting {
    pub a: u32,
    pub b: u32,
    pub shift: [i32; 2],
}

/// Runs joined into islands: a forest whose links know how many periods lie between its ends.
pub(super) struct UnionFind {
    parent: Vec<u32>,
    shift: Vec<[i32; 2]>,
    /// Roots of islands that meet themselves across the edges: they have no extent.
    pub endless: Vec<bool>,
}

impl UnionFind {
    /// The forest of `runs` runs that meet at `meetings`.
    pub fn new(runs: usize, meetings: &[Meeting]) -> UnionFind {
        let mut forest = UnionFind {
            parent: (0..runs as u32).collect(),
            shift: vec![[0, 0]; runs],
            endless: vec![false; runs],
        };
        meetings.iter().for_each(|meeting| forest.join(meeting));
        forest
    }

    /// The root of a run, and the periods from the root to the run.
    pub fn root(&self, run: usize) -> (usize, [i32; 2]) {
        let (mut at, mut shift) = (run, [0, 0]);
        while self.parent[at] as usize != at {
            shift = [shift[0] + self.shift[at][0], shift[1] + self.shift[at][1]];
            at = self.parent[at] as usize;
        }
        (at, shift)
    }

    /// The same, linking every run on the way to the root.
    fn root_and_shorten(&mut self, run: usize) -> (usize, [i32; 2]) {
        let (root, total) = self.root(run);
        let (mut at, mut left) = (run, total);
        while at != root {
            let (parent, step) = (self.parent[at] as usize, self.shift[at]);
            self.parent[at] = root as u32;
            self.shift[at] = left;
            left = [left[0] - step[0], left[1] - step[1]];
            at = parent;
        }
        (root, total)
    }

    fn join(&mut self, meeting: &Meeting) {
        let (a, from_a) = self.root_and_shorten(meeting.a as usize);
        let (b, from_b) = self.root_and_shorten(meeting.b as usize);
        // periods from root a to root b
        let gap = [from_a[0] + meeting.shift[0] - from_b[0], from_a[1] + meeting.shift[1] - from_b[1]];
        if a == b {
            self.endless[a] |= gap != [0, 0];
        } else if a < b {
            self.parent[b] = a as u32;
            self.shift[b] = gap;
            self.endless[a] |= self.endless[b];
        } else {
            self.parent[a] = b as u32;
            self.shift[a] = [-gap[0], -gap[1]];
            self.endless[b] |= self.endless[a];
        }
    }
}
