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
    pub wide: usize,
    /// To the next cell of the line; 0 at its end.
    pub ahead: Vec<f64>,
    /// To the cell beside it on the next line; on the last line, to the first.
    pub beside: Vec<f64>,
    /// To the ends, where the pressure is given.
    pub ends: Vec<f64>,
    /// 1 over the sum of a cell's conductances; 0 of a closed cell.
    pub inverse: Vec<f64>,
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
        let inverse = sum.into_iter().map(|s| if s > 0.0 { 1.0 / s } else { 0.0 }).collect();
        Network { long, wide, ahead, beside, ends, inverse }
    }

    /// Σ g x over the neighbours of cell `i`.
    #[inline]
    fn inflow(&self, x: &[f64], i: usize, column: usize) -> f64 {
        let n = x.len();
        let below = if i >= self.long { i - self.long } else { n - self.long + i };
        let above = if i + self.long < n { i + self.long } else { i + self.long - n };
        let mut sum = self.beside[i] * x[above] + self.beside[below] * x[below];
        if column > 0 {
            sum += self.ahead[i - 1] * x[i - 1];
        }
        if column + 1 < self.long {
            sum += self.ahead[i] * x[i + 1];
        }
        sum
    }

    /// y = A x.
    pub fn apply(&self, x: &[f64], y: &mut [f64]) {
        for line in 0..self.wide {
            for column in 0..self.long {
                let i = line * self.long + column;
                y[i] = if self.inverse[i] > 0.0 {
                    x[i] / self.inverse[i] - self.inflow(x, i, column)
                } else {
                    0.0
                };
            }
        }
    }

    /// One sweep of Gauss and Seidel, forwards or backwards.
    fn smooth(&self, b: &[f64], x: &mut [f64], backwards: bool) {
        let mut relax = |i: usize, column: usize| {
            if self.inverse[i] > 0.0 {
                x[i] = (b[i] + self.inflow(x, i, column)) * self.inverse[i];
            }
        };
        for step in 0..self.wide {
            let line = if backwards { self.wide - 1 - step } else { step };
            for step in 0..self.long {
                let column = if backwards { self.long - 1 - step } else { step };
                relax(line * self.long + column, column);
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
    /// Right-hand side, answer and residual of each coarse grid.
    rooms: Vec<[Vec<f64>; 3]>,
}

impl Multigrid {
    pub fn from_network(network: Network) -> Multigrid {
        let mut levels = vec![network];
        while let Some(next) = levels.last().and_then(Network::coarser) {
            levels.push(next);
        }
        // the finest grid works on what it is given
        let room = |(k, level): (usize, &Network)| {
            [(); 3].map(|()| vec![0.0; if k == 0 { 0 } else { level.ends.len() }])
        };
        Multigrid { rooms: levels.iter().enumerate().map(room).collect(), levels }
    }

    /// x ≈ A⁻¹ b by one symmetric cycle; `r` is room of the same length.
    pub fn cycle(&mut self, b: &[f64], x: &mut [f64], r: &mut [f64]) {
        self.descend(0, b, x, r);
    }

    /// A sweep forwards, corrections of the coarser grid, a sweep backwards.
    fn descend(&mut self, level: usize, b: &[f64], x: &mut [f64], r: &mut [f64]) {
        let network = &self.levels[level];
        x.fill(0.0);
        network.smooth(b, x, false);
        if level + 1 == self.levels.len() {
            for _ in 0..COARSEST_SWEEPS {
                network.smooth(b, x, true);
                network.smooth(b, x, false);
            }
            network.smooth(b, x, true);
            return;
        }
        let [mut coarse_b, mut coarse_x, mut coarse_r] = std::mem::take(&mut self.rooms[level + 1]);
        for visit in 0..VISITS {
            let (network, coarser) = (&self.levels[level], &self.levels[level + 1]);
            network.apply(x, r);
            let (long, coarse_long) = (network.long, coarser.long);
            coarse_b.fill(0.0);
            for (line, (r, b)) in r.chunks(long).zip(b.chunks(long)).enumerate() {
                let to = &mut coarse_b[line / 2 * coarse_long..];
                r.iter().zip(b).enumerate().for_each(|(column, (r, b))| to[column / 2] += b - r);
            }
            self.descend(level + 1, &coarse_b, &mut coarse_x, &mut coarse_r);
            let network = &self.levels[level];
            for (line, x) in x.chunks_mut(long).enumerate() {
                let from = &coarse_x[line / 2 * coarse_long..];
                x.iter_mut().enumerate().for_each(|(column, x)| *x += from[column / 2]);
            }
            // what was forwards before a visit is backwards after it: the cycle is symmetric
            network.smooth(b, x, true);
            if visit + 1 < VISITS {
                network.smooth(b, x, false);
            }
        }
        self.rooms[level + 1] = [coarse_b, coarse_x, coarse_r];
    }
}

/// Σ a b.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
