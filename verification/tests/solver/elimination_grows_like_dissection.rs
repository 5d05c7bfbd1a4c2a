//! A factorisation takes operations like unknowns^1.5 on meshes of every size: no numbering makes a large one several times
//! dearer than its neighbours.
//!
//! Source: George, Nested dissection of a regular finite element mesh, SIAM J. Numer. Anal. 10 (1973), p. 345: a square grid
//! of m nodes takes 829/84 m^1.5 multiplications. With two unknowns a node and the additions counted these are
//! 16 * 829/84 (n / 2)^1.5 = 56 n^1.5 operations of n unknowns.
//!
//! The tolerance of 2: quadratic elements couple eight nodes, not four, and the mesh is graded (measured 0.8 to 1.2). With
//! approximate minimum degrees alone, of the two starts, the last row takes 2.3.

use asperity_solver::elimination::elimination_order;
use asperity_solver::model::Model;
use asperity_solver::problem::prepare;
use asperity_solver::scene::Accuracy;
use asperity_verification::single_asperity::scene;

#[test]
fn factorisations_cost_no_more_than_twice_those_of_a_square_grid() {
    let mut scene = scene(Accuracy::Standard).unwrap();
    for elements in [28, 104, 240, 400] {
        scene.numerics.elements_in_contact = Some(elements);
        let problem = prepare(&scene, None).unwrap();
        let model =
            Model::new(&problem.mesh, problem.symmetry, problem.metal, |n| problem.held[n], None).unwrap();
        let grid = 16.0 * 829.0 / 84.0 * (model.unknowns() as f64 / 2.0).powf(1.5);
        let share = model.operations().factor / grid;
        assert!((0.3..2.0).contains(&share), "{elements} elements: {share:.2} of a square grid's operations");
    }
}

#[test]
fn each_free_node_is_eliminated_once_and_no_other() {
    // three quadrilaterals in a row, of which the first edge is held; node 8 belongs to no element
    let cells = [0, 1, 3, 2, 2, 3, 5, 4, 4, 5, 7, 6];
    let free = [false, false, true, true, true, true, true, true, false];
    let mut order = elimination_order(&cells, 4, &free).unwrap();
    order.sort_unstable();
    assert_eq!(order, [2, 3, 4, 5, 6, 7]);
}

#[test]
fn a_body_without_free_nodes_has_nothing_to_eliminate() {
    assert_eq!(elimination_order(&[0, 1, 2, 3], 4, &[false; 4]).unwrap(), []);
}
