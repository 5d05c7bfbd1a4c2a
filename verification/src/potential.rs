//! Heat through the spots of a joint, by finite volumes: no half-space kernel, no contact mechanics.
//!
//! One body of conductivity 1 stands on its base at the potential 1. Its face is at 0 on the spots and lets
//! nothing through beside them; sideways it is periodic. Far from the face the flux is even, so that a base a
//! side below the face is as good as one without end (e^-4π of the longest wave is left of it).
//!
//! Cells are square in the plane, some to a pixel of the spots, and grow with the depth. Conjugate gradients
//! are preconditioned by a V-cycle that solves lines along the depth and makes cells twice as wide. At the
//! rim of a spot the flux is without bound as 1/√distance, so that the drop is off by the first power of the
//! cell; two grids tell it.

/// Depth of the body, in sides.
const DEPTH: f64 = 1.0;
/// Heights of neighbouring layers.
const GROWTH: f64 = 1.15;
/// Residual over the first at which the search ends.
const TOLERANCE: f64 = 1e-6;
/// Iterations at most.
const ITERATIONS: usize = 200;
/// Damping of the lines of a smoothing.
const DAMPING: f64 = 0.8;
/// Cells along a side at which grids are no longer made coarser.
const COARSEST: usize = 4;

/// A grid of `n` x `n` columns of layers, and what joins its cells.
struct Grid {
    n: usize,
    layers: usize,
    /// Of each layer, between neighbours in it.
    sideways: Vec<f64>,
    /// Of each layer, to the one below; the last to the base.
    down: Vec<f64>,
    /// Of each column, from its first cell to the face; 0 beside the spots.
    face: Vec<f64>,
}

/// Places of the four neighbours of the column at `x`, `y` of `n` x `n`.
fn neighbours(n: usize, x: usize, y: usize) -> [usize; 4] {
    let (left, right) = ((x + n - 1) % n, (x + 1) % n);
    let (above, below) = ((y + n - 1) % n, (y + 1) % n);
    [y * n + left, y * n + right, above * n + x, below * n + x]
}

impl Grid {
    /// Of `spots`, true in contact, `side` to a row, in cells of 1/`times` of a pixel.
    fn new(spots: &[bool], side: usize, times: usize) -> Grid {
        let n = side * times;
        let cell = 1.0 / times as f64;
        let mut heights = vec![cell];
        let mut depth = cell;
        while depth < DEPTH * side as f64 {
            let next = heights[heights.len() - 1] * GROWTH;
            depth += next;
            heights.push(next);
        }
        let half = |k: usize| 0.5 * heights.get(k).copied().unwrap_or(0.0);
        let area = cell * cell;
        let down = (0..heights.len()).map(|k| area / (half(k) + half(k + 1))).collect();
        let of_face = |i: usize| {
            let [x, y] = [i % n / times, i / n / times];
            if spots[y * side + x] { area / half(0) } else { 0.0 }
        };
        let face = (0..n * n).map(of_face).collect();
        Grid { n, layers: heights.len(), sideways: heights, down, face }
    }

    /// The same in cells twice as wide.
    fn coarser(&self) -> Grid {
        let n = self.n / 2;
        let four = |i: usize| {
            let (x, y) = (2 * (i % n), 2 * (i / n));
            [0, 1].map(|k| self.face[(y + k) * self.n + x] + self.face[(y + k) * self.n + x + 1])
        };
        Grid {
            n,
            layers: self.layers,
            sideways: self.sideways.clone(),
            down: self.down.iter().map(|d| 4.0 * d).collect(),
            face: (0..n * n).map(|i| four(i).iter().sum()).collect(),
        }
    }

    fn cells(&self) -> usize {
        self.n * self.n * self.layers
    }

    /// The conductance that joins layer `k` of a column to the one above it, or its first cell to the face.
    fn up(&self, column: usize, k: usize) -> f64 {
        if k == 0 { self.face[column] } else { self.down[k - 1] }
    }

    /// The sum over neighbours in the layers, cell by cell of a column: what leaves it sideways is 4 times
    /// its own less that.
    fn sum_of_neighbours(&self, t: &[f64], column: usize, out: &mut [f64]) {
        let places = neighbours(self.n, column % self.n, column / self.n);
        out.fill(0.0);
        for place in places {
            let other = &t[place * self.layers..][..self.layers];
            out.iter_mut().zip(other).for_each(|(o, t)| *o += t);
        }
    }

    /// The currents that leave the cells at the potential `t`, the base at 0.
    fn apply(&self, t: &[f64], out: &mut [f64]) {
        let mut near = vec![0.0; self.layers];
        for column in 0..self.n * self.n {
            self.sum_of_neighbours(t, column, &mut near);
            let from = column * self.layers;
            for k in 0..self.layers {
                let own = t[from + k];
                let above = if k == 0 { 0.0 } else { t[from + k - 1] };
                let below = if k + 1 == self.layers { 0.0 } else { t[from + k + 1] };
                out[from + k] = self.sideways[k] * (4.0 * own - near[k])
                    + self.up(column, k) * (own - above)
                    + self.down[k] * (own - below);
            }
        }
    }

    /// Adds the damped solutions of all columns, each with its neighbours as they are, to `t`.
    fn smooth(&self, right: &[f64], t: &mut [f64]) {
        let mut left = vec![0.0; t.len()];
        self.apply(t, &mut left);
        let [mut sweep, mut value] = [(); 2].map(|()| vec![0.0; self.layers]);
        for column in 0..self.n * self.n {
            let from = column * self.layers;
            let residual = |k: usize| right[from + k] - left[from + k];
            for k in 0..self.layers {
                let up = self.up(column, k);
                let joined = if k == 0 { [0.0; 2] } else { [sweep[k - 1], value[k - 1]] };
                let pivot = 4.0 * self.sideways[k] + up + self.down[k] - up * joined[0];
                sweep[k] = self.down[k] / pivot;
                value[k] = (residual(k) + up * joined[1]) / pivot;
            }
            for k in (0..self.layers).rev() {
                if k + 1 < self.layers {
                    value[k] += sweep[k] * value[k + 1];
                }
                t[from + k] += DAMPING * value[k];
            }
        }
    }
}

/// One V-cycle for what leaves the cells of the first of `grids` to be `right`.
fn cycle(grids: &[Grid], right: &[f64]) -> Vec<f64> {
    let [grid, coarser @ ..] = grids else { return Vec::new() };
    let mut t = vec![0.0; grid.cells()];
    grid.smooth(right, &mut t);
    if let Some(coarse) = coarser.first() {
        let mut left = vec![0.0; t.len()];
        grid.apply(&t, &mut left);
        let wide = |column: usize| (column / grid.n / 2) * coarse.n + column % grid.n / 2;
        let mut open = vec![0.0; coarse.cells()];
        for column in 0..grid.n * grid.n {
            for k in 0..grid.layers {
                let i = column * grid.layers + k;
                open[wide(column) * grid.layers + k] += right[i] - left[i];
            }
        }
        let found = cycle(coarser, &open);
        for column in 0..grid.n * grid.n {
            for k in 0..grid.layers {
                t[column * grid.layers + k] += found[wide(column) * grid.layers + k];
            }
        }
    } else {
        (0..8).for_each(|_| grid.smooth(right, &mut t));
    }
    grid.smooth(right, &mut t);
    t
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The drop of potential at the face of one body over the even flux, in pixels, in cells of 1/`times` of a
/// pixel: NaN where the search does not end.
fn drop_of_grid(spots: &[bool], side: usize, times: usize) -> f64 {
    let mut grids = vec![Grid::new(spots, side, times)];
    while let Some(last) = grids.last().filter(|g| g.n.is_multiple_of(2) && g.n / 2 >= COARSEST) {
        let next = last.coarser();
        grids.push(next);
    }
    let grid = &grids[0];
    let last = grid.layers - 1;
    // the base is at 1
    let mut residual = vec![0.0; grid.cells()];
    residual.iter_mut().skip(last).step_by(grid.layers).for_each(|r| *r = grid.down[last]);
    let mut t = vec![0.0; grid.cells()];
    let mut way = cycle(&grids, &residual);
    let mut change = vec![0.0; t.len()];
    let mut now = dot(&residual, &way);
    let first = now;
    for _ in 0..ITERATIONS {
        grid.apply(&way, &mut change);
        let step = now / dot(&way, &change);
        t.iter_mut().zip(&way).for_each(|(t, w)| *t += step * w);
        residual.iter_mut().zip(&change).for_each(|(r, c)| *r -= step * c);
        let better = cycle(&grids, &residual);
        let next = dot(&residual, &better);
        if next <= TOLERANCE * TOLERANCE * first {
            let flux: f64 =
                t.iter().skip(last).step_by(grid.layers).map(|t| grid.down[last] * (1.0 - t)).sum();
            let depth: f64 = grid.sideways.iter().sum();
            let area = (side * side) as f64;
            return area / flux - depth;
        }
        let beta = next / now;
        now = next;
        way.iter_mut().zip(&better).for_each(|(w, b)| *w = b + beta * *w);
    }
    f64::NAN
}

/// Conductance h of a joint of two bodies of the conductivity k through `spots` (true in contact, `side` to a
/// row, square pixels): h times the pixel over k. From cells of 1/`times` of a pixel and half that, whose
/// errors go with the cell.
pub fn conductance(spots: &[bool], side: usize, times: usize) -> f64 {
    let [coarse, fine] = [times, 2 * times].map(|times| drop_of_grid(spots, side, times));
    0.5 / (2.0 * fine - coarse)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// Strips of width w at the pitch L: the drop of one body is (L/π k) ln(1/sin(πw/2L)) times the flux
    /// (Johnson 1985, section 13.2, by the analogy; Cooper, Mikic and Yovanovich 1969 have the circle).
    /// Tolerance: 16 cells to a strip, whose error of the first power is taken out.
    #[test]
    fn strips_conduct_as_their_closed_form() {
        for (pitch, width) in [(32, 8), (32, 16)] {
            let side = 32;
            let spots: Vec<bool> = (0..side * side).map(|i| i % side % pitch < width).collect();
            let (l, w) = (pitch as f64, width as f64);
            let exact = 0.5 * PI / l / (1.0 / (PI * w / (2.0 * l)).sin()).ln();
            let found = conductance(&spots, side, 1);
            assert!((found / exact - 1.0).abs() < 5e-3, "{found} {exact}");
        }
    }
}
