//! Claim: a rigid rotation superposed on a stretch rotates the stress and leaves energy and plastic strain
//! unchanged.
//!
//! Source: objectivity; with b ← R b Rᵀ the stress must be R τ Rᵀ. Tolerance 1e-10: nine increments of 20
//! degrees add only rounding.

use asperity_mesh::ElementKind;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{
    ELASTIC_METAL, TIGHT_SETTINGS, hollomon, increment, model, stresses,
};
use asperity_verification::test_meshes::{boundary, distorted_square};

#[test]
fn stress_turns_with_the_body_and_energy_stays() {
    let turn = 20.0_f64.to_radians();
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for metal in [ELASTIC_METAL, hollomon(0.01, 0.3)] {
            let mesh = distorted_square(kind);
            let held: Vec<[bool; 2]> = boundary(&mesh).iter().map(|&b| [b, b]).collect();
            let mut model = model(&mesh, Symmetry::PlaneStrain, metal.clone(), &held, None).unwrap();
            increment(&mut model, f64::INFINITY, &TIGHT_SETTINGS, |node| {
                let [x, z] = mesh.nodes[node];
                // not uniform, so that stresses differ from point to point
                [0.1 * x + 0.05 * x * z, -0.15 * z + 0.1 * x * x]
            })
            .unwrap();
            let before = stresses(&model);
            let [elastic, plastic] = model.state().energies(model.body());
            let (s, c) = turn.sin_cos();
            for _ in 0..9 {
                let x = model.state().position.clone();
                increment(&mut model, f64::INFINITY, &TIGHT_SETTINGS, |node| {
                    let [r, z] = x[node];
                    [c * r - s * z - r, s * r + c * z - z]
                })
                .unwrap();
            }
            let (s, c) = (9.0 * turn).sin_cos();
            let scale = before.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (old, new) in before.iter().zip(stresses(&model)) {
                let [xx, zz, yy, xz] = *old;
                let turned = [
                    c * c * xx - 2.0 * c * s * xz + s * s * zz,
                    s * s * xx + 2.0 * c * s * xz + c * c * zz,
                    yy,
                    c * s * (xx - zz) + (c * c - s * s) * xz,
                ];
                assert!((0..4).all(|i| (new[i] - turned[i]).abs() < 1e-10 * scale), "{new:?} {turned:?}");
            }
            let [elastic_after, plastic_after] = model.state().energies(model.body());
            assert!((elastic_after / elastic - 1.0).abs() < 1e-10);
            assert!((plastic_after - plastic).abs() <= 1e-10 * plastic);
        }
    }
}
