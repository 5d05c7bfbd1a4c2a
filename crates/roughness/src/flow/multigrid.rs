//! A network of conductances on a grid, and a multigrid cycle that nearly solves it.

/// Cells at which coarsening ends.
const COARSEST_CELLS: usize = 16;
/// Sweeps on the coarsest grid.
const COARSEST_SWEEPS: usize = 20;
/// Visits of a coarser grid in a cycle: corrections that are constant on a large cell need more than one.
const VISITS: usize = 2;

/// Conductances between the cells of a grid and to its ends: `long` cells a line.
#[derive(Clone, Debug)]
pub(super) struct Network {
    pub long: usize,
    wide: usize,
    /// To the next cell of the line; 0 at its end.
    ahead: Vec<f64>,
    /// To the cell beside it on the next line; on the last line, to the first.
    beside: Vec<f64>,
    /// To the ends, where the pressure is given.
    pub ends: Vec<f64>,
    /// Sum of a cell's conductances.
    sum: Vec<f64>,
    /// 1 over that; 0 of a closed cell.
    inverse: Vec<f64>,
}

impl Network {
    pub fn new(long: usize, wide: usize, ahead: Vec<f64>, beside: Vec<f64>, ends: Vec<f64>) -> Network {
        let n = long * wide;
        let mut sum = ends.clone();
        for i in 0..n {
            if ahead[i] > 0.0 {
                sum[i] += ahead[i];
                sum[i + 1] += ahead[i];
            }
            if beside[i] > 0.0 {
                sum[i] += beside[i];
                sum[(i + long) % n] += beside[i];
            }
        }
        let inverse = sum.iter().map(|s| if *s > 0.0 { 1.0 / s } else { 0.0 }).collect();
        Network { long, wide, ahead, beside, ends, sum, inverse }
    }

    /// Flow from the lines beside `line` to its cells: Σ g x.
    fn inflow_from_beside(&self, x: &[f64], line: usize, sum: &mut [f64]) {
        let row = |line: usize| line * self.long..(line + 1) * self.long;
        let (here, below) = (row(line), row((line + self.wide - 1) % self.wide));
        let above = row((line + 1) % self.wide);
        let terms =
            self.beside[here].iter().zip(&x[above]).zip(self.beside[below.clone()].iter().zip(&x[below]));
        sum.iter_mut().zip(terms).for_each(|(sum, ((a, xa), (b, xb)))| *sum = a * xa + b * xb);
    }

    /// y = A x; `sum` is room of a line.
    pub fn apply(&self, x: &[f64], y: &mut [f64], sum: &mut [f64]) {
        let long = self.long;
        for (line, y) in y.chunks_exact_mut(long).enumerate() {
            self.inflow_from_beside(x, line, sum);
            let here = line * long..(line + 1) * long;
            let (x, ahead, whole) = (&x[here.clone()], &self.ahead[here.clone()], &self.sum[here]);
            for i in 0..long {
                y[i] = whole[i] * x[i] - sum[i];
            }
            // the last cell of a line has nothing ahead
            for i in 0..long - 1 {
                y[i] -= ahead[i] * x[i + 1];
                y[i + 1] -= ahead[i] * x[i];
            }
        }
    }

    /// One sweep of Gauss and Seidel, forwards or backwards; `sum` is room of a line.
    ///
    /// All that does not depend on the cell before is summed first, many cells at once.
    fn smooth(&self, b: &[f64], x: &mut [f64], backwards: bool, sum: &mut [f64]) {
        let long = self.long;
        for step in 0..self.wide {
            let line = if backwards { self.wide - 1 - step } else { step };
            self.inflow_from_beside(x, line, sum);
            let here = line * long..(line + 1) * long;
            let (x, b, ahead) = (&mut x[here.clone()], &b[here.clone()], &self.ahead[here.clone()]);
            let inverse = &self.inverse[here];
            let mut before = 0.0;
            if backwards {
                for i in 1..long {
                    sum[i] += ahead[i - 1] * x[i - 1];
                }
                for i in 0..long {
                    sum[i] = (sum[i] + b[i]) * inverse[i];
                }
                for i in (0..long).rev() {
                    before = sum[i] + ahead[i] * inverse[i] * before;
                    x[i] = before;
                }
            } else {
                for i in 0..long - 1 {
                    sum[i] += ahead[i] * x[i + 1];
                }
                for i in 0..long {
                    sum[i] = (sum[i] + b[i]) * inverse[i];
                }
                let mut flow = 0.0;
                for i in 0..long {
                    before = sum[i] + flow * inverse[i] * before;
                    x[i] = before;
                    flow = ahead[i];
                }
            }
        }
    }

    /// The network of twice as large cells.
    ///
    /// Conductances that cross between large cells add up and are halved for twice the distance.
    fn coarser(&self) -> Option<Network> {
        if self.long * self.wide <= COARSEST_CELLS {
            return None;
        }
        let (long, wide) = (self.long.div_ceil(2), self.wide.div_ceil(2));
        let [mut ahead, mut beside, mut ends] = [(); 3].map(|()| vec![0.0; long * wide]);
        for i in 0..self.ends.len() {
            let (column, line) = (i % self.long, i / self.long);
            let cell = line / 2 * long + column / 2;
            ends[cell] += 0.5 * self.ends[i];
            if column % 2 == 1 {
                ahead[cell] += 0.5 * self.ahead[i];
            }
            let next = (line + 1) % self.wide;
            if next / 2 != line / 2 {
                beside[cell] += 0.5 * self.beside[i];
            }
        }
        Some(Network::new(long, wide, ahead, beside, ends))
    }
}

/// The grids from the finest to the coarsest.
pub(super) struct Multigrid {
    pub levels: Vec<Network>,
    /// Right-hand side, answer and residual of each grid.
    rooms: Vec<[Vec<f64>; 3]>,
    /// Room of a line.
    line: Vec<f64>,
}

impl Multigrid {
    pub fn from_network(network: Network) -> Multigrid {
        let mut levels = vec![network];
        while let Some(next) = levels.last().and_then(Network::coarser) {
            levels.push(next);
        }
        let room = |level: &Network| [(); 3].map(|()| vec![0.0; level.ends.len()]);
        let line = vec![0.0; levels[0].long];
        Multigrid { rooms: levels.iter().map(room).collect(), levels, line }
    }

    /// x ≈ A⁻¹ b by one symmetric cycle.
    pub fn cycle(&mut self, b: &[f64], x: &mut [f64]) {
        self.rooms[0][0].copy_from_slice(b);
        self.descend(0);
        x.copy_from_slice(&self.rooms[0][1]);
    }

    /// y = A x on the finest grid.
    pub fn apply(&mut self, x: &[f64], y: &mut [f64]) {
        self.levels[0].apply(x, y, &mut self.line);
    }

    /// A sweep forwards, corrections of the coarser grid, a sweep backwards.
    fn descend(&mut self, level: usize) {
        let [b, mut x, mut r] = std::mem::take(&mut self.rooms[level]);
        x.fill(0.0);
        self.smooth(level, &b, &mut x, false);
        if level + 1 == self.levels.len() {
            for _ in 0..COARSEST_SWEEPS {
                self.smooth(level, &b, &mut x, true);
                self.smooth(level, &b, &mut x, false);
            }
            self.smooth(level, &b, &mut x, true);
            self.rooms[level] = [b, x, r];
            return;
        }
        let (long, coarse_long) = (self.levels[level].long, self.levels[level + 1].long);
        for visit in 0..VISITS {
            self.levels[level].apply(&x, &mut r, &mut self.line[..long]);
            let [coarse_b, ..] = &mut self.rooms[level + 1];
            coarse_b.fill(0.0);
            for (line, (r, b)) in r.chunks(long).zip(b.chunks(long)).enumerate() {
                let to = &mut coarse_b[line / 2 * coarse_long..];
                r.iter().zip(b).enumerate().for_each(|(column, (r, b))| to[column / 2] += b - r);
            }
            self.descend(level + 1);
            let [_, coarse_x, _] = &self.rooms[level + 1];
            for (line, x) in x.chunks_mut(long).enumerate() {
                let from = &coarse_x[line / 2 * coarse_long..];
                x.iter_mut().enumerate().for_each(|(column, x)| *x += from[column / 2]);
            }
            // what was forwards before a visit is backwards after it: the cycle is symmetric
            self.smooth(level, &b, &mut x, true);
            if visit + 1 < VISITS {
                self.smooth(level, &b, &mut x, false);
            }
        }
        self.rooms[level] = [b, x, r];
    }

    fn smooth(&mut self, level: usize, b: &[f64], x: &mut [f64], backwards: bool) {
        let network = &self.levels[level];
        network.smooth(b, x, backwards, &mut self.line[..network.long]);
    }
}

/// Σ a b.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
