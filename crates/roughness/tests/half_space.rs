//! Claims of the half-space about its answers: a contact is the same from every side, its area hangs on the
//! limit of pressure by no more than it says, straight strips end within their stated error, load and
//! residual are those of the definitions. Tolerances are those of the search, others are given their reason.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_roughness::half_space::{HalfSpace, HalfSpaceError};
use asperity_roughness::{Grid, HeightMap, Kind, Load, Surface, Target, generate};
use std::f64::consts::PI;

const MODULUS: f64 = 2e11;

fn elastic(tolerance: f64) -> HalfSpace {
    HalfSpace { reduced_modulus: MODULUS, limit: None, tolerance }
}

/// A square self-affine map of 1 um pixels, its shortest wave of `cutoff` metres.
fn self_affine(nodes: usize, seed: u64, cutoff: f64) -> HeightMap {
    let grid = Grid { nodes: [nodes; 2], pixel: [1e-6; 2], seed };
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 40e-6, cutoff };
    generate(kind, &grid, Target::Height(0.3e-6)).unwrap()
}

/// The contact of a surface does not hang on the side that it is seen from, nor that of a periodic one on
/// where it begins.
#[test]
fn a_contact_knows_no_side_and_no_beginning() {
    let (nx, ny, pixel) = (54, 40, [1e-6, 1.4e-6]);
    let grid = Grid { nodes: [nx, ny], pixel, seed: 21 };
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 30e-6, cutoff: 7e-6 };
    let drawn = generate(kind, &grid, Target::Height(0.3e-6)).unwrap();
    let whole = drawn.heights().to_vec();
    // a line and a pattern of points that were not measured
    let mut holed = whole.clone();
    for i in (0..nx * ny).filter(|i| i % nx == 20 || i % 7 == 3 && i / nx % 4 == 1) {
        holed[i] = f64::NAN;
    }
    let numbers = |nodes: [usize; 2], pixel: [f64; 2], z: Vec<f64>, periodic: bool, limit: Option<f64>| {
        let map = HeightMap::new(nodes[0], nodes[1], pixel, z).unwrap().with_periodic(periodic);
        let body = HalfSpace { limit, ..elastic(1e-9) };
        let found = body.press(&Surface::from_map(map).unwrap(), Load::Pressure(8e8)).unwrap();
        let stiffness = found.stiffness.unwrap();
        [
            found.area.ratio,
            found.area.corrected,
            1.0 + found.area.error,
            found.mean_gap / 1e-7,
            found.largest_pressure / 1e9,
            found.elastic_work,
            stiffness,
            found.plane_stiffness.unwrap_or(1.0),
            1.0 + found.limited_share,
        ]
    };
    for (z, periodic, limit) in [
        (&whole, true, None),
        (&whole, false, None),
        (&whole, true, Some(6e9)),
        (&whole, false, Some(6e9)),
        (&holed, true, None),
        (&holed, false, None),
    ] {
        let of = |at: &dyn Fn(usize, usize) -> [usize; 2]| {
            let from = |i: usize| {
                let [x, y] = at(i % nx, i / nx);
                z[y * nx + x]
            };
            numbers([nx, ny], pixel, (0..nx * ny).map(from).collect(), periodic, limit)
        };
        let own = of(&|x, y| [x, y]);
        let exchanged = (0..nx * ny).map(|i| z[i % ny * nx + i / ny]).collect();
        let mut others = vec![
            of(&|x, y| [nx - 1 - x, y]),
            of(&|x, y| [x, ny - 1 - y]),
            numbers([ny, nx], [pixel[1], pixel[0]], exchanged, periodic, limit),
        ];
        if periodic {
            others.push(of(&|x, y| [(x + 17) % nx, (y + 9) % ny]));
        }
        for other in others {
            for (a, b) in own.into_iter().zip(other) {
                assert!((a / b - 1.0).abs() < 1e-4, "{periodic} {limit:?}: {own:?} {other:?}");
            }
        }
    }
}

/// From one limit to the next the area falls by no more than the sensitivity says, and by all of it where it
/// is load over limit.
#[test]
fn the_area_hangs_on_the_limit_by_no_more_than_its_sensitivity() {
    let surface = Surface::from_map(self_affine(64, 7, 6e-6).with_periodic(true)).unwrap();
    let at = |limit: f64, load: f64| {
        HalfSpace { limit: Some(limit), ..elastic(1e-9) }.press(&surface, Load::Pressure(load)).unwrap()
    };
    for share in [0.05, 0.3, 0.9] {
        let [found, harder] = [1e9, 1.01e9].map(|limit| at(limit, share * 1e9));
        let falls = (found.area.corrected / harder.area.corrected).ln() / 1.01f64.ln();
        let said = found.limit_sensitivity(1e9);
        assert!(
            said > 0.2 && said <= 1.0 && falls > 0.0 && falls < said + 0.05,
            "{share}: {falls} of {said}"
        );
    }
    // of the load, what is carried at the limit (pressures are of single precision)
    for limit in [1e10, 1.4e10, 2e10] {
        let found = at(limit, 4e8);
        let load = |least: f64| -> f64 {
            found.pressures.iter().map(|p| f64::from(*p)).filter(|p| *p >= least).sum()
        };
        let at_limit = load(0.999_999 * limit) / load(0.0);
        let said = found.limit_sensitivity(limit);
        assert!(at_limit > 0.01 && at_limit < 0.99, "{limit}: {at_limit}");
        assert!((said / at_limit - 1.0).abs() < 1e-4, "{limit}: {said} {at_limit}");
    }
    let found = at(1e9, 0.5e9);
    assert_eq!(found.limit_sensitivity(f64::INFINITY), 0.0);
    assert_eq!(at(1e9, 0.0).limit_sensitivity(1e9), 0.0);
    let none = HalfSpace { reduced_modulus: 0.0, ..elastic(1e-6) };
    assert!(matches!(none.press(&surface, Load::Pressure(1e6)), Err(HalfSpaceError::Value { .. })));
}

/// The metal that flows lowers the surface by what is said.
#[test]
fn a_flattened_surface_is_lower_by_its_residual_displacement() {
    let surface = Surface::from_map(self_affine(64, 7, 6e-6)).unwrap();
    let pressed = |limit| {
        let found = HalfSpace { limit, ..elastic(1e-6) }.press(&surface, Load::Pressure(2e8)).unwrap();
        let lower = surface.extent.high - found.flattened_surface(&surface).unwrap().extent.high;
        (found.residual_displacement, lower)
    };
    let (said, lower) = pressed(Some(1e9));
    assert!(said > 1e-8 && (said / lower - 1.0).abs() < 1e-3, "{said} {lower}");
    assert_eq!(pressed(None).0, 0.0);
}

/// Grooves of so many waves along the two sides, or their image in a mirror, and the load that is this share
/// of the one that closes them.
fn grooves(waves: [f64; 2], share: f64, mirrored: bool) -> (Surface, f64) {
    let n = 96;
    let length = n as f64 / waves[0].hypot(waves[1]);
    let phase = |i: usize| {
        let (x, y) = (if mirrored { n - 1 - i % n } else { i % n }, i / n);
        2.0 * PI * ((waves[0] * x as f64 + waves[1] * y as f64) / n as f64 + 0.37 * share)
    };
    let z = (0..n * n).map(|i| phase(i).cos()).collect();
    let map = HeightMap::new(n, n, [1.0; 2], z).unwrap().with_periodic(true);
    (Surface::from_map(map).unwrap(), share * PI * MODULUS / length)
}

/// Grooves along the grid, along its diagonal, and between: strips of contact whose width is known
/// (Westergaard 1939) end on lines of the grid, all along.
#[test]
fn the_error_of_straight_strips_holds_in_every_direction() {
    for waves in
        [[2.0, 0.0], [0.0, 3.0], [2.0, 2.0], [4.0, 2.0], [-1.0, 2.0], [3.0, 1.0], [1.0, 3.0], [7.0, 1.0]]
    {
        let ratios = (1..40).map(|k| {
            let share = f64::from(k) / 40.0;
            let (surface, load) = grooves(waves, share, false);
            let area = elastic(1e-6).press(&surface, Load::Pressure(load)).unwrap().area;
            area.error / (area.corrected - 2.0 / PI * share.sqrt().asin()).abs()
        });
        let mut ratios: Vec<f64> = ratios.collect();
        ratios.sort_by(f64::total_cmp);
        let held = ratios.iter().filter(|ratio| **ratio >= 1.0).count() as f64 / ratios.len() as f64;
        let middle = ratios[ratios.len() / 2];
        assert!(held >= 0.94 && middle < 8.0, "{waves:?}: {held} {middle}");
    }
}

/// Grooves and their image in a mirror have one stated error of the area: the same pixels touch.
#[test]
fn the_error_of_straight_strips_is_that_of_their_mirror_image() {
    for waves in [[1.0, 3.0], [3.0, 1.0], [2.0, 1.0], [2.0, 3.0], [1.0, 1.0], [1.0, 4.0]] {
        let [own, other] = [false, true].map(|mirrored| {
            let (surface, load) = grooves(waves, 0.3, mirrored);
            elastic(1e-9).press(&surface, Load::Pressure(load)).unwrap().area
        });
        assert_eq!(own.ratio, other.ratio, "{waves:?}");
        assert!((own.error / other.error - 1.0).abs() < 1e-9, "{waves:?}: {own:?} {other:?}");
    }
}

/// The lightest load is carried as exactly as others: the search counts in shares of it. And a flat surface,
/// which has no height to measure a residual by, touches whole.
#[test]
fn a_light_load_and_a_flat_surface_have_their_answers() {
    let surface = Surface::from_map(self_affine(48, 5, 8e-6)).unwrap();
    for load in [1e-3, 1.0, 1e6] {
        let found = elastic(1e-6).press(&surface, Load::Pressure(load)).unwrap();
        let carried: f64 =
            found.pressures.iter().map(|p| f64::from(*p)).sum::<f64>() / found.pressures.len() as f64;
        assert!((carried / load - 1.0).abs() < 1e-5, "{load}: {carried}");
    }
    let flat = HeightMap::new(8, 8, [1e-6; 2], vec![2e-6; 64]).unwrap().with_periodic(true);
    let found = elastic(1e-6).press(&Surface::from_map(flat).unwrap(), Load::Pressure(1e6)).unwrap();
    assert_eq!(found.area.ratio, 1.0);
    assert!(found.residual < 1e-6, "{}", found.residual);
}
