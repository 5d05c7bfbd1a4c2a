//! Claim: a frictionless plane presses a flat bar uniformly on a distorted mesh, by the pressure of the
//! uniaxial bar at the travel less p/ε, with both elements and in both symmetries of the section.
//!
//! Source: R. L. Taylor, P. Papadopoulos (1991), the contact patch test. Tolerance 1e-10: clipping and Gauss
//! points integrate a uniform pressure exactly.

use asperity_mesh::ElementKind;
use asperity_numerics::newton::solve;
use asperity_solver::body::discrete_body::ToolContact;
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{ELASTIC_METAL, TIGHT_SETTINGS, increment, model, stresses};
use asperity_verification::test_meshes::{distorted_square, nodes_of};
use asperity_verification::uniaxial::penetration;

#[test]
fn contact_pressure_is_uniform_and_that_of_the_bar() {
    let penalty = 4.0;
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        let mesh = distorted_square(kind);
        let mut held = vec![[false; 2]; mesh.nodes.len()];
        nodes_of(&mesh, &mesh.sides.base).iter().for_each(|&n| held[n][1] = true);
        nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
        let contact = ToolContact { tool: Tool::Plane, penalty, friction: None };
        let mut model = model(&mesh, Symmetry::Axisymmetric, ELASTIC_METAL, &held, Some(contact)).unwrap();
        let travels = [0.1, 0.2, 0.3, 0.4];
        for travel in travels {
            // the contact is measured over the last converged surface, a disc of this radius
            let radius = model.state().position.iter().fold(0.0_f64, |m, x| m.max(x[0]));
            let penalty = penalty * radius * radius;
            increment(&mut model, 1.0 - travel, &TIGHT_SETTINGS, |_| [0.0; 2]).unwrap();
            let depth = penetration(&ELASTIC_METAL.elastic, penalty, 1.0, travel);
            for edge in &model.state().edges {
                for &node in &edge.nodes[..edge.node_count()] {
                    let here = model.state().position[node as usize][1] - (1.0 - travel);
                    assert!((here / depth - 1.0).abs() < 1e-10, "{kind:?} {travel}: {here} {depth}");
                }
            }
            // F = ε d π R²
            let force = penalty * depth * std::f64::consts::PI;
            assert!((model.state().load() / force - 1.0).abs() < 1e-10);
            let axial = (1.0 - travel + depth).ln();
            for stress in stresses(&model) {
                let expected = [0.0, axial, 0.0, 0.0];
                assert!((0..4).all(|i| (stress[i] - expected[i]).abs() < 1e-10), "{stress:?}");
            }
        }
    }
}

/// An elastic bar on a spring stores F t/2, of which three quarters are given up on the way back to half of
/// the travel t: as much of the bar as of the contact. On the way there nothing is. (1e-3: strains of 1e-4.)
#[test]
fn an_increment_gives_up_the_energy_of_body_and_contact() {
    let mesh = distorted_square(ElementKind::Quad8);
    let mut held = vec![[false; 2]; mesh.nodes.len()];
    nodes_of(&mesh, &mesh.sides.base).iter().for_each(|&n| held[n][1] = true);
    nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
    for penalty in [0.2, 1.0, 5.0] {
        let contact = ToolContact { tool: Tool::Plane, penalty, friction: None };
        let mut model = model(&mesh, Symmetry::Axisymmetric, ELASTIC_METAL, &held, Some(contact)).unwrap();
        let travel = 1e-4;
        model.begin(1.0 - travel, 0.0, |_| [0.0; 2]);
        solve(&mut model, &TIGHT_SETTINGS).map_err(|(failure, _)| failure).unwrap();
        assert_eq!(model.energy_released(), 0.0);
        model.accept().unwrap();
        let stored = 0.5 * model.state().load() * travel;
        model.begin(1.0 - 0.5 * travel, 0.0, |_| [0.0; 2]);
        solve(&mut model, &TIGHT_SETTINGS).map_err(|(failure, _)| failure).unwrap();
        let share = model.energy_released() / stored;
        assert!((share / 0.75 - 1.0).abs() < 1e-3, "{penalty}: {share}");
    }
}
