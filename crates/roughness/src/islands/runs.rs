//! Runs of neighbouring nodes above the plane, row by row.

use crate::height_map::{HeightMap, ROWS_PER_CHUNK};
use rayon::prelude::*;

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
    /// The runs of `row`, where `first_run` numbers the first run of each row.
    pub fn new(runs: &'a [Run], first_run: &[usize], row: usize) -> Cursor<'a> {
        let (first, end) = (first_run[row], first_run[row + 1]);
        Cursor { runs: &runs[first..end], number: first, at: 0 }
    }

    /// The first cell, from `column` on, with a corner in a run of this row.
    pub fn reach(&self, column: usize) -> Option<usize> {
        self.runs[self.at..]
            .iter()
            .find(|run| run.end as usize > column)
            .map(|run| (run.start as usize).saturating_sub(1).max(column))
    }

    /// The run that holds node `column`.
    pub fn at(&mut self, column: usize) -> Option<u32> {
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

/// All runs above the plane, and the number of the first run of each row (with one more at the end).
pub(super) fn find_runs(map: &HeightMap, plane: f64) -> (Vec<Run>, Vec<usize>) {
    let parts: Vec<(Vec<Run>, Vec<usize>)> = (0..map.rows().div_ceil(ROWS_PER_CHUNK))
        .into_par_iter()
        .map(|chunk| {
            let first = chunk * ROWS_PER_CHUNK;
            let mut runs = Vec::new();
            let mut counts = Vec::with_capacity(ROWS_PER_CHUNK);
            for row in first..(first + ROWS_PER_CHUNK).min(map.rows()) {
                let before = runs.len();
                runs_of_row(map, row, plane, &mut runs);
                counts.push(runs.len() - before);
            }
            (runs, counts)
        })
        .collect();
    let mut first_run = Vec::with_capacity(map.rows() + 1);
    let mut total = 0;
    for count in parts.iter().flat_map(|(_, counts)| counts) {
        first_run.push(total);
        total += count;
    }
    first_run.push(total);
    let mut runs = Vec::with_capacity(total);
    parts.iter().for_each(|(part, _)| runs.extend_from_slice(part));
    (runs, first_run)
}

fn runs_of_row(map: &HeightMap, row: usize, plane: f64, runs: &mut Vec<Run>) {
    let heights = map.row(row);
    let mut column = 0;
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

/// Whether a cell with four measured corners holds the edge from node `column - 1` to node `column` of `row`.
fn edge_is_used(map: &HeightMap, row: usize, column: usize) -> bool {
    let measured = |row: usize| {
        let heights = map.row(row);
        !heights[column - 1].is_nan() && !heights[column].is_nan()
    };
    let before = if row > 0 { Some(row - 1) } else { map.periodic().then(|| map.rows() - 1) };
    let after = if row + 1 < map.rows() { Some(row + 1) } else { map.periodic().then_some(0) };
    measured(row) && (before.is_some_and(measured) || after.is_some_and(measured))
}
