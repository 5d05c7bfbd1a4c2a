//! Claims of the half-space: closed forms, bounds, the same bits for any number of threads.
//!
//! Sources: Johnson, Contact Mechanics (1985): Hertz ch. 4, cone ch. 5 (Sneddon 1965), wave ch. 13
//! (Westergaard 1939).

use super::*;
use crate::{Grid, HeightMap, Kind, Load, Surface, Target, generate};
use asperity_numerics::bisection::bisect;
use std::f64::consts::PI;

const MODULUS: f64 = 2e11;

fn elastic(tolerance: f64) -> HalfSpace {
    HalfSpace { reduced_modulus: MODULUS, limit: None, tolerance }
}

/// A square map of `n` nodes, `pixel` apart, of heights by the distance from its middle.
fn round(n: usize, pixel: f64, height: impl Fn(f64) -> f64) -> Surface {
    let middle = (n as f64 - 1.0) / 2.0;
    let at = |i: usize| {
        let (x, y) = ((i % n) as f64 - middle, (i / n) as f64 - middle);
        height(pixel * (x * x + y * y).sqrt())
    };
    Surface::from_map(HeightMap::new(n, n, [pixel, pixel], (0..n * n).map(at).collect()).unwrap()).unwrap()
}

fn close(name: &str, found: f64, wanted: f64, tolerance: f64) {
    assert!((found / wanted - 1.0).abs() < tolerance, "{name}: {found:e} against {wanted:e}");
}

#[test]
fn a_sphere_follows_hertz() {
    let (n, pixel, radius, a): (usize, f64, f64, f64) = (256, 1e-6, 2e-3, 80e-6);
    let surface = round(n, pixel, |r| -r * r / (2.0 * radius));
    let force = 4.0 / 3.0 * MODULUS * a.powi(3) / radius;
    let nominal = (n as f64 * pixel).powi(2);
    let found = elastic(1e-6).press(&surface, Load::Pressure(force / nominal)).unwrap();
    close("area", found.area.corrected * nominal, PI * a * a, 5e-3);
    close("pressure", found.largest_pressure, 2.0 * MODULUS * a / (PI * radius), 5e-3);
    close("mean pressure", found.mean_pressure().unwrap(), force / (PI * a * a), 1e-2);
    // first touch is the highest node, half a pixel off the middle
    let approach = -(found.separation + surface.parameters.mean);
    close("approach", approach, a * a / radius, 5e-3);
    close("stored work", found.elastic_work, 0.4 * force * a * a / radius, 5e-3);
    // the same contact by its separation
    let again = elastic(1e-6).press(&surface, Load::Separation(found.separation)).unwrap();
    close("load at the separation", again.pressure, found.pressure, 1e-3);
}

#[test]
fn a_cone_follows_sneddon() {
    let (n, pixel, tan, a): (usize, f64, f64, f64) = (256, 1e-6, 0.05, 90e-6);
    let surface = round(n, pixel, |r| -r * tan);
    let force = PI / 2.0 * MODULUS * tan * a * a;
    let nominal = (n as f64 * pixel).powi(2);
    let found = elastic(1e-6).press(&surface, Load::Pressure(force / nominal)).unwrap();
    close("area", found.area.corrected * nominal, PI * a * a, 5e-3);
    close("depth", -(found.separation + surface.parameters.mean), PI / 2.0 * a * tan, 5e-3);
}

/// z = Δ cos(2πs/λ), contact of half width a: p = p* sin²(πa/λ), p* = πE*Δ/λ, largest pressure 2√(p p*). A
/// row of flat strips yields by λ/(πE*) ln(p*/p), the integral of which is the mean gap Δ(1 - p/p* + p/p*
/// ln(p/p*)).
#[test]
fn a_wave_follows_westergaard() {
    let (n, amplitude, pixel): (usize, f64, f64) = (256, 1e-6, 1e-6);
    // along the grid a strip is a whole number of pixels wide: area is read off waves that lie askew
    for (waves, rows) in [([1, 0], 4), ([2, 1], 251)] {
        let z = |i: usize| {
            let phase = (waves[0] * (i % n)) as f64 / n as f64 + (waves[1] * (i / n)) as f64 / rows as f64;
            amplitude * (2.0 * PI * (phase + 0.3 / n as f64)).cos()
        };
        let map = HeightMap::new(n, rows, [pixel, pixel], (0..n * rows).map(z).collect()).unwrap();
        let surface = Surface::from_map(map.with_periodic(true)).unwrap();
        let length = n as f64 * pixel / f64::hypot(waves[0] as f64, waves[1] as f64 * n as f64 / rows as f64);
        let full = PI * MODULUS * amplitude / length;
        for share in [0.05f64, 0.3, 0.8] {
            let found = elastic(1e-7).press(&surface, Load::Pressure(share * full)).unwrap();
            close("pressure", found.largest_pressure, 2.0 * share.sqrt() * full, 5e-3);
            let gap = amplitude * (1.0 - share + share * share.ln());
            close("mean gap", found.mean_gap, gap, 5e-3);
            assert!((found.mean_gap - found.separation).abs() < 1e-6 * amplitude);
            let stiffness = PI * MODULUS / (length * (1.0 / share).ln());
            // the logarithm of a pixel more or less in the width of the strips
            close("stiffness", found.stiffness.unwrap(), stiffness, 1e-2);
            let width = 2.0 / PI * share.sqrt().asin();
            if waves[1] > 0 {
                close("area", found.area.corrected, width, 5e-3);
            }
        }
        let flat = elastic(1e-7).press(&surface, Load::Pressure(1.2 * full)).unwrap();
        assert_eq!(flat.area.ratio, 1.0);
        close("full contact", flat.largest_pressure, 2.2 * full, 2e-4);
    }
}

/// Complete elliptic integrals K and E of modulus k, by the arithmetic-geometric mean (Abramowitz and Stegun
/// 17.6).
fn elliptic(k: f64) -> [f64; 2] {
    let (mut a, mut b, mut c, mut power, mut sum) = (1.0f64, (1.0 - k * k).sqrt(), k, 0.5, 0.0);
    while c.abs() > 1e-16 {
        sum += power * c * c;
        (a, b, c) = (0.5 * (a + b), (a * b).sqrt(), 0.5 * (a - b));
        power *= 2.0;
    }
    let first = PI / (2.0 * a);
    [first, first * (1.0 - sum)]
}

/// Displacement at `r` of a half-space with E* = 1 under unit pressure on a disc of radius `a` (Johnson 1985,
/// ch. 3.4).
fn under_disc(r: f64, a: f64) -> f64 {
    if a <= 0.0 {
        return 0.0;
    }
    if r < a {
        return 4.0 * a / PI * elliptic(r / a)[1];
    }
    let k = (a / r).min(1.0 - 1e-15);
    let [first, second] = elliptic(k);
    4.0 * r / PI * (second - (1.0 - k * k) * first)
}

/// Area and approach of a sphere of curvature radius 1 whose pressure is limited, on rings: E* = 1, `force`
/// given.
fn saturated_rings(limit: f64, force: f64, outer: f64) -> (f64, f64) {
    let m = 400;
    let width = outer / m as f64;
    let middle: Vec<f64> = (0..m).map(|i| (i as f64 + 0.5) * width).collect();
    let matrix: Vec<Vec<f64>> = middle
        .iter()
        .map(|r| {
            (0..m)
                .map(|j| under_disc(*r, (j + 1) as f64 * width) - under_disc(*r, j as f64 * width))
                .collect()
        })
        .collect();
    let ring = |j: usize| PI * width * width * (2 * j + 1) as f64;
    let mut p = vec![0.0; m];
    let carried = |p: &mut Vec<f64>, depth: f64| {
        for _ in 0..4000 {
            let mut moved: f64 = 0.0;
            for i in 0..m {
                let lift: f64 = matrix[i].iter().zip(p.iter()).map(|(a, p)| a * p).sum();
                let gap = lift + 0.5 * middle[i] * middle[i] - depth;
                let next = (p[i] - gap / matrix[i][i]).clamp(0.0, limit);
                moved = moved.max((next - p[i]).abs());
                p[i] = next;
            }
            if moved < 1e-9 * limit {
                break;
            }
        }
        p.iter().enumerate().map(|(j, p)| p * ring(j)).sum::<f64>()
    };
    let [_, high] = bisect([0.0, outer * outer], 40, |depth| carried(&mut p, depth) < force);
    // towards the rim the square of the pressure falls linearly
    let last = p.iter().rposition(|p| *p > 1e-3 * limit).unwrap();
    let (inner, here) = (p[last - 1].powi(2), p[last].powi(2));
    let rim = middle[last] + width * here / (inner - here);
    (PI * rim * rim, high)
}

#[test]
fn a_saturated_sphere_follows_rings() {
    let (n, pixel, radius, a): (usize, f64, f64, f64) = (256, 1e-6, 2e-3, 60e-6);
    let surface = round(n, pixel, |r| -r * r / (2.0 * radius));
    let (force, peak) = (4.0 / 3.0 * MODULUS * a.powi(3) / radius, 2.0 * MODULUS * a / (PI * radius));
    let nominal = (n as f64 * pixel).powi(2);
    for share in [0.5, 0.35] {
        let body = HalfSpace { limit: Some(share * peak), ..elastic(1e-7) };
        let found = body.press(&surface, Load::Pressure(force / nominal)).unwrap();
        let (area, depth) =
            saturated_rings(share * peak / MODULUS, force / MODULUS / radius.powi(2), 110e-6 / radius);
        close("area", found.area.corrected * nominal, area * radius * radius, 5e-3);
        close("approach", -(found.separation + surface.parameters.mean), depth * radius, 5e-3);
    }
}

#[test]
fn bounds_and_load_hold_and_the_flattened_surface_carries_the_same() {
    let surface = rough(96, true);
    let limit = 0.03 * MODULUS;
    let load = Load::Pressure(0.2 * limit);
    let soft = HalfSpace { limit: Some(limit), ..elastic(1e-7) };
    let found = soft.press(&surface, load).unwrap();
    close("load", found.pressure, 0.2 * limit, 1e-9);
    assert!(found.pressures.iter().all(|p| (0.0..=(limit * (1.0 + 1e-6)) as f32).contains(p)));
    assert!(found.limited_share > 0.1 && found.limited_share < 1.0 && found.plastic_work > 0.0);
    // no area bears more than the limit, however soft the metal
    let softest = HalfSpace { limit: Some(0.1 * limit), ..elastic(1e-7) };
    for (body, share) in [(&soft, 0.2), (&softest, 0.02)] {
        let limit = body.limit.unwrap_or(f64::INFINITY);
        let area = body.press(&surface, Load::Pressure(share * limit)).unwrap().area;
        // the load is met to 1e-7
        assert!(area.corrected >= share * (1.0 - 1e-6) && area.corrected <= area.ratio, "{area:?}");
    }
    // unloading is elastic on what the flow left: the load is carried by the same pressures, none of them
    // above the limit
    let left = found.flattened_surface(&surface).unwrap();
    let again = elastic(1e-7).press(&left, load).unwrap();
    close("area again", again.area.ratio, found.area.ratio, 2e-3);
    assert!(again.largest_pressure < 1.01 * limit);
    // a limit that no pixel reaches is none
    let hard = HalfSpace { limit: Some(MODULUS), ..elastic(1e-7) };
    let (hard, free) = (hard.press(&surface, load).unwrap(), elastic(1e-7).press(&surface, load).unwrap());
    assert_eq!(hard.area, free.area);
    assert!(found.area.ratio > 1.2 * free.area.ratio && found.mean_gap < free.mean_gap);
}

/// A periodic (or free) rough map of `n` nodes, pixel 1 µm.
fn rough(n: usize, periodic: bool) -> Surface {
    let grid = Grid { nodes: [n, n], pixel: [1e-6, 1e-6], seed: 7 };
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 40e-6, cutoff: 6e-6 };
    Surface::from_map(generate(kind, &grid, Target::Height(0.3e-6)).unwrap().with_periodic(periodic)).unwrap()
}

/// A free map without long waves sinks by a hundred times its heights: rounding in `f32` leaves more than the
/// tolerance.
#[test]
fn a_map_that_sinks_far_is_found_to_the_tolerance() {
    let grid = Grid { nodes: [256, 256], pixel: [1e-6, 1e-6], seed: 3 };
    let kind = Kind::SelfAffine { hurst: 0.2, rolloff: 4e-6, cutoff: 2e-6 };
    let surface = Surface::from_map(generate(kind, &grid, Target::Slope(0.07)).unwrap()).unwrap();
    let found = elastic(TOLERANCE).press(&surface, Load::Pressure(0.01 * MODULUS)).unwrap();
    assert!(found.pressure_error <= TOLERANCE && found.convolutions < 400, "{found:?}");
}

#[test]
fn the_bits_are_those_of_one_thread() {
    for (periodic, limit) in [(true, None), (false, Some(0.02 * MODULUS))] {
        let surface = rough(130, periodic);
        let body = HalfSpace { limit, ..elastic(1e-5) };
        let press = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| body.press(&surface, Load::Pressure(1e9)).unwrap())
        };
        let (one, three) = (press(1), press(3));
        assert_eq!(one.pressures, three.pressures);
        assert_eq!((one.separation, one.stiffness), (three.separation, three.stiffness));
    }
}

#[test]
fn holes_carry_nothing_and_extremes_have_an_answer() {
    let surface = rough(64, false);
    let mut heights = surface.map.heights().to_vec();
    heights[..64 * 20].fill(f64::NAN);
    let holed = Surface::from_map(surface.map.with_heights(heights).unwrap()).unwrap();
    let found = elastic(1e-6).press(&holed, Load::Pressure(1e9)).unwrap();
    assert!(found.pressures[..64 * 20].iter().all(|p| *p == 0.0) && found.gaps[0].is_nan());
    close("load on what is used", found.pressure, 1e9, 1e-6);
    assert_eq!(found.pixels, 64 * 44);
    let untouched = elastic(1e-6).press(&surface, Load::Pressure(0.0)).unwrap();
    assert_eq!((untouched.area.ratio, untouched.stiffness), (0.0, None));
    close("first touch", untouched.separation, surface.extent.high - surface.parameters.mean, 1e-9);
    let soft = HalfSpace { limit: Some(1e9), ..elastic(1e-6) };
    assert!(matches!(soft.press(&surface, Load::Pressure(1.1e9)), Err(HalfSpaceError::Limit { .. })));
    assert!(soft.press(&surface, Load::Pressure(0.995e9)).unwrap().area.ratio > 0.994);
    let periodic = rough(64, true);
    let below = elastic(1e-6).press(&periodic, Load::Separation(-1e-7));
    assert!(matches!(below, Err(HalfSpaceError::Closed { .. })));
    let flat = Surface::from_map(HeightMap::new(40, 3, [1e-6, 1e-3], vec![1e-6; 120]).unwrap()).unwrap();
    assert_eq!(elastic(1e-6).press(&flat, Load::Pressure(1e6)).unwrap().area.ratio, 1.0);
    for bad in [HalfSpace { reduced_modulus: f64::NAN, ..soft }, HalfSpace { tolerance: 0.0, ..soft }] {
        assert!(matches!(bad.press(&surface, Load::Pressure(1e6)), Err(HalfSpaceError::Value { .. })));
    }
}

/// From a few saturated summits to nearly all of the surface at the limit.
#[test]
fn any_load_below_the_limit_is_found() {
    for periodic in [true, false] {
        let surface = rough(64, periodic);
        for limit in [3e8, 1e9, 6e9] {
            for share in [0.01, 0.5, 0.8, 0.97, 0.995] {
                let soft = HalfSpace { limit: Some(limit), ..elastic(1e-6) };
                let found = soft.press(&surface, Load::Pressure(share * limit)).unwrap();
                close("load", found.pressure, share * limit, 1e-6);
                assert!(found.pressure_error <= 1e-6 && found.area.ratio >= share, "{found:?}");
            }
        }
    }
}

/// Waves z = Σ a cos(q·x): full contact has p = P + Σ E* |q|/2 a cos(q·x), whatever the load, and no gap.
#[test]
fn full_contact_is_its_closed_form_at_any_load() {
    let (n, amplitude): (usize, f64) = (96, 0.1e-6);
    for pixel in [[1e-6, 1e-6], [1e-6, 0.2e-6]] {
        let waves = [([3.0, 1.0], 1.0), ([7.0, -5.0], 0.4), ([20.0, 11.0], 0.1)];
        let sum = |i: usize, gain: &dyn Fn(f64) -> f64| -> f64 {
            let wave = |(k, a): &([f64; 2], f64)| {
                let [qx, qy] = [0, 1].map(|axis| 2.0 * PI * k[axis] / (n as f64 * pixel[axis]));
                let phase = qx * (i % n) as f64 * pixel[0] + qy * (i / n) as f64 * pixel[1];
                a * amplitude * gain(qx.hypot(qy)) * phase.cos()
            };
            waves.iter().map(wave).sum()
        };
        let z = (0..n * n).map(|i| sum(i, &|_| 1.0)).collect();
        let surface = Surface::from_map(HeightMap::new(n, n, pixel, z).unwrap().with_periodic(true)).unwrap();
        let unit = MODULUS * surface.parameters.rms_gradient;
        for ratio in [3.0, 10.0, 30.0, 100.0, 1e6] {
            let load = ratio * unit;
            for limit in [None, Some(5.0 * load)] {
                let body = HalfSpace { limit, ..elastic(TOLERANCE) };
                let found = body.press(&surface, Load::Pressure(load)).unwrap();
                assert!(found.convolutions <= 10 && found.pressure_error <= TOLERANCE, "{ratio} {found:?}");
                assert_eq!((found.area.ratio, found.area.error), (1.0, 0.0));
                close("load", found.pressure, load, 1e-9);
                for (i, p) in found.pressures.iter().enumerate() {
                    let exact = load + sum(i, &|q| 0.5 * MODULUS * q);
                    // pressures are kept with seven digits
                    assert!(
                        (f64::from(*p) - exact).abs() < 1e-6 * exact.max(load),
                        "{ratio} {i} {p} {exact}"
                    );
                }
            }
        }
    }
}

/// A narrow pit that loads far beyond the mean slope do not close: the rest is in full contact.
#[test]
fn a_pit_stays_open_under_loads_that_close_all_else() {
    let n = 128;
    let z = |i: usize| {
        let (x, y) = ((i % n) as f64 - 40.0, (i / n) as f64 - 70.0);
        let wave = (2.0 * PI * (3 * (i % n) + 2 * (i / n)) as f64 / n as f64).cos();
        (1e-3 * wave - (-(x * x + y * y) / 8.0).exp()) * 1e-6
    };
    let map = HeightMap::new(n, n, [1e-6; 2], (0..n * n).map(z).collect()).unwrap().with_periodic(true);
    let surface = Surface::from_map(map).unwrap();
    let unit = MODULUS * surface.parameters.rms_gradient;
    let mut last = 0.0;
    for ratio in [3.0, 6.0, 10.0] {
        let found = elastic(TOLERANCE).press(&surface, Load::Pressure(ratio * unit)).unwrap();
        assert!(found.pressure_error <= TOLERANCE && found.convolutions < 100, "{ratio} {found:?}");
        assert!(found.area.ratio > last && found.area.ratio < 1.0, "{ratio} {:?}", found.area);
        assert!(found.pressures.iter().all(|p| *p >= 0.0));
        close("load", found.pressure, ratio * unit, 1e-7);
        last = found.area.ratio;
    }
}

/// Lines a thousand pixels apart are found, or refused for what they are.
#[test]
fn long_pixels_work_or_are_refused_with_their_reason() {
    let rough = rough(32, true);
    for ratio in [0.1, 10.0, 1e3] {
        let heights = rough.map.heights().to_vec();
        let map = HeightMap::new(32, 32, [1e-6, ratio * 1e-6], heights).unwrap().with_periodic(true);
        let surface = Surface::from_map(map).unwrap();
        let load = 0.02 * MODULUS * surface.parameters.rms_gradient;
        match elastic(TOLERANCE).press(&surface, Load::Pressure(load)) {
            Ok(found) => assert!(found.pressure_error <= TOLERANCE),
            Err(HalfSpaceError::LongPixels { ratio: told, .. }) => close("sides", told, 1e3, 1e-9),
            Err(other) => panic!("{ratio}: {other}"),
        }
    }
}

/// The residual counts in root mean squares of the heights about their mean, missing points left out.
#[test]
fn heights_are_measured_about_their_mean() {
    let wave = |i: usize| 2e-6 + 0.3e-6 * (2.0 * PI * (i % 40) as f64 / 40.0).cos();
    let mut z: Vec<f64> = (0..40 * 8).map(wave).collect();
    z[40..80].fill(f64::NAN);
    let (mean, rms) = super::cascade::spread(&z);
    close("mean", mean, 2e-6, 1e-9);
    close("root mean square", rms, 0.3e-6 / 2.0f64.sqrt(), 1e-9);
}
