//! Claim: simple shear follows the closed form of Hencky elasticity to γ = 4, past the maximum of the shear
//! stress at γ = 3.02.
//!
//! Source: `simple_shear` (Hoger 1987). Tolerance 1e-10: the field is uniform and elastic, whatever the
//! increments.

use asperity_mesh::ElementKind;
use asperity_solver::body::energy::stored;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::simple_shear::{energy, normal_stress, shear_stress};
use asperity_verification::single_increment::{ELASTIC_METAL, TIGHT_SETTINGS, increment, model, stresses};
use asperity_verification::test_meshes::{boundary, distorted_square};

#[test]
fn shear_stress_follows_hencky_to_gamma_four() {
    let g = ELASTIC_METAL.elastic.shear_modulus();
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        let mesh = distorted_square(kind);
        let held: Vec<[bool; 2]> = boundary(&mesh).iter().map(|&b| [b, b]).collect();
        let mut model = model(&mesh, Symmetry::PlaneStrain, ELASTIC_METAL, &held, None).unwrap();
        for step in 1..=16 {
            increment(&mut model, f64::INFINITY, &TIGHT_SETTINGS, |node| [0.25 * mesh.nodes[node][1], 0.0])
                .unwrap();
            let gamma = 0.25 * f64::from(step);
            let (shear, normal) = (shear_stress(g, gamma), normal_stress(g, gamma));
            for stress in stresses(&model) {
                let exact = [normal, -normal, 0.0, shear];
                assert!(
                    (0..4).all(|i| (stress[i] - exact[i]).abs() < 1e-10),
                    "{gamma}: {stress:?} {exact:?}"
                );
            }
            let work = stored(&ELASTIC_METAL, &model.state().points.states, &model.body().volume);
            assert!((work / energy(g, gamma) - 1.0).abs() < 1e-10);
        }
    }
}
