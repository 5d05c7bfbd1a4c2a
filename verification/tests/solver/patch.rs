//! Claim: both elements reproduce a constant large strain exactly on a distorted mesh: axisymmetric with
//! λ_r = λ_θ and λ_z, and in plane strain a stretch with rotation and shear; elastic and flowing.
//!
//! Source: B. M. Irons, A. Razzaque (1972), the patch test; T. J. R. Hughes, The Finite Element Method, §4.6.
//! Tolerance 1e-10 of the displacement and of the stress: rounding of a converged solve, nothing else.

use asperity_mesh::ElementKind;
use asperity_solver::point::j2::{Tangent, update};
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{
    ELASTIC_METAL, TIGHT_SETTINGS, hollomon, increment, model, stresses,
};
use asperity_verification::test_meshes::{boundary, distorted_square};

/// ∂x/∂X in the plane: rr, rz, zr, zz.
type Plane = [f64; 4];

fn apply(f: Plane, x: [f64; 2]) -> [f64; 2] {
    [f[0] * x[0] + f[1] * x[1], f[2] * x[0] + f[3] * x[1]]
}

fn multiply(f: Plane, g: Plane) -> Plane {
    let ([a, b], [c, d]) = (apply(f, [g[0], g[2]]), apply(f, [g[1], g[3]]));
    [a, c, b, d]
}

/// Deforms the square by `step` `steps` times, the boundary held to it, and compares every inner node and
/// point.
fn patch(symmetry: Symmetry, step: Plane, steps: usize) {
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for metal in [ELASTIC_METAL, hollomon(0.01, 0.2)] {
            let mesh = distorted_square(kind);
            let on = boundary(&mesh);
            let held: Vec<[bool; 2]> = on.iter().map(|&b| [b, b]).collect();
            let mut model = model(&mesh, symmetry, metal.clone(), &held, None).unwrap();
            let mut point = metal.virgin();
            let mut stress = [0.0; 4];
            let mut total = [1.0, 0.0, 0.0, 1.0];
            for _ in 0..steps {
                let x = model.state().position.clone();
                increment(&mut model, f64::INFINITY, &TIGHT_SETTINGS, |node| {
                    let to = apply(step, x[node]);
                    // a first guess that is wrong inside: the answer must come from the equations
                    let wrong = if on[node] { 0.0 } else { 5e-3 };
                    [to[0] - x[node][0] + wrong, to[1] - x[node][1] - wrong]
                })
                .unwrap();
                let hoop = if symmetry == Symmetry::Axisymmetric { step[0] - 1.0 } else { 0.0 };
                let gradient = [step[0] - 1.0, step[1], step[2], step[3] - 1.0, hoop];
                let end = update(&metal, &point, &gradient, Tangent::None).unwrap();
                (point, stress) = (end.state, end.stress);
                total = multiply(step, total);
            }
            for (x, reference) in model.state().position.iter().zip(&mesh.nodes) {
                let exact = apply(total, *reference);
                for i in 0..2 {
                    assert!((x[i] - exact[i]).abs() < 1e-10, "{kind:?} {symmetry:?}: {x:?} {exact:?}");
                }
            }
            let scale = stress.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
            for (at, state) in stresses(&model).iter().zip(&model.state().points.states) {
                for i in 0..4 {
                    assert!((at[i] - stress[i]).abs() < 1e-10 * scale, "{kind:?}: {at:?} {stress:?}");
                }
                assert!((state.plastic_strain - point.plastic_strain).abs() < 1e-10);
            }
        }
    }
}

#[test]
fn axisymmetric_constant_strain_is_exact() {
    patch(Symmetry::Axisymmetric, [1.12, 0.0, 0.0, 0.8], 4);
    patch(Symmetry::Axisymmetric, [0.9, 0.0, 0.0, 1.2], 4);
}

#[test]
fn plane_strain_rotation_with_shear_is_exact() {
    let (s, c) = 0.3_f64.sin_cos();
    let rotation = [c, -s, s, c];
    patch(Symmetry::PlaneStrain, multiply(rotation, [1.1, 0.25, 0.0, 0.85]), 4);
}
