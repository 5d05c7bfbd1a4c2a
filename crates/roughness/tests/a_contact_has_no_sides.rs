//! A contact is the same from every side, and its area hangs on the limit of pressure by no more than it
//! says. By symmetry of the equations; tolerances are those of the search.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_roughness::half_space::{HalfSpace, HalfSpaceError};
use asperity_roughness::{Grid, HeightMap, Kind, Load, Surface, Target, generate};

const MODULUS: f64 = 2e11;

fn elastic(tolerance: f64) -> HalfSpace {
    HalfSpace { reduced_modulus: MODULUS, limit: None, tolerance }
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
    let grid = Grid { nodes: [64, 64], pixel: [1e-6, 1e-6], seed: 7 };
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 40e-6, cutoff: 6e-6 };
    let map = generate(kind, &grid, Target::Height(0.3e-6)).unwrap().with_periodic(true);
    let surface = Surface::from_map(map).unwrap();
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
    let found = at(1e9, 0.5e9);
    assert_eq!(found.limit_sensitivity(f64::INFINITY), 0.0);
    assert_eq!(at(1e9, 0.0).limit_sensitivity(1e9), 0.0);
    let none = HalfSpace { reduced_modulus: 0.0, ..elastic(1e-6) };
    assert!(matches!(none.press(&surface, Load::Pressure(1e6)), Err(HalfSpaceError::Value { .. })));
}
