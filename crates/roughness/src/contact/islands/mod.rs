//! Islands: the connected parts of the surface above a plane.
//!
//! 1. Every row of nodes is cut into runs of neighbouring nodes above the plane.
//! 2. Every cell with a corner above joins the runs of its corners and gives its area above to one of them.
//!    (In a cell whose middle is not above, two diagonal corners stay apart and each takes the triangles
//!    beside it.)
//! 3. Runs that meet are one island. A periodic map also joins across its edges, and then each run remembers
//!    how many periods it lies from its island's first run.

mod runs;
mod union_find;

use super::bearing_area::Above;
use super::ellipse::Ellipse;
use crate::surface::cells::{self, Moments};
use crate::surface::height_map::HeightMap;
use runs::Cursor;
pub(crate) use runs::Runs;
use std::ops::Range;
use union_find::{Meeting, UnionFind};

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
#[derive(Clone, Copy, Debug)]
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
    /// Position of corner 0 of the cell, in pixels; beyond the edge where a periodic island goes on there.
    pub offset: [f64; 2],
}

/// All islands above a plane.
#[derive(Clone, Debug)]
pub struct Islands {
    /// The plane's height in metres.
    pub plane: f64,
    /// The islands, in the order of their first node.
    pub islands: Vec<Island>,
    runs: Runs,
    homes: Vec<Home>,
}

/// Cells of one row that belong to a run.
struct Visit<'a> {
    run: u32,
    /// The first of the cells.
    cell: [u32; 2],
    part: Part<'a>,
}

/// The part of the cells that lies above the plane.
enum Part<'a> {
    /// All of neighbouring cells, the run along their lower side: heights of the nodes below and above them,
    /// one more than there are cells.
    Whole([&'a [f64]; 2]),
    /// Something of some triangles of one cell.
    Cut {
        /// Position of corner 0 from the first node of the run.
        offset: [i32; 2],
        corners: [f64; 4],
        sides: u8,
    },
}

/// A cell with something above the plane; its corners are numbered from the lower left one around.
struct CutCell {
    /// Row and column.
    place: [usize; 2],
    /// The column of the right corners.
    next: usize,
    /// True where the right, the upper corners lie beyond the edge of a periodic map.
    wraps: [bool; 2],
    /// Heights of the corners above the plane.
    corners: [f64; 4],
    /// The runs that hold the corners.
    runs: [Option<u32>; 4],
}

impl CutCell {
    fn is_right(corner: usize) -> bool {
        corner == 1 || corner == 2
    }

    /// Periods along x and y between the cell and the node at its corner.
    fn periods(&self, corner: usize) -> [i32; 2] {
        [self.wraps[0] && CutCell::is_right(corner), self.wraps[1] && corner >= 2].map(i32::from)
    }
}

/// Quantity that is summed over the cells of a run.
trait Tally: Clone + Default + Send {
    /// Adds what cells of one row bring; `start` is the column of the first node of the run.
    fn visit(&mut self, visit: &Visit, start: u32, inverse_pixel: [f64; 2]);

    /// Adds another part of the same run.
    fn join(&mut self, other: &Self);
}

impl Tally for Above {
    fn visit(&mut self, visit: &Visit, _: u32, inverse_pixel: [f64; 2]) {
        match &visit.part {
            Part::Whole([low, high]) => {
                self.area += (low.len() - 1) as f64;
                self.slope_area += cells::whole_slopes(low, high, inverse_pixel);
            }
            Part::Cut { corners, sides, .. } => {
                let (area, slope_area) = part_above(corners, *sides, inverse_pixel);
                self.area += area;
                self.slope_area += slope_area;
            }
        }
    }

    fn join(&mut self, other: &Above) {
        self.add(*other);
    }
}

/// The moments of a run are about its first node.
impl Tally for Moments {
    fn visit(&mut self, visit: &Visit, start: u32, inverse_pixel: [f64; 2]) {
        match &visit.part {
            Part::Whole([low, high]) => {
                for (i, (a, b)) in low.windows(2).zip(high.windows(2)).enumerate() {
                    let slope = cells::mean_gradient(&[a[0], a[1], b[1], b[0]], inverse_pixel);
                    let x = f64::from(visit.cell[1] - start) + i as f64;
                    self.add(&Moments::of_cell(slope).moved(x, 0.0));
                }
            }
            Part::Cut { corners, sides, offset } => {
                let m = cells::moments_above(corners, *sides, inverse_pixel);
                self.add(&m.moved(f64::from(offset[0]), f64::from(offset[1])));
            }
        }
    }

    fn join(&mut self, other: &Moments) {
        self.add(other);
    }
}

impl Islands {
    /// The islands of `map` above `plane` (m).
    pub fn above_plane(map: &HeightMap, plane: f64) -> Islands {
        let runs = Runs::above_plane(map, plane);
        let mut islands = Islands { plane, islands: Vec::new(), runs, homes: Vec::new() };
        let (moments, meetings) = islands.sums::<Moments>(map);
        let forest = UnionFind::new(islands.runs.list.len(), &meetings);
        islands.collect(map, &moments, &forest);
        islands
    }

    /// Area and slope integral alone of every island above `plane`, in cells, from the runs above it.
    pub(crate) fn sizes(map: &HeightMap, plane: f64, runs: Runs) -> Vec<Above> {
        let islands = Islands { plane, islands: Vec::new(), runs, homes: Vec::new() };
        let (mut sums, meetings) = islands.sums::<Above>(map);
        let forest = UnionFind::new(sums.len(), &meetings);
        // a root is the first run of its island
        for run in 0..sums.len() {
            let (root, _) = forest.root(run);
            if root != run {
                let sum = sums[run];
                sums[root].join(&sum);
                sums[run] = Above::default();
            }
        }
        sums.retain(|sum| sum.area > 0.0);
        sums
    }

    /// Sums per run, and which runs meet; in the order of the rows.
    fn sums<T: Tally>(&self, map: &HeightMap) -> (Vec<T>, Vec<Meeting>) {
        let inverse_pixel = map.inverse_pixel();
        let parts = map.chunks(|Range { start: first, end }| {
            // runs of the rows first..=end; the last row of a periodic map meets row 0, kept apart at the end
            let base = self.runs.first[first];
            let last = self.runs.first[(end + 1).min(map.rows())];
            let wrapped = if end == map.rows() { self.runs.first[1] } else { 0 };
            let mut sums = vec![T::default(); last - base + wrapped];
            let mut meetings: Vec<Meeting> = Vec::new();
            for row in first..end {
                let slot = |run: usize| {
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
                        let run = visit.run as usize;
                        sums[slot(run)].visit(&visit, self.runs.list[run].start, inverse_pixel);
                    },
                );
            }
            (base, last, sums, meetings)
        });
        let mut total = vec![T::default(); self.runs.list.len()];
        let mut all = Vec::new();
        for (base, last, sums, meetings) in parts {
            let (inside, wrapped) = sums.split_at(last - base);
            total[base..last].iter_mut().zip(inside).for_each(|(t, s)| t.join(s));
            total.iter_mut().zip(wrapped).for_each(|(t, s)| t.join(s));
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
        mut add: impl FnMut(Visit<'_>),
    ) {
        let wrap_row = row + 1 == map.rows();
        let next_row = if wrap_row { 0 } else { row + 1 };
        let (low, high) = (map.row(row), map.row(next_row));
        let mut below = Cursor::new(&self.runs, row);
        let mut over = Cursor::new(&self.runs, next_row);
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
            if let (Some(r0), Some(r3)) = (below.run_at(column), over.run_at(column)) {
                let end = self.runs.list[r0 as usize].end.min(self.runs.list[r3 as usize].end) as usize;
                if column + 1 < end {
                    // nodes column..end of both rows are above, and so are the cells between them
                    let shift = [0, i32::from(wrap_row)];
                    meet(Meeting { a: r0, b: r3, shift });
                    let part = Part::Whole([&low[column..end], &high[column..end]]);
                    add(Visit { run: r0, cell: [row as u32, column as u32], part });
                    column = end - 1;
                    continue;
                }
            }
            if column + 1 == cells {
                last_cell = false;
            }
            let wrap_column = column + 1 == columns;
            let next = if wrap_column { 0 } else { column + 1 };
            let corners = [low[column], low[next], high[next], high[column]].map(|z| z - self.plane);
            let at_next =
                |cursor: &mut Cursor| if wrap_column { cursor.first() } else { cursor.run_at(next) };
            let (r0, r3) = (below.run_at(column), over.run_at(column));
            let runs = [r0, at_next(&mut below), at_next(&mut over), r3];
            if !corners.iter().any(|z| z.is_nan()) {
                let cell =
                    CutCell { place: [row, column], next, wraps: [wrap_column, wrap_row], corners, runs };
                self.visit_cell(&cell, &mut meet, &mut add);
            }
            column += 1;
        }
    }

    /// Gives the triangles of a cell above the plane to the runs of its corners, and joins those that meet in
    /// it.
    #[inline]
    fn visit_cell(&self, cell: &CutCell, meet: &mut impl FnMut(Meeting), add: &mut impl FnMut(Visit<'_>)) {
        let CutCell { place: [row, column], next, corners, runs, .. } = *cell;
        let mut visit = |corner: usize, sides: u8| {
            let Some(run) = runs[corner] else { return };
            let left = if CutCell::is_right(corner) { next as i32 - 1 } else { column as i32 };
            let offset = [left - self.runs.list[run as usize].start as i32, -i32::from(corner >= 2)];
            let part = Part::Cut { offset, corners, sides };
            add(Visit { run, cell: [row as u32, column as u32], part });
        };
        let up = corners.map(|z| z > 0.0);
        let saddle = up[0] == up[2] && up[1] == up[3] && up[0] != up[1] && cells::centre(&corners) <= 0.0;
        if saddle {
            let (one, other) = if up[0] { (0, 2) } else { (1, 3) };
            for corner in [one, other] {
                visit(corner, (1 << corner) | (1 << ((corner + 3) % 4)));
            }
            return;
        }
        let Some(first) = (0..4).find(|c| up[*c]) else { return };
        visit(first, 15);
        for corner in first + 1..4 {
            if let (true, Some(a), Some(b)) = (up[corner], runs[first], runs[corner]) {
                let (p, q) = (cell.periods(first), cell.periods(corner));
                let shift = [q[0] - p[0], q[1] - p[1]];
                if a != b || shift != [0, 0] {
                    meet(Meeting { a, b, shift });
                }
            }
        }
    }

    /// Turns joined runs into islands; runs that no cell holds are dropped.
    fn collect(&mut self, map: &HeightMap, moments: &[Moments], forest: &UnionFind) {
        let runs = &self.runs.list;
        let size = [map.columns() as i64, map.rows() as i64];
        let place = |run: usize| [runs[run].start, runs[run].row].map(i64::from);
        // root, moments about the first node of the root, and highest node of each island
        let mut sums: Vec<(usize, Moments, f64)> = Vec::new();
        let mut number: Vec<Option<usize>> = vec![None; runs.len()];
        self.homes = Vec::with_capacity(runs.len());
        for (run, sum) in moments.iter().enumerate() {
            let (root, shift) = forest.root(run);
            let island = *number[root].get_or_insert_with(|| {
                sums.push((root, Moments::default(), f64::NEG_INFINITY));
                sums.len() - 1
            });
            let [at, from] = [run, root].map(place);
            let [dx, dy] = [0, 1].map(|k| (at[k] - from[k] + i64::from(shift[k]) * size[k]) as f64);
            let (_, total, high) = &mut sums[island];
            total.add(&sum.moved(dx, dy));
            *high = high.max(runs[run].high);
            self.homes.push(Home { island: island as u32, shift });
        }
        let mut kept = vec![u32::MAX; sums.len()];
        for (old, (root, moments, high)) in sums.iter().enumerate().filter(|(_, sum)| sum.1.area > 0.0) {
            kept[old] = self.islands.len() as u32;
            let origin = place(*root).map(|x| x as f64);
            let ellipse = || Ellipse::from_moments(moments, origin, map.pixel());
            self.islands.push(Island {
                area: moments.area * map.cell_area(),
                slope: moments.slope_area / moments.area,
                approach: high - self.plane,
                ellipse: if forest.endless[*root] { None } else { ellipse() },
            });
        }
        self.homes.iter_mut().for_each(|home| home.island = kept[home.island as usize]);
    }

    /// Calls `each` with island, row and columns of all neighbouring nodes that belong to an island, row by
    /// row.
    pub(crate) fn spans(&self, mut each: impl FnMut(u32, usize, Range<usize>)) {
        for (run, home) in self.runs.list.iter().zip(&self.homes).filter(|(_, home)| home.island != u32::MAX)
        {
            each(home.island, run.row as usize, run.start as usize..run.end as usize);
        }
    }

    /// The island that holds the node at column and row `node`, if any does.
    pub fn holding(&self, [column, row]: [usize; 2]) -> Option<&Island> {
        let first = *self.runs.first.get(row)?;
        let runs = self.runs.first.get(row + 1).map(|_| self.runs.row(row))?;
        let at = runs.iter().position(|run| (run.start as usize..run.end as usize).contains(&column))?;
        self.islands.get(self.homes[first + at].island as usize)
    }

    /// The pieces of the islands of cell row `row`, from left to right; pieces of one cell follow each other.
    pub(crate) fn pieces(&self, map: &HeightMap, row: usize, mut each: impl FnMut(Piece)) {
        let inverse_pixel = map.inverse_pixel();
        let size = [map.columns() as i64, map.rows() as i64];
        self.visit_row(
            map,
            row,
            |_| {},
            |visit| {
                let (home, run) = (self.homes[visit.run as usize], self.runs.list[visit.run as usize]);
                if home.island == u32::MAX {
                    return;
                }
                let first = [run.start, run.row].map(i64::from);
                let origin = [0, 1].map(|axis| first[axis] + i64::from(home.shift[axis]) * size[axis]);
                let mut piece = |cell: [u32; 2], from_run: [i64; 2], area: f64| {
                    let offset = [0, 1].map(|axis| (origin[axis] + from_run[axis]) as f64);
                    each(Piece { cell, island: home.island, area, offset });
                };
                match visit.part {
                    Part::Whole([nodes, _]) => {
                        let [row, left] = visit.cell;
                        for column in left..left + nodes.len() as u32 - 1 {
                            piece([row, column], [i64::from(column) - first[0], 0], 1.0);
                        }
                    }
                    Part::Cut { offset, corners, sides } => {
                        let (area, _) = part_above(&corners, sides, inverse_pixel);
                        piece(visit.cell, offset.map(i64::from), area);
                    }
                }
            },
        );
    }
}

/// Area and slope integral above 0 of the triangles named by `sides`.
fn part_above(corners: &[f64; 4], sides: u8, inverse_pixel: [f64; 2]) -> (f64, f64) {
    if sides == 15 {
        cells::area_above(corners, inverse_pixel)
    } else {
        let m = cells::moments_above(corners, sides, inverse_pixel);
        (m.area, m.slope_area)
    }
}
