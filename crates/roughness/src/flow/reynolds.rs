//! Reynolds flow through a gap.

use super::gap::{Axis, Gap, Oriented};
use super::multigrid::{Multigrid, Network, dot};
use crate::half_space::Real;

/// Share of the flux that two iterations in a row change at the end of a search. On maps of 2048² points in
/// contact on 10 % the error that remains is below 1e-6, on the last percent before no path is open below
/// 1e-3, where the pixels alone make an error of percents.
const TOLERANCE: f64 = 1e-7;
/// The same on pixels twice as wide, for the error, which it is a part of, and for where the search begins.
const COARSE_TOLERANCE: f64 = 1e-6;
/// Least hydraulic gap over the largest gap with which the cycle runs in single precision. What that rounds
/// away in the widest passages must be small beside the flow: at 0.05 the search takes the same iterations
/// in both, at 0.025 it fails.
const LEAST_GAP_OF_SINGLE: f64 = 0.05;
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
/// both sides alone. Solved by conjugate gradients, preconditioned by a multigrid cycle, from the pressures
/// on pixels twice as wide. A gap of the same height everywhere leaks g³/12 times width over length exactly.
///
/// The error is what the flow changes on pixels twice as wide that let through as much, and what it changes
/// there when the points without a height, closed else, have the gap of their rims.
pub fn leak(gap: &Gap, axis: Axis) -> Option<Leak> {
    let map = crossing(gap, axis)?;
    let coarse = crossing(&gap.halved(true).gap(), axis).map(|coarse| {
        let zero = vec![0.0; coarse.gaps.len()];
        (flow::<f64>(&coarse, zero, COARSE_TOLERANCE), coarse)
    });
    let start = match &coarse {
        Some((found, coarse)) => interpolated(coarse, &found.pressures, &map),
        None => vec![0.0; map.gaps.len()],
    };
    let wide = |(found, _): &(Flow, Oriented)| found.leak.hydraulic_gap > LEAST_GAP_OF_SINGLE * map.largest();
    let flow_on_map = if coarse.as_ref().is_some_and(wide) { flow::<f32> } else { flow::<f64> };
    let found = flow_on_map(&map, start, TOLERANCE).leak;
    let coarse = coarse.map(|(found, _)| found.leak);
    Some(Leak { error: error(gap, axis, found, coarse), ..found })
}

fn error(gap: &Gap, axis: Axis, found: Leak, coarse: Option<Leak>) -> f64 {
    let change = |from: Leak, to: Option<Leak>| {
        to.map_or(f64::INFINITY, |to| (to.conductance / from.conductance).ln().abs())
    };
    let pixels = change(found, coarse) + COARSE_TOLERANCE;
    if !gap.values.iter().any(|g| g.is_nan()) {
        return pixels.exp_m1();
    }
    let filled = gap.halved(false).filled().and_then(|filled| crossing(&filled.gap(), axis));
    let open = filled.map(|filled| flow::<f64>(&filled, vec![0.0; filled.gaps.len()], COARSE_TOLERANCE).leak);
    let missing = coarse.map_or(f64::INFINITY, |coarse| change(coarse, open));
    (pixels + missing).exp_m1()
}

/// The part of `gap` that joins both ends of `axis`, the rest closed; None if there is none.
fn crossing(gap: &Gap, axis: Axis) -> Option<Oriented> {
    let mut map = gap.oriented(axis);
    keep_crossing(&mut map);
    (map.largest() > 0.0).then_some(map)
}

/// A flow without its error, and its pressures, 1 at the entry and 0 at the exit.
struct Flow {
    leak: Leak,
    pressures: Vec<f64>,
}

/// With a multigrid cycle in the numbers `T`.
fn flow<T: Real>(map: &Oriented, start: Vec<f64>, tolerance: f64) -> Flow {
    let largest = map.largest();
    let (network, entry) = network(map, largest);
    let Solution { flux, imbalance, iterations, pressures } = solve::<T>(network, &entry, start, tolerance);
    let conductance = flux * largest.powi(3) / 12.0;
    let shape = map.wide as f64 * map.pixel[1] / (map.long as f64 * map.pixel[0]);
    let hydraulic_gap = (12.0 * conductance / shape).cbrt();
    Flow { leak: Leak { conductance, hydraulic_gap, error: 0.0, imbalance, iterations }, pressures }
}

/// `pressures` of `coarse`, whose pixels are twice as wide as those of `map`, on the pixels of `map`: those
/// of the wide pixel around and, a quarter of the way, of the next ones if they are open.
fn interpolated(coarse: &Oriented, pressures: &[f64], map: &Oriented) -> Vec<f64> {
    // the wide pixel on the other side of pixel `i` than the one it lies in, on a ring
    let next = |i: usize, count: usize| (i / 2 + if i.is_multiple_of(2) { count - 1 } else { 1 }) % count;
    let value = |i: usize| {
        if map.gaps[i] <= 0.0 {
            return 0.0;
        }
        let (column, line) = (i % map.long, i / map.long);
        let row = line / 2 * coarse.long;
        let own = pressures[row + column / 2];
        let towards = |other: usize| if coarse.gaps[other] > 0.0 { pressures[other] - own } else { 0.0 };
        let ahead = match column {
            0 => 2.0 * (1.0 - own),
            _ if column + 1 == map.long => -2.0 * own,
            _ => towards(row + next(column, coarse.long)),
        };
        let edge = !map.periodic && (line == 0 || line + 1 == map.wide);
        let beside = if edge { 0.0 } else { towards(next(line, coarse.wide) * coarse.long + column / 2) };
        own + 0.25 * (ahead + beside)
    };
    (0..map.gaps.len()).map(value).collect()
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
fn network(map: &Oriented, largest: f64) -> (Network<f64>, Vec<f64>) {
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

/// The end of a search.
struct Solution {
    flux: f64,
    /// Relative difference of what enters and leaves.
    imbalance: f64,
    iterations: usize,
    pressures: Vec<f64>,
}

/// The flow from pressure 1 at the entry to 0 at the exit, from the pressures `x` on, until two iterations in
/// a row change it by a share of `tolerance` at most.
fn solve<T: Real>(network: Network<f64>, entry: &[f64], mut x: Vec<f64>, tolerance: f64) -> Solution {
    let (n, long) = (entry.len(), network.long);
    let mut grids = Multigrid::<T>::from_network(network.rounded());
    let [mut z, mut t, mut given] = [(); 3].map(|()| vec![0.0; n]);
    network.apply(&x, &mut given);
    let mut r: Vec<f64> = entry.iter().zip(&given).map(|(e, g)| e - g).collect();
    let entries = || entry.iter().step_by(long);
    // Σ e (1 - x) - r·x: of the second order in the error of the pressures
    let flux = |x: &[f64], r: &[f64]| {
        entries().zip(x.iter().step_by(long)).map(|(e, p)| e * (1.0 - p)).sum::<f64>() - dot(r, x)
    };
    let (mut last, mut changed) = (0.0, f64::INFINITY);
    let mut iterations = 0;
    while iterations < ITERATIONS {
        grids.cycle(&r, &mut z);
        let now = dot(&r, &z);
        let beta = if last > 0.0 { now / last } else { 0.0 };
        last = now;
        t.iter_mut().zip(&z).for_each(|(t, z)| *t = z + beta * *t);
        network.apply(&t, &mut given);
        let step = now / dot(&t, &given);
        if !step.is_finite() {
            break;
        }
        x.iter_mut().zip(&t).for_each(|(x, t)| *x += step * t);
        r.iter_mut().zip(&given).for_each(|(r, q)| *r -= step * q);
        iterations += 1;
        let change = step * now;
        if change.max(changed) <= tolerance * flux(&x, &r) {
            break;
        }
        changed = change;
    }
    let flux = flux(&x, &r);
    let ends = &network.ends;
    let leaves: f64 = x.iter().zip(entry.iter().zip(ends)).map(|(p, (entry, ends))| (ends - entry) * p).sum();
    Solution { flux, imbalance: (leaves / flux - 1.0).abs(), iterations, pressures: x }
}
