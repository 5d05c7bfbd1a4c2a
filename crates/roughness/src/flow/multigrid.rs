//! A network of conductances on a grid, and a multigrid cycle that nearly solves it.

use crate::half_space::Real;

/// Cells at which coarsening ends.
const COARSEST_CELLS: usize = 16;
/// Sweeps on the coarsest grid.
const COARSEST_SWEEPS: usize = 20;
/// Visits of a coarser grid in a cycle: corrections that are constant on a large cell need more than one.
const VISITS: usize = 2;
/// Lines that a sweep takes at once: each cell of a line waits for the one before, cells of others do not.
const LINES: usize = 4;

/// Conductances between the cells of a grid and to its ends: `long` cells a line.
#[derive(Clone, Debug)]
pub(super) struct Network<T> {
    pub long: usize,
    wide: usize,
    /// To the next cell of the line; 0 at its end.
    ahead: Vec<T>,
    /// To the cell beside it on the next line; on the last line, to the first.
    beside: Vec<T>,
    /// To the ends, where the pressure is given.
    pub ends: Vec<T>,
    /// Sum of a cell's conductances.
    sum: Vec<T>,
}

impl<T: Real> Network<T> {
    pub fn new(long: usize, wide: usize, ahead: Vec<T>, beside: Vec<T>, ends: Vec<T>) -> Network<T> {
        let n = long * wide;
        let mut sum = ends.clone();
        for i in 0..n {
            if ahead[i] > T::zero() {
                sum[i] += ahead[i];
                sum[i + 1] += ahead[i];
            }
            if beside[i] > T::zero() {
                sum[i] += beside[i];
                sum[(i + long) % n] += beside[i];
            }
        }
        Network { long, wide, ahead, beside, ends, sum }
    }

    /// The same in other numbers.
    pub fn rounded<U: Real>(&self) -> Network<U> {
        let [ahead, beside, ends, sum] = [&self.ahead, &self.beside, &self.ends, &self.sum]
            .map(|values| values.iter().map(|x| U::nearest(x.wide())).collect());
        Network { long: self.long, wide: self.wide, ahead, beside, ends, sum }
    }

    /// Flow from the lines beside `line` to its cells: Σ g x.
    fn inflow_from_beside(&self, x: &[T], line: usize, sum: &mut [T]) {
        let row = |line: usize| line * self.long..(line + 1) * self.long;
        let (here, below) = (row(line), row((line + self.wide - 1) % self.wide));
        let above = row((line + 1) % self.wide);
        let terms =
            self.beside[here].iter().zip(&x[above]).zip(self.beside[below.clone()].iter().zip(&x[below]));
        sum.iter_mut().zip(terms).for_each(|(sum, ((a, xa), (b, xb)))| *sum = *a * *xa + *b * *xb);
    }

    /// A x on `line`.
    fn apply_line(&self, x: &[T], line: usize, y: &mut [T]) {
        let long = self.long;
        self.inflow_from_beside(x, line, y);
        let here = line * long..(line + 1) * long;
        let (x, ahead, whole) = (&x[here.clone()], &self.ahead[here.clone()], &self.sum[here]);
        y.iter_mut().zip(whole.iter().zip(x)).for_each(|(y, (w, x))| *y = *w * *x - *y);
        // the last cell of a line has nothing ahead
        y.iter_mut().zip(ahead.iter().zip(&x[1..])).for_each(|(y, (g, x))| *y -= *g * *x);
        y[1..].iter_mut().zip(ahead.iter().zip(x)).for_each(|(y, (g, x))| *y -= *g * *x);
    }

    /// y = A x.
    pub fn apply(&self, x: &[T], y: &mut [T]) {
        y.chunks_exact_mut(self.long).enumerate().for_each(|(line, y)| self.apply_line(x, line, y));
    }

    /// The network of twice as large cells.
    ///
    /// Conductances that cross between large cells add up and are halved for twice the distance.
    fn coarser(&self) -> Option<Network<T>> {
        if self.long * self.wide <= COARSEST_CELLS {
            return None;
        }
        let half = T::nearest(0.5);
        let (long, wide) = (self.long.div_ceil(2), self.wide.div_ceil(2));
        let [mut ahead, mut beside, mut ends] = [(); 3].map(|()| vec![T::zero(); long * wide]);
        for i in 0..self.ends.len() {
            let (column, line) = (i % self.long, i / self.long);
            let cell = line / 2 * long + column / 2;
            ends[cell] += half * self.ends[i];
            if column % 2 == 1 {
                ahead[cell] += half * self.ahead[i];
            }
            let next = (line + 1) % self.wide;
            if next / 2 != line / 2 {
                beside[cell] += half * self.beside[i];
            }
        }
        Some(Network::new(long, wide, ahead, beside, ends))
    }
}

/// A network with what a sweep needs.
struct Grid<T> {
    network: Network<T>,
    /// 1 over the sum of a cell's conductances; 0 of a closed cell.
    inverse: Vec<T>,
    /// Right-hand side and answer.
    b: Vec<T>,
    x: Vec<T>,
}

impl<T: Real> Grid<T> {
    fn new(network: Network<T>) -> Grid<T> {
        let inverse =
            network.sum.iter().map(|s| if *s > T::zero() { T::one() / *s } else { T::zero() }).collect();
        let [b, x] = [(); 2].map(|()| vec![T::zero(); network.sum.len()]);
        Grid { network, inverse, b, x }
    }

    /// One sweep of Gauss and Seidel, or the same backwards: the even lines, then the odd ones.
    ///
    /// All that does not depend on the cell before is summed first, many cells at once.
    fn smooth(&mut self, backwards: bool, rooms: &mut [Vec<T>; LINES]) {
        let wide = self.network.wide;
        let [even, odd] = [0, 1].map(|first| (first..wide).step_by(2 * LINES));
        if backwards {
            odd.rev().chain(even.rev()).for_each(|line| self.smooth_lines(line, true, rooms));
        } else {
            even.chain(odd).for_each(|line| self.smooth_lines(line, false, rooms));
        }
    }

    /// Every second line from `first` on.
    fn smooth_lines(&mut self, first: usize, backwards: bool, rooms: &mut [Vec<T>; LINES]) {
        let (long, wide) = (self.network.long, self.network.wide);
        let line = |k: usize| first + 2 * k;
        let count = (wide - first).div_ceil(2).min(LINES);
        let row = |k: usize| line(k) * long..(line(k) + 1) * long;
        for (k, sum) in rooms[..count].iter_mut().enumerate() {
            let sum = &mut sum[..long];
            self.network.inflow_from_beside(&self.x, line(k), sum);
            let (x, b, inverse, ahead) =
                (&self.x[row(k)], &self.b[row(k)], &self.inverse[row(k)], &self.network.ahead[row(k)]);
            if backwards {
                sum[1..].iter_mut().zip(ahead.iter().zip(x)).for_each(|(s, (g, x))| *s += *g * *x);
            } else {
                sum.iter_mut().zip(ahead.iter().zip(&x[1..])).for_each(|(s, (g, x))| *s += *g * *x);
            }
            sum.iter_mut().zip(b.iter().zip(inverse)).for_each(|(s, (b, i))| *s = (*s + *b) * *i);
        }
        // where there are fewer lines the other rooms are computed, too, and not read
        let rows = std::array::from_fn::<_, LINES, _>(|k| row(k.min(count - 1)));
        let ahead = rows.clone().map(|row| &self.network.ahead[row]);
        let inverse = rows.map(|row| &self.inverse[row]);
        let sums = rooms.each_mut().map(|room| &mut room[..long]);
        relax(sums, ahead, inverse, backwards);
        for (k, sum) in rooms[..count].iter().enumerate() {
            self.x[row(k)].copy_from_slice(&sum[..long]);
        }
    }

    /// Residual on twice as large cells.
    fn restrict(&self, coarse: &mut [T], coarse_long: usize, room: &mut [T]) {
        coarse.fill(T::zero());
        let long = self.network.long;
        for (line, b) in self.b.chunks_exact(long).enumerate() {
            let y = &mut room[..long];
            self.network.apply_line(&self.x, line, y);
            let to = &mut coarse[line / 2 * coarse_long..][..coarse_long];
            let (b, last_b) = b.as_chunks::<2>();
            let (y, last_y) = y.as_chunks::<2>();
            to.iter_mut().zip(b.iter().zip(y)).for_each(|(to, (b, y))| *to += (b[0] - y[0]) + (b[1] - y[1]));
            if let ([b], [y]) = (last_b, last_y) {
                to[coarse_long - 1] += *b - *y;
            }
        }
    }

    /// Adds a correction that is constant on twice as large cells.
    fn prolong(&mut self, coarse: &[T], coarse_long: usize) {
        for (line, x) in self.x.chunks_exact_mut(self.network.long).enumerate() {
            let from = &coarse[line / 2 * coarse_long..][..coarse_long];
            for (x, c) in x.chunks_mut(2).zip(from) {
                x.iter_mut().for_each(|x| *x += *c);
            }
        }
    }
}

/// x_i = s_i + g x_before / sum_i along each line, in the place of s; g joins it to the cell before.
fn relax<T: Real>(s: [&mut [T]; LINES], ahead: [&[T]; LINES], inverse: [&[T]; LINES], backwards: bool) {
    let long = s[0].len();
    let (s, ahead, inverse) =
        (s.map(|s| &mut s[..long]), ahead.map(|a| &a[..long]), inverse.map(|i| &i[..long]));
    let mut before = [T::zero(); LINES];
    let mut cell = |i: usize, joint: usize| {
        for k in 0..LINES {
            before[k] = s[k][i] + (ahead[k][joint] * inverse[k][i]) * before[k];
            s[k][i] = before[k];
        }
    };
    if backwards {
        (0..long).rev().for_each(|i| cell(i, i));
    } else {
        // nothing is before the first
        (0..long).for_each(|i| cell(i, i.saturating_sub(1)));
    }
}

/// The grids from the finest to the coarsest.
pub(super) struct Multigrid<T> {
    levels: Vec<Grid<T>>,
    /// Rooms of a line.
    rooms: [Vec<T>; LINES],
}

impl<T: Real> Multigrid<T> {
    pub fn from_network(network: Network<T>) -> Multigrid<T> {
        let rooms = [(); LINES].map(|()| vec![T::zero(); network.long]);
        let mut levels = vec![Grid::new(network)];
        while let Some(next) = levels.last().and_then(|grid| grid.network.coarser()) {
            levels.push(Grid::new(next));
        }
        Multigrid { levels, rooms }
    }

    /// x ≈ A⁻¹ b by one symmetric cycle.
    pub fn cycle(&mut self, b: &[f64], x: &mut [f64]) {
        self.levels[0].b.iter_mut().zip(b).for_each(|(to, b)| *to = T::nearest(*b));
        descend(&mut self.levels, &mut self.rooms);
        x.iter_mut().zip(&self.levels[0].x).for_each(|(x, from)| *x = from.wide());
    }
}

/// A sweep forwards, corrections of the coarser grid, a sweep backwards.
fn descend<T: Real>(levels: &mut [Grid<T>], rooms: &mut [Vec<T>; LINES]) {
    let Some((grid, coarser)) = levels.split_first_mut() else { return };
    grid.x.fill(T::zero());
    grid.smooth(false, rooms);
    let Some(coarse_long) = coarser.first().map(|grid| grid.network.long) else {
        for _ in 0..COARSEST_SWEEPS {
            grid.smooth(true, rooms);
            grid.smooth(false, rooms);
        }
        grid.smooth(true, rooms);
        return;
    };
    for visit in 0..VISITS {
        grid.restrict(&mut coarser[0].b, coarse_long, &mut rooms[0]);
        descend(coarser, rooms);
        grid.prolong(&coarser[0].x, coarse_long);
        // what was forwards before a visit is backwards after it: the cycle is symmetric
        grid.smooth(true, rooms);
        if visit + 1 < VISITS {
            grid.smooth(false, rooms);
        }
    }
}

/// Σ a b.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
