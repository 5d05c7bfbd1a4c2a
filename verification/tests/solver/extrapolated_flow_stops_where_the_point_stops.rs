//! Claim: the second-order flow rule never takes a point to where backward Euler would not: whether the
//! strain is held, slows down, is reversed, turns or comes in pieces of very different length, the stress is
//! that of a point strained that way.
//!
//! Source: uniaxial perfect plasticity, σ = min(max(σ + E Δε, -σ_y), σ_y) in any number of steps. Increments
//! of 10 ε_y are those at which an extrapolation without a bound turned σ_y into -σ_y. Tolerance 1e-6 of σ_y:
//! equilibrium is solved to 1e-12, and what is frozen at a nearly converged iterate is corrected by the
//! return; 3e-3 where the point stays elastic, from ln(1 + ε).

use asperity_material::StressMeasure;
use asperity_mesh::ElementKind;
use asperity_numerics::newton::solve;
use asperity_solver::equilibrium::Equilibrium;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;
use asperity_solver::point::tensor::contract;
use asperity_verification::single_increment::{TIGHT_SETTINGS, hollomon, model, stresses};
use asperity_verification::test_meshes::{boundary, mapped, nodes_of};

const YIELD: f64 = 1e-3;

/// The materials: isotropic and with a back stress, by true and by Kirchhoff's stress.
fn metals() -> [Metal; 3] {
    let metal = hollomon(YIELD, 0.0);
    [
        metal.clone(),
        Metal { kinematic_share: 1.0, ..metal.clone() },
        Metal { stress_measure: StressMeasure::Cauchy, ..metal },
    ]
}

/// One increment, extrapolated as for a step `ratio` times the last one.
fn increment(model: &mut Equilibrium<'_>, ratio: f64, guess: impl Fn(usize) -> [f64; 2]) {
    model.begin(f64::INFINITY, ratio, guess);
    solve(model, &TIGHT_SETTINGS).map_err(|(failure, _)| failure).unwrap();
    model.accept().unwrap();
}

/// Axial stress of a bar over the yield stress after increments of so many yield strains.
fn strained(metal: &Metal, steps: &[f64]) -> Vec<f64> {
    let mesh = mapped(ElementKind::Quad8, [1, 1], |x| x);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    let ends = [&mesh.sides.surface, &mesh.sides.base].map(|side| nodes_of(&mesh, side));
    ends.iter().flatten().for_each(|&node| held[node][1] = true);
    nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&node| held[node][0] = true);
    let mut model = model(&mesh, Symmetry::Axisymmetric, metal.clone(), &held, None).unwrap();
    let mut last = 0.0;
    let axial = |&step: &f64| {
        let (strain, x) = (YIELD * step, model.state().position.clone());
        let ratio = if last * step > 0.0 { step / last } else { 0.0 };
        increment(&mut model, ratio, |node| {
            [x[node][0] * (-0.5 * strain).exp_m1(), x[node][1] * strain.exp_m1()]
        });
        last = step;
        stresses(&model)[0][1] / YIELD
    };
    steps.iter().map(axial).collect()
}

#[test]
fn stress_is_that_of_the_strain_however_it_goes_on() {
    let start = [10.0; 4];
    let cut = 10.0 / 128.0;
    for metal in metals() {
        for (then, expected, tolerance) in [
            // so little that the ratio of the steps does not reveal that the point stops
            (&[1e-9, 1e-9][..], &[1.0, 1.0][..], 1e-6),
            (&[2.0, 2.0, 10.0], &[1.0, 1.0, 1.0], 1e-6),
            (&[-0.5, -10.0, -10.0], &[0.5, -1.0, -1.0], 3e-3),
            (&[cut, cut, cut, 10.0, 10.0], &[1.0; 5], 1e-6),
        ] {
            let steps: Vec<f64> = start.iter().chain(then).copied().collect();
            let found = strained(&metal, &steps);
            for (stress, expected) in found[4..].iter().zip(expected) {
                // Kirchhoff's stress of the bar differs from the true one by its volume
                let volume = if metal.yields_by_true_stress() { 1e-3 } else { 0.0 };
                assert!((stress - expected).abs() < tolerance + volume, "{then:?}: {found:?}");
            }
        }
    }
}

/// Held strain without any hint: the ratio of the steps says "go on".
#[test]
fn a_point_that_stops_while_the_load_goes_on_keeps_its_stress() {
    for metal in metals() {
        let mesh = mapped(ElementKind::Quad8, [2, 2], |x| x);
        let held: Vec<[bool; 2]> = boundary(&mesh).iter().map(|&b| [b, b]).collect();
        let mut model = model(&mesh, Symmetry::PlaneStrain, metal.clone(), &held, None).unwrap();
        let step = 10.0 * YIELD;
        for _ in 0..4 {
            let x = model.state().position.clone();
            increment(&mut model, 1.0, |node| [step * x[node][0], -step * x[node][1]]);
        }
        let before = stresses(&model);
        increment(&mut model, 1.0, |_| [0.0; 2]);
        for (a, b) in before.iter().zip(stresses(&model)) {
            let difference = std::array::from_fn(|i| a[i] - b[i]);
            // Ĵ goes on as the volume did, by less than a yield strain
            let tolerance = if metal.yields_by_true_stress() { YIELD } else { 1e-6 };
            assert!(contract(&difference, &difference).sqrt() < tolerance * YIELD, "{a:?} {b:?}");
        }
    }
}

/// Compression along z, then simple shear: strain at a right angle to the last. The stress of backward Euler
/// from the same state is the judge; its flow has a tenth part along the last one (σ_y against 2G times 10
/// ε_y), which may be extrapolated: 10 % of σ_y.
#[test]
fn a_turn_by_a_right_angle_is_that_of_backward_euler() {
    for metal in metals() {
        let turned = |ratio: f64| {
            let mesh = mapped(ElementKind::Quad8, [2, 2], |x| x);
            let held: Vec<[bool; 2]> = boundary(&mesh).iter().map(|&b| [b, b]).collect();
            let mut model = model(&mesh, Symmetry::PlaneStrain, metal.clone(), &held, None).unwrap();
            let step = 10.0 * YIELD;
            for _ in 0..4 {
                let x = model.state().position.clone();
                increment(&mut model, 1.0, |node| [step * x[node][0], -step * x[node][1]]);
            }
            let x = model.state().position.clone();
            increment(&mut model, ratio, |node| [2.0 * step * x[node][1], 0.0]);
            stresses(&model)
        };
        for (second, euler) in turned(1.0).iter().zip(turned(0.0)) {
            let difference = std::array::from_fn(|i| second[i] - euler[i]);
            assert!(contract(&difference, &difference).sqrt() < 0.1 * YIELD, "{second:?} {euler:?}");
        }
    }
}

/// Strain whose direction turns by a right angle while it grows by eight yield strains, in steps of half a
/// yield strain: the rule of second order errs by less than half of what backward Euler does, against steps a
/// sixteenth as long. Without extrapolation both are the same.
#[test]
fn a_steady_turn_is_followed_better_than_by_backward_euler() {
    for metal in metals() {
        let turned = |parts: usize, ratio: f64| {
            let mesh = mapped(ElementKind::Quad8, [1, 1], |x| x);
            let held: Vec<[bool; 2]> = boundary(&mesh).iter().map(|&b| [b, b]).collect();
            let mut model = model(&mesh, Symmetry::PlaneStrain, metal.clone(), &held, None).unwrap();
            let step = 0.5 * YIELD / parts as f64;
            let mut advance = |twice_angle: f64| {
                let (c, s) = (step * twice_angle.cos(), step * twice_angle.sin());
                let x = model.state().position.clone();
                increment(&mut model, ratio, |node| {
                    [c * x[node][0] + s * x[node][1], s * x[node][0] - c * x[node][1]]
                });
            };
            (0..8 * parts).for_each(|_| advance(0.0));
            let turns = 16 * parts;
            (0..turns).for_each(|i| advance(std::f64::consts::PI * (i as f64 + 0.5) / turns as f64));
            stresses(&model)[0]
        };
        let exact = turned(16, 1.0);
        let error = |found: [f64; 4]| {
            let difference = std::array::from_fn(|i| found[i] - exact[i]);
            contract(&difference, &difference).sqrt() / YIELD
        };
        let (second, euler) = (error(turned(1, 1.0)), error(turned(1, 0.0)));
        println!("second order {second:.2e}, backward Euler {euler:.2e}");
        assert!(second < 0.5 * euler && euler > 1e-3, "{second:e} {euler:e}");
    }
}
