//! Claim: a bar that cannot widen follows τ = (K + 4G/3) ln λ before yield and τ = K ln λ - ⅔σ_y after, to
//! half its height, in compression, where the volume must shrink by a half.
//!
//! Source: `uniaxial::confined_stress`, `uniaxial::confined_flow_stress`. Tolerance 1e-10: the path of the
//! deviator is straight, so that the return mapping is exact, and only rounding is left.

use asperity_mesh::ElementKind;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{TIGHT_SETTINGS, hollomon, increment, model, stresses};
use asperity_verification::test_meshes::distorted_square;
use asperity_verification::uniaxial::{confined_flow_stress, confined_stress};

#[test]
fn confined_stress_follows_both_branches() {
    let metal = hollomon(0.01, 0.0);
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
            let mesh = distorted_square(kind);
            let held: Vec<[bool; 2]> =
                mesh.nodes.iter().map(|x| [x[0] == 0.0 || x[0] == 1.0, x[1] == 0.0 || x[1] == 1.0]).collect();
            let mut model = model(&mesh, symmetry, metal.clone(), &held, None).unwrap();
            for stretch in [0.995, 0.95, 0.8, 0.65, 0.5] {
                let x = model.state().position.clone();
                increment(&mut model, f64::INFINITY, &TIGHT_SETTINGS, |node| {
                    [0.0, stretch * mesh.nodes[node][1] - x[node][1]]
                })
                .unwrap();
                let yielded = model.state().points.states[0].plastic_strain > 0.0;
                assert_eq!(yielded, stretch < 0.99);
                let exact = if yielded {
                    confined_flow_stress(&metal.elastic, 0.01, stretch)
                } else {
                    confined_stress(&metal.elastic, stretch)
                };
                for stress in stresses(&model) {
                    assert!((stress[1] / exact - 1.0).abs() < 1e-10, "{kind:?} {}: {exact}", stress[1]);
                }
            }
        }
    }
}
