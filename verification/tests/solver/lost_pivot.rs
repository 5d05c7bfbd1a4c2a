//! Claim: a stiffness that loses a pivot is answered in order: the tangent without compressive geometric
//! stiffness; else LDLᵀ with up to two negative pivots; else a stiffer diagonal, whose direction goes down;
//! where that is not allowed a failure that halves the step. Never a panic, never a wrong answer.
//!
//! Source: the decision of `Model::factorise`. A straight strut pressed beyond Euler's load is the first
//! case, a bar pulled beyond Considère's strain the second and third. Tolerances with the claims.

use asperity_material::{Elastic, Hardening, HardeningLaw, StressMeasure};
use asperity_mesh::ElementKind;
use asperity_numerics::newton::{Settings, System};
use asperity_solver::body::energy::stored;
use asperity_solver::body::failure::Failure;
use asperity_solver::equilibrium::{Equilibrium, SolveFailure};
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;
use asperity_verification::single_increment::{
    ELASTIC_METAL, TIGHT_SETTINGS, hollomon, increment, model, reaction,
};
use asperity_verification::test_meshes::{mapped, nodes_of};

#[test]
fn a_strut_beyond_eulers_load_loses_a_pivot_and_finds_an_equilibrium() {
    // slenderness 10, ends that shift but do not turn: Euler's strain is π²/12 · (1/10)² = 0.8 %
    let mesh = mapped(ElementKind::Quad8, [1, 10], |[s, t]| [s, 10.0 * t]);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    for side in [&mesh.sides.base, &mesh.sides.surface] {
        nodes_of(&mesh, side).iter().for_each(|&n| held[n][1] = true);
    }
    nodes_of(&mesh, &mesh.sides.base)
        .iter()
        .filter(|&&n| mesh.nodes[n][0] == 0.0)
        .for_each(|&n| held[n][0] = true);
    let mut strut = model(&mesh, Symmetry::PlaneStrain, ELASTIC_METAL, &held, None).unwrap();
    let lost = [0.004, 0.20].map(|shortening| {
        let x = strut.state().position.clone();
        increment(&mut strut, f64::INFINITY, &TIGHT_SETTINGS, |node| {
            [0.0, (1.0 - shortening) * mesh.nodes[node][1] - x[node][1]]
        })
        .unwrap();
        strut.counters.lost_pivots
    });
    assert!(lost[0] == 0 && lost[1] > 0, "{lost:?}");
    // it may bend or stay straight, but not at a higher energy than straight: ½E*(ln λ)² in plane strain
    let straight = 0.5 * ELASTIC_METAL.elastic.reduced_modulus() * 0.8_f64.ln().powi(2) * 10.0;
    let energy = stored(&ELASTIC_METAL, &strut.state().points.states, &strut.body().volume);
    assert!(energy <= straight * (1.0 + 1e-9), "{energy} {straight}");
    let ends = [&mesh.sides.base, &mesh.sides.surface]
        .map(|side| reaction(&strut, &nodes_of(&mesh, side), |_| [0.0, 1.0]));
    assert!((ends[0] + ends[1]).abs() < 1e-9 * ends[0].abs(), "{ends:?}");
}

/// A bar of perfectly plastic metal under tension beyond first yield: every cross section may neck.
fn pulled(metal: Metal, elements: usize, strain: f64, stiffens: bool) -> (Result<(), SolveFailure>, usize) {
    let length = elements as f64;
    let mesh = mapped(ElementKind::Quad4, [1, elements], |[s, t]| [s, length * t]);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    for side in [&mesh.sides.base, &mesh.sides.surface] {
        nodes_of(&mesh, side).iter().for_each(|&n| held[n][1] = true);
    }
    nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
    let mut bar: Equilibrium<'_> = model(&mesh, Symmetry::Axisymmetric, metal, &held, None).unwrap();
    bar.stiffen(stiffens);
    let mut last = 0.0_f64;
    let loose = Settings { tolerance: 1e-8, max_iterations: 30, keep: 0.0 };
    for step in 1..=10 {
        let now = strain * f64::from(step) / 10.0;
        let x = bar.state().position.clone();
        let guess = |node: usize| {
            let [r, z]: [f64; 2] = x[node];
            [r * (0.5 * (last - now)).exp_m1(), z * (now - last).exp_m1()]
        };
        if step == 10 {
            bar.begin(f64::INFINITY, 0.0, guess);
            let outcome = bar.assess(true).and_then(|_| bar.renew());
            if outcome.is_ok() {
                bar.find_direction();
                assert!(bar.slope() < 0.0 || !stiffens, "the direction goes up");
            }
            return (outcome.map_err(SolveFailure::from), bar.counters.lost_pivots);
        }
        if let Err(failure) = increment(&mut bar, f64::INFINITY, &loose, guess) {
            return (Err(failure), bar.counters.lost_pivots);
        }
        last = now;
    }
    (Ok(()), bar.counters.lost_pivots)
}

#[test]
fn a_bar_with_one_neck_takes_an_indefinite_step() {
    // Considère: the force falls from ε = n on; a bar of four radii has room for one neck
    let (outcome, lost) = pulled(hollomon(1.0 / 300.0, 0.1), 4, 0.2, false);
    assert_eq!(outcome, Ok(()));
    assert!(lost > 0);
}

#[test]
fn a_bar_with_many_necks_is_stiffened_or_refused() {
    let hardening =
        Hardening { law: HardeningLaw::Swift, yield_stress: 1.0 / 300.0, exponent: 0.0, youngs_modulus: 1.0 };
    let metal = Metal {
        elastic: Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 },
        hardening: Some(hardening.into()),
        kinematic_share: 0.0,
        stress_measure: StressMeasure::Kirchhoff,
    };
    for (stiffens, expected) in [(true, Ok(())), (false, Err(Failure::Singular.into()))] {
        let (outcome, lost) = pulled(metal.clone(), 40, 0.2, stiffens);
        assert_eq!(outcome, expected);
        assert!(lost > 0);
    }
}
