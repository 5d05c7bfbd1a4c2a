//! Reynolds flow through a gap.

use super::gap::{Axis, Gap, Oriented};
use super::multigrid::{Multigrid, Network, dot};

/// Relative error of the flux at which the search ends: that of the pressures is its root.
const TOLERANCE: f64 = 1e-9;
/// The same of a flow that tells an error alone.
const ERROR_TOLERANCE: f64 = 1e-4;
/// Iterations at most.
const ITERATIONS: usize = 500;

/// A flow along one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leak {
    /// Volume flux times viscosity over pressure difference, in m³.
    pub conductance: f64,
    /// The gap between parallel planes of the same size that leaks as much, in metres.
    pub hydraulic_gap: f64,
    /// Bound of its error by the pixels and by points without a height: the true conductance lies between
    /// this over 1 + error and this times 1 + error. Infinite where nothing bounds it.
    pub error: f64,
    /// Relative difference of what enters and leaves.
    pub imbalance: f64,
    /// Iterations.
    pub iterations: usize,
}

/// The flow along `axis` through `gap`, the pressure given on both sides that it joins, nothing passing the
/// other two unless they are joined to a ring; None where nothing passes.
///
/// ∇·(g³/12 ∇p) = 0 on the open pixels, conductances of neighbours in series; the part of the gap that joins
/// both sides alone. Solved by conjugate gradients, preconditioned by a multigrid cycle. A gap of the same
/// height everywhere leaks g³/12 times width over length exactly.
///
/// The error is what the flow changes on pixels twice as wide that let through as much, and what it changes
/// there when the points without a height, closed else, have the gap of their rims.
pub fn leak(gap: &Gap, axis: Axis) -> Option<Leak> {
    let found = flow(gap, axis, TOLERANCE)?;
    Some(Leak { error: error(gap, axis, found.conductance), ..found })
}

fn error(gap: &Gap, axis: Axis, conductance: f64) -> f64 {
    let change =
        |from: f64, to: Option<Leak>| to.map_or(f64::INFINITY, |to| (to.conductance / from).ln().abs());
    let wide = gap.halved(true);
    let coarse = flow(&wide.gap(), axis, ERROR_TOLERANCE);
    let pixels = change(conductance, coarse);
    if !gap.values.iter().any(|g| g.is_nan()) {
        return pixels.exp_m1();
    }
    let filled = gap.halved(false).filled();
    let open = filled.and_then(|filled| flow(&filled.gap(), axis, ERROR_TOLERANCE));
    let missing = coarse.map_or(f64::INFINITY, |coarse| change(coarse.conductance, open));
    (pixels + missing).exp_m1()
}

/// The flow without its error.
fn flow(gap: &Gap, axis: Axis, tolerance: f64) -> Option<Leak> {
    let mut map = gap.oriented(axis);
    keep_crossing(&mut map);
    let largest = map.gaps.iter().copied().fold(0.0, f64::max);
    if largest <= 0.0 {
        return None;
    }
    let (network, entry) = network(&map, largest);
    let (conductance, imbalance, iterations) = solve(network, &entry, tolerance);
    let conductance = conductance * largest.powi(3) / 12.0;
    let shape = map.wide as f64 * map.pixel[1] / (map.long as f64 * map.pixel[0]);
    let hydraulic_gap = (12.0 * conductance / shape).cbrt();
    Some(Leak { conductance, hydraulic_gap, error: 0.0, imbalance, iterations })
}

/// Closes every pixel that is not joined to both ends.
fn keep_crossing(map: &mut Oriented) {
    let n = map.gaps.len();
    let reached = |from: usize| {
        let mut seen = vec![false; n];
        let mut stack: Vec<usize> = (0..map.wide).map(|line| line * map.long + from).collect();
        while let Some(i) = stack.pop() {
            if seen[i] || map.gaps[i] <= 0.0 {
                continue;
            }
            seen[i] = true;
            let back = (i % map.long > 0).then(|| i - 1);
            let below =
                if i >= map.long { Some(i - map.long) } else { map.periodic.then(|| n - map.long + i) };
            stack.extend([back, below, map.ahead(i), map.next_line(i)].into_iter().flatten());
        }
        seen
    };
    let (first, last) = (reached(0), reached(map.long - 1));
    map.gaps.iter_mut().zip(first.iter().zip(last)).for_each(|(g, (a, b))| {
        if !(*a && b) {
            *g = 0.0;
        }
    });
}

/// The network of `map` with gaps in units of `largest`, and the conductance of each cell to where the fluid
/// enters.
fn network(map: &Oriented, largest: f64) -> (Network, Vec<f64>) {
    let ratio = map.pixel[1] / map.pixel[0];
    let cube: Vec<f64> = map.gaps.iter().map(|g| (g / largest).powi(3)).collect();
    let series = |a: f64, b: f64| if a > 0.0 && b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 };
    let n = cube.len();
    let ahead = |i: usize| map.ahead(i).map_or(0.0, |j| ratio * series(cube[i], cube[j]));
    let beside = |i: usize| map.next_line(i).map_or(0.0, |j| series(cube[i], cube[j]) / ratio);
    let mut entry = vec![0.0; n];
    let mut ends = vec![0.0; n];
    for line in 0..map.wide {
        let (first, last) = (line * map.long, (line + 1) * map.long - 1);
        entry[first] = 2.0 * ratio * cube[first];
        ends[first] += entry[first];
        ends[last] += 2.0 * ratio * cube[last];
    }
    let [ahead, beside] = [(0..n).map(ahead).collect::<Vec<f64>>(), (0..n).map(beside).collect::<Vec<f64>>()];
    (Network::new(map.long, map.wide, ahead, beside, ends), entry)
}

/// The flow from pressure 1 at the entry to 0 at the exit, to a relative `tolerance`, the relative difference
/// of both, and the iterations.
fn solve(network: Network, entry: &[f64], tolerance: f64) -> (f64, f64, usize) {
    let n = entry.len();
    let long = network.long;
    let mut grids = Multigrid::from_network(network);
    let mut r = entry.to_vec();
    let [mut x, mut z, mut t, mut given] = [(); 4].map(|()| vec![0.0; n]);
    // the energy of the error is the error of what enters
    let enters = |x: &[f64]| entry.iter().zip(x).step_by(long).map(|(e, p)| e * (1.0 - p)).sum::<f64>();
    let (mut last, mut iterations) = (0.0, 0);
    for iteration in 0..ITERATIONS {
        iterations = iteration;
        grids.cycle(&r, &mut z);
        let now = dot(&r, &z);
        if now <= tolerance * enters(&x) {
            break;
        }
        let beta = if last > 0.0 { now / last } else { 0.0 };
        last = now;
        t.iter_mut().zip(&z).for_each(|(t, z)| *t = z + beta * *t);
        grids.apply(&t, &mut given);
        let step = now / dot(&t, &given);
        if !step.is_finite() {
            break;
        }
        x.iter_mut().zip(&t).for_each(|(x, t)| *x += step * t);
        r.iter_mut().zip(&given).for_each(|(r, q)| *r -= step * q);
    }
    let flux = enters(&x);
    let ends = &grids.levels[0].ends;
    let leaves: f64 = x.iter().zip(entry.iter().zip(ends)).map(|(p, (entry, ends))| (ends - entry) * p).sum();
    (flux, (leaves / flux - 1.0).abs(), iterations)
}
