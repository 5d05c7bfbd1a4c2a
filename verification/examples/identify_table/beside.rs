//! The published finite elements beside those of the program, at metals that are known: what a fit of them
//! can be off by.

use crate::Book;
use crate::cases::{DEPTH, Published};
use asperity_calibration::indentation::solve;
use asperity_material::cone_atlas::{Atlas, Contact, SharpCone};
use asperity_simulation::scene::{Accuracy, Friction};
use asperity_simulation::setup::cone::Cone;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::report::Report;
use asperity_verification::twins::indenter;
use rayon::prelude::*;
use serde_json::json;

/// Numbers of the program over the published ones.
#[derive(Clone, Copy)]
pub struct Ratios {
    pub exponent: f64,
    pub e_over_sy: f64,
    /// Loading curvatures under 60° and 50°.
    pub curvatures: [Option<f64>; 2],
    /// Unloading slope under 60°.
    pub slope: Option<f64>,
}

impl Ratios {
    /// True where both curvatures agree within `share`.
    pub fn agree(&self, share: f64) -> bool {
        self.curvatures.iter().all(|k| k.is_some_and(|k| (k - 1.0).abs() <= share))
    }
}

/// K/E, S/(E h) and the returned share of the work under a smooth cone of this slope on a metal of law
/// `swift`; none where the path stopped.
pub fn indented(
    book: &Book,
    ratio: f64,
    exponent: f64,
    slope_deg: f64,
    accuracy: Accuracy,
) -> Option<[f64; 3]> {
    by_finite_elements(book, [ratio, exponent, slope_deg], accuracy, 0.0)
}

/// The same with a coefficient of `friction`.
fn by_finite_elements(
    book: &Book,
    [ratio, exponent, slope_deg]: [f64; 3],
    accuracy: Accuracy,
    friction: f64,
) -> Option<[f64; 3]> {
    let level = if accuracy == Accuracy::Standard { "" } else { " finer" };
    let rough = if friction == 0.0 { String::new() } else { format!(" friction {friction}") };
    let found = book.recall(&format!("cone {slope_deg} {ratio} {exponent}{level}{rough}"), || {
        let cone = indenter(slope_deg, ratio, exponent);
        let cone = Cone { friction: Friction::Coefficient(friction).law(), ..cone };
        let found = solve(&cone, accuracy, &Analyses::default()).ok()?.0;
        Some(json!([found.k_over_e, found.stiffness, found.elastic_share]))
    })?;
    Some([found[0].as_f64()?, found[1].as_f64()?, found[2].as_f64()?])
}

/// K/E that the atlas of cones expects: what a fit goes by before finite elements are asked.
fn by_the_atlas(ratio: f64, exponent: f64, slope_deg: f64) -> Option<f64> {
    let Cone { metal, .. } = indenter(slope_deg, ratio, exponent);
    let cone = SharpCone::new(slope_deg, &metal.elastic, metal.hardening?, Contact::Indenting);
    Some(Atlas::committed()?.nearest(&cone).k_over_e.value)
}

/// The ratios of all metals.
pub fn ratios(book: &Book, metals: &[Published]) -> Vec<Ratios> {
    let one = |p: &Published| {
        let ratio = p.youngs_modulus / p.yield_stress;
        let under = [30.0, 40.0].map(|slope| indented(book, ratio, p.exponent, slope, Accuracy::Standard));
        let curvature = |k: usize| Some(under[k]?[0] * p.youngs_modulus / p.curvatures[k]?);
        Ratios {
            exponent: p.exponent,
            e_over_sy: p.youngs_modulus / p.yield_stress,
            curvatures: [curvature(0), curvature(1)],
            // GPa times µm is kN/m
            slope: under[0].map(|[_, s, _]| 1e3 * s * p.youngs_modulus * DEPTH / p.slope),
        }
    };
    metals.par_iter().with_max_len(1).map(one).collect()
}

/// Mean, least and largest of some ratios less 1, in percent.
fn spread(values: impl Iterator<Item = f64>) -> String {
    let values: Vec<f64> = values.map(|v| 100.0 * (v - 1.0)).collect();
    let mean = values.iter().sum::<f64>() / values.len().max(1) as f64;
    let (least, most) =
        values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |a, v| (a.0.min(*v), a.1.max(*v)));
    format!("{mean:+.1} ({least:+.1} to {most:+.1})")
}

/// Writes the table of what the two differ by.
pub fn section(report: &mut Report, ratios: &[Ratios]) {
    report.section("The program's finite elements beside the published ones");
    report.table(
        "| n | E/σ_y | metals | K under 60°, % above the published | K under 50°, % above | unloading slope under 60°, % above |",
    );
    for exponent in [0.0, 0.1, 0.3, 0.5] {
        for (name, low, high) in [("up to 80", 0.0, 80.0), ("above 80", 80.0, f64::INFINITY)] {
            let own: Vec<&Ratios> = ratios
                .iter()
                .filter(|r| r.exponent == exponent && r.e_over_sy > low && r.e_over_sy <= high)
                .collect();
            report.line(&format!(
                "| {exponent} | {name} | {} | {} | {} | {} |",
                own.len(),
                spread(own.iter().filter_map(|r| r.curvatures[0])),
                spread(own.iter().filter_map(|r| r.curvatures[1])),
                spread(own.iter().filter_map(|r| r.slope))
            ));
        }
    }
}

/// Metals whose curvature is computed in several ways: n, E/σ_y.
const FINER: [[f64; 2]; 5] =
    [[0.0, 100.0], [0.0, 1000.0 / 3.0], [0.1, 100.0], [0.1, 1000.0 / 3.0], [0.5, 1000.0 / 3.0]];
/// A coefficient of friction of a polished tool.
const FRICTION: f64 = 0.1;

/// Writes whether the differences are those of the emulator, of the level, or of friction.
pub fn finer(report: &mut Report, book: &Book, metals: &[Published]) {
    report.section("Loading curvature over the published one: emulator, levels, friction");
    report.table(&format!(
        "| half apex angle, ° | n | E/σ_y | the atlas, % | standard, % | reference, % | standard with friction {FRICTION}, % |"
    ));
    for (k, slope_deg) in [30.0, 40.0].into_iter().enumerate() {
        for [exponent, ratio] in FINER {
            let like = |p: &&Published| {
                p.exponent == exponent && (p.youngs_modulus / p.yield_stress / ratio - 1.0).abs() < 1e-3
            };
            let Some(p) = metals.iter().find(like) else { continue };
            let above = |k_over_e: Option<f64>| {
                let over = k_over_e.zip(p.curvatures[k]).map(|(ours, c)| ours * p.youngs_modulus / c);
                over.map_or_else(|| "stopped".into(), |over| format!("{:+.1}", 100.0 * (over - 1.0)))
            };
            let computed = |accuracy, friction| {
                let place = [p.youngs_modulus / p.yield_stress, exponent, slope_deg];
                above(by_finite_elements(book, place, accuracy, friction).map(|found| found[0]))
            };
            report.line(&format!(
                "| {} | {exponent} | {ratio:.0} | {} | {} | {} | {} |",
                90.0 - slope_deg,
                above(by_the_atlas(p.youngs_modulus / p.yield_stress, exponent, slope_deg)),
                computed(Accuracy::Standard, 0.0),
                computed(Accuracy::Reference, 0.0),
                computed(Accuracy::Standard, FRICTION)
            ));
        }
    }
}
