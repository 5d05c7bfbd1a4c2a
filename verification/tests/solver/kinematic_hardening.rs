//! Claim: kinematic hardening repeats isotropic hardening in monotone tension, yields in reverse after a drop
//! of 2σ_y, is objective, and is the metal of the isotropic update where nothing hardens and no principal
//! direction turns.
//!
//! Source: the derivation in `asperity_solver::point::kinematic_hardening` (rule of Prager and Ziegler in the
//! logarithmic strain space of Miehe, Apel, Lambrecht 2002). Bar with linear hardening σ_y + Hε_p: the
//! reversed branch leaves the elastic line at τ_a - 2σ_y and goes on with EH/(E + H). Tolerances: 1e-9 for
//! bars, as in `uniaxial_bar`; 1e-12 for points, rounding.

use asperity_material::{Hardening, HardeningLaw, HardeningTable};
use asperity_mesh::ElementKind;
use asperity_solver::point::j2::{self, Tangent};
use asperity_solver::point::kinematic_hardening::{self, History};
use asperity_solver::point::material::{Metal, PointState, stress, volume_ratio};
use asperity_solver::point::tensor::{Gradient, Sym};
use asperity_verification::single_increment::{ELASTIC_METAL, hollomon, stretch_bar};

const YIELD: f64 = 2e-3;
const SLOPE: f64 = 0.05;

fn kinematic(metal: Metal) -> Metal {
    Metal { kinematic_share: 1.0, ..metal }
}

/// σ_y + H ε_p as far as the tests go.
fn linear() -> Metal {
    let table = HardeningTable::new(&[[0.0, YIELD], [10.0, YIELD + 10.0 * SLOPE]]).unwrap();
    Metal { hardening: Some(table.into()), ..ELASTIC_METAL }
}

/// A point under increments f - I, one after the other; its last stress and state.
fn drive(metal: &Metal, increments: &[Gradient]) -> (Sym, PointState, History) {
    let (mut state, mut memory, mut tau) = (metal.virgin(), History::default(), [0.0; 4]);
    for g in increments {
        let (end, after) = kinematic_hardening::update(metal, &state, &memory, g, Tangent::None).unwrap();
        (state, memory, tau) = (end.state, after, end.stress);
    }
    (tau, state, memory)
}

#[test]
fn monotone_tension_is_that_of_isotropic_hardening() {
    let strains = [0.001, 0.0016, 0.002, 0.01, 0.05, 0.1, 0.5, 1.0];
    let swift =
        Hardening { law: HardeningLaw::Swift, yield_stress: 2e-3, exponent: 0.1, youngs_modulus: 1.0 };
    let swift = Metal { hardening: Some(swift.into()), ..ELASTIC_METAL };
    for metal in [hollomon(300.0 / 210e3, 0.3), swift, linear()] {
        for kind in [ElementKind::Quad4, ElementKind::Quad8] {
            let grows = stretch_bar(kind, &metal, &strains).unwrap();
            let moves = stretch_bar(kind, &kinematic(metal.clone()), &strains).unwrap();
            let half = Metal { kinematic_share: 0.5, ..metal.clone() };
            let half = stretch_bar(kind, &half, &strains).unwrap();
            assert!(grows.iter().zip(&half).all(|(a, b)| (a / b - 1.0).abs() < 1e-9), "{half:?}");
            let at_once = stretch_bar(kind, &kinematic(metal.clone()), &[0.01, 1.0]).unwrap();
            for (a, b) in grows.iter().zip(&moves) {
                assert!((a / b - 1.0).abs() < 1e-9, "{kind:?}: {grows:?} {moves:?}");
            }
            assert!((at_once[1] / grows[7] - 1.0).abs() < 1e-9, "steps matter: {at_once:?}");
        }
    }
}

#[test]
fn a_bar_yields_in_reverse_after_twice_the_first_yield_stress() {
    let top = 0.1;
    let plastic_slope = SLOPE / (1.0 + SLOPE);
    let peak = YIELD + (top - YIELD) * plastic_slope;
    let elastic_drop = 2.0 * YIELD; // a strain, as E = 1
    let drops = [0.5 * elastic_drop, 0.999 * elastic_drop, 1.5 * elastic_drop, 0.05, 2.0 * top];
    let back: Vec<f64> = drops.iter().map(|drop| top - drop).collect();
    let strains = [&[top], &back[..], &[0.0, top]].concat();
    let exact = |drop: f64| peak - drop.min(elastic_drop) - (drop - elastic_drop).max(0.0) * plastic_slope;
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        let stresses = stretch_bar(kind, &kinematic(linear()), &strains).unwrap();
        assert!((stresses[0] / peak - 1.0).abs() < 1e-9);
        for (drop, stress) in drops.iter().zip(&stresses[1..]) {
            assert!(
                (stress - exact(*drop)).abs() < 1e-9 * peak,
                "{kind:?} {drop}: {stress} {}",
                exact(*drop)
            );
        }
        // a closed cycle of a surface that only moves ends where it began
        assert!((stresses[stresses.len() - 1] / peak - 1.0).abs() < 1e-9, "{stresses:?}");
        // half of the hardening moves it: its size has grown to (τ_a + σ_y)/2
        let half = Metal { kinematic_share: 0.5, ..linear() };
        let drop = peak + YIELD;
        let (before, after) = (top - 0.999 * drop, top - drop - 0.01);
        let half = stretch_bar(kind, &half, &[top, before, after]).unwrap();
        assert!((half[1] - (peak - 0.999 * drop)).abs() < 1e-9 * peak);
        assert!((half[2] - (peak - drop - 0.01 * plastic_slope)).abs() < 1e-9 * peak, "{half:?}");
        // a surface that grows is still elastic there: Bauschinger's effect is the difference
        let grows = stretch_bar(kind, &linear(), &strains[..4]).unwrap();
        assert!((grows[3] - (peak - 1.5 * elastic_drop)).abs() < 1e-9 * peak);
    }
}

#[test]
fn a_superposed_rotation_turns_the_stress_and_nothing_else() {
    let metal = kinematic(hollomon(YIELD, 0.2));
    let path = [[0.1, 0.2, -0.1, -0.05, 0.02], [-0.05, 0.1, 0.15, 0.1, -0.06], [0.02, -0.2, 0.1, -0.1, 0.04]];
    let (plain, state, memory) = drive(&metal, &path);
    // each increment f becomes Q(t₊) f Q(t)ᵀ
    let product = |a: [f64; 4], b: [f64; 4]| {
        [
            a[0] * b[0] + a[1] * b[2],
            a[0] * b[1] + a[1] * b[3],
            a[2] * b[0] + a[3] * b[2],
            a[2] * b[1] + a[3] * b[3],
        ]
    };
    let turn = |angle: f64| [angle.cos(), -angle.sin(), angle.sin(), angle.cos()];
    let mut angle = 0.0;
    let turned = path.map(|g| {
        let f = [1.0 + g[0], g[1], g[2], 1.0 + g[3]];
        let [a, b, c, d] = product(product(turn(angle + 0.9), f), turn(-angle));
        angle += 0.9;
        [a - 1.0, b, c, d - 1.0, g[4]]
    });
    let (stress, turned_state, turned_memory) = drive(&metal, &turned);
    let (q, t) = (turn(angle), [plain[0], plain[3], plain[3], plain[1]]);
    let [rr, rz, _, zz] = product(product(q, t), turn(-angle));
    for (got, want) in stress.into_iter().zip([rr, zz, plain[2], rz]) {
        assert!((got - want).abs() < 1e-13, "{stress:?}");
    }
    assert!((turned_state.plastic_strain - state.plastic_strain).abs() < 1e-13);
    for i in 0..4 {
        assert!((turned_memory.plastic[i] - memory.plastic[i]).abs() < 1e-13);
        assert!((turned_memory.back[i] - memory.back[i]).abs() < 1e-13);
    }
}

/// The state that fields, islands and energies read is the stress of the point and its volume.
#[test]
fn stored_state_is_the_stress_and_volume_of_the_point() {
    let metal = kinematic(hollomon(YIELD, 0.2));
    let (tau, state, memory) = drive(&metal, &[[0.1, 0.4, -0.1, -0.05, 0.02], [-0.05, 0.1, 0.3, 0.1, -0.06]]);
    let shown = stress(&metal.elastic, &state.b_minus_i);
    assert!((0..4).all(|i| (shown[i] - tau[i]).abs() < 1e-13), "{shown:?} {tau:?}");
    let d = memory.deformation;
    let volume = ((1.0 + d[0]) * (1.0 + d[3]) - d[1] * d[2]) * (1.0 + d[4]);
    assert!((volume_ratio(&state.b_minus_i) / volume - 1.0).abs() < 1e-12);
}

#[test]
fn without_hardening_coaxial_paths_are_those_of_the_isotropic_update() {
    let metal = hollomon(YIELD, 0.0);
    // principal directions stay, the ratio of stretches does not
    let path: [Gradient; 5] = [
        [1e-3, 0.0, 0.0, -2e-3, 5e-4],
        [0.2, 0.0, 0.0, -0.1, 0.05],
        [-0.1, 0.0, 0.0, 0.3, -0.2],
        [-0.3, 0.0, 0.0, 0.1, 0.3],
        [2e-3, 0.0, 0.0, 2e-3, -1e-3],
    ];
    let mut grows = metal.virgin();
    let (mut state, mut memory) = (metal.virgin(), History::default());
    for g in &path {
        let a = j2::update(&metal, &grows, g, Tangent::Exact).unwrap();
        let (b, after) =
            kinematic_hardening::update(&kinematic(metal.clone()), &state, &memory, g, Tangent::Exact)
                .unwrap();
        (grows, state, memory) = (a.state, b.state, after);
        assert!((0..4).all(|i| (a.stress[i] - b.stress[i]).abs() < 1e-12 * YIELD.max(a.stress[i].abs())));
        assert!((grows.plastic_strain - state.plastic_strain).abs() < 1e-12);
        let scale = a.tangent.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
        // against shear they differ: that turns directions
        for (i, k) in [0, 3, 4].into_iter().flat_map(|i| [(i, 0), (i, 3), (i, 4)]) {
            assert!((a.tangent[i][k] - b.tangent[i][k]).abs() < 1e-10 * scale, "({i}, {k})");
        }
    }
}

/// Strains that add differ from strains that multiply where directions turn. In simple shear without
/// hardening the shear stress is σ_y/√3 in the latter; measured in the former here.
#[test]
fn simple_shear_shows_the_limit_of_additive_strains() {
    let metal = kinematic(hollomon(YIELD, 0.0));
    let steps = 400;
    let mut shown = Vec::new();
    for shear in [0.1, 0.5, 1.0, 2.0] {
        let path = vec![[0.0, shear / f64::from(steps), 0.0, 0.0, 0.0]; steps as usize];
        let (tau, ..) = drive(&metal, &path);
        shown.push(tau[3] / (YIELD / 3.0_f64.sqrt()));
    }
    println!("shear stress over that of the multiplicative update at γ = 0.1, 0.5, 1, 2: {shown:.4?}");
    assert!((shown[0] - 1.0).abs() < 5e-3 && (shown[1] - 1.0).abs() < 0.05, "{shown:?}");
}
