//! Scales of generated surfaces beside what is known of them: slopes beside a quadrature over the generator's
//! spectrum, fitted spectra, mean pressures over E* h', Persson's theory, and verdicts beside two finer
//! octaves and beside half the map.
//!
//! `cargo run --release -p asperity-verification --example scales [-- --out FILE]` (some
//! minutes of one core); the tables are `verification/results/scales.md`.

// on surfaces made here
#![allow(clippy::expect_used)]

mod halved;
mod verdicts;

use asperity_material::HardeningLaw;
use asperity_material::units::Stress;
use asperity_roughness::half_space::{HalfSpace, PressureLimit};
use asperity_roughness::scales::{
    Numbers, Scale, Scales, SelfAffine, SlopePower, Slopes, Task, cutoffs, persson, press_scale,
};
use asperity_roughness::{Grid, HeightMap, Kind, Load, Material, Surface, Target, generate};
use asperity_solver::point::material::Metal;
use asperity_verification::report::Report;
use asperity_verification::single_increment::{ELASTIC_METAL, hollomon};
use asperity_verification::wave_on_wave::{WaveContact, Waves};
use cpu_time::ProcessTime;
use std::f64::consts::LN_2;

/// E*, in Pa: steel.
const REDUCED: f64 = 210e9 / 0.91;
/// Mean gradient of all maps.
const GRADIENT: f64 = 0.1;
/// Maps of each kind in the tables of fits and verdicts.
const MAPS: u64 = 30;
/// Points of the larger maps along a side.
const FINE: usize = 512;

fn made(side: usize, hurst: f64, [rolloff, cutoff]: [f64; 2], seed: u64) -> Surface {
    let grid = Grid { nodes: [side; 2], pixel: [1e-6; 2], seed };
    let kind = Kind::SelfAffine { hurst, rolloff: rolloff * 1e-6, cutoff: cutoff * 1e-6 };
    let map = generate(kind, &grid, Target::Slope(GRADIENT)).expect("the kind is in range");
    Surface::from_map(map.with_periodic(true)).expect("a map of many cells")
}

/// Steel of a yield stress (Pa), on an elastic half-space.
fn task(yield_stress: f64) -> Task {
    let material = Material {
        youngs_modulus: Stress(210e9),
        poissons_ratio: 0.3,
        hardness: None,
        hardness_error: None,
        yield_stress: Some(Stress(yield_stress)),
        hardening_exponent: None,
        hardening_law: None,
    };
    let body = HalfSpace { reduced_modulus: REDUCED, limit: None, tolerance: 1e-6 };
    Task { material, law: HardeningLaw::Hollomon, body, closures: Vec::new() }
}

/// Mean square slope of the generator's spectrum that a Gaussian filter of the cut-off (µm) leaves, up to a
/// factor: ∫ f² C(f) G(f) 2πf df by the midpoint rule in ln f, of an endless map.
fn quadrature(hurst: f64, [rolloff, shortest]: [f64; 2], cutoff: f64) -> f64 {
    const STEPS: usize = 20_000;
    let (low, high) = ((1e-3 / rolloff).ln(), (1.0 / shortest).ln());
    let width = (high - low) / STEPS as f64;
    let part = |k: usize| {
        let f = (low + (k as f64 + 0.5) * width).exp();
        let density = (f * rolloff).max(1.0).powf(-2.0 - 2.0 * hurst);
        density * (-2.0 * LN_2 * (cutoff * f).powi(2)).exp() * f.powi(4) * width
    };
    (0..STEPS).map(part).sum()
}

fn slopes(report: &mut Report) {
    report.section("Slope by scale");
    report.line(
        "Rms slope at each cut-off over that of the whole map, mean of 8 periodic maps of 512² (roll-off 64 µm, shortest wave 4 µm, pixel \
         1 µm), over the same ratio by a quadrature over the generator's spectrum, less 1, in %.\n",
    );
    let waves = [64.0, 4.0];
    let shown = [32.0, 16.0, 8.0, 4.0].map(|c: f64| c * 2f64.sqrt());
    report.table("| Hurst exponent | 45 µm | 23 µm | 11 µm | 5.7 µm | H of the last two octaves less H |");
    for hurst in [0.3, 0.5, 0.7, 0.8, 0.9] {
        let mut sums = [0.0; 4];
        for seed in 1..=8 {
            let surface = made(FINE, hurst, waves, seed);
            let (power, _) = SlopePower::new(&surface.map).expect("heights");
            for (sum, cutoff) in sums.iter_mut().zip(shown) {
                let scale = Scale::new(&surface, cutoff * 1e-6).expect("a cut-off of the map");
                let whole = power.filtered(None)[0];
                *sum += Slopes::new(&scale, &surface.map, &power).rms / whole / 8.0;
            }
        }
        let known = |cutoff: f64| (quadrature(hurst, waves, cutoff) / quadrature(hurst, waves, 0.0)).sqrt();
        let off = sums.iter().zip(shown).map(|(found, cutoff)| 1e2 * (found / known(cutoff) - 1.0));
        let cells: Vec<String> = off.map(|off| format!("{off:.2}")).collect();
        let law = 1.0 - (sums[3] / sums[1]).log2() / 2.0 - hurst;
        report.line(&format!("| {hurst} | {} | {law:.2} |", cells.join(" | ")));
    }
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

fn fits(report: &mut Report) {
    report.section("Hurst exponent and roll-off");
    report.line(&format!(
        "{MAPS} maps of 256² of each kind, H 0.3 to 0.9, roll-off 32 to 64 µm, shortest wave 2 to 6 µm, pixel 1 µm; the free ones are 256² \
         out of periodic maps of 512², levelled by a plane.\n"
    ));
    report.table("| maps | H inside its interval | half width of H, median | roll-off inside | half width of the roll-off over it, median, % |");
    for free in [false, true] {
        let (mut inside, mut widths) = ([0; 2], [Vec::new(), Vec::new()]);
        for seed in 1..=MAPS {
            let share = seed as f64 / MAPS as f64;
            let (hurst, rolloff, shortest) =
                (0.3 + 0.6 * share, 32.0 + 32.0 * (7.0 * share).fract(), 2.0 + seed as f64 % 5.0);
            let surface = made(if free { 512 } else { 256 }, hurst, [rolloff, shortest], seed);
            let map = if free { first_half(&surface.map) } else { surface.map };
            let (_, points) = SlopePower::new(&map).expect("heights");
            let fit = SelfAffine::new(&map, &points).expect("many bands");
            for (k, (found, known)) in
                [(fit.hurst, hurst), (fit.rolloff, rolloff * 1e-6)].into_iter().enumerate()
            {
                inside[k] += usize::from((found.low..=found.high).contains(&known));
                widths[k].push(0.5 * (found.high - found.low) / if k == 0 { 1.0 } else { known });
            }
        }
        let [hurst, rolloff] = widths.map(median);
        report.line(&format!(
            "| {} | {} of {MAPS} | {hurst:.3} | {} of {MAPS} | {:.0} |",
            if free { "free" } else { "periodic" },
            inside[0],
            inside[1],
            1e2 * rolloff
        ));
    }
}

/// The first quarter of a map, of half its sides, levelled.
fn first_half(map: &HeightMap) -> HeightMap {
    let n = map.columns() / 2;
    let heights = (0..n).flat_map(|y| map.row(y)[..n].to_vec()).collect();
    let cut = HeightMap::new(n, n, map.pixel(), heights).expect("a quarter of a map");
    asperity_roughness::level(cut, asperity_roughness::Levelling::Plane)
}

/// The area that has been corrected for pixels.
fn corrected(found: &Numbers) -> f64 {
    found.area.map_or(f64::NAN, |area| area.corrected)
}

fn pressures(report: &mut Report) {
    report.section("Elastic mean pressure over E* h'");
    report.line(
        "κ = E* h' A/(p A₀) by scale, the area corrected for pixels, of periodic maps of 512² (roll-off 64 µm, shortest wave 4 µm), each scale at a load \
         of 0.02 E* h' of its own, which leaves 4 to 5 % in contact at every scale; in brackets the contact, %.\n",
    );
    report.table("| Hurst exponent | 45 µm | 23 µm | 11 µm | 5.7 µm | whole |");
    for hurst in [0.3, 0.5, 0.8] {
        let surface = made(FINE, hurst, [64.0, 4.0], 1);
        let (power, _) = SlopePower::new(&surface.map).expect("heights");
        let cell = |cutoff: f64| {
            let scale = Scale::new(&surface, cutoff * 1e-6).expect("a cut-off of the map");
            let stress = REDUCED * Slopes::new(&scale, &surface.map, &power).rms;
            let pressure = 0.02 * stress;
            let found = press_scale(&task(800e6).body, &scale.surface, pressure, None, None);
            let area = corrected(&found.expect("the load is carried").0);
            format!("{:.2} ({:.1})", stress * area / pressure, 1e2 * area)
        };
        let cells = [45.25, 22.63, 11.31, 5.657, 2.0].map(cell);
        report.line(&format!("| {hurst} | {} |", cells.join(" | ")));
    }
}

fn follow(task: &Task, surface: &Surface, pressure: f64) -> Scales {
    let found = task.follow(surface, Load::Pressure(pressure), &mut |_, _, _| true);
    found.expect("the load is carried").expect("nothing ends the way")
}

fn theory(report: &mut Report) {
    report.section("Persson's theory over the limited half-space");
    report.line(
        "Contact area by the theory over that of the half-space with the same limit of pressure, by magnification (roll-off over shortest wave \
         √2 cut-offs); periodic map of 512², H 0.8, roll-off 128 µm, shortest wave 4 µm. In brackets the area over nominal area by the half-space, %.\n",
    );
    let surface = made(FINE, 0.8, [128.0, 4.0], 1);
    report.table("| limit over E* h' | load over E* h' | 2.8 | 5.7 | 11 | 32 |");
    for limit in [0.1, 0.3, 1.0] {
        for load in [0.02, 0.05] {
            let stress = REDUCED * surface.parameters.rms_gradient;
            let (power, _) = SlopePower::new(&surface.map).expect("heights");
            let cell = |cutoff: f64| {
                let scale = Scale::new(&surface, cutoff * 1e-6).expect("a cut-off of the map");
                let slopes = Slopes::new(&scale, &surface.map, &power);
                let body = HalfSpace { limit: Some(limit * stress), ..task(1e9).body };
                let (found, _) = press_scale(&body, &scale.surface, load * stress, None, None)
                    .expect("the load is carried");
                let theory =
                    persson(slopes.rms, load * stress, REDUCED, body.limit).expect("below the limit");
                let area = corrected(&found);
                format!("{:.2} ({:.1})", theory.total() / area, 1e2 * area)
            };
            let cells = [32.0, 16.0, 8.0, 2.0].map(|c: f64| cell(if c > 2.0 { c } else { 2.0 }));
            report.line(&format!("| {limit} | {load} | {} |", cells.join(" | ")));
        }
    }
}

/// A metal of the waves: E over yield stress, 0 of an elastic one, and the exponent of its hardening.
type WaveMetal = (f64, f64);

/// Points of the longest wave of the half-space of waves, and its lines, which are alike.
const WAVE_POINTS: [usize; 2] = [8192, 4];
/// Elements to the shortest wave.
const WAVE_ELEMENTS: usize = 32;

/// The half-space of `waves` with that limit of pressure (over E) at the nominal `pressure`.
fn on_half_space(waves: &Waves, limit: Option<f64>, pressure: f64) -> Option<WaveContact> {
    let [n, lines] = WAVE_POINTS;
    let heights = (0..n * lines).map(|i| waves.height((i % n) as f64 / n as f64)).collect();
    let map = HeightMap::new(n, lines, [1.0 / n as f64; 2], heights).ok()?.with_periodic(true);
    let body = HalfSpace { reduced_modulus: 1.0 / 0.91, limit, tolerance: 1e-6 };
    let surface = Surface::from_map(map).ok()?;
    let found = press_scale(&body, &surface, pressure, None, None).ok()?.0;
    Some(WaveContact { pressure, area: found.area_ratio?, high_pressure: found.pressures[1]? })
}

/// The limits of pressure over E of `waves`: at the mean slope of all of them, and at that of the patches.
fn limits(waves: &Waves, (ratio, exponent): WaveMetal, pressure: f64) -> [Option<f64>; 2] {
    if ratio == 0.0 {
        return [None; 2];
    }
    let e = 210e9;
    let steel = task(e / ratio).material;
    let metal = Material { hardening_exponent: Some(exponent), ..steel };
    let [n, lines] = WAVE_POINTS;
    let heights = (0..n * lines).map(|i| waves.height((i % n) as f64 / n as f64)).collect();
    let map = HeightMap::new(n, lines, [1.0 / n as f64; 2], heights).expect("a wave of points");
    let surface = Surface::from_map(map.with_periodic(true)).expect("a map of many cells");
    let law = HardeningLaw::Hollomon;
    let by_slope = PressureLimit::at_slope(&metal, law, surface.parameters.mean_gradient);
    let by_patch = PressureLimit::on_surface(&metal, law, &surface, Load::Pressure(pressure * e));
    [by_slope, by_patch].map(|limit| limit.map(|limit| limit.pressure / e))
}

fn waves(report: &mut Report) {
    const BELIEVED: f64 = 0.15;
    report.section("Waves on a wave, beside finite elements");
    report.line(&format!(
        "Plane strain, ν = 0.3: a wave of the largest slope 0.02 with eight waves of 0.04 on it (two scales), or four of 0.03 and sixteen of 0.05 \
         (three). Finite elements at large strains, {WAVE_ELEMENTS} to the shortest wave; half-space of a map that is constant along y, {} points to the longest wave, with no limit of \
         elastic metal, with the plateau of the atlas of cones at the mean slope of all waves (by slope), and at that of the patches. \
         Areas and the pressures that 99 % of the contact are below, over those of finite elements.\n",
        WAVE_POINTS[0]
    ));
    report.table(
        "| scales | E/σ_y | n | p/E* h' | contact, % | p99/σ_y or E* h' | elastic: area | p99 | by slope: area | p99 | by patch: area | p99 |",
    );
    let two = Waves { waves: vec![[1.0, 0.02], [8.0, 0.04]] };
    let three = Waves { waves: vec![[1.0, 0.02], [4.0, 0.03], [16.0, 0.05]] };
    let mut right = [0; 2];
    for (count, waves) in [(2, &two), (3, &three)] {
        let steep = (waves.waves.iter().map(|[_, slope]| 0.5 * slope * slope).sum::<f64>()).sqrt() / 0.91;
        for metal @ (ratio, exponent) in [(0.0, 0.0), (300.0, 0.2), (1000.0, 0.1)] {
            let body: Metal = if ratio == 0.0 { ELASTIC_METAL } else { hollomon(1.0 / ratio, exponent) };
            let shares = if ratio == 1000.0 { [0.01, 0.03] } else { [0.03, 0.1] };
            let pressures = shares.map(|share| share * steep);
            let Ok(crushed) = waves.crushed(&body, &pressures, WAVE_ELEMENTS) else {
                report.line(&format!("| {count} | {ratio} | {exponent} | did not converge |"));
                continue;
            };
            for (share, truth) in shares.iter().zip(crushed) {
                let limits = limits(waves, metal, truth.pressure);
                let found = [None, limits[0], limits[1]].map(|l| on_half_space(waves, l, truth.pressure));
                let ratios = found
                    .map(|found| found.map(|f| [f.area / truth.area, f.high_pressure / truth.high_pressure]));
                for (right, one) in right.iter_mut().zip(&ratios[1..]) {
                    let near = |ratio: &f64| (ratio - 1.0).abs() <= BELIEVED;
                    *right += usize::from(one.is_some_and(|both| both.iter().all(near)));
                }
                let cells = ratios.map(|one| {
                    one.map_or("– | –".into(), |[area, high]| format!("{area:.2} | {high:.2}"))
                });
                let unit = if ratio == 0.0 { 1.0 / steep } else { ratio };
                report.line(&format!(
                    "| {count} | {} | {exponent} | {share} | {:.2} | {:.2} | {} |",
                    if ratio == 0.0 { "∞".into() } else { ratio.to_string() },
                    1e2 * truth.area,
                    unit * truth.high_pressure,
                    cells.join(" | ")
                ));
            }
        }
    }
    report.line(&format!(
        "\nArea and 99 % pressure both within {:.0} % of finite elements: by slope in {} of 12 cases, by patch in {}.",
        1e2 * BELIEVED,
        right[0],
        right[1]
    ));
}

fn cost(report: &mut Report) {
    report.section("Core seconds");
    report.line("All scales of periodic maps (H 0.8, roll-off a quarter of the side, shortest wave two pixels, a load that leaves 4 % of the whole map in contact, steel that flows at 800 MPa), both half-spaces, leak and stiffness; and of 4096² the statistics alone.\n");
    report.table("| map | scales | core seconds |");
    for side in [1024, 2048, 4096] {
        let surface = made(side, 0.8, [side as f64 / 4.0, 2.0], 1);
        let start = ProcessTime::now();
        let scales = if side == 4096 {
            let (power, points) = SlopePower::new(&surface.map).expect("heights");
            SelfAffine::new(&surface.map, &points).expect("many bands");
            let all = cutoffs(&surface.map);
            for cutoff in &all {
                let scale = Scale::new(&surface, *cutoff).expect("a cut-off of the map");
                Slopes::new(&scale, &surface.map, &power);
            }
            all.len()
        } else {
            let pressure = 0.02 * REDUCED * surface.parameters.rms_gradient;
            follow(&task(800e6), &surface, pressure).steps.len()
        };
        let alone = if side == 4096 { ", statistics" } else { "" };
        report.line(&format!("| {side}²{alone} | {scales} | {:.1} |", start.elapsed().as_secs_f64()));
    }
}

/// A section of the report.
type Part = fn(&mut Report);

fn main() -> std::io::Result<()> {
    let (mut report, rest) = Report::of_example("scales", "half_space.tolerance = 1e-6");
    let parts: [(&str, Part); 8] = [
        ("slopes", slopes),
        ("fits", fits),
        ("pressures", pressures),
        ("theory", theory),
        ("waves", waves),
        ("verdicts", verdicts::judged),
        ("halved", halved::judged),
        ("cost", cost),
    ];
    for (name, part) in parts {
        if rest.is_empty() || rest.iter().any(|word| word == name) {
            part(&mut report);
        }
    }
    report.finish()
}
