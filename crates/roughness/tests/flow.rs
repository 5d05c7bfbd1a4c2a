//! Claims about flows: planes, steps, open and closed paths.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_roughness::flow::{Axis, Constriction, Gap, constriction, leak};
use asperity_roughness::half_space::HalfSpace;
use asperity_roughness::{Grid, Kind, Load, Surface, Target, generate};

fn gap(nodes: [usize; 2], periodic: bool, values: &[f32]) -> Gap<'_> {
    Gap { nodes, pixel: [2e-6, 0.5e-6], periodic, values }
}

/// Poiseuille: flux times viscosity over pressure difference is g³/12 times width over length.
#[test]
fn parallel_planes_leak_as_poiseuille_says() {
    for (nodes, periodic) in [([64, 40], false), ([37, 21], true), ([1, 5], false), ([5, 1], true)] {
        let values = vec![3e-7; nodes[0] * nodes[1]];
        let map = gap(nodes, periodic, &values);
        let size = [nodes[0] as f64 * 2e-6, nodes[1] as f64 * 0.5e-6];
        for (axis, shape) in [(Axis::X, size[1] / size[0]), (Axis::Y, size[0] / size[1])] {
            let found = leak(&map, axis).unwrap();
            let exact = f64::from(3e-7f32).powi(3) / 12.0 * shape;
            assert!((found.conductance / exact - 1.0).abs() < 1e-8, "{nodes:?} {axis:?} {found:?}");
            assert!((found.hydraulic_gap / 3e-7 - 1.0).abs() < 1e-6);
        }
    }
}

/// Two halves with gaps a and b, one after the other: resistances add; side by side: conductances do.
#[test]
fn steps_leak_in_series_and_in_parallel() {
    let (a, b) = (2e-7f32, 5e-7f32);
    let values: Vec<f32> = (0..32 * 16).map(|i| if i % 32 < 16 { a } else { b }).collect();
    let map = gap([32, 16], true, &values);
    let cube = |g: f32| f64::from(g).powi(3) / 12.0;
    let series = 2.0 / (1.0 / cube(a) + 1.0 / cube(b)) * (8e-6 / 64e-6);
    let parallel = 0.5 * (cube(a) + cube(b)) * (64e-6 / 8e-6);
    for (axis, exact) in [(Axis::X, series), (Axis::Y, parallel)] {
        let found = leak(&map, axis).unwrap();
        assert!((found.conductance / exact - 1.0).abs() < 1e-8, "{axis:?} {found:?} {exact}");
    }
    assert_eq!(constriction(&map, Axis::X).unwrap().gap, f64::from(a));
    assert_eq!(constriction(&map, Axis::Y).unwrap().gap, f64::from(b));
}

#[test]
fn a_wall_is_tight_and_a_hole_in_it_is_the_constriction() {
    let mut values = vec![1e-6f32; 20 * 12];
    (0..12).for_each(|row| values[row * 20 + 7] = 0.0);
    let wall = gap([20, 12], false, &values);
    assert!(leak(&wall, Axis::X).is_none() && constriction(&wall, Axis::X).is_none());
    assert!(leak(&wall, Axis::Y).is_some());
    let mut holed = values.clone();
    holed[5 * 20 + 7] = 2e-7;
    let holed = gap([20, 12], false, &holed);
    let narrowest = constriction(&holed, Axis::X).unwrap();
    assert_eq!((narrowest.at, narrowest.gap), ([7, 5], f64::from(2e-7f32)));
    // one pixel from wall to wall, however long along the flow; a slot of three of them has three
    assert!((narrowest.width / 0.5e-6 - 1.0).abs() < 1e-12, "{narrowest:?}");
    let mut slot = values.clone();
    (4..7).for_each(|row| slot[row * 20 + 7] = if row == 5 { 2e-7 } else { 1e-7 });
    let slot = gap([20, 12], false, &slot);
    assert!((constriction(&slot, Axis::X).unwrap().width / 1.5e-6 - 1.0).abs() < 1e-12);
    // diagonal neighbours do not join
    let corner: Vec<f32> = vec![1e-6, 0.0, 0.0, 1e-6];
    assert!(constriction(&gap([2, 2], false, &corner), Axis::X).is_none());
    let nothing = vec![f32::NAN; 4];
    assert!(leak(&gap([2, 2], true, &nothing), Axis::X).is_none());
}

/// A wave over the open pixels that are at least so wide, one step at a time: whether it crosses.
fn crosses(map: &Gap<'_>, axis: Axis, least: f32) -> bool {
    let [nx, ny] = map.nodes;
    let wide = |i: usize| map.values[i] >= least && map.values[i] > 0.0;
    let entry = |i: usize| if axis == Axis::X { i.is_multiple_of(nx) } else { i < nx };
    let exit = |i: usize| if axis == Axis::X { i % nx == nx - 1 } else { i / nx == ny - 1 };
    let joined = |i: usize, j: usize| {
        let apart = |a: usize, b: usize, n: usize, ring: bool| {
            let d = a.abs_diff(b);
            if ring { d.min(n - d) } else { d }
        };
        let ring = |other: Axis| map.periodic && axis == other;
        apart(i % nx, j % nx, nx, ring(Axis::Y)) + apart(i / nx, j / nx, ny, ring(Axis::X)) == 1
    };
    let mut wet: Vec<bool> = (0..nx * ny).map(|i| wide(i) && entry(i)).collect();
    loop {
        let next =
            (0..nx * ny).find(|i| wide(*i) && !wet[*i] && (0..nx * ny).any(|j| wet[j] && joined(*i, j)));
        match next {
            Some(i) => wet[i] = true,
            None => return (0..nx * ny).any(|i| wet[i] && exit(i)),
        }
    }
}

/// Against the definition, on maps of few gaps that are often equal: a path crosses as wide as the
/// constriction, none wider.
#[test]
fn no_path_is_wider_than_the_constriction() {
    let mut state = 7u32;
    let mut drawn = |n: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 16) % n
    };
    for _ in 0..200 {
        let nodes = [1 + drawn(6) as usize, 1 + drawn(6) as usize];
        let values: Vec<f32> = (0..nodes[0] * nodes[1]).map(|_| drawn(6) as f32).collect();
        let map = gap(nodes, drawn(2) == 0, &values);
        for axis in [Axis::X, Axis::Y] {
            let widest = (1..6).rev().map(|k| k as f32).find(|least| crosses(&map, axis, *least));
            let found = constriction(&map, axis);
            assert_eq!(found.map(|c| c.gap as f32), widest, "{map:?} {axis:?}");
            if let Some(Constriction { at: [x, y], gap, .. }) = found {
                assert_eq!(f64::from(values[y * nodes[0] + x]), gap);
            }
        }
    }
}

/// The gap of a rough surface: what enters leaves, the constriction bounds the path, more load leaks less.
#[test]
fn a_rough_gap_balances_and_closes_with_the_load() {
    let grid = Grid { nodes: [160, 130], pixel: [1e-6, 1e-6], seed: 5 };
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 24e-6, cutoff: 8e-6 };
    let map = generate(kind, &grid, Target::Height(1e-6)).unwrap().with_periodic(true);
    let surface = Surface::from_map(map).unwrap();
    let body = HalfSpace { reduced_modulus: 1e11, limit: None, tolerance: 1e-5 };
    let mut last = f64::INFINITY;
    for share in [0.02, 0.06, 0.1] {
        let load = Load::Pressure(share * 1e11 * surface.parameters.rms_gradient);
        let found = body.press(&surface, load).unwrap();
        let map = Gap::new(&surface.map, &found.gaps);
        for axis in [Axis::X, Axis::Y] {
            let flow = leak(&map, axis).unwrap();
            assert!(flow.imbalance < 1e-4 && flow.hydraulic_gap < found.mean_gap, "{flow:?}");
            assert!(constriction(&map, axis).unwrap().gap > 0.3 * flow.hydraulic_gap);
        }
        let flow = leak(&map, Axis::X).unwrap().conductance;
        assert!(flow < 0.5 * last);
        last = flow;
    }
}

/// Points without a height are closed to the flow; its error reaches to the map that was measured whole.
#[test]
fn missing_points_widen_the_error_of_a_leak() {
    let whole: Vec<f32> = (0..60 * 40).map(|i| 1e-6 * (1.5 + (0.3 * (i % 60) as f32).sin())).collect();
    let mut holed = whole.clone();
    (0..36).for_each(|row| holed[row * 60 + 20] = f32::NAN);
    let [whole, holed] = [whole, holed].map(|values| leak(&gap([60, 40], false, &values), Axis::X).unwrap());
    let off = (whole.conductance / holed.conductance).ln().abs();
    assert!(off > 0.2 && off <= holed.error.ln_1p(), "{whole:?} {holed:?}");
    assert!(whole.error < 0.1, "{whole:?}");
}

/// The values of a map of `nodes`, each taken from the place `at` its own.
fn turned(nodes: [usize; 2], values: &[f32], at: impl Fn(usize, usize) -> [usize; 2]) -> Vec<f32> {
    let [nx, ny] = nodes;
    let from = |i: usize| {
        let [x, y] = at(i % nx, i / nx);
        values[y * nx + x]
    };
    (0..nx * ny).map(from).collect()
}

/// A surface leaks the same seen from the other end, from the other side, with its axes exchanged and, where
/// it is periodic, from any place on; so does its constriction, and so do their errors.
#[test]
fn a_leak_knows_no_side_and_no_beginning() {
    // even, so that pixels twice as wide begin at either end
    let [nx, ny] = [48, 40];
    let height = |i: usize| {
        let (x, y) = ((i % nx) as f32 / nx as f32, (i / nx) as f32 / ny as f32);
        let wave = |kx: f32, ky: f32, phase: f32| (std::f32::consts::TAU * (kx * x + ky * y) + phase).sin();
        1e-6 * (0.7 + wave(1.0, 2.0, 0.3) + 0.7 * wave(3.0, -1.0, 1.0) + 0.5 * wave(-2.0, 5.0, 2.0)).max(0.0)
    };
    let mut whole: Vec<f32> = (0..nx * ny).map(height).collect();
    // a point that was not measured
    whole[7 * nx + 11] = f32::NAN;
    let of = |periodic: bool, values: &[f32], axis: Axis| {
        let map = gap([nx, ny], periodic, values);
        let (flow, narrow) = (leak(&map, axis).unwrap(), constriction(&map, axis).unwrap());
        [flow.conductance, flow.hydraulic_gap, 1.0 + flow.error, narrow.gap, narrow.width]
    };
    let same = |one: [f64; 5], other: [f64; 5], what: &str| {
        for (a, b) in one.into_iter().zip(other) {
            // grids of an error's own halves begin at one end
            assert!((a / b - 1.0).abs() < 1e-3, "{what}: {one:?} {other:?}");
        }
        assert!((one[0] / other[0] - 1.0).abs() < 1e-6, "{what}: {one:?} {other:?}");
    };
    for (periodic, axis) in [false, true].into_iter().flat_map(|p| [(p, Axis::X), (p, Axis::Y)]) {
        let own = of(periodic, &whole, axis);
        let ends = turned([nx, ny], &whole, |x, y| [nx - 1 - x, y]);
        same(own, of(periodic, &ends, axis), "other end");
        let sides = turned([nx, ny], &whole, |x, y| [x, ny - 1 - y]);
        same(own, of(periodic, &sides, axis), "other side");
        let (swapped, across) = (
            (0..nx * ny).map(|i| whole[i % ny * nx + i / ny]).collect::<Vec<_>>(),
            match axis {
                Axis::X => Axis::Y,
                Axis::Y => Axis::X,
            },
        );
        let map = Gap { nodes: [ny, nx], pixel: [0.5e-6, 2e-6], periodic, values: &swapped };
        let (flow, narrow) = (leak(&map, across).unwrap(), constriction(&map, across).unwrap());
        let other = [flow.conductance, flow.hydraulic_gap, 1.0 + flow.error, narrow.gap, narrow.width];
        same(own, other, "axes exchanged");
        if periodic {
            // across the flow alone: along it the pressure falls over the map
            let moved = turned([nx, ny], &whole, |x, y| match axis {
                Axis::X => [x, (y + 12) % ny],
                Axis::Y => [(x + 12) % nx, y],
            });
            same(own, of(periodic, &moved, axis), "another beginning");
        }
    }
}

/// Conductance of the network of `map` along x by elimination: columns joined in series, pressures given on
/// both sides.
fn eliminated(map: &Gap) -> f64 {
    let [nx, ny] = map.nodes;
    let cube = |i: usize| f64::from(map.values[i].max(0.0)).powi(3) / 12.0;
    let series = |a: f64, b: f64| if a * b > 0.0 { 2.0 * a * b / (a + b) } else { 0.0 };
    let ratio = map.pixel[1] / map.pixel[0];
    let mut rows = vec![vec![0.0; nx * ny + 1]; nx * ny];
    // what is joined to no side has pressure 0
    (0..nx * ny).for_each(|i| rows[i][i] = 1e-34);
    let mut join = |i: usize, j: usize, g: f64| {
        rows[i][i] += g;
        rows[j][j] += g;
        rows[i][j] -= g;
        rows[j][i] -= g;
    };
    for i in 0..nx * ny {
        if i % nx + 1 < nx {
            join(i, i + 1, ratio * series(cube(i), cube(i + 1)));
        }
        if i + nx < nx * ny || map.periodic {
            let next = (i + nx) % (nx * ny);
            join(i, next, series(cube(i), cube(next)) / ratio);
        }
    }
    let entry = |line: usize| 2.0 * ratio * cube(line * nx);
    for line in 0..ny {
        let (first, last) = (line * nx, line * nx + nx - 1);
        rows[first][first] += entry(line);
        rows[last][last] += 2.0 * ratio * cube(last);
        rows[first][nx * ny] = entry(line);
    }
    for pivot in 0..nx * ny {
        let upper = rows[pivot].clone();
        for row in rows.iter_mut().enumerate().filter(|(i, _)| *i != pivot).map(|(_, row)| row) {
            let factor = row[pivot] / upper[pivot];
            if factor != 0.0 {
                (pivot..=nx * ny).for_each(|j| row[j] -= factor * upper[j]);
            }
        }
    }
    (0..ny).map(|line| entry(line) * (1.0 - rows[line * nx][nx * ny] / rows[line * nx][line * nx])).sum()
}

/// Gentle gaps, whose search runs in single precision, and gaps that differ by a factor of 200, with islands.
#[test]
fn the_search_finds_the_flow_of_an_elimination() {
    for (nodes, periodic) in [([26, 15], true), ([17, 22], false)] {
        for (contrast, islands) in [(0.3, 0.0), (1.8, 0.25)] {
            let height = |i: usize| {
                let (x, y) = ((i % nodes[0]) as f64, (i / nodes[0]) as f64);
                let noise = (12.9898 * x + 78.233 * y).sin() * 43758.5453;
                let wave = (0.7 * x + 0.2).sin() * (0.9 * y).cos() + noise.fract();
                let open = (3.1 * noise).fract().abs() > islands || i.is_multiple_of(3);
                if open { (1e-6 * (contrast * wave).exp()) as f32 } else { 0.0 }
            };
            let values: Vec<f32> = (0..nodes[0] * nodes[1]).map(height).collect();
            let map = gap(nodes, periodic, &values);
            let (found, exact) = (leak(&map, Axis::X).unwrap(), eliminated(&map));
            assert!((found.conductance / exact - 1.0).abs() < 1e-6, "{contrast} {found:?} {exact}");
            assert!(found.imbalance < 1e-3, "{found:?}");
        }
    }
}
