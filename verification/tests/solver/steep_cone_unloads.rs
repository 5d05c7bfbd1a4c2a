//! Claim: where an edge that lies along the flank of the tool touches and leaves as a whole, Newton finds the
//! equilibrium: a cone of 30° comes back from steel, under quadratic elements drawn out fivefold beside its
//! tip.
//!
//! Source: this program's own runs. With a loose line search alone the residual wandered at 5e-3 of the force
//! and no increment was small enough (971 iterations, stopped at the start of unloading); a close one after
//! many iterations takes 334. Tolerance: the bound on iterations is twice that.

use asperity_simulation::scene::{Accuracy, ElementChoice, Scene};
use asperity_verification::single_asperity::crush;

#[test]
fn a_steep_cone_comes_back_on_quadratic_elements() {
    let mut scene: Scene = toml::from_str(include_str!("../../../meshes/cone-indentation.toml")).unwrap();
    scene.accuracy = Accuracy::Draft;
    scene.tool.slope_deg = Some(30.0);
    scene.numerics.element = Some(ElementChoice::Q8r);
    let outcome = crush(&scene).unwrap();
    assert_eq!(outcome.stopped, None);
    let iterations = outcome.summary.newton_iterations;
    assert!(iterations < 700, "{iterations}");
}
