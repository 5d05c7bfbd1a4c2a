//! A factorisation takes operations like unknowns^1.5 on small and large meshes: no numbering makes a large
//! one several times dearer than its neighbours.
//!
//! Source: nested dissection of a square grid of m nodes with nine-point coupling (George, SIAM J. Numer.
//! Anal. 10 (1973), pp. 345-363): 829/84 m^1.5 multiplications to leading order, from half the sum of the
//! squared columns of its separators. With two unknowns a node and the additions counted these are 16 *
//! 829/84 (n / 2)^1.5 = 56 n^1.5 operations of n unknowns.
//!
//! The tolerance of 2: quadratic elements couple eight nodes, not four, the mesh is graded, and zeros kept
//! for dense blocks are counted (measured 0.8 to 1.2 here, 0.7 to 1.4 up to 437,000 unknowns). With
//! approximate minimum degrees alone, of the two starts, the largest mesh takes 2.3. Below 0.5 something
//! would be left out of the count.

use asperity_numerics::sparse::fill_ordering::elimination_order;
use asperity_simulation::scene::Accuracy;
use asperity_solver::body::analysis::Analyses;
use asperity_verification::single_asperity::{prepared, scene};

#[test]
fn factorisations_cost_no_more_than_twice_those_of_a_square_grid() {
    let mut scene = scene(Accuracy::Standard).unwrap();
    for elements in [28, 104, 240, 400] {
        scene.numerics.elements_in_contact = Some(elements);
        let problem = prepared(&scene).unwrap();
        let model = problem.equilibrium(&Analyses::default()).unwrap();
        let grid = 16.0 * 829.0 / 84.0 * (model.body().analysis.dofs.count as f64 / 2.0).powf(1.5);
        let share = model.operations().factor / grid;
        assert!((0.5..2.0).contains(&share), "{elements} elements: {share:.2} of a square grid's operations");
    }
}

#[test]
fn each_free_node_is_eliminated_once_and_no_other() {
    // three quadrilaterals in a row, of which the first edge is held; nodes 8 and 9 belong to no element
    let cells = [0, 1, 3, 2, 2, 3, 5, 4, 4, 5, 7, 6];
    let free = [false, false, true, true, true, true, true, true, false, true];
    let mut order = elimination_order(&cells, 4, &free).unwrap();
    order.sort_unstable();
    assert_eq!(order, [2, 3, 4, 5, 6, 7, 9]);
}

/// Large enough for nested dissection, and of two pieces.
#[test]
fn large_bodies_of_several_pieces_are_eliminated_whole() {
    let rows = 90;
    let grid = |first: u32| {
        let node = move |i: u32, j: u32| first + i * (rows + 1) + j;
        (0..rows * rows).flat_map(move |c| {
            let (i, j) = (c / rows, c % rows);
            [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]
        })
    };
    let nodes = (rows + 1) * (rows + 1);
    let cells: Vec<u32> = grid(0).chain(grid(nodes)).collect();
    let mut order = elimination_order(&cells, 4, &vec![true; 2 * nodes as usize]).unwrap();
    order.sort_unstable();
    assert!(order.into_iter().eq(0..2 * nodes as usize));
}

#[test]
fn a_body_without_free_nodes_has_nothing_to_eliminate() {
    assert_eq!(elimination_order(&[0, 1, 2, 3], 4, &[false; 4]).unwrap(), Vec::<usize>::new());
}
