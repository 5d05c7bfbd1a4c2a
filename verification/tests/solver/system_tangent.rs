//! Claim: the stiffness of the whole system is the derivative of its residual, flowing and in contact, with
//! both elements and in both symmetries.
//!
//! Source: central differences, step 1e-6 of the element size. Tolerance 1e-6 of the largest entry: the
//! differences carry an error of about 1e-9, more where a point is within a step of yielding or an edge of
//! touching.

use asperity_mesh::ElementKind;
use asperity_numerics::newton::{Settings, System, solve};
use asperity_solver::body::discrete_body::ToolContact;
use asperity_solver::contact::tool::Tool;
use asperity_solver::equilibrium::Equilibrium;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{hollomon, model};
use asperity_verification::test_meshes::{distorted_square, nodes_of};

const STEP: f64 = 1e-6;

/// The residual with the increment `du`: the second assessment sees the true contact, not the kept one.
fn residual(model: &mut Equilibrium<'_>, tip: f64, du: &[[f64; 2]]) -> Vec<f64> {
    model.begin(tip, 0.5, |node| du[node]);
    model.assess(false).unwrap();
    model.assess(true).unwrap();
    model.response().residual.to_vec()
}

fn check(kind: ElementKind, symmetry: Symmetry) {
    let mesh = distorted_square(kind);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    nodes_of(&mesh, &mesh.sides.base).iter().for_each(|&n| held[n] = [true; 2]);
    nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
    let tool = Tool::Cone { tan_slope: 0.3, tip_radius: 0.0 };
    let contact = ToolContact { tool, penalty: 2.0, friction: None };
    let mut model = model(&mesh, symmetry, hollomon(0.01, 0.2), &held, Some(contact)).unwrap();
    // one converged increment, so that the next starts with flow carried on
    model.begin(0.95, 0.0, |_| [0.0; 2]);
    solve(&mut model, &Settings { tolerance: 1e-10, max_iterations: 40, keep: 0.0 }).unwrap();
    model.accept().unwrap();
    let (tip, count) = (0.91, mesh.nodes.len());
    let mut du: Vec<[f64; 2]> = (0..count)
        .map(|n| [0, 1].map(|i| if held[n][i] { 0.0 } else { 0.01 * ((7 * n + 3 * i) as f64).sin() }))
        .collect();
    residual(&mut model, tip, &du);
    assert!(
        model.response().contact.iter().any(|edge| edge.load > 0.0)
            && (0..mesh.cell_count()).any(|cell| model.response().yielding[cell])
    );
    let (stiffness, numbers) = (model.stiffness().clone(), model.body().analysis.dofs.number.to_vec());
    let scale = stiffness.data().iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    for node in 0..count {
        for i in 0..2 {
            if held[node][i] {
                continue;
            }
            let col = numbers[node][i] as usize;
            let keep = du[node][i];
            du[node][i] = keep + STEP;
            let up = residual(&mut model, tip, &du);
            du[node][i] = keep - STEP;
            let down = residual(&mut model, tip, &du);
            du[node][i] = keep;
            for row in 0..up.len() {
                let difference = (up[row] - down[row]) / (2.0 * STEP);
                // the lower triangle holds both
                let exact = stiffness.get(row.max(col), row.min(col)).copied().unwrap_or(0.0);
                assert!(
                    (difference - exact).abs() < 1e-6 * scale,
                    "{kind:?} {symmetry:?} ({row}, {col}): {difference} {exact}"
                );
            }
        }
    }
}

#[test]
fn stiffness_is_the_derivative_of_the_residual() {
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for symmetry in [Symmetry::Axisymmetric, Symmetry::PlaneStrain] {
            check(kind, symmetry);
        }
    }
}
