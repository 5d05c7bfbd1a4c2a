//! Islands, ellipses, contact and pressure against closed forms.

use crate::contact::bearing_area::tests::above_plane;
use crate::contact::islands::Runs;
use crate::surface::generate::{Grid, Kind, Target, generate};
use crate::*;
use asperity_material::units::Stress;
use std::f64::consts::PI;

fn map(n: usize, pixel: f64, z: impl Fn(f64, f64) -> f64) -> HeightMap {
    let at = |i: usize| (i as f64 - 0.5 * (n - 1) as f64) * pixel;
    HeightMap::new(n, n, [pixel, pixel], (0..n * n).map(|i| z(at(i % n), at(i / n))).collect()).unwrap()
}

fn steel() -> Material {
    Material {
        youngs_modulus: Stress(210e9),
        poissons_ratio: 0.3,
        hardness: Some(Stress(1280e6)),
        hardness_error: None,
        yield_stress: None,
        hardening_exponent: None,
        hardening_law: None,
    }
}

fn contact(map: &HeightMap, closure: Closure, load: Load) -> Contact {
    press(&Surface::from_map(map.clone()).unwrap(), &ClosureLaw::new(closure, &steel(), None).unwrap(), load)
        .unwrap()
}

/// A tilted elliptic paraboloid cut d below its top: A = π a b, mean gradient and semi-axes in closed form.
#[test]
fn an_elliptic_paraboloid_gives_back_its_ellipse() {
    let (a, b, turn) = (24e-6, 9e-6, 0.6f64);
    let z = |x: f64, y: f64| {
        let (u, v) = (x * turn.cos() + y * turn.sin(), y * turn.cos() - x * turn.sin());
        -1e-6 * ((u / a).powi(2) + (v / b).powi(2))
    };
    for (pixel, tolerance) in [(1e-6, 5e-3), (0.25e-6, 4e-4)] {
        let n = (64e-6 / pixel) as usize + 1;
        let islands = Islands::above_plane(&map(n, pixel, |x, y| z(x - 2e-6, y + 3e-6)), -1e-6);
        assert_eq!(islands.islands.len(), 1);
        let island = islands.islands[0];
        let ellipse = island.ellipse.unwrap();
        assert!((island.area / (PI * a * b) - 1.0).abs() < tolerance);
        assert!(
            (ellipse.semi_axes[0] / a - 1.0).abs() < tolerance
                && (ellipse.semi_axes[1] / b - 1.0).abs() < tolerance
        );
        assert!((ellipse.semi_axes[0] * ellipse.semi_axes[1] * PI / island.area - 1.0).abs() < 1e-12);
        assert!((ellipse.direction[0].abs() - turn.cos()).abs() < 1e-3);
        let centre = 0.5 * (n - 1) as f64 * pixel;
        assert!(
            (ellipse.centre[0] - centre - 2e-6).abs() < 1e-8
                && (ellipse.centre[1] - centre + 3e-6).abs() < 1e-8
        );
        assert!((island.approach / 1e-6 - 1.0).abs() < 0.02);
    }
}

/// A periodic island across the corner of the map has the same area and ellipse as the one in its middle.
#[test]
fn an_island_across_the_edges_of_a_periodic_map_is_one() {
    let n = 48;
    let bump = |shift: usize| {
        let z = (0..n * n).map(|i| {
            let at = |k: usize| {
                let k = (k + shift) % n;
                k as f64 - 24.0
            };
            -(at(i % n).powi(2) / 64.0 + at(i / n).powi(2) / 25.0)
        });
        HeightMap::new(n, n, [1e-6, 1e-6], z.collect()).unwrap().with_periodic(true)
    };
    let one = |shift| {
        let islands = Islands::above_plane(&bump(shift), -1.3).islands;
        assert_eq!(islands.len(), 1, "{shift}");
        islands[0]
    };
    let (inside, across) = (one(0), one(24));
    assert!(
        (inside.area / across.area - 1.0).abs() < 1e-12 && (inside.slope / across.slope - 1.0).abs() < 1e-12
    );
    let (a, b) = (inside.ellipse.unwrap(), across.ellipse.unwrap());
    assert!(
        (a.semi_axes[0] / b.semi_axes[0] - 1.0).abs() < 1e-9
            && (a.semi_axes[1] / b.semi_axes[1] - 1.0).abs() < 1e-9
    );
    // not periodic: cut into four
    let open = Islands::above_plane(&bump(24).with_periodic(false), -1.3).islands;
    assert_eq!(open.len(), 4);
    // a ridge that meets itself has no extent
    let ridge = (0..n * n).map(|i| -((i / n) as f64 - 20.0).abs()).collect();
    let ridge = HeightMap::new(n, n, [1e-6, 1e-6], ridge).unwrap();
    assert!(Islands::above_plane(&ridge, -3.5).islands[0].ellipse.is_some());
    let endless = Islands::above_plane(&ridge.with_periodic(true), -3.5).islands;
    assert!(endless.len() == 1 && endless[0].ellipse.is_none());
}

/// Two diagonal nodes join only if the mean of their cell is above the plane; each then takes its own
/// triangles.
#[test]
fn a_saddle_joins_only_above_its_middle() {
    let n = 4;
    let mut z = vec![-1.0; n * n];
    z[n + 1] = 0.6;
    z[2 * n + 2] = 0.6;
    let map = HeightMap::new(n, n, [1.0, 1.0], z.clone()).unwrap();
    assert_eq!(Islands::above_plane(&map, 0.0).islands.len(), 2);
    z[n + 1] = 1.6;
    let map = HeightMap::new(n, n, [1.0, 1.0], z).unwrap();
    assert_eq!(Islands::above_plane(&map, 0.0).islands.len(), 1);
    let total: f64 = Islands::above_plane(&map, 0.0).islands.iter().map(|i| i.area).sum();
    assert!((total - above_plane(&map, 0.0).area).abs() < 1e-12);
}

/// Sums over islands equal sums over cells, with and without edges and holes.
#[test]
fn islands_and_cells_hold_the_same_area_and_slope() {
    for (periodic, holes) in [(false, false), (true, false), (false, true), (true, true)] {
        let n = 137;
        let z = (0..n * 90).map(|i: usize| {
            let (x, y) = ((i % n) as f64, (i / n) as f64);
            let hole = holes && (i * 7919).is_multiple_of(13);
            if hole {
                f64::NAN
            } else {
                (0.3 * x).sin() + (0.4 * y + 0.1 * x).cos() + 0.5 * (1.3 * x * y).sin()
            }
        });
        let map = HeightMap::new(n, 90, [1.0, 1.0], z.collect()).unwrap().with_periodic(periodic);
        for plane in [-3.0, -0.7, 0.0, 0.4, 1.5, 2.4, 2.6] {
            let sum = above_plane(&map, plane);
            let islands = Islands::above_plane(&map, plane).islands;
            let area: f64 = islands.iter().map(|i| i.area).sum();
            let slope: f64 = islands.iter().map(|i| i.area * i.slope).sum();
            assert!((area - sum.area).abs() <= 1e-9 * sum.area.max(1.0), "{periodic} {holes} {plane}");
            assert!((slope - sum.slope_area).abs() <= 1e-9 * sum.slope_area.max(1.0));
            // the islands found within what lies above a lower plane are the same, in the same order
            let lower =
                Runs::above_plane(&map, plane - 0.9).narrowed(&map, plane - 0.2).narrowed(&map, plane);
            let sizes = Islands::sizes(&map, plane, lower);
            assert_eq!(sizes.len(), islands.len(), "{periodic} {holes} {plane}");
            for (size, island) in sizes.iter().zip(&islands) {
                assert!((size.area - island.area).abs() <= 1e-9 * island.area);
                assert!((size.slope_area - island.area * island.slope).abs() <= 1e-9 * size.slope_area);
            }
        }
    }
}

/// Eq. [15]: a Hertz profile peaks at 3/2 of the mean, a uniform one is the mean, and each sums to the load.
#[test]
fn pressure_profiles_sum_to_the_load_and_peak_as_they_should() {
    let (n, tan) = (513, 0.1);
    let cone = map(n, 1e-6, |x, y| -tan * x.hypot(y));
    for (closure, ratio) in [(Closure::Published, 1.0), (Closure::Sneddon, 4.0 / PI / PI)] {
        let contact = contact(&cone, closure, Load::Pressure(100e6));
        let mean = contact.mean_pressure().unwrap();
        for (profile, low, high) in [
            (PressureProfile::Hertz, 1.49, 1.51),
            (PressureProfile::Uniform, 0.99, 1.02),
            (PressureProfile::Cone, 4.0, 6.0),
        ] {
            let field = PressureField::distribute(&cone, &contact, profile);
            let force: f64 = field.pixels.iter().map(|p| f64::from(p.pressure)).sum::<f64>() * 1e-12;
            assert!((force / (100e6 * contact.nominal_area) - 1.0).abs() < 1e-5);
            let peak = field.largest / mean;
            assert!(peak > low && peak < high, "{closure:?} {profile:?} {peak}");
            let area: f64 = field.pixels.iter().map(|p| f64::from(p.contact)).sum::<f64>() * 1e-12;
            assert!((area / (contact.area_ratio * contact.nominal_area) - 1.0).abs() < 0.01, "{profile:?}");
        }
        assert!((contact.contact_area(0) / (ratio * contact.islands.islands[0].area) - 1.0).abs() < 1e-12);
    }
}

/// The same bits for any number of threads.
#[test]
fn one_and_many_threads_give_the_same_bits() {
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 60e-6, cutoff: 8e-6 };
    let grid = Grid { nodes: [300, 211], pixel: [1e-6, 1e-6], seed: 5 };
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let map = generate(kind, &grid, Target::Slope(0.1)).unwrap().with_periodic(true);
            let mut bits = Vec::new();
            for closure in [Closure::Published, Closure::Johnson] {
                let contact = contact(&map, closure, Load::Pressure(150e6));
                let field = PressureField::distribute(&map, &contact, PressureProfile::Hertz);
                bits.extend([contact.separation, contact.area_ratio, field.largest].map(f64::to_bits));
                bits.extend(contact.curve.iter().map(|p| p.pressure.to_bits()));
                bits.extend(contact.islands.islands.iter().map(|i| i.area.to_bits()));
            }
            bits
        })
    };
    assert_eq!(run(1), run(4));
    assert_eq!(run(1), run(3));
}

/// Closures that are not linear in tan β meet the load too, or say that it jumps.
#[test]
fn johnson_meets_the_load_on_a_rough_map() {
    let grid = Grid { nodes: [256, 256], pixel: [1e-6, 1e-6], seed: 2 };
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 60e-6, cutoff: 8e-6 };
    let map = generate(kind, &grid, Target::Slope(0.1)).unwrap().with_periodic(true);
    for pressure in [1e6, 50e6, 200e6, 500e6] {
        let contact = contact(&map, Closure::Johnson, Load::Pressure(pressure));
        assert!(contact.load_error.unwrap() <= 1e-6 || contact.jump, "{pressure} {:?}", contact.load_error);
        assert!(contact.load_error.unwrap() < 0.01);
        let unloading = unload(&contact, &ClosureLaw::new(Closure::Johnson, &steel(), None).unwrap(), 1.22);
        assert!(unloading.residual_displacement >= 0.0);
        let share = unloading.elastic_share.unwrap();
        assert!(share > 0.0 && share < 1.0);
        let curve = &unloading.curve;
        assert!((curve[0].pressure / contact.pressure - 1.0).abs() < 1e-12 && curve[63].pressure == 0.0);
        assert!(curve.windows(2).all(|w| w[1].pressure <= w[0].pressure));
    }
}

/// Load 0, a load out of reach, a flat map, scales from 1e-12 to 1e3 m.
#[test]
fn extremes_have_an_answer() {
    let cone = |scale: f64| map(65, 0.1 * scale, |x, y| -0.1 * x.hypot(y));
    let zero = contact(&cone(1e-6), Closure::Published, Load::Pressure(0.0));
    assert!(zero.area_ratio == 0.0 && zero.mean_pressure().is_none() && zero.shares.is_none());
    let extent = cone(1e-6).extent().unwrap();
    assert!((zero.separation + Parameters::measure(&cone(1e-6), &extent).mean - extent.high).abs() < 1e-18);
    let reference = contact(&cone(1.0), Closure::Published, Load::Pressure(200e6));
    for scale in [1e-12, 1e-9, 1e3] {
        for closure in [Closure::Published, Closure::Johnson, Closure::Sneddon] {
            let found = contact(&cone(scale), closure, Load::Pressure(200e6));
            assert!(found.load_error.unwrap() < 1e-6, "{scale} {closure:?}");
            if closure == Closure::Published {
                assert!((found.area_ratio / reference.area_ratio - 1.0).abs() < 1e-6);
                assert!((found.separation / scale / reference.separation - 1.0).abs() < 1e-6);
            }
        }
    }
    let flat = map(9, 1.0, |_, _| 3.0);
    for (map, pressure) in [(&flat, 1.0), (&cone(1.0), 1e13)] {
        let surface = Surface::from_map(map.clone()).unwrap();
        for closure in [Closure::Published, Closure::Johnson, Closure::Sneddon] {
            let model = ClosureLaw::new(closure, &steel(), None).unwrap();
            let message = press(&surface, &model, Load::Pressure(pressure)).err().unwrap().to_string();
            assert!(message.contains("largest load"), "{message}");
        }
    }
    // a single spike, and a separation below the lowest point
    let spike = map(33, 1e-6, |x, y| if x == 0.0 && y == 0.0 { 5e-6 } else { 0.0 });
    let pressed = contact(&spike, Closure::Published, Load::Pressure(1e6));
    assert!(pressed.load_error.unwrap() < 1e-6 && pressed.islands.islands.len() == 1);
    let deep = contact(&cone(1.0), Closure::Published, Load::Separation(-10.0));
    assert!((deep.area_ratio - 1.0).abs() < 1e-12);
}
