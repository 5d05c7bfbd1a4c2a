use super::*;
use crate::surface::height_map::HeightMap;
use crate::surface::prepared_surface::Surface;
use proptest::prelude::*;
use std::f64::consts::PI;

/// A map of `nx` × `ny` nodes, 1 µm × 2 µm apart, of a function of metres.
fn surface(nx: usize, ny: usize, height: impl Fn(f64, f64) -> f64) -> Surface {
    let z = (0..nx * ny).map(|i| height((i % nx) as f64 * 1e-6, (i / nx) as f64 * 2e-6));
    Surface::from_map(HeightMap::new(nx, ny, [1e-6, 2e-6], z.collect()).unwrap()).unwrap()
}

fn hills(surface: &Surface, prune: f64) -> Vec<Asperity> {
    find(surface, Segmentation::Hills { prune }).unwrap()
}

#[test]
fn a_cone_gives_its_slope_its_ellipse_and_its_profile() {
    let tan = 0.2;
    let cone = surface(301, 151, |x, y| 20e-6 - tan * (x - 150e-6).hypot(y - 150e-6));
    let separation = 12e-6 - cone.parameters.mean;
    let found = find(&cone, Segmentation::Islands { separation }).unwrap();
    let [one] = found[..] else { panic!("{} islands", found.len()) };
    let radius = 8e-6 / tan;
    assert_eq!((one.summit, one.cut), ([150, 75], false));
    // the pixels of a cone's tip are flatter than the cone
    assert!((one.area / (PI * radius * radius) - 1.0).abs() < 2e-3 && (one.slope / tan - 1.0).abs() < 5e-3);
    assert!((one.rise - 8e-6).abs() < 1e-12 && (one.height - (20e-6 - cone.parameters.mean)).abs() < 1e-12);
    let ellipse = one.ellipse.unwrap();
    assert!(ellipse.semi_axes.iter().all(|a| (a / radius - 1.0).abs() < 2e-3));
    let profile = RadialProfile::around_summit(&cone.map, one.summit, one.rise).unwrap();
    // chords of pixels lie below a cone by less than half a pixel times its slope
    let worst =
        profile.points[3..].iter().map(|[r, z]| (z - profile.height() + tan * r).abs()).fold(0.0, f64::max);
    assert!(worst < 0.5 * 2e-6 * tan, "{worst}");
    assert!(profile.points.last().unwrap()[1] == 0.0 && profile.height() >= one.rise);
    let (area, slope) = profile.area_and_slope(one.rise);
    assert!((area / (PI * radius * radius) - 1.0).abs() < 0.01 && (slope / tan - 1.0).abs() < 0.01);
}

#[test]
fn a_body_of_revolution_is_cut_exactly() {
    // a cone with a step of its slope at half its height
    let profile = RadialProfile { points: vec![[0.0, 3.0], [2.0, 2.0], [3.0, 0.0]] };
    let (area, slope) = profile.area_and_slope(2.0);
    assert!((area - PI * 6.25).abs() < 1e-12);
    assert!((slope - (0.5 * 4.0 + 2.0 * 2.25) / 6.25).abs() < 1e-12);
    assert_eq!(profile.area_and_slope(0.0), (0.0, 0.0));
    assert_eq!([0.0, 1.0, 2.5, 3.0, 9.0].map(|r| profile.height_at(r)), [3.0, 2.5, 1.0, 0.0, 0.0]);
    let body = profile.surface(4.0, 64).unwrap();
    assert_eq!((body.extent.high, body.extent.low, body.map.heights()[32 * 64 + 32]), (3.0, 0.0, 3.0));
}

#[test]
fn the_tip_of_a_ball_and_of_a_saddle_has_its_curvatures() {
    let ball = surface(61, 31, |x, y| -((x - 30e-6).powi(2) + (y - 30e-6).powi(2)) / (2.0 * 1e-3));
    let tip = hills(&ball, 0.05)[0].tip.unwrap();
    assert!(tip.curvatures.iter().all(|c| (c / 1e3 - 1.0).abs() < 1e-9), "{tip:?}");
    assert!((tip.radius().unwrap() / 1e-3 - 1.0).abs() < 1e-9);
    // a ridge turned by 30 degrees, with 3 times the curvature across it
    let (c, s) = (PI / 6.0).sin_cos();
    let ridge = surface(61, 31, |x, y| {
        let (u, v) = (c * (x - 30e-6) + s * (y - 30e-6), c * (y - 30e-6) - s * (x - 30e-6));
        -0.5e3 * (u * u + 3.0 * v * v)
    });
    let [low, high] = hills(&ridge, 0.05)[0].tip.unwrap().curvatures;
    assert!((low / 1e3 - 1.0).abs() < 1e-9 && (high / 3e3 - 1.0).abs() < 1e-9);
}

#[test]
fn pruning_keeps_a_hill_that_rises_far_enough() {
    // summits of 10, 6.5 and 9 with saddles of 6 and 3
    let height = |x: f64, _: f64| {
        let at = [(0.0, 0.0), (10.0, 10.0), (20.0, 6.0), (25.0, 6.5), (35.0, 3.0), (50.0, 9.0), (60.0, 0.0)];
        let k = at.iter().position(|(p, _)| *p >= x * 1e6 - 1e-9).unwrap().max(1);
        let ((x0, z0), (x1, z1)) = (at[k - 1], at[k]);
        1e-6 * (z0 + (z1 - z0) * (x * 1e6 - x0) / (x1 - x0))
    };
    let ridges = surface(61, 5, height);
    let rises = |prune| hills(&ridges, prune).iter().map(|h| (h.rise * 1e7).round()).collect::<Vec<_>>();
    assert_eq!(rises(0.0), [40.0, 60.0, 5.0]);
    assert_eq!(rises(0.049), [40.0, 60.0, 5.0]);
    // the hill that is pruned goes to the one beyond its saddle
    assert_eq!(rises(0.051), [70.0, 60.0]);
    // the saddle itself is on the steeper side, which is the other one: 34 whole columns of cells and a half
    assert!((hills(&ridges, 0.051)[0].area / (34.5 * 8.0 * 1e-12) - 1.0).abs() < 1e-12);
    assert_eq!(rises(0.61), [100.0]);
}

#[test]
fn an_island_over_the_seam_of_a_periodic_map_is_whole() {
    let wave = surface(40, 20, |x, y| {
        let turn = |x: f64| (2.0 * PI * x / 40e-6).cos();
        1e-6 * (turn(x) + turn(y))
    });
    let free = |surface: &Surface| {
        find(surface, Segmentation::Islands { separation: 1e-6 })
            .unwrap()
            .iter()
            .map(|a| a.cut)
            .collect::<Vec<_>>()
    };
    assert_eq!(free(&wave), [true; 4]);
    let endless = Surface::from_map(wave.map.with_periodic(true)).unwrap();
    assert_eq!(free(&endless), [false]);
    let [hill] = hills(&endless, 0.05)[..] else { panic!() };
    assert!((hill.area / 1.6e-9 - 1.0).abs() < 1e-12 && !hill.cut);
    let axes = hill.ellipse.unwrap().semi_axes;
    assert!((axes[0] / axes[1] - 1.0).abs() < 0.05, "{axes:?}");
}

#[test]
fn what_has_no_asperity_says_why() {
    let error = |surface: &Surface, how| find(surface, how).unwrap_err().to_string();
    let slope = surface(9, 9, |x, _| x);
    let islands = |separation| Segmentation::Islands { separation };
    assert!(error(&surface(9, 9, |_, _| 3.0), islands(0.0)).contains("flat"));
    assert!(error(&slope, islands(5e-6)).contains("4 µm above the mean"));
    assert!(error(&slope, islands(-5e-6)).contains("raise it"));
    assert!(error(&slope, islands(f64::NAN)).contains("highest point"));
    assert!(error(&slope, Segmentation::Hills { prune: 1.0 }).contains("0.05"));
    let cone = surface(61, 31, |x, y| -(x - 30e-6).hypot(y - 30e-6) * 0.1);
    let around = |depth| RadialProfile::around_summit(&cone.map, [30, 15], depth).unwrap_err();
    assert!(matches!(around(1e-7), ProfileError::Coarse { points: 1 }));
    assert!(matches!(around(1e-4), ProfileError::Edge { .. }));
    let dimple = surface(61, 31, |x, y| -1e-6 * (0.3e6 * (x - 30e-6).hypot(y - 30e-6)).sin().abs());
    assert!(matches!(
        RadialProfile::around_summit(&dimple.map, [30, 15], 5e-6),
        Err(ProfileError::Shallow { .. })
    ));
}

#[test]
fn a_line_runs_along_x_or_y_and_skips_single_holes() {
    let mut z: Vec<f64> = (0..20 * 30).map(|i| i as f64).collect();
    z[7 * 20 + 3] = f64::NAN;
    let map = HeightMap::new(20, 30, [1.0, 2.0], z).unwrap();
    let row = line(&map, Direction::X, 14.9).unwrap();
    assert_eq!((row.at, row.points.len(), row.points[3]), (14.0, 19, [4.0, 144.0]));
    let column = line(&map, Direction::Y, 3.2).unwrap();
    assert_eq!((column.at, column.points[1]), (3.0, [2.0, 23.0]));
    assert!(matches!(line(&map, Direction::X, 59.5), Err(LineError::Beside { .. })));
    assert!(line(&map, Direction::Y, f64::NAN).is_err());
    let empty = HeightMap::new(20, 2, [1.0, 1.0], vec![f64::NAN; 40]).unwrap();
    assert!(matches!(line(&empty, Direction::X, 0.0), Err(LineError::Missing { missing: 20, .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]
    #[test]
    fn hills_share_the_map_and_each_rises_enough(
        z in prop::collection::vec(0.0..1.0f64, 12 * 9), prune in 0.0..0.6f64, periodic: bool,
    ) {
        let map = HeightMap::new(12, 9, [1.0, 1.5], z).unwrap().with_periodic(periodic);
        let surface = Surface::from_map(map).unwrap();
        let found = hills(&surface, prune);
        prop_assert!(!found.is_empty());
        let area: f64 = found.iter().map(|h| h.area).sum();
        prop_assert!((area / surface.nominal_area() - 1.0).abs() < 1e-12);
        prop_assert_eq!(found.iter().map(|h| h.nodes).sum::<usize>(), 12 * 9);
        let least = prune * (surface.extent.high - surface.extent.low);
        prop_assert!(found.len() == 1 || found.iter().all(|h| h.rise >= least));
        if prune == 0.0 || found.len() == 1 { return Ok(()); }
        // less pruning never leaves fewer, and what stays has its summit
        let more = hills(&surface, 0.0);
        prop_assert!(found.iter().all(|h| more.iter().any(|m| m.summit == h.summit)) && more.len() >= found.len());
    }
}
