//! Claims: two blocks of one body that do not match press each other uniformly (patch test across the
//! contact), and let go of each other.
//!
//! Source: R. L. Taylor, P. Papadopoulos (1991), the contact patch test, here of a surface with itself.
//! Tolerance 1e-9: the integration points lie between the nodes of the other side, so that a uniform pressure
//! is integrated exactly.

use asperity_mesh::{ElementKind, Mesh};
use asperity_solver::body::discrete_body::ToolContact;
use asperity_solver::contact::tool::Tool;
use asperity_solver::equilibrium::Equilibrium;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{ELASTIC_METAL, TIGHT_SETTINGS, increment, model, stresses};
use asperity_verification::test_meshes::{mapped, nodes_of};

/// A block of 3 × 2 elements below one of 4 × 2, both 1 × 1; the two faces between them are the surface.
fn stacked(kind: ElementKind) -> Mesh {
    let (mut lower, upper) = (mapped(kind, [3, 2], |x| x), mapped(kind, [4, 2], |[r, z]| [r, z + 1.0]));
    let (nodes, cells) = (lower.nodes.len() as u32, lower.cell_count() as u32);
    lower.nodes.extend(&upper.nodes);
    lower.cells.extend(upper.cells.iter().map(|node| node + nodes));
    let moved = |edges: &[asperity_mesh::Edge]| {
        edges.iter().map(|edge| asperity_mesh::Edge { cell: edge.cell + cells, ..*edge }).collect::<Vec<_>>()
    };
    lower.sides.surface.extend(moved(&upper.sides.base));
    lower.sides.axis.extend(moved(&upper.sides.axis));
    // the side that is moved
    lower.sides.outer = moved(&upper.sides.surface);
    lower
}

/// Moves the upper side by `travel`.
fn press(model: &mut Equilibrium<'_>, moved: &[usize], travel: f64) {
    increment(
        model,
        1e3,
        &TIGHT_SETTINGS,
        |node| if moved.contains(&node) { [0.0, -travel] } else { [0.0; 2] },
    )
    .unwrap();
}

#[test]
fn a_uniform_pressure_passes_between_blocks_that_do_not_match_and_falls_with_the_travel() {
    for kind in [ElementKind::Quad4, ElementKind::Quad8] {
        for symmetry in [Symmetry::PlaneStrain, Symmetry::Axisymmetric] {
            let mesh = stacked(kind);
            let mut held = vec![[false; 2]; mesh.nodes.len()];
            let moved = nodes_of(&mesh, &mesh.sides.outer);
            nodes_of(&mesh, &mesh.sides.base).iter().chain(&moved).for_each(|&n| held[n][1] = true);
            nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
            // a tool that is out of reach gives the penalty
            let contact = ToolContact { tool: Tool::Plane, penalty: 4.0, friction: None };
            let mut model = model(&mesh, symmetry, ELASTIC_METAL, &held, Some(contact)).unwrap();
            for _ in 0..4 {
                press(&mut model, &moved, 0.02);
                let stress = stresses(&model);
                let axial = stress[0][1];
                assert!(axial < -1e-3, "{kind:?} {symmetry:?}: the blocks do not press each other");
                for (point, s) in stress.iter().enumerate() {
                    let off = (s[1] / axial - 1.0).abs().max(s[0].abs() / -axial).max(s[3].abs() / -axial);
                    assert!(off < 1e-9, "{kind:?} {symmetry:?} point {point}: {s:?}, {axial}");
                }
            }
            let most = stresses(&model)[0][1];
            for _ in 0..3 {
                press(&mut model, &moved, -0.02);
            }
            // a quarter of the travel is left; the penalty is taken over another surface than on the way in:
            // a few thousandths
            let left = stresses(&model)[0][1] / most;
            assert!((0.23..0.25).contains(&left), "{kind:?} {symmetry:?}: {left} of the pressure is left");
        }
    }
}
