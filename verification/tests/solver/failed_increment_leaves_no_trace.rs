//! Claim: an increment that was tried and not accepted changes nothing of what is read from the body
//! afterwards: force of the contact, its edges and the pressure at its nodes are those of the last converged
//! state, bit for bit.
//!
//! Source: none outside; fields of a run that stopped are drawn from the model after the failed attempt.
//! Tolerance: none, bit for bit.

use asperity_mesh::ElementKind;
use asperity_numerics::newton::System;
use asperity_solver::body::discrete_body::ToolContact;
use asperity_solver::contact::tool::Tool;
use asperity_solver::equilibrium::Equilibrium;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{ELASTIC_METAL, TIGHT_SETTINGS, increment, model};
use asperity_verification::test_meshes::{distorted_square, nodes_of};

fn seen(model: &Equilibrium<'_>) -> (f64, Vec<f64>, Vec<[f64; 2]>) {
    let surface = model.converged_surface();
    let pressures = surface
        .edges
        .iter()
        .flat_map(|edge| [surface.nodal_pressure(edge, -1.0), surface.nodal_pressure(edge, 1.0)]);
    (model.state().load(), pressures.collect(), model.state().position.clone())
}

#[test]
fn contact_is_that_of_the_last_converged_increment() {
    let mesh = distorted_square(ElementKind::Quad8);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    nodes_of(&mesh, &mesh.sides.base).iter().for_each(|&n| held[n] = [true, true]);
    let contact = ToolContact { tool: Tool::Sphere { radius: 3.0 }, penalty: 4.0, friction: None };
    let mut model = model(&mesh, Symmetry::Axisymmetric, ELASTIC_METAL, &held, Some(contact)).unwrap();
    increment(&mut model, 0.9, &TIGHT_SETTINGS, |_| [0.0; 2]).unwrap();
    let before = seen(&model);
    assert!(before.0 > 0.0);
    for tip in [0.7, f64::INFINITY] {
        model.begin(tip, 1.0, |_| [0.0, -0.01]);
        model.assess(true).unwrap();
        assert_eq!(seen(&model), before);
    }
}
