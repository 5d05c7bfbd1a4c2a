//! Claims about joints, against closed forms.

use super::*;
use crate::half_space::{HalfSpace, HalfSpaceError};
use crate::test_waves::Waves;
use crate::{HeightMap, Load, Surface};
use std::f64::consts::{PI, TAU};

const REDUCED: f64 = 1e9;

fn elastic() -> HalfSpace {
    HalfSpace { reduced_modulus: REDUCED, limit: None, tolerance: 1e-6 }
}

fn pressed(body: &HalfSpace, surface: &Surface, largest: f64, count: usize) -> JointPath {
    let largest = largest_pressure(body, surface, Some(Load::Pressure(largest))).unwrap();
    follow(body, surface, &loads(largest, count), &mut |_, _| Ok(true)).unwrap()
}

fn wave(n: usize, amplitude: f64) -> Surface {
    let z = (0..n * 16).map(|i| amplitude * (TAU * (i % n) as f64 / n as f64).cos()).collect();
    Surface::from_map(HeightMap::new(n, 16, [1e-6; 2], z).unwrap().with_periodic(true)).unwrap()
}

/// Westergaard 1939 (Johnson 1985, section 13.2): contact where sin²(πa/λ) = p/p*, p* = πE*Δ/λ; each
/// dp on that strip lowers the mean gap by -(λ/πE*) ln(p/p*) dp.
#[test]
fn a_wave_closes_as_westergaard_says() {
    let (n, amplitude) = (256, 1e-6);
    let full = PI * REDUCED * amplitude / (n as f64 * 1e-6);
    let path = pressed(&elastic(), &wave(n, amplitude), 0.9 * full, 25);
    let gap = |x: f64| amplitude * if x > 0.0 { 1.0 - x + x * x.ln() } else { 1.0 };
    let mut worst = [0.0_f64; 2];
    for point in &path.loading {
        let x = point.pressure / full;
        worst[0] = worst[0].max((point.mean_gap - gap(x)).abs() / amplitude);
        assert!((point.approach - (amplitude - point.mean_gap)).abs() < 1e-6 * amplitude);
        if x > 0.02 {
            let exact = PI * REDUCED / (n as f64 * 1e-6) / (1.0 / x).ln();
            let off = (point.elastic.unwrap().gap / exact - 1.0).abs();
            worst[1] = worst[1].max(off);
            // the two rims of the strip step by whole pixels: what is stated covers that
            assert!(off < point.error.unwrap().max(0.02), "{x}: {off} {:?}", point.error);
        }
        assert_eq!(point.stiffness, point.elastic.map(|s| s.gap));
    }
    assert!(worst[0] < 1e-3 && worst[1] < 0.03, "{worst:?}");
    // the exact work is amplitude p* (x²/4 - x² ln x/2)
    let x: f64 = 0.9;
    let exact = amplitude * full * (x * x / 4.0 - x * x * x.ln() / 2.0);
    let work = Law::new(&path.loading).unwrap().work();
    assert!((work / exact - 1.0).abs() < 2e-3, "{work} {exact}");
}

#[test]
fn the_work_on_an_elastic_joint_is_the_energy_it_stores() {
    for seed in [3, 4] {
        let surface = Waves::drawn(16.0, seed).surface(128);
        let path = pressed(&elastic(), &surface, 0.3 * REDUCED, 25);
        let work = Law::new(&path.loading).unwrap().work();
        let stored = path.loading.last().unwrap().elastic_work / path.nominal_area;
        // the bound asked of the law
        assert!((work / stored - 1.0).abs() < 1e-3, "{seed}: {work} {stored}");
        assert_eq!(path.unloading.len(), path.loading.len());
        assert_eq!(path.unloading.last(), path.loading.first());
    }
}

/// The slope of the law between loads is that of the chord of each load by itself, to the error that is
/// stated of it, and on the mean to a quarter of that.
#[test]
fn the_loads_beside_give_the_stiffness_of_a_load_alone() {
    let surface = Waves::drawn(16.0, 5).surface(128);
    let pressures = loads(0.1 * REDUCED * surface.parameters.rms_gradient, 25);
    let path = follow(&elastic(), &surface, &pressures, &mut |_, _| Ok(true)).unwrap();
    let places = [6, 10, 14, 18, 22];
    let off = places.map(|i| {
        let alone = follow(&elastic(), &surface, &pressures[i - 1..i], &mut |_, _| Ok(true)).unwrap();
        let (beside, chord) = (path.loading[i], alone.loading[1].elastic.unwrap().gap);
        let off = (beside.elastic.unwrap().gap / chord - 1.0).abs() / beside.error.unwrap();
        assert!(off < 1.0 && beside.error.unwrap() < 0.5, "{i}: {off} {beside:?}");
        off
    });
    assert!(off.iter().sum::<f64>() < 0.25 * places.len() as f64, "{off:?}");
}

/// A sphere that stands free: dF/d(approach) = 2E*a (Johnson 1985, section 4.2), so that the conductance of
/// its spot is 2ka (Holm 1967). The mean gap leaves out what the map sinks as a whole.
#[test]
fn a_free_sphere_has_the_stiffness_and_the_conductance_of_its_spot() {
    let (n, pixel, radius) = (128, 1e-6, 1e-3);
    let z = |i: usize| {
        let [x, y] = [i % n, i / n].map(|i| (i as f64 - 63.5) * pixel);
        -(x * x + y * y) / (2.0 * radius)
    };
    let surface =
        Surface::from_map(HeightMap::new(n, n, [pixel; 2], (0..n * n).map(z).collect()).unwrap()).unwrap();
    let spot: f64 = 20e-6;
    let force = 4.0 / 3.0 * REDUCED * spot.powi(3) / radius;
    let area = (n as f64 * pixel).powi(2);
    let path = follow(&elastic(), &surface, &[force / area], &mut |_, _| Ok(true)).unwrap();
    let stiffness = path.loading[1].elastic.unwrap();
    // a circle of 20 pixels radius, whose rim moves by a pixel over the chord
    let exact = 2.0 * REDUCED * spot / area;
    assert!((stiffness.plane / exact - 1.0).abs() < 0.02, "{} {exact}", stiffness.plane);
    let steel = Bodies { conductivities: [40.0, 200.0 / 3.0] };
    let spots = steel.of_contact(stiffness.plane, REDUCED) * area;
    assert!((steel.conductivity() - 50.0).abs() < 1e-9);
    assert!((spots / (2.0 * 50.0 * spot) - 1.0).abs() < 0.02, "{spots}");
    assert!(stiffness.gap > stiffness.plane);
}

/// Full contact of a wave has no gap: the stiffness is beyond numbers and is not given.
#[test]
fn a_closed_joint_has_no_stiffness_and_a_flat_one_no_law() {
    let surface = wave(64, 1e-7);
    let full = PI * REDUCED * 1e-7 / 64e-6;
    let path = pressed(&elastic(), &surface, 1.5 * full, 9);
    let last = path.loading.last().unwrap();
    assert_eq!((last.elastic, last.stiffness, last.area.ratio), (None, None, 1.0));
    assert!(last.mean_gap < 1e-6 * 1e-7);
    assert!(Law::new(&path.loading).is_some());
    let largest = |surface: &Surface, load| largest_pressure(&elastic(), surface, load);
    let flat = Surface::from_map(HeightMap::new(8, 8, [1e-6; 2], vec![0.0; 64]).unwrap()).unwrap();
    assert_eq!(largest(&flat, None), Err(JointError::Flat));
    assert_eq!(largest(&surface, Some(Load::Pressure(0.0))), Err(JointError::NoTouch));
    assert_eq!(largest(&surface, Some(Load::Separation(1e-3))), Err(JointError::NoTouch));
    let soft = HalfSpace { limit: Some(1e6), ..elastic() };
    let beyond = largest_pressure(&soft, &surface, Some(Load::Pressure(2e6)));
    assert!(matches!(beyond, Err(JointError::HalfSpace(HalfSpaceError::Limit { .. }))));
    assert_eq!(of_medium(0.03, 1e-6), 0.03 / 1e-6);
}

#[test]
fn without_a_load_a_joint_is_pressed_until_it_is_closed_or_flows() {
    let surface = Waves::drawn(8.0, 7).surface(64);
    let closed = largest_pressure(&elastic(), &surface, None).unwrap();
    let area = |p: f64| elastic().press(&surface, Load::Pressure(p)).unwrap().area.ratio;
    assert!(area(closed) >= 0.989 && area(0.8 * closed) < 0.99, "{closed}");
    let soft = HalfSpace { limit: Some(0.05 * REDUCED), ..elastic() };
    let most = largest_pressure(&soft, &surface, None).unwrap();
    assert!((most / (0.9 * 0.05 * REDUCED) - 1.0).abs() < 1e-12);
}

/// Metal that flows is stiffer in unloading than in loading, and does not recover all of its approach.
#[test]
fn a_flattened_joint_goes_back_elastically() {
    let surface = Waves::drawn(8.0, 5).surface(64);
    let soft = HalfSpace { limit: Some(0.2 * REDUCED), ..elastic() };
    let path = pressed(&soft, &surface, 0.1 * REDUCED, 13);
    let (peak, back) = (path.loading.last().unwrap(), &path.unloading);
    assert!(peak.elastic.unwrap().gap > 1.2 * peak.stiffness.unwrap(), "{peak:?}");
    assert!((back[0].mean_gap / peak.mean_gap - 1.0).abs() < 1e-3);
    assert!((back[0].separation - peak.separation).abs() < 1e-3 * peak.mean_gap);
    assert!((back[0].elastic.unwrap().gap / peak.elastic.unwrap().gap - 1.0).abs() < 0.01);
    let end = back.last().unwrap();
    assert!(end.pressure == 0.0 && end.approach > 0.05 * peak.approach, "{end:?}");
    assert!(back.windows(2).all(|two| two[1].approach < two[0].approach));
}

/// A table has so few points, and straight lines between them are the curve to what was asked.
#[test]
fn a_table_is_the_curve_to_its_tolerance() {
    let path = pressed(&elastic(), &Waves::drawn(8.0, 9).surface(64), 0.2 * REDUCED, 25);
    let law = Law::new(&path.loading).unwrap();
    for (tolerance, most) in [(5e-3, 60), (0.05, 20)] {
        let table = law.table(tolerance);
        assert!(table.len() < most && table.windows(2).all(|t| t[1][0] > t[0][0] && t[1][1] > t[0][1]));
        for point in &path.loading[1..] {
            let i = table.partition_point(|row| row[0] < point.approach).clamp(1, table.len() - 1);
            let [[a, p], [b, q]] = [table[i - 1], table[i]];
            let line = p + (q - p) * (point.approach - a) / (b - a);
            let off = (line - point.pressure).abs() / point.pressure;
            assert!(off <= 1.01 * tolerance, "{}: {off}", point.pressure);
        }
    }
}

/// The one-dimensional optimum, by a finer search over evenly spaced loads.
#[test]
fn bounds_are_those_of_the_best_chord() {
    let path = pressed(&elastic(), &Waves::drawn(8.0, 9).surface(64), 0.2 * REDUCED, 25);
    let law = Law::new(&path.loading).unwrap();
    let [_, most] = law.range();
    for share in [0.05, 0.2, 0.5] {
        let (p, range) = (share * most, 0.02 * law.approach(most));
        let found = bounds(&law, range, p);
        let chords = (1..20_000).map(|k| most * f64::from(k) / 20_000.0);
        let low = |q: &f64| (p - q) / (law.approach(p) + range - law.approach(*q));
        let high = |q: &f64| (q - p) / (law.approach(*q) - law.approach(p) - range);
        let best = chords.clone().filter(|q| *q < p).map(|q| low(&q)).fold(0.0, f64::max);
        assert!((found.low / best - 1.0).abs() < 0.01, "{found:?} {best}");
        let best = chords.filter(|q| *q > p).map(|q| high(&q)).filter(|s| *s > 0.0);
        let best = best.fold(f64::INFINITY, f64::min);
        assert!((found.high.unwrap() / best - 1.0).abs() < 0.01, "{found:?} {best}");
    }
    // roughness as high as the whole approach leaves nothing to say from above
    assert_eq!(bounds(&law, 2.0 * law.approach(most), 0.2 * most).high, None);
}

#[test]
fn the_mean_of_several_maps_states_how_far_they_differ() {
    let path = |seed| pressed(&elastic(), &Waves::drawn(8.0, seed).surface(64), 0.1 * REDUCED, 5);
    let paths = [1, 2, 3].map(path);
    let mean = JointPath::mean(&paths).unwrap();
    let stiffness = |path: &JointPath| path.loading[3].elastic.unwrap().gap;
    let all = paths.each_ref().map(stiffness);
    let middle = all.iter().sum::<f64>() / 3.0;
    let spread = all.iter().map(|s| (s / middle - 1.0).powi(2)).sum::<f64>() / 2.0;
    assert!((stiffness(&mean) / middle - 1.0).abs() < 1e-12);
    assert!((mean.loading[3].repeatability.unwrap() - 2.0 * spread.sqrt()).abs() < 1e-12);
    assert_eq!(mean.loading[0].repeatability, None);
    assert_eq!(JointPath::mean(&paths[..1]).as_ref(), Some(&paths[0]));
}

/// A law of two powers, p^0.5 over a decade and p^2 over the next two: one line through all is off by far
/// more than 20 %, so that the formula is the second, from a little below where it begins.
#[test]
fn a_formula_goes_over_the_widest_range_that_it_meets() {
    let two = |p: f64| if p < 1.0 { p.sqrt() } else { p * p };
    let loads: Vec<f64> = (-8..=16).map(|i| 10f64.powf(f64::from(i) / 8.0)).collect();
    let found = Power::new(loads.iter().map(|p| [*p, two(*p)])).unwrap();
    assert!((found.exponent - 2.0).abs() < 0.1 && found.fit.residual <= 0.2, "{found:?}");
    assert!(
        (found.fit.range[1] - 100.0).abs() < 1e-9 && (0.1..=1.0).contains(&found.fit.range[0]),
        "{found:?}"
    );
    let whole = Power::new(loads.iter().map(|p| [*p, 3.0 * p.powf(0.8)])).unwrap();
    assert!((whole.exponent - 0.8).abs() < 1e-12 && (whole.factor - 3.0).abs() < 1e-12, "{whole:?}");
    assert!((whole.fit.range[0] - 0.1).abs() < 1e-12 && whole.fit.residual < 1e-12, "{whole:?}");
    // ten times up and down is near no power
    let rough = (0..8).map(|i| [f64::from(i + 1), if i % 2 == 0 { 1.0 } else { 10.0 }]);
    assert_eq!(Power::new(rough), None);
    assert_eq!(Power::new([1.0, 2.0, 3.0].map(|p| [p, p])), None);
}

/// A conductance that grows as p², at three loads a decade: a straight line between loads is off by up to
/// 40 %, between the rows of the table by the 0.5 % that was asked; below the first load is the medium.
#[test]
fn a_table_of_conductances_is_a_smooth_curve_through_its_loads() {
    let loads: Vec<[f64; 2]> = std::iter::once([0.0, 50.0])
        .chain((0..=9).map(|i| 10f64.powf(f64::from(i) / 3.0)).map(|p| [p, 100.0 * p * p]))
        .collect();
    let table = conductance_table(&loads, 5e-3);
    assert!(table.len() < 120 && table.windows(2).all(|two| two[1][0] > two[0][0]), "{}", table.len());
    let line = |p: f64| {
        let i = table.partition_point(|row| row[0] < p).clamp(1, table.len() - 1);
        let [[a, g], [b, h]] = [table[i - 1], table[i]];
        g + (h - g) * (p - a) / (b - a)
    };
    for i in 0..=300 {
        let p = 10f64.powf(f64::from(i) / 100.0);
        assert!((line(p) / (100.0 * p * p) - 1.0).abs() < 5.1e-3, "{p}: {}", line(p));
    }
    assert!((line(0.5) - 75.0).abs() < 1e-9 && table[0] == [0.0, 50.0]);
    assert_eq!(conductance_table(&loads[..2], 5e-3), loads[..2]);
}
