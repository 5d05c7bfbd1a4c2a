//! Claims about scales.

use super::persson::{by_images, by_sines};
use super::verdict::Class;
use super::*;
use crate::half_space::HalfSpace;
use crate::{Grid, HeightMap, Kind, Load, Material, Surface, Target, generate};
use asperity_material::HardeningLaw;
use asperity_material::units::Stress;
use std::f64::consts::{SQRT_2, TAU};

fn steel() -> Material {
    Material {
        youngs_modulus: Stress(210e9),
        poissons_ratio: 0.3,
        hardness: None,
        hardness_error: None,
        yield_stress: Some(Stress(800e6)),
        hardening_exponent: None,
        hardening_law: None,
    }
}

fn task() -> Task {
    let body = HalfSpace { reduced_modulus: 210e9 / 0.91, limit: None, tolerance: 1e-5 };
    Task { material: steel(), law: HardeningLaw::Hollomon, body, closures: Vec::new() }
}

fn self_affine(n: usize, hurst: f64, waves: [f64; 2], seed: u64) -> Surface {
    let grid = Grid { nodes: [n; 2], pixel: [1e-6; 2], seed };
    let [rolloff, cutoff] = waves.map(|w| w * 1e-6);
    let map = generate(Kind::SelfAffine { hurst, rolloff, cutoff }, &grid, Target::Slope(0.1)).unwrap();
    Surface::from_map(map.with_periodic(true)).unwrap()
}

fn wave(n: usize, length: usize, amplitude: f64) -> Surface {
    let z = (0..n * n).map(|i| amplitude * (TAU * (i % n) as f64 / length as f64).cos());
    Surface::from_map(HeightMap::new(n, n, [1e-6; 2], z.collect()).unwrap().with_periodic(true)).unwrap()
}

/// A cosine of amplitude a and length λ has the rms slope √2 π a/λ, of which the Gaussian leaves exp(-ln 2
/// (λc/λ)²), and half the Laplacian ½ (2π/λ)² a/√2.
#[test]
fn a_wave_has_its_slope_and_curvature_at_every_scale() {
    let (length, amplitude) = (32.0, 0.3e-6);
    let surface = wave(128, 32, amplitude);
    let (power, _) = SlopePower::new(&surface.map).unwrap();
    for cutoff in cutoffs(&surface.map) {
        let scale = Scale::new(&surface, cutoff).unwrap();
        let found = Slopes::new(&scale, &surface.map, &power);
        let gain = if cutoff < 2.1e-6 { 1.0 } else { 2f64.powf(-(cutoff * 1e6 / length).powi(2)) };
        let slope = gain * TAU * amplitude / (length * 1e-6) / SQRT_2;
        assert!((found.rms / slope - 1.0).abs() < 1e-9, "{cutoff} {found:?} {slope}");
        let curvature = 0.5 * slope * TAU / (length * 1e-6);
        assert!((found.rms_curvature / curvature - 1.0).abs() < 1e-9);
        // the heights on the coarser grid are those of the filtered wave; the filter ends at one cut-off
        assert!((scale.surface.parameters.sq / (gain * amplitude / SQRT_2) - 1.0).abs() < 2e-3);
        // grooves along y; mean |cos| over rms is 2√2/π
        assert!(found.anisotropy < 1e-6 && found.steepest_deg.abs() < 1e-6);
        assert!((found.mean / found.rms / 0.9003 - 1.0).abs() < 0.02, "{found:?}");
    }
}

/// (h(x + l) - h(x))/l of a wave has the rms slope times sin(πl/λ)/(πl/λ), the second difference its square.
#[test]
fn differences_over_a_distance_are_those_of_a_wave() {
    let surface = wave(128, 32, 1e-6);
    let (power, _) = SlopePower::new(&surface.map).unwrap();
    let scale = Scale::new(&surface, cutoffs(&surface.map)[0]).unwrap();
    let found = Slopes::new(&scale, &surface.map, &power);
    let x = std::f64::consts::PI * found.distance * 1e6 / 32.0;
    let slope = TAU / 32.0 / SQRT_2;
    assert!((found.over_distance[0].unwrap() / slope / (x.sin() / x).abs() - 1.0).abs() < 1e-9);
    let curvature = slope * TAU / 32e-6 * (x.sin() / x).powi(2);
    assert!((found.curvature_over_distance[0].unwrap() / curvature - 1.0).abs() < 1e-9);
    assert!(found.over_distance[1].unwrap() < 1e-12);
}

/// A periodic map of any kind has slopes between those of sharp cut-offs an octave to either side, and the
/// coarser grid keeps the slope of the filtered map.
#[test]
fn coarser_grids_keep_the_filtered_slope() {
    let surface = self_affine(256, 0.7, [64.0, 4.0], 5);
    let (power, _) = SlopePower::new(&surface.map).unwrap();
    for cutoff in cutoffs(&surface.map).into_iter().filter(|c| *c > 7.9e-6) {
        let scale = Scale::new(&surface, cutoff).unwrap();
        let exact = power.filtered(Some(cutoff))[0];
        // the derivative of seven points on eight pixels a cut-off
        assert!((scale.surface.parameters.sdq / exact - 1.0).abs() < 0.02, "{cutoff}");
        assert!(scale.surface.map.pixel()[0] <= cutoff / 7.9);
    }
}

/// Both sums solve the diffusion between two ends; the whole is never less than the load over the limit.
#[test]
fn images_and_sines_are_the_same_theory() {
    for share in [0.02, 0.2, 0.6] {
        for spread in [0.1, 0.3, 0.4, 0.5, 0.9] {
            let (a, b) = (by_images(share, spread), by_sines(share, spread));
            // the sines of the least spread need more than 24 terms for 1e-6
            let near = if spread < 0.2 { 1e-3 } else { 1e-9 };
            assert!(
                (a.elastic - b.elastic).abs() < near && (a.plastic - b.plastic).abs() < near,
                "{a:?} {b:?}"
            );
            assert!(a.total() >= share - 1e-12 && a.elastic >= 0.0 && a.plastic >= -1e-12);
        }
    }
    let elastic = persson(0.1, 1e6, 200e9, None).unwrap();
    // of small loads p κ/(E* h') with κ = √(8/π)
    assert!((elastic.elastic / (1e6 * 1.5957691 / (200e9 * 0.1)) - 1.0).abs() < 1e-3);
    let hard = persson(0.1, 1e9, 200e9, Some(1e12)).unwrap();
    assert!((hard.elastic / persson(0.1, 1e9, 200e9, None).unwrap().elastic - 1.0).abs() < 1e-9);
    assert_eq!(persson(0.1, 2e9, 200e9, Some(1e9)), None);
}

/// Johnson (1985, ch. 6): indentation by cones is elastic up to E* tan β/σ_y of about 2 to 3 and fully
/// plastic from about 30 to 60 on.
#[test]
fn regimes_end_where_indentation_has_them() {
    let found = RegimeSlopes::new(&steel(), HardeningLaw::Hollomon).unwrap();
    let x = |tan: f64| 210e9 / 0.91 * tan / 800e6;
    assert!((1.0..6.0).contains(&x(found.elastic)), "{}", x(found.elastic));
    assert!((15.0..80.0).contains(&x(found.plastic)), "{}", x(found.plastic));
    let unknown = Material { yield_stress: None, ..steel() };
    assert_eq!(RegimeSlopes::new(&unknown, HardeningLaw::Hollomon), None);
}

#[test]
fn hurst_exponent_and_rolloff_lie_in_their_intervals() {
    let mut inside = [0; 2];
    for (hurst, seed) in [(0.3, 1), (0.5, 2), (0.7, 3), (0.9, 4)] {
        let surface = self_affine(256, hurst, [40.0, 4.0], seed);
        let (_, points) = SlopePower::new(&surface.map).unwrap();
        let fit = SelfAffine::new(&surface.map, &points).unwrap();
        inside[0] += usize::from((fit.hurst.low..=fit.hurst.high).contains(&hurst));
        inside[1] += usize::from((fit.rolloff.low..=fit.rolloff.high).contains(&40e-6));
        assert!(fit.hurst.high - fit.hurst.low < 0.2 && fit.has_rolloff(), "{fit:?}");
        assert!((fit.shortest.low..=fit.shortest.high).contains(&4e-6), "{fit:?}");
    }
    // 90 % intervals, four maps
    assert!(inside[0] >= 3 && inside[1] >= 3, "{inside:?}");
}

#[test]
fn a_map_that_ends_before_its_pixel_has_converged_and_one_that_goes_on_has_not() {
    let pressure = Load::Pressure(0.03 * 0.1 * 210e9 / 0.91);
    let class = |cutoff: f64, quantity: Quantity| {
        let surface = self_affine(128, 0.6, [32.0, cutoff], 7);
        let found = task().follow(&surface, pressure, &mut |_, _, _| true).unwrap().unwrap();
        let of = found.verdicts.iter().find(|j| j.quantity == quantity && !j.limited).unwrap().verdict;
        (of.class, of.exponent.unwrap(), found.growth.goes_on())
    };
    let (ended, _, goes_on) = class(12.0, Quantity::Slope);
    assert!(ended == Class::Converged && !goes_on);
    let (slope, exponent, goes_on) = class(2.0, Quantity::Slope);
    // an octave multiplies the slope by 2^(1 - H), more near the roll-off
    assert!(slope == Class::NotConverging && goes_on && (0.3..0.7).contains(&exponent), "{exponent}");
    // the area falls as the slope grows where contact is light, by less where it is not
    let (area, exponent, _) = class(2.0, Quantity::Area);
    assert!(area == Class::NotConverging && (-0.8..-0.2).contains(&exponent), "{exponent}");
}

#[test]
fn a_small_map_says_that_it_is_small() {
    let surface = self_affine(16, 0.8, [8.0, 2.0], 1);
    let found = task().follow(&surface, Load::Pressure(1e9), &mut |_, _, _| true).unwrap().unwrap();
    assert!(found.steps.len() >= 2 && found.verdicts.iter().all(|j| j.verdict.class == Class::MapTooSmall));
    let flat = Surface::from_map(HeightMap::new(8, 8, [1e-6; 2], vec![1.0; 64]).unwrap()).unwrap();
    let refused = task().follow(&flat, Load::Pressure(1e9), &mut |_, _, _| true);
    assert_eq!(refused.err(), Some(ScalesError::Flat));
    let idle = task().follow(&surface, Load::Pressure(0.0), &mut |_, _, _| true);
    assert_eq!(idle.err(), Some(ScalesError::NoTouch));
}

/// A tip of radius R follows no curvature above 1/R; noise of one wave is found at that wave.
#[test]
fn a_tip_and_noise_limit_the_trust() {
    let surface = self_affine(128, 0.6, [32.0, 4.0], 3);
    let (power, _) = SlopePower::new(&surface.map).unwrap();
    let one = std::slice::from_ref(&surface);
    let curvature = power.filtered(Some(10e-6))[1];
    let found = trusted(one, Some(1.0 / curvature)).unwrap().unwrap();
    assert!((found / 10e-6 - 1.0).abs() < 1e-6, "{found}");
    assert_eq!(trusted(one, None).unwrap(), None);
    assert_eq!(trusted(&[surface.clone(), surface.clone()], None).unwrap(), None);
    let shaken =
        surface.map.heights().iter().enumerate().map(|(i, z)| z + if i % 2 == 0 { 1e-7 } else { 0.0 });
    let again = Surface::from_map(surface.map.with_heights(shaken.collect()).unwrap()).unwrap();
    assert!(trusted(&[surface.clone(), again], None).unwrap().is_some_and(|cutoff| cutoff > 1e-6));
    let other = self_affine(64, 0.6, [32.0, 4.0], 3);
    assert!(matches!(trusted(&[surface, other], None), Err(ScalesError::Repeated(..))));
}

/// A map of 512², seen by pixels four times wider that are means or picked points, grows by two octaves as
/// its bounds say: whatever the sampling, the exponent, and an end between the map and the surface.
#[test]
fn the_slope_of_finer_maps_grows_between_its_bounds() {
    let grown = |hurst: f64, shortest: f64, means: bool| {
        let fine = self_affine(512, hurst, [96.0, shortest], 11);
        let side = if means { 4 } else { 1 };
        let mean = |i: usize| {
            let [x, y] = [i % 128 * 4, i / 128 * 4];
            let sum: f64 = (y..y + side).flat_map(|y| &fine.map.row(y)[x..x + side]).sum();
            sum / (side * side) as f64
        };
        let coarse = HeightMap::new(128, 128, [4e-6; 2], (0..128 * 128).map(mean).collect()).unwrap();
        let [(seen, _), (whole, _)] =
            [&coarse.with_periodic(true), &fine.map].map(|map| SlopePower::new(map).unwrap());
        let true_growth = (whole.filtered(None)[0] / seen.filtered(None)[0]).ln();
        let growth = seen.growth();
        let [least, most] = [growth.least, growth.most].map(|octaves| octaves.iter().sum::<f64>());
        // half a percent of the slope: bands of the spectrum do not end where octaves do
        assert!(least - 0.005 <= true_growth && true_growth <= most + 0.005, "{true_growth} {growth:?}");
        growth.goes_on()
    };
    for hurst in [0.3, 0.5, 0.8] {
        assert!(grown(hurst, 2.0, true) && grown(hurst, 2.0, false));
        assert!(!grown(hurst, 20.0, true) && !grown(hurst, 20.0, false));
    }
}
