//! Runs of neighbouring nodes above the plane, row by row.

use crate::surface::height_map::{HeightMap, chunks};
use std::ops::Range;

/// Nodes `start..end` of one row, all above the plane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub row: u32,
    pub start: u32,
    pub end: u32,
    pub high: f64,
}

/// Looks up the run that holds a node, for nodes asked from left to right.
pub(super) struct Cursor<'a> {
    pub runs: &'a [Run],
    number: usize,
    at: usize,
}

impl<'a> Cursor<'a> {
    /// At the left end of `row`.
    pub fn new(runs: &'a Runs, row: usize) -> Cursor<'a> {
        Cursor { runs: runs.row(row), number: runs.first[row], at: 0 }
    }

    /// The first cell, from `column` on, with a corner in a run of this row.
    pub fn reach(&self, column: usize) -> Option<usize> {
        self.runs[self.at..]
            .iter()
            .find(|run| run.end as usize > column)
            .map(|run| (run.start as usize).saturating_sub(1).max(column))
    }

    /// The run that holds node `column`.
    pub fn run_at(&mut self, column: usize) -> Option<u32> {
        while self.runs.get(self.at).is_some_and(|run| run.end as usize <= column) {
            self.at += 1;
        }
        let run = self.runs.get(self.at)?;
        (run.start as usize <= column).then_some((self.number + self.at) as u32)
    }

    /// The run that holds node 0.
    pub fn first(&self) -> Option<u32> {
        self.runs.first().filter(|run| run.start == 0).map(|_| self.number as u32)
    }
}

/// All runs above a plane, row by row.
#[derive(Clone, Debug)]
pub(crate) struct Runs {
    pub(super) list: Vec<Run>,
    /// Number of the first run of each row, with one more at the end.
    pub(super) first: Vec<usize>,
}

impl Runs {
    /// The runs of `map` above `plane`.
    pub fn above_plane(map: &HeightMap, plane: f64) -> Runs {
        let whole = 0..map.columns();
        Runs::gathered(map, |row, runs| runs_of_span(map, row, whole.clone(), plane, runs))
    }

    /// The runs above `plane`, which is not below the plane of these runs: only they are searched.
    pub fn narrowed(&self, map: &HeightMap, plane: f64) -> Runs {
        Runs::gathered(map, |row, runs| {
            for run in self.row(row).iter().filter(|run| run.high > plane) {
                runs_of_span(map, row, run.start as usize..run.end as usize, plane, runs);
            }
        })
    }

    /// The runs of `row`.
    pub(super) fn row(&self, row: usize) -> &[Run] {
        &self.list[self.first[row]..self.first[row + 1]]
    }

    /// Rows in parallel, joined in their order; `find` appends the runs of one row.
    fn gathered(map: &HeightMap, find: impl Fn(usize, &mut Vec<Run>) + Sync) -> Runs {
        let parts = chunks(map.rows(), |rows| {
            let mut runs = Vec::new();
            let ends = rows.map(|row| {
                find(row, &mut runs);
                runs.len()
            });
            let ends: Vec<usize> = ends.collect();
            (runs, ends)
        });
        let mut list = Vec::with_capacity(parts.iter().map(|(part, _)| part.len()).sum());
        let mut first = Vec::with_capacity(map.rows() + 1);
        first.push(0);
        for (part, ends) in &parts {
            first.extend(ends.iter().map(|end| list.len() + end));
            list.extend_from_slice(part);
        }
        Runs { list, first }
    }
}

/// Appends the runs among the nodes `span` of one row.
fn runs_of_span(map: &HeightMap, row: usize, span: Range<usize>, plane: f64, runs: &mut Vec<Run>) {
    let heights = &map.row(row)[..span.end];
    let mut column = span.start;
    while let Some(step) = heights[column..].iter().position(|z| *z > plane) {
        let start = column + step;
        let mut end = start + 1;
        let mut high = heights[start];
        // with holes in the map, two nodes are neighbours only if a used cell holds both
        while end < heights.len()
            && heights[end] > plane
            && (map.missing() == 0 || edge_is_used(map, row, end))
        {
            high = high.max(heights[end]);
            end += 1;
        }
        runs.push(Run { row: row as u32, start: start as u32, end: end as u32, high });
        column = end;
    }
}

/// True where a cell with four measured corners holds the edge from node `column - 1` to node `column` of
/// `row`.
fn edge_is_used(map: &HeightMap, row: usize, column: usize) -> bool {
    let measured = |row: usize| {
        let heights = map.row(row);
        !heights[column - 1].is_nan() && !heights[column].is_nan()
    };
    let before = if row > 0 { Some(row - 1) } else { map.periodic().then(|| map.rows() - 1) };
    let after = if row + 1 < map.rows() { Some(row + 1) } else { map.periodic().then_some(0) };
    measured(row) && (before.is_some_and(measured) || after.is_some_and(measured))
}
