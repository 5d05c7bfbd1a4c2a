//! Joints beside a finite-volume solution of the potential, a correlation of measured conductances, the work
//! beside the stored energy, the power of the stiffness, the proven bounds beside the whole maps, and what it
//! costs.
//!
//! `cargo run --release -p asperity-verification --example joint [-- [PART …] --out FILE]` (some minutes of
//! one core); the tables are `verification/results/joint.md`.

// on surfaces made here
#![allow(clippy::expect_used)]

use asperity_roughness::half_space::HalfSpace;
use asperity_roughness::joint::{Fits, JointPath, Law, bounds, follow, loads};
use asperity_roughness::{Grid, HeightMap, Kind, Load, Surface, Target, generate, s_filter};
use asperity_verification::potential::conductance;
use asperity_verification::report::Report;
use cpu_time::ProcessTime;
use std::f64::consts::TAU;

/// Side of the maps, in pixels of 1 µm.
const SIDE: usize = 256;
/// E*, in Pa.
const REDUCED: f64 = 100e9;
/// Mean gradient of all maps.
const GRADIENT: f64 = 0.15;
/// Cut-offs of what is left out, in µm.
const CUTOFFS: [f64; 5] = [4.0, 6.0, 8.0, 12.0, 24.0];
/// p/H of the correlation.
const SHARES: [f64; 4] = [1e-3, 3e-3, 1e-2, 5e-2];
/// Maps of the bounds.
const BOUNDED_MAPS: u64 = 20;

fn surface(hurst: f64, lengths: [f64; 2], seed: u64) -> Surface {
    made(SIDE, hurst, lengths, seed)
}

fn made(side: usize, hurst: f64, [rolloff, cutoff]: [f64; 2], seed: u64) -> Surface {
    let grid = Grid { nodes: [side; 2], pixel: [1e-6; 2], seed };
    let kind = Kind::SelfAffine { hurst, rolloff: rolloff * 1e-6, cutoff: cutoff * 1e-6 };
    let map = generate(kind, &grid, Target::Slope(GRADIENT)).expect("the kind is in range");
    Surface::from_map(map.with_periodic(true)).expect("a map of many cells")
}

fn pressed(surface: &Surface, limit: Option<f64>, pressures: &[f64]) -> JointPath {
    let body = HalfSpace { reduced_modulus: REDUCED, limit, tolerance: 1e-6 };
    follow(&body, surface, pressures, &mut |_, _| Ok(true)).expect("the loads are below the limit")
}

/// Mean of |dz/dx| over neighbours along x and y: the mean absolute slope of profiles.
fn profile_slope(map: &HeightMap) -> f64 {
    let (nx, ny) = (map.columns(), map.rows());
    let z = |x: usize, y: usize| map.row(y % ny)[x % nx];
    let steps = (0..nx * ny).map(|i| {
        let (x, y) = (i % nx, i / nx);
        (z(x + 1, y) - z(x, y)).abs() + (z(x, y + 1) - z(x, y)).abs()
    });
    0.5 * steps.sum::<f64>() / (nx * ny) as f64 / map.pixel()[0]
}

/// h/k = 1.25 m/σ (p/H)^0.95 of Gaussian surfaces whose spots flow (Cooper, Mikic and Yovanovich 1969).
fn known_conductance(surface: &Surface, share: f64) -> f64 {
    1.25 * profile_slope(&surface.map) / surface.parameters.sq * share.powf(0.95)
}

/// That correlation beside maps of `side` points.
fn correlation_on(report: &mut Report, side: usize, maps: &[(f64, [f64; 2])]) {
    const HARDNESS: f64 = 1e9;
    report.section("Conductance over that of Cooper, Mikic and Yovanovich");
    report.line(&format!(
        "Periodic maps of {side}², E* = {} GPa, a limit of 1 GPa, mean gradient {GRADIENT}; by p/H.\n",
        REDUCED * 1e-9
    ));
    report.table("| Hurst exponent | roll-off, µm | cut-off, µm | 1e-3 | 3e-3 | 1e-2 | 5e-2 |");
    for (hurst, lengths) in maps {
        let surface = made(side, *hurst, *lengths, 1);
        let path = pressed(&surface, Some(HARDNESS), &SHARES.map(|share| share * HARDNESS));
        let cells = SHARES.iter().zip(&path.loading[1..]).map(|(share, point)| {
            let found = point.elastic.map_or(f64::NAN, |s| s.gap / REDUCED);
            format!("{:.3}", found / known_conductance(&surface, *share))
        });
        let cells: Vec<String> = cells.collect();
        let [rolloff, cutoff] = lengths;
        report.line(&format!("| {hurst} | {rolloff} | {cutoff} | {} |", cells.join(" | ")));
    }
}

fn correlation(report: &mut Report) {
    let maps = [
        (0.8, [64.0, 16.0]),
        (0.8, [64.0, 8.0]),
        (0.8, [128.0, 8.0]),
        (0.5, [64.0, 8.0]),
        (0.3, [64.0, 8.0]),
    ];
    correlation_on(report, SIDE, &maps);
}

/// The same on maps of more roll-offs to a side, whose summits are more like those of an endless surface.
fn wide(report: &mut Report) {
    correlation_on(report, 2 * SIDE, &[(0.8, [32.0, 8.0]), (0.3, [32.0, 8.0]), (0.8, [64.0, 8.0])]);
}

/// The same of the parts of maps above a plane, which are the spots that the correlation stands for: no
/// contact is pressed, and the conductance is that of the stiffness of these pixels.
fn cut(report: &mut Report) {
    report.section("Conductance of the parts above a plane over that of Cooper, Mikic and Yovanovich");
    report.line(
        "Pixels of periodic maps that are the highest p/H of the area, as spots: no contact mechanics. Mean and standard deviation over seeds, by p/H.\n",
    );
    report.table("| map | Hurst exponent | roll-off, µm | cut-off, µm | seeds | 1e-3 | 3e-3 | 1e-2 | 5e-2 |");
    let maps = [
        (512, 0.8, [32.0, 8.0], 6),
        (1024, 0.8, [64.0, 16.0], 3),
        (512, 0.8, [32.0, 28.0], 6),
        (512, 0.3, [32.0, 8.0], 6),
    ];
    for (side, hurst, lengths, seeds) in maps {
        let found: Vec<[f64; 4]> =
            (1..=seeds).map(|seed| ratios_of_cut(&made(side, hurst, lengths, seed))).collect();
        let cells: Vec<String> = (0..SHARES.len())
            .map(|k| {
                let mean = found.iter().map(|of| of[k]).sum::<f64>() / seeds as f64;
                let squares = found.iter().map(|of| (of[k] - mean).powi(2)).sum::<f64>();
                format!("{mean:.3} ± {:.3}", (squares / (seeds - 1) as f64).sqrt())
            })
            .collect();
        let [rolloff, cutoff] = lengths;
        let cells = cells.join(" | ");
        report.line(&format!("| {side}² | {hurst} | {rolloff} | {cutoff} | {seeds} | {cells} |"));
    }
}

/// h/k of the highest pixels of `surface` over the correlation, at each of [`SHARES`] of the area.
fn ratios_of_cut(surface: &Surface) -> [f64; 4] {
    let body = HalfSpace { reduced_modulus: REDUCED, limit: None, tolerance: 1e-6 };
    let touch = body.press(surface, Load::Pressure(0.0)).expect("nothing is pressed");
    let heights = surface.map.heights();
    let mut sorted = heights.to_vec();
    sorted.sort_by(|a, b| b.total_cmp(a));
    SHARES.map(|share| {
        let plane = sorted[(share * sorted.len() as f64) as usize];
        let mut spots = touch.clone();
        spots.pressures = heights.iter().map(|z| if *z > plane { 1.0 } else { 0.0 }).collect();
        // the stiffness of pixels at their limit is asked for by this
        spots.limited_share = 1.0;
        let stiffness = body.elastic_stiffness(surface, &spots).map_or(f64::NAN, |s| s.gap);
        stiffness / REDUCED / known_conductance(surface, share)
    })
}

/// Energy and power of elastic maps, over three decades to 0.05 E* h'.
fn elastic(report: &mut Report) {
    report.section("Elastic maps: work and power of the stiffness");
    report.line("25 loads over three decades to 0.05 E* of the rms gradient, periodic.\n");
    report.table(
        "| Hurst exponent | seed | work over stored energy, less 1, % | exponent of S over p | residual, % | S Sq/p |",
    );
    for hurst in [0.3, 0.5, 0.8] {
        for seed in [1, 2] {
            let surface = surface(hurst, [64.0, 8.0], seed);
            let most = 0.05 * REDUCED * surface.parameters.rms_gradient;
            let path = pressed(&surface, None, &loads(most, 25));
            let law = Law::new(&path.loading).expect("25 loads");
            let last = path.loading[path.loading.len() - 1];
            let energy = law.work() / (last.elastic_work / path.nominal_area) - 1.0;
            // the upper two decades
            let upper: Vec<_> =
                path.loading.iter().filter(|p| p.pressure >= 0.0099 * most).copied().collect();
            let fit = Fits::new(&upper).stiffness.expect("the loads touch in spots");
            let height = last.elastic.map_or(f64::NAN, |s| s.gap) * surface.parameters.sq / last.pressure;
            report.line(&format!(
                "| {hurst} | {seed} | {:.3} | {:.3} | {:.1} | {height:.2} |",
                1e2 * energy,
                fit.exponent,
                1e2 * fit.fit.residual
            ));
        }
    }
}

/// Barber's bounds of the filtered map, beside the whole map.
fn bounded(report: &mut Report) {
    report.section("Proven bounds of the stiffness, beside the whole maps");
    report.line(&format!(
        "{BOUNDED_MAPS} elastic, periodic maps (Hurst exponent 0.8, roll-off 64 µm, cut-off 8 µm): the map without what a Gaussian filter takes \
         off bounds the stiffness of the whole map, at 25 loads to 0.1 E* of the rms gradient. Width: upper over lower bound at half of \
         the largest load.\n"
    ));
    report.table(
        "| cut-off of the filter, µm | height range left out over Sq, median | violations of the bracket | violations of the bounds | width, median | without upper bound |",
    );
    let whole: Vec<(Surface, JointPath, Vec<f64>)> = (1..=BOUNDED_MAPS)
        .map(|seed| {
            let surface = surface(0.8, [64.0, 8.0], seed);
            let pressures = loads(0.1 * REDUCED * surface.parameters.rms_gradient, 25);
            let path = pressed(&surface, None, &pressures);
            (surface, path, pressures)
        })
        .collect();
    for cutoff in CUTOFFS {
        let (mut outside, mut wrong, mut unbounded) = (0, 0, 0);
        let (mut ranges, mut widths) = (Vec::new(), Vec::new());
        for (surface, path, pressures) in &whole {
            let smooth = s_filter(&surface.map, cutoff * 1e-6).expect("a cut-off of the map");
            let rest: Vec<f64> =
                surface.map.heights().iter().zip(smooth.heights()).map(|(a, b)| a - b).collect();
            let high = rest.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let low = rest.iter().copied().fold(f64::INFINITY, f64::min);
            let range = high - low;
            let smooth = Surface::from_map(smooth).expect("a map of many cells");
            let smoothed = pressed(&smooth, None, pressures);
            let law = Law::new(&smoothed.loading).expect("25 loads");
            // the approach counts from where the plane would touch the smooth map raised by the highest rest
            let start = smoothed.loading[0].mean_gap + smooth.parameters.mean + high;
            let mean = surface.parameters.mean;
            for (one, all) in smoothed.loading.iter().zip(&path.loading).skip(1) {
                let approach = start - (all.mean_gap + mean);
                let bracket = [one.approach, one.approach + range];
                let slack = 1e-6 * range;
                outside += usize::from(approach < bracket[0] - slack || approach > bracket[1] + slack);
                let found = bounds(&law, range, all.pressure);
                let Some(stiffness) = all.elastic else { continue };
                let above = found.high.is_some_and(|high| stiffness.gap > high);
                wrong += usize::from(stiffness.gap < found.low || above);
            }
            ranges.push(range / surface.parameters.sq);
            let middle = bounds(&law, range, 0.5 * pressures[pressures.len() - 1]);
            match middle.high {
                Some(high) => widths.push(high / middle.low),
                None => unbounded += 1,
            }
        }
        let width = median(&mut widths).map_or("–".into(), |width| format!("{width:.2}"));
        report.line(&format!(
            "| {cutoff} | {:.2} | {outside} | {wrong} | {width} | {unbounded} of {BOUNDED_MAPS} |",
            median(&mut ranges).unwrap_or(f64::NAN)
        ));
    }
}

fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// A sum of waves of 16 to 32 of 64 pixels with phases drawn by `seed`, in µm, on `side` points to 64 µm.
fn summed(side: usize, seed: u64) -> Surface {
    // a multiplicative generator of whole numbers (Park and Miller 1988)
    let mut state = 7_u64.pow(5) * (seed + 1);
    let mut drawn = || {
        state = state * 16_807 % 2_147_483_647;
        state as f64 / 2_147_483_647.0
    };
    let numbers = (0..=4).flat_map(|x| (-4..=4).map(move |y| [f64::from(x), f64::from(y)]));
    let waves: Vec<[f64; 4]> = numbers
        .filter(|[x, y]| (2.0..=4.0).contains(&x.hypot(*y)))
        .map(|[x, y]| [x, y, x.hypot(y).powf(-1.8), TAU * drawn()])
        .collect();
    let height = |i: usize| {
        let [x, y] = [i % side, i / side].map(|k| TAU * k as f64 / side as f64);
        1e-6 * waves
            .iter()
            .map(|[p, q, amplitude, phase]| amplitude * (p * x + q * y + phase).cos())
            .sum::<f64>()
    };
    let heights = (0..side * side).map(height).collect();
    let map = HeightMap::new(side, side, [64e-6 / side as f64; 2], heights).expect("points");
    Surface::from_map(map.with_periodic(true)).expect("a map of many cells")
}

/// Conductances beside the potential in the two bodies, solved by finite volumes.
fn potential(report: &mut Report) {
    const PIXELS: usize = 64;
    const FINER: usize = 3;
    report.section("Conductance over that of the potential");
    report.line(
        "k S/E* of the joint over the conductance of its spots by finite volumes, which know no half-space; periodic sums of waves of 16 to 32 \
         pixels on 64². Spots that are whole pixels conduct too well, by the first power of the pixel: they are taken from 64² and 192² points of the \
         same surface under the same load, and that is extrapolated away.\n",
    );
    report.table(
        "| contact | area, % | h·64 µm/k, spots of 64² | of 192² | without pixels | joint of 64² over that | of 192² |",
    );
    let cases = [
        ("elastic", 1, 0.03, None),
        ("elastic", 2, 0.10, None),
        ("with a limit of pressure", 3, 0.05, Some(0.3)),
    ];
    for (name, seed, load, limit) in cases {
        let stress = REDUCED * summed(PIXELS, seed).parameters.rms_gradient;
        let limit = limit.map(|limit: f64| limit * stress);
        let body = HalfSpace { reduced_modulus: REDUCED, limit, tolerance: 1e-6 };
        let found = [1, FINER].map(|finer| {
            let surface = summed(finer * PIXELS, seed);
            let path = pressed(&surface, limit, &[load * stress]);
            let found = body.press(&surface, Load::Pressure(load * stress)).expect("below the limit");
            let spots: Vec<bool> = found.pressures.iter().map(|p| *p > 0.0).collect();
            let known =
                (finer * PIXELS) as f64 * conductance(&spots, finer * PIXELS, if finer == 1 { 2 } else { 1 });
            let joint = path.loading[1].elastic.map_or(f64::NAN, |s| s.gap) * 64e-6 / REDUCED;
            (known, joint, found.area.corrected)
        });
        let [(coarse, joint, area), (fine, finer_joint, _)] = found;
        // the rest goes with the pixel
        let known = fine + (fine - coarse) / (FINER - 1) as f64;
        report.line(&format!(
            "| {name} | {:.1} | {coarse:.3} | {fine:.3} | {known:.3} | {:.3} | {:.3} |",
            1e2 * area,
            joint / known,
            finer_joint / known
        ));
    }
}

/// Core seconds of a law beside those of one load, both with stiffness and without leak.
fn cost(report: &mut Report) {
    report.section("Core seconds");
    report.line(
        "25 loads to 0.05 E* of the rms gradient on periodic, elastic maps (H 0.8, roll-off a quarter of the side, shortest wave 8 pixels), beside one load, \
         the middle one, pressed from nothing with the same numbers.\n",
    );
    report.table("| map | 25 loads | one load | ratio |");
    for side in [1024, 2048] {
        let surface = made(side, 0.8, [side as f64 / 4.0, 8.0], 1);
        let pressures = loads(0.05 * REDUCED * surface.parameters.rms_gradient, 25);
        let seconds = |pressures: &[f64]| {
            let start = ProcessTime::now();
            pressed(&surface, None, pressures);
            start.elapsed().as_secs_f64()
        };
        let [all, one] = [&pressures[..], &pressures[12..13]].map(seconds);
        report.line(&format!("| {side}² | {all:.1} | {one:.1} | {:.1} |", all / one));
    }
}

/// A section of the report.
type Part = fn(&mut Report);

fn main() -> std::io::Result<()> {
    let (mut report, rest) = Report::of_example("joint", "half_space.tolerance = 1e-6");
    let parts: [(&str, Part); 7] = [
        ("potential", potential),
        ("correlation", correlation),
        ("wide", wide),
        ("cut", cut),
        ("elastic", elastic),
        ("bounds", bounded),
        ("cost", cost),
    ];
    for (name, part) in parts {
        if rest.is_empty() || rest.iter().any(|word| word == name) {
            part(&mut report);
        }
    }
    report.finish()
}
