//! Islands: the connected parts of the surface above a plane.
//!
//! 1. Every row of nodes is cut into runs of neighbouring nodes above the plane.
//! 2. Every cell with a corner above joins the runs of its corners and gives its area above to one of them. (In a
//!    cell whose middle is not above, two diagonal corners stay apart and each takes the triangles beside it.)
//! 3. Joined runs are one island. A periodic map also joins across its edges, and then each run remembers how many
//!    periods it lies from its island's first run.

mod joined;
mod runs;

use crate::cell::{self, Moments};
use crate::ellipse::Ellipse;
use crate::height_map::HeightMap;
use joined::{Joined, Meeting};
use rayon::prelude::*;
use runs::{Cursor, Run, find_runs};

/// A connected part of the surface above the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Island {
    /// Exact projected area A_j, in m².
    pub area: f64,
    /// tan β_j = mean of |∇h| over the island.
    pub slope: f64,
    /// d_j: highest node above the plane, in metres.
    pub approach: f64,
    /// Ellipse of equal area and equal second moments, where there is one.
    pub ellipse: Option<Ellipse>,
}

/// A run's island, and how many periods the run lies from the first run of it.
#[derive(Clone, Copy)]
struct Home {
    island: u32,
    shift: [i32; 2],
}

/// Part of a cell that belongs to one island.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Piece {
    /// Row and column of the cell.
    pub cell: [u32; 2],
    /// The island it belongs to.
    pub island: u32,
    /// Area above the plane, in cells.
    pub area: f64,
    /// Where corner 0 of the cell lies, in pixels; beyond the edge where a periodic island goes on there.
    pub offset: [f64; 2],
}

/// All islands above a plane.
pub struct Islands {
    /// The plane's height in metres.
    pub plane: f64,
    /// The islands, in the order of their first node.
    pub islands: Vec<Island>,
    runs: Vec<Run>,
    first_run: Vec<usize>,
    homes: Vec<Home>,
}

/// An island in the making: moments about the first node of run `root`.
struct Sum {
    moments: Moments,
    high: f64,
    endless: bool,
    root: usize,
}

/// What a cell adds to a run.
struct Visit {
    run: u32,
    /// Where corner 0 lies from the first node of the run.
    offset: [i32; 2],
    cell: [u32; 2],
    corners: [f64; 4],
    sides: u8,
}

impl Islands {
    /// The islands of `map` above `plane` (m); `ellipses` asks for the second moments too.
    pub fn above(map: &HeightMap, plane: f64, ellipses: bool) -> Islands {
        let (runs, first_run) = find_runs(map, plane);
        let mut islands = Islands { plane, islands: Vec::new(), runs, first_run, homes: Vec::new() };
        let (moments, meetings) = islands.sums(map, ellipses);
        let joined = Joined::new(islands.runs.len(), &meetings);
        islands.collect(map, &moments, joined, ellipses);
        islands
    }

    /// Sums per run, and which runs meet; in the order of the rows.
    fn sums(&self, map: &HeightMap, ellipses: bool) -> (Vec<Moments>, Vec<Meeting>) {
        let inverse_pixel = map.pixel().map(|p| 1.0 / p);
        let parts: Vec<_> = map
            .chunks()
            .into_par_iter()
            .map(|(first, end)| {
                // runs of the rows first..=end; the last row of a periodic map meets row 0, kept apart at the end
                let base = self.first_run[first];
                let last = self.first_run[(end + 1).min(map.rows())];
                let wrapped = if end == map.rows() { self.first_run[1] } else { 0 };
                let mut sums = vec![Moments::default(); last - base + wrapped];
                let mut meetings: Vec<Meeting> = Vec::new();
                for row in first..end {
                    let slot = |run: u32| {
                        let run = run as usize;
                        if run >= base && run < last { run - base } else { last - base + run }
                    };
                    self.visit_row(
                        map,
                        row,
                        |meeting| {
                            if meetings.last() != Some(&meeting) {
                                meetings.push(meeting);
                            }
                        },
                        |visit| {
                            let sum = &mut sums[slot(visit.run)];
                            if ellipses {
                                let m = cell::moments_above(&visit.corners, visit.sides, inverse_pixel);
                                sum.add(&m.moved(f64::from(visit.offset[0]), f64::from(visit.offset[1])));
                            } else {
                                let (area, slope_area) =
                                    part_above(&visit.corners, visit.sides, inverse_pixel);
                                sum.area += area;
                                sum.slope_area += slope_area;
                            }
                        },
                    );
                }
                (base, last, sums, meetings)
            })
            .collect();
        let mut total = vec![Moments::default(); self.runs.len()];
        let mut all = Vec::new();
        for (base, last, sums, meetings) in parts {
            let (inside, wrapped) = sums.split_at(last - base);
            total[base..last].iter_mut().zip(inside).for_each(|(t, s)| t.add(s));
            total.iter_mut().zip(wrapped).for_each(|(t, s)| t.add(s));
            all.extend(meetings);
        }
        (total, all)
    }

    /// Walks the cells of cell row `row` that have a corner above the plane.
    fn visit_row(
        &self,
        map: &HeightMap,
        row: usize,
        mut meet: impl FnMut(Meeting),
        mut add: impl FnMut(Visit),
    ) {
        let wrap_row = row + 1 == map.rows();
        let next_row = if wrap_row { 0 } else { row + 1 };
        let (low, high) = (map.row(row), map.row(next_row));
        let mut below = Cursor::new(&self.runs, &self.first_run, row);
        let mut over = Cursor::new(&self.runs, &self.first_run, next_row);
        let cells = map.cell_columns();
        let columns = map.columns();
        let mut column = 0;
        // a run that starts in column 0 of a periodic map is also met by the last cell of the row
        let wraps = |cursor: &Cursor| map.periodic() && cursor.runs.first().is_some_and(|r| r.start == 0);
        let mut last_cell = wraps(&below) || wraps(&over);
        loop {
            // the next cell that a run of either row reaches
            let reach = match (below.reach(column), over.reach(column)) {
                (Some(a), Some(b)) => Some(a.min(b)),
                (a, b) => a.or(b),
            };
            column = match reach {
                Some(c) if c < cells => c,
                _ if last_cell && column < cells => cells - 1,
                _ => break,
            };
            if column + 1 == cells {
                last_cell = false;
            }
            let wrap_column = column + 1 == columns;
            let next = if wrap_column { 0 } else { column + 1 };
            let corners = [low[column], low[next], high[next], high[column]].map(|z| z - self.plane);
            let at_next = |cursor: &mut Cursor| if wrap_column { cursor.first() } else { cursor.at(next) };
            let (r0, r3) = (below.at(column), over.at(column));
            let runs = [r0, at_next(&mut below), at_next(&mut over), r3];
            column += 1;
            if corners.iter().any(|z| z.is_nan()) {
                continue;
            }
            let periods = |corner: usize| {
                [i32::from(wrap_column && (corner == 1 || corner == 2)), i32::from(wrap_row && corner >= 2)]
            };
            let run_of = |corner: usize| runs[corner];
            let mut visit = |corner: usize, sides: u8| {
                if let Some(run) = run_of(corner) {
                    let node = [if corner == 1 || corner == 2 { next } else { column - 1 }, 0];
                    let (cx, cy) = (i32::from(corner == 1 || corner == 2), i32::from(corner >= 2));
                    let start = self.runs[run as usize].start as i32;
                    add(Visit {
                        run,
                        offset: [node[0] as i32 - cx - start, -cy],
                        cell: [row as u32, (column - 1) as u32],
                        corners,
                        sides,
                    });
                }
            };
            let up = corners.map(|z| z > 0.0);
            let saddle = up[0] == up[2] && up[1] == up[3] && up[0] != up[1] && cell::centre(&corners) <= 0.0;
            if saddle {
                let (one, other) = if up[0] { (0, 2) } else { (1, 3) };
                for corner in [one, other] {
                    visit(corner, (1 << corner) | (1 << ((corner + 3) % 4)));
                }
                continue;
            }
            let Some(first) = (0..4).find(|c| up[*c]) else { continue };
            visit(first, 15);
            for corner in first + 1..4 {
                if let (true, Some(a), Some(b)) = (up[corner], run_of(first), run_of(corner)) {
                    let (p, q) = (periods(first), periods(corner));
                    let shift = [q[0] - p[0], q[1] - p[1]];
                    if a != b || shift != [0, 0] {
                        meet(Meeting { a, b, shift });
                    }
                }
            }
        }
    }

    /// Turns joined runs into islands; runs that no cell holds are dropped.
    fn collect(&mut self, map: &HeightMap, moments: &[Moments], joined: Joined, ellipses: bool) {
        let mut number = vec![u32::MAX; self.runs.len()];
        let mut sums: Vec<Sum> = Vec::new();
        self.homes = Vec::with_capacity(self.runs.len());
        let size = [map.columns() as i64, map.rows() as i64];
        for (run, sum) in moments.iter().enumerate() {
            let (root, shift) = joined.root(run);
            if number[root] == u32::MAX {
                number[root] = sums.len() as u32;
                sums.push(Sum {
                    moments: Moments::default(),
                    high: f64::NEG_INFINITY,
                    endless: joined.endless[root],
                    root,
                });
            }
            let home = Home { island: number[root], shift };
            let target = &mut sums[home.island as usize];
            if ellipses {
                let d = self.offset_from(run, root, shift, size);
                target.moments.add(&sum.moved(d[0], d[1]));
            } else {
                target.moments.area += sum.area;
                target.moments.slope_area += sum.slope_area;
            }
            target.high = target.high.max(self.runs[run].high);
            self.homes.push(home);
        }
        self.number(map, sums, ellipses);
    }

    /// Where the first node of `run` lies from the first node of run `root`, in pixels.
    fn offset_from(&self, run: usize, root: usize, shift: [i32; 2], size: [i64; 2]) -> [f64; 2] {
        let (a, b) = (self.runs[run], self.runs[root]);
        [
            (i64::from(a.start) - i64::from(b.start) + i64::from(shift[0]) * size[0]) as f64,
            (i64::from(a.row) - i64::from(b.row) + i64::from(shift[1]) * size[1]) as f64,
        ]
    }

    fn number(&mut self, map: &HeightMap, sums: Vec<Sum>, ellipses: bool) {
        let mut kept = vec![u32::MAX; sums.len()];
        for (old, Sum { moments, high, endless, root }) in sums.into_iter().enumerate() {
            if moments.area > 0.0 {
                kept[old] = self.islands.len() as u32;
                let origin = [self.runs[root].start, self.runs[root].row].map(f64::from);
                self.islands.push(Island {
                    area: moments.area * map.cell_area(),
                    slope: moments.slope_area / moments.area,
                    approach: high - self.plane,
                    ellipse: if ellipses && !endless {
                        Ellipse::of(&moments, origin, map.pixel())
                    } else {
                        None
                    },
                });
            }
        }
        self.homes.iter_mut().for_each(|home| home.island = kept[home.island as usize]);
    }

    /// The pieces of the islands of cell row `row`, from left to right; pieces of one cell follow each other.
    pub(crate) fn pieces(&self, map: &HeightMap, row: usize, mut each: impl FnMut(Piece)) {
        let inverse_pixel = map.pixel().map(|p| 1.0 / p);
        let size = [map.columns() as i64, map.rows() as i64];
        self.visit_row(
            map,
            row,
            |_| {},
            |visit| {
                let home = self.homes[visit.run as usize];
                if home.island == u32::MAX {
                    return;
                }
                let run = self.runs[visit.run as usize];
                let position = [
                    i64::from(run.start) + i64::from(visit.offset[0]) + i64::from(home.shift[0]) * size[0],
                    i64::from(run.row) + i64::from(visit.offset[1]) + i64::from(home.shift[1]) * size[1],
                ];
                let (area, _) = part_above(&visit.corners, visit.sides, inverse_pixel);
                each(Piece {
                    cell: visit.cell,
                    island: home.island,
                    area,
                    offset: position.map(|p| p as f64),
                });
            },
        );
    }
}

/// Area and slope integral above 0 of the triangles named by `sides`.
fn part_above(corners: &[f64; 4], sides: u8, inverse_pixel: [f64; 2]) -> (f64, f64) {
    if sides == 15 {
        cell::above(corners, inverse_pixel)
    } else {
        let m = cell::moments_above(corners, sides, inverse_pixel);
        (m.area, m.slope_area)
    }
}
