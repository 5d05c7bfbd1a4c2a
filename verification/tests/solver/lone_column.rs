//! Claim: the mode that two by two points of a quadratic element do not see lives in one element alone; a
//! column, and a row, of two elements or more has the rigid motions and no other motion without energy.
//!
//! Source: the mode is u = α ξ (1 - 3η²), v = β η (3ξ² - 1) with α/h_y = β/h_x for the half widths h: all
//! strains vanish at ξ², η² = 1/3. On the side η = 1 of one element and η = -1 of the next it gives u = -2α ξ
//! in both, but v = β (3ξ² - 1) and -β (3ξ² - 1): so α is the same in both and β its own opposite, both are
//! 0. The eigenvalues below 1e-9 of E are counted by the negative pivots of K - 1e-9 (Sylvester).

use asperity_mesh::ElementKind;
use asperity_numerics::newton::System;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{ELASTIC_METAL, model};
use asperity_verification::test_meshes::mapped;

/// Motions without energy of `counts` elements that are `shape` wide and high.
fn motions_without_energy(symmetry: Symmetry, counts: [usize; 2], shape: [f64; 2]) -> usize {
    let place = |x: [f64; 2]| [0, 1].map(|i| counts[i] as f64 * shape[i] * x[i] + [1.0, 0.0][i]);
    let mesh = mapped(ElementKind::Quad8, counts, place);
    let held = vec![[false; 2]; mesh.nodes.len()];
    let mut model = model(&mesh, symmetry, ELASTIC_METAL, &held, None).unwrap();
    model.begin(f64::INFINITY, 0.0, |_| [0.0; 2]);
    model.assess(true).unwrap();
    let count = model.body().analysis.dofs.count;
    let entry = |row: usize, col: usize| model.stiffness().get(row.max(col), row.min(col)).copied();
    let mut matrix: Vec<Vec<f64>> =
        (0..count).map(|row| (0..count).map(|col| entry(row, col).unwrap_or(0.0)).collect()).collect();
    (0..count).for_each(|i| matrix[i][i] -= 1e-9);
    let mut negative = 0;
    for k in 0..count {
        let pivot = matrix[k].clone();
        negative += usize::from(pivot[k] < 0.0);
        for row in &mut matrix[k + 1..] {
            let share = row[k] / pivot[k];
            row.iter_mut().zip(&pivot).for_each(|(entry, above)| *entry -= share * above);
        }
    }
    negative
}

#[test]
fn only_a_single_element_moves_without_energy() {
    for (symmetry, rigid) in [(Symmetry::PlaneStrain, 3), (Symmetry::Axisymmetric, 1)] {
        for shape in [[1.0, 1.0], [5.0, 1.0], [1.0, 5.0]] {
            assert_eq!(motions_without_energy(symmetry, [1, 1], shape), rigid + 1, "{symmetry:?} {shape:?}");
            for counts in [[1, 2], [2, 1], [1, 5], [5, 1]] {
                let motions = motions_without_energy(symmetry, counts, shape);
                assert_eq!(motions, rigid, "{symmetry:?} {counts:?} {shape:?}");
            }
        }
    }
}
