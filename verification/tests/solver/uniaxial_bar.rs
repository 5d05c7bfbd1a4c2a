//! Claim: a bar in tension follows eq. [1] of the paper at total logarithmic strains from 0.002 to 1, force
//! included.
//!
//! Source: `uniaxial::hollomon_stress` (Kirchhoff's stress: the law is an energy in logarithmic strain).
//! Tolerance 1e-9: the path is straight, so that the return mapping is exact for any increment; what is left
//! is the local solve of the law.

use asperity_material::HardeningCurve;
use asperity_mesh::ElementKind;
use asperity_numerics::newton::solve;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{
    TIGHT_SETTINGS, hollomon, increment, model, reaction, stresses,
};
use asperity_verification::test_meshes::{mapped, nodes_of};
use asperity_verification::uniaxial::{hollomon_stress, nominal_stress};

#[test]
fn tension_follows_eq_1_from_strain_0_002_to_1() {
    let metal = hollomon(300.0 / 210e3, 0.3);
    let Some(HardeningCurve::Power(hardening)) = metal.hardening else { panic!("a power law") };
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        // one element: a longer bar would neck beyond ε = n
        let mesh = mapped(kind, [1, 1], |x| x);
        let mut held = vec![[false; 2]; mesh.nodes.len()];
        let top = nodes_of(&mesh, &mesh.sides.surface);
        nodes_of(&mesh, &mesh.sides.base).iter().chain(&top).for_each(|&n| held[n][1] = true);
        nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
        let mut model = model(&mesh, Symmetry::Axisymmetric, metal.clone(), &held, None).unwrap();
        let mut last = 0.0_f64;
        for strain in [0.002, 0.01, 0.05, 0.1, 0.5, 1.0_f64] {
            let x = model.state().position.clone();
            increment(&mut model, f64::INFINITY, &TIGHT_SETTINGS, |node| {
                let [r, z] = x[node];
                // as incompressible: nearly right
                [r * (0.5 * (last - strain)).exp_m1(), z * (strain - last).exp_m1()]
            })
            .unwrap();
            last = strain;
            let exact = hollomon_stress(&hardening, strain);
            for stress in stresses(&model) {
                assert!((stress[1] / exact - 1.0).abs() < 1e-9, "{kind:?} {strain}: {} {exact}", stress[1]);
                assert!(stress[0].abs() < 1e-9 * exact && stress[2].abs() < 1e-9 * exact);
            }
            let force = reaction(&model, &top, |_| [0.0, 1.0]) / std::f64::consts::PI;
            assert!((force / nominal_stress(exact, strain) - 1.0).abs() < 1e-9);
        }
    }
}

/// The plastic work of an increment under way is that of the stress on the strain, ∫σ dε less the elastic
/// energy σ²/2E, over the volume of the bar.
#[test]
fn the_plastic_work_of_an_increment_is_what_tension_does_beyond_its_elastic_energy() {
    let metal = hollomon(300.0 / 210e3, 0.3);
    let Some(HardeningCurve::Power(hardening)) = metal.hardening else { panic!("a power law") };
    let mesh = mapped(ElementKind::Quad8, [1, 1], |x| x);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    let ends = [&mesh.sides.surface, &mesh.sides.base].map(|side| nodes_of(&mesh, side));
    ends.iter().flatten().for_each(|&n| held[n][1] = true);
    nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
    let mut model = model(&mesh, Symmetry::Axisymmetric, metal, &held, None).unwrap();
    let x = model.state().position.clone();
    let strain = 0.05_f64;
    model.begin(f64::INFINITY, 0.0, |node| {
        [x[node][0] * (-0.5 * strain).exp_m1(), x[node][1] * strain.exp_m1()]
    });
    solve(&mut model, &TIGHT_SETTINGS).map_err(|(failure, _)| failure).unwrap();
    let steps = 20_000;
    // elastic below the yield strain, where eq. (1) lies above
    let at = |i: f64| {
        let reached = strain * i / f64::from(steps);
        reached.min(hollomon_stress(&hardening, reached))
    };
    let whole: f64 = (0..steps).map(|i| at(f64::from(i) + 0.5) * strain / f64::from(steps)).sum();
    let plastic = std::f64::consts::PI * (whole - 0.5 * at(f64::from(steps)).powi(2));
    // the midpoint rule at the kink of the law: a step of the elastic strain's share
    assert!((model.plastic_work() / plastic - 1.0).abs() < 1e-6, "{} {plastic}", model.plastic_work());
}
