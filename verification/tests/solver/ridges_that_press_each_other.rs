//! Claims: two equal ridges that press each other, one part of the body against another, do so as Hertz says:
//! the pressure in the middle of their contact follows from the force, and falls back with it.
//!
//! Source: K. L. Johnson, Contact Mechanics (1985), §4.2(c): p₀² = F E_e/(π R_e), with 1/R_e = 2/R and 1/E_e
//! = 2/E'. Tolerance 1 %: 9 elements across the half width at the peak, which is a twentieth of the blocks;
//! below the middle p₀ falls as 1/√(1 + (z/b)²).

use asperity_mesh::{Edge, ElementKind, Mesh};
use asperity_numerics::newton::Settings;
use asperity_solver::body::discrete_body::ToolContact;
use asperity_solver::contact::tool::Tool;
use asperity_solver::element::kernel::GAUSS;
use asperity_solver::point::kinematics::Symmetry;
use asperity_verification::single_increment::{ELASTIC_METAL, increment, model, stresses};
use asperity_verification::test_meshes::{mapped, nodes_of};
use std::f64::consts::PI;

const RADIUS: f64 = 10.0;

/// Pressure per penetration: the two faces sink into each other by less than a thousandth of what they come
/// closer.
const PENALTY: f64 = 500.0;

/// The claim is to 1 %.
const SETTLED: Settings = Settings { tolerance: 1e-7, max_iterations: 40, keep: 0.0 };

/// Half of two ridges, one above the other, on blocks of width and height 1 that grow finer towards the
/// contact.
fn ridges(kind: ElementKind, counts: [usize; 2]) -> Mesh {
    let shape = |[s, t]: [f64; 2], up: f64| {
        let (x, below) = (s * s, (1.0 - t) * (1.0 - t));
        [x, -up * (below + (1.0 - below) * x * x / (2.0 * RADIUS))]
    };
    let mut lower = mapped(kind, counts, |x| shape(x, 1.0));
    let upper = mapped(kind, counts, |[s, t]| shape([s, 1.0 - t], -1.0));
    let (nodes, cells) = (lower.nodes.len() as u32, lower.cell_count() as u32);
    lower.nodes.extend(&upper.nodes);
    lower.cells.extend(upper.cells.iter().map(|node| node + nodes));
    let moved = |edges: &[Edge]| {
        edges.iter().map(|edge| Edge { cell: edge.cell + cells, ..*edge }).collect::<Vec<_>>()
    };
    lower.sides.surface.extend(moved(&upper.sides.base));
    lower.sides.axis.extend(moved(&upper.sides.axis));
    // the side that is moved
    lower.sides.outer = moved(&upper.sides.surface);
    lower
}

#[test]
fn ridges_pressed_on_each_other_bear_the_pressure_of_hertz() {
    for (kind, counts) in [(ElementKind::Quad8, [40, 24]), (ElementKind::Quad4, [80, 48])] {
        let mesh = ridges(kind, counts);
        let mut held = vec![[false; 2]; mesh.nodes.len()];
        let moved = nodes_of(&mesh, &mesh.sides.outer);
        nodes_of(&mesh, &mesh.sides.base).iter().chain(&moved).for_each(|&n| held[n][1] = true);
        nodes_of(&mesh, &mesh.sides.axis).iter().for_each(|&n| held[n][0] = true);
        // a tool that is out of reach gives the penalty
        let contact = ToolContact { tool: Tool::Plane, penalty: PENALTY, friction: None };
        let mut model = model(&mesh, Symmetry::PlaneStrain, ELASTIC_METAL, &held, Some(contact)).unwrap();
        let effective = 0.5 * ELASTIC_METAL.elastic.reduced_modulus();
        let [columns, rows] = counts;
        // the integration point of the lower ridge nearest to the middle of the contact
        let (cell, point) = ((rows - 1) * columns, 3);
        let corners = mesh.cell(cell);
        let height = mesh.nodes[corners[3] as usize][1] - mesh.nodes[corners[0] as usize][1];
        let below = 0.5 * (1.0 - GAUSS) * height;
        let mut worst: f64 = 0.0;
        // the front passes an element in some increments
        let steps: [(f64, usize); 2] = [(5e-6, 80), (-5e-6, 40)];
        for (number, step) in steps.iter().flat_map(|(step, count)| (0..*count).map(move |i| (i, *step))) {
            let push = |n: usize| if moved.contains(&n) { [0.0, -step] } else { [0.0; 2] };
            increment(&mut model, 1e3, &SETTLED, push).unwrap();
            if (number + 1) % 20 > 0 {
                continue;
            }
            let stress = stresses(&model);
            // what the lowest row of elements bears: its stress over its width
            let force: f64 = 2.0
                * (0..columns)
                    .map(|i| {
                        let [a, b] = [0, 1].map(|k| mesh.nodes[mesh.cell(i)[k] as usize][0]);
                        -0.25 * (b - a) * stress[4 * i..4 * i + 4].iter().map(|s| s[1]).sum::<f64>()
                    })
                    .sum::<f64>();
            let peak = (force * effective / (PI * 0.5 * RADIUS)).sqrt();
            let half_width = 2.0 * force / (PI * peak);
            let there = peak / (1.0 + (below / half_width).powi(2)).sqrt();
            let off = -stress[4 * cell + point][1] / there - 1.0;
            worst = worst.max(off.abs());
        }
        assert!(worst < 0.01, "{kind:?}: {worst}");
    }
}
