//! Claim: a table of hardening is the law it was taken from, to the error of its sampling, and two points are
//! linear hardening; a table with kinks costs Newton's method nothing.
//!
//! Source: linear interpolation between the points, constant beyond, as *PLASTIC of Abaqus and CalculiX. Bar:
//! ε = τ/E + ε_p and τ = σ_y + H ε_p give τ = (σ_y + Hε)/(1 + H/E); tolerance 1e-9, what the local solve
//! leaves. A dense table of Voce's law stands beside the law itself, which the solver returns to by another
//! way: 0.3 % of the force. Asperity: forces are sums of stresses, so that no force differs by more than the
//! largest error of the sampled stress, besides ten times the tolerance of Newton's method.

use asperity_material::units::Stress;
use asperity_material::{Hardening, HardeningLaw, HardeningTable, Voce};
use asperity_mesh::ElementKind;
use asperity_simulation::record::rows::CurveRow;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, HardeningChoice, Material, Scene};
use asperity_solver::point::material::Metal;
use asperity_verification::single_asperity::{crush, scene};
use asperity_verification::single_increment::{ELASTIC_METAL, stretch_bar};

const SWIFT: Hardening =
    Hardening { law: HardeningLaw::Swift, yield_stress: 300e6, exponent: 0.3, youngs_modulus: 210e9 };

/// Plastic strains from 0, then `count` in equal ratios from 1e-5 to 3.
fn strains(count: usize) -> Vec<f64> {
    let ratio = (3.0_f64 / 1e-5).powf(1.0 / (count - 1) as f64);
    std::iter::once(0.0).chain((0..count).map(|i| 1e-5 * ratio.powi(i as i32))).collect()
}

fn points(strains: &[f64]) -> Vec<[f64; 2]> {
    strains.iter().map(|&p| [p, SWIFT.flow(p).yield_stress]).collect()
}

/// The asperity at draft with a table of the law.
fn tabulated(strains: &[f64]) -> Scene {
    let mut scene = scene(Accuracy::Draft).unwrap();
    scene.numerics.newton_tolerance = Some(1e-6);
    scene.material = Material {
        yield_stress: None,
        hardening_exponent: None,
        hardening_law: HardeningChoice::Table,
        hardening_table: Some(points(strains).iter().map(|&[p, s]| (p, Stress(s))).collect()),
        ..scene.material
    };
    scene
}

fn swift() -> Outcome {
    let mut scene = scene(Accuracy::Draft).unwrap();
    scene.numerics.newton_tolerance = Some(1e-6);
    scene.material.hardening_law = HardeningChoice::Swift;
    crush(&scene).unwrap()
}

#[test]
fn two_points_are_linear_hardening() {
    let (first, modulus, last) = (1.5e-3, 0.02, 0.3);
    let table = HardeningTable::new(&[[0.0, first], [last, first + modulus * last]]).unwrap();
    let metal = Metal { hardening: Some(table.into()), ..ELASTIC_METAL };
    let strains = [1e-3, 1.6e-3, 0.01, 0.1, 0.3, 0.31, 0.6, 1.0];
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for (stress, strain) in stretch_bar(kind, &metal, &strains).unwrap().into_iter().zip(strains) {
            let hardening = (first + modulus * strain) / (1.0 + modulus);
            let exact = hardening.min(strain).min(first + modulus * last);
            assert!((stress / exact - 1.0).abs() < 1e-9, "{kind:?} {strain}: {stress} {exact}");
        }
    }
}

#[test]
fn a_dense_table_gives_the_force_of_its_law() {
    let exact = swift();
    for count in [40, 200] {
        let strains = strains(count);
        let table = HardeningTable::new(&points(&strains)).unwrap();
        let sampling =
            strains.windows(2).flat_map(|pair| [0.25, 0.5, 0.75].map(|t| pair[0] + t * (pair[1] - pair[0])));
        let error = sampling
            .map(|p| (table.flow(p).yield_stress / SWIFT.flow(p).yield_stress - 1.0).abs())
            .fold(0.0, f64::max);
        let got = crush(&tabulated(&strains)).unwrap();
        assert!(got.stopped.is_none());
        let peak = exact.summary.peak_force;
        let differs = |(a, b): (&CurveRow, &CurveRow)| (a.force - b.force).abs() / peak;
        let worst = got.rows.iter().zip(&exact.rows).map(differs).fold(0.0, f64::max);
        println!("{count} points: stress to {error:.1e}, force to {worst:.1e}");
        assert!(worst <= error + 1e-5, "{count} points: {worst:e}, sampled to {error:e}");
        let residual = |o: &Outcome| o.summary.residual_depth.unwrap() / o.summary.peak_depth;
        assert!((residual(&got) - residual(&exact)).abs() <= error + 1e-5);
        let estimates = [&got, &exact].map(|o| o.summary.estimated_error);
        assert!((estimates[0] / estimates[1] - 1.0).abs() < 0.05, "{estimates:?}");
    }
}

#[test]
fn voce_gives_the_force_of_a_dense_table() {
    let law = Voce { yield_stress: 300e6, saturation_stress: 700e6, saturation_strain: 0.1 };
    let mut saturating = scene(Accuracy::Draft).unwrap();
    saturating.material.hardening_exponent = None;
    let mut tabulated = saturating.clone();
    saturating.material = saturating.material.saturating(Stress(300e6), Stress(700e6), 0.1);
    tabulated.material.yield_stress = None;
    let table = (0..1500).map(|i| 0.001 * f64::from(i)).map(|p| (p, Stress(law.flow(p).yield_stress)));
    tabulated.material = tabulated.material.hardening_by(table);
    let [exact, got] = [saturating, tabulated].map(|scene| crush(&scene).unwrap());
    assert!(exact.stopped.is_none() && got.stopped.is_none());
    let [force, other] = [&exact, &got].map(|outcome| outcome.summary.peak_force);
    println!("force {force} of the law, {other} of its table");
    assert!((other / force - 1.0).abs() < 3e-3, "{force} {other}");
    for (a, b) in exact.rows.iter().zip(&got.rows) {
        assert!((a.force - b.force).abs() < 3e-3 * force, "{} {}", a.force, b.force);
    }
}

#[test]
fn kinks_in_the_table_cost_no_iterations() {
    let exact = swift();
    // kinks where most of the metal flows, the slope falling to a tenth in one of them
    let got = crush(&tabulated(&[0.0, 0.002, 0.02, 0.15])).unwrap();
    assert!(got.stopped.is_none() && got.summary.cutbacks <= exact.summary.cutbacks);
    let (iterations, smooth) = (got.summary.newton_iterations, exact.summary.newton_iterations);
    println!("{iterations} iterations with kinks, {smooth} without");
    assert!(10 * iterations <= 12 * smooth, "{iterations} {smooth}");
    // the energy of the smooth law balances to as much at this accuracy
    assert!(got.summary.energy_balance_error < 2.0 * exact.summary.energy_balance_error);
}
