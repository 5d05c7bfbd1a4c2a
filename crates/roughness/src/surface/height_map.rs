//! Heights on a regular grid, and its cells.

use rayon::prelude::*;
use std::ops::Range;
use thiserror::Error;

/// Rows of cells that one task takes: fixed, so that sums come out the same for any number of threads.
const ROWS_PER_CHUNK: usize = 32;

/// The answers of `of` for chunks of `rows` rows in parallel, in their order.
pub(crate) fn chunks<T: Send>(rows: usize, of: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    let chunk = |k: usize| of(k * ROWS_PER_CHUNK..((k + 1) * ROWS_PER_CHUNK).min(rows));
    (0..rows.div_ceil(ROWS_PER_CHUNK)).into_par_iter().map(chunk).collect()
}

/// The reason why numbers are not a height map.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum MapError {
    /// The shape does not hold the heights.
    #[error("a map of {columns} x {rows} nodes needs {} heights, {found} were given", columns.saturating_mul(*rows))]
    Shape {
        /// Nodes along x.
        columns: usize,
        /// Nodes along y.
        rows: usize,
        /// Heights given.
        found: usize,
    },
    /// A pixel size is not a positive length.
    #[error("a pixel of {0} m x {1} m is not possible: both sides must be finite and above 0")]
    Pixel(f64, f64),
    /// No cell can be made.
    #[error(
        "the map has no cell with four measured corners ({columns} x {rows} nodes, {missing} missing): a surface needs at \
         least 2 x 2 neighbouring nodes; missing = \"fill\" closes holes"
    )]
    NoCell {
        /// Nodes along x.
        columns: usize,
        /// Nodes along y.
        rows: usize,
        /// Nodes without a height.
        missing: usize,
    },
    /// More nodes than the contact analysis can number.
    #[error(
        "{columns} x {rows} nodes are more than the {} that can be handled: cut or thin the map",
        i32::MAX
    )]
    TooLarge {
        /// Nodes along x.
        columns: usize,
        /// Nodes along y.
        rows: usize,
    },
    /// Tiles of too few points.
    #[error(
        "{count} x {count} tiles have {points} points along their shorter side, fewer than {fewest}: cut fewer"
    )]
    SmallTiles {
        /// Tiles along a side.
        count: usize,
        /// Points along the shorter side of one.
        points: usize,
        /// The fewest.
        fewest: usize,
    },
}

/// Heights on a regular grid, in metres; a missing point is NaN, and only a missing point is.
///
/// Between the nodes the surface is piecewise linear: a cell is four triangles about the mean of its corners.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    columns: usize,
    rows: usize,
    pixel: [f64; 2],
    heights: Vec<f64>,
    missing: usize,
    periodic: bool,
}

impl HeightMap {
    /// A map of `columns` nodes along x and `rows` along y; `heights` (m) row by row, `pixel` = spacing along
    /// x and y (m).
    ///
    /// Heights that are not finite count as missing.
    ///
    /// # Errors
    /// A number of heights that is not that of the nodes or too large, or a spacing that is not finite and
    /// above 0.
    pub fn new(
        columns: usize,
        rows: usize,
        pixel: [f64; 2],
        mut heights: Vec<f64>,
    ) -> Result<Self, MapError> {
        if columns.checked_mul(rows) != Some(heights.len()) {
            return Err(MapError::Shape { columns, rows, found: heights.len() });
        }
        if heights.len() >= i32::MAX as usize {
            return Err(MapError::TooLarge { columns, rows });
        }
        if !pixel.iter().all(|p| p.is_finite() && *p > 0.0) {
            return Err(MapError::Pixel(pixel[0], pixel[1]));
        }
        let missing = heights.par_iter_mut().filter(|z| !z.is_finite()).map(|z| *z = f64::NAN).count();
        Ok(HeightMap { columns, rows, pixel, heights, missing, periodic: false })
    }

    /// The same map as one period of an endless surface (or not).
    pub fn with_periodic(mut self, periodic: bool) -> Self {
        self.periodic = periodic;
        self
    }

    /// Nodes along x.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Nodes along y.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Spacing of the nodes along x and y, in metres.
    pub fn pixel(&self) -> [f64; 2] {
        self.pixel
    }

    /// Heights in metres, row by row; NaN where missing.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// The heights alone, as [`HeightMap::heights`] gives them.
    pub(crate) fn into_heights(self) -> Vec<f64> {
        self.heights
    }

    /// The number of nodes that have no height.
    pub fn missing(&self) -> usize {
        self.missing
    }

    /// True where the map repeats beyond its edges.
    pub fn periodic(&self) -> bool {
        self.periodic
    }

    /// Cells along x: columns - 1, or columns of a periodic map.
    pub fn cell_columns(&self) -> usize {
        if self.periodic { self.columns } else { self.columns.saturating_sub(1) }
    }

    /// Cells along y: rows - 1, or rows of a periodic map.
    pub fn cell_rows(&self) -> usize {
        if self.periodic { self.rows } else { self.rows.saturating_sub(1) }
    }

    /// Area of one cell, in m².
    pub fn cell_area(&self) -> f64 {
        self.pixel[0] * self.pixel[1]
    }

    /// The heights of node row `row` (counted modulo the rows of the map).
    pub fn row(&self, row: usize) -> &[f64] {
        let row = if row < self.rows { row } else { row - self.rows };
        &self.heights[row * self.columns..(row + 1) * self.columns]
    }

    /// A map of the same grid with other heights, made by `change(row, heights of the row)` in parallel.
    pub fn mapped(mut self, change: impl Fn(usize, &mut [f64]) + Sync) -> Self {
        let columns = self.columns.max(1);
        self.heights.par_chunks_mut(columns).enumerate().for_each(|(row, heights)| change(row, heights));
        self
    }

    /// The same map, its missing points counted anew.
    pub(crate) fn recounted(mut self) -> Self {
        self.missing = self.heights.par_iter().filter(|z| z.is_nan()).count();
        self
    }

    /// The same grid and edges with these heights (one per node, NaN = missing).
    ///
    /// # Errors
    /// A number of heights that is not that of the nodes.
    pub fn with_heights(&self, heights: Vec<f64>) -> Result<Self, MapError> {
        Ok(HeightMap::new(self.columns, self.rows, self.pixel, heights)?.with_periodic(self.periodic))
    }

    /// The answers of `of` for chunks of cell rows in parallel, in their order.
    pub(crate) fn chunks<T: Send>(&self, of: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
        chunks(self.cell_rows(), of)
    }

    /// The answers of `of` for the heights of chunks of rows in parallel, in their order.
    pub(crate) fn parts<T: Send>(&self, of: impl Fn(&[f64]) -> T + Sync + Send) -> Vec<T> {
        self.heights.par_chunks(ROWS_PER_CHUNK * self.columns.max(1)).map(of).collect()
    }

    /// 1/dx and 1/dy, in 1/m.
    pub(crate) fn inverse_pixel(&self) -> [f64; 2] {
        self.pixel.map(|p| 1.0 / p)
    }

    /// Calls `visit` with the corner heights of every used cell of cell row `row`, from left to right.
    ///
    /// Corners run around the cell: (x, y), (x+1, y), (x+1, y+1), (x, y+1).
    pub(crate) fn for_each_cell(&self, row: usize, mut visit: impl FnMut([f64; 4])) {
        let (low, high) = (self.row(row), self.row(row + 1));
        let inner = self.columns.saturating_sub(1);
        let whole = self.missing == 0;
        let mut visit_used = |corners: [f64; 4]| {
            if whole || !corners.iter().any(|z| z.is_nan()) {
                visit(corners);
            }
        };
        for (a, b) in low.windows(2).zip(high.windows(2)) {
            visit_used([a[0], a[1], b[1], b[0]]);
        }
        if self.periodic && !low.is_empty() {
            visit_used([low[inner], low[0], high[0], high[inner]]);
        }
    }

    /// Lowest and highest node, and the number of used cells.
    ///
    /// # Errors
    /// A map without a cell whose corners were all measured.
    pub fn extent(&self) -> Result<Extent, MapError> {
        // a missing height compares with nothing
        let widened = |(low, high): (f64, f64), z: &f64| {
            (if *z < low { *z } else { low }, if *z > high { *z } else { high })
        };
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let ends = self.parts(|part| part.iter().fold(none, widened));
        let (low, high) = ends.iter().fold(none, |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let cells = if self.missing == 0 {
            self.cell_columns() * self.cell_rows()
        } else {
            let count = |row| {
                let mut n = 0;
                self.for_each_cell(row, |_| n += 1);
                n
            };
            (0..self.cell_rows()).into_par_iter().map(count).sum()
        };
        if cells == 0 {
            return Err(MapError::NoCell { columns: self.columns, rows: self.rows, missing: self.missing });
        }
        Ok(Extent { low, high, cells })
    }
}

/// Range of heights and number of cells of a map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Lowest node, in metres.
    pub low: f64,
    /// Highest node, in metres.
    pub high: f64,
    /// Cells with four measured corners; times the cell area this is the nominal area.
    pub cells: usize,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_are_counted_with_edges_and_holes() {
        let map = HeightMap::new(3, 3, [1.0, 1.0], vec![0.0; 9]).unwrap();
        assert_eq!(map.extent().unwrap().cells, 4);
        assert_eq!(map.clone().with_periodic(true).extent().unwrap().cells, 9);
        let mut holed = vec![0.0; 9];
        holed[8] = f64::INFINITY;
        let map = HeightMap::new(3, 3, [1.0, 1.0], holed).unwrap();
        assert_eq!((map.missing(), map.extent().unwrap().cells), (1, 3));
        assert_eq!(map.with_periodic(true).extent().unwrap().cells, 5);
    }

    #[test]
    fn what_is_no_map_is_refused() {
        assert!(HeightMap::new(2, 2, [1.0, 1.0], vec![0.0; 3]).is_err());
        assert!(HeightMap::new(usize::MAX, 3, [1.0, 1.0], vec![0.0; 3]).is_err());
        assert!(HeightMap::new(1, 1, [0.0, 1.0], vec![0.0]).is_err());
        assert!(HeightMap::new(1, 1, [1.0, 1.0], vec![0.0]).unwrap().extent().is_err());
        assert!(HeightMap::new(0, 0, [1.0, 1.0], vec![]).unwrap().extent().is_err());
    }
}
