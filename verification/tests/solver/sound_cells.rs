//! Claim: the meshes of all sound scenes have sound cells: convex, of at least a tenth of a right angle, and
//! no splinters.
//!
//! Source: Strang & Fix, An Analysis of the Finite Element Method (1973), section 3.3: the map of a cell is
//! one to one where its Jacobian is positive, which for straight sides the corners decide.
//!
//! Scenes drawn at random: slopes to 60°, tips to 0.9 of the height, one to three asperities on the axis or
//! in a row, both kinds of element. Tolerance: 0.02 of the scaled Jacobian is that of the steepest flanks on
//! the coarsest meshes; an aspect of 1e6 is that of the narrowest gap between two feet that is drawn, a
//! rounded sum would leave 1e15.

use asperity_simulation::scene::{Accuracy, Scene};
use asperity_verification::random_scenes::{Kind, draw};
use asperity_verification::single_asperity::prepared;
use rayon::prelude::*;

#[test]
fn meshes_of_random_scenes_have_convex_cells() {
    let scenes: Vec<_> = draw(2000, 1).unwrap().into_iter().filter(|d| d.kind == Kind::Sound).collect();
    assert!(scenes.len() > 1000);
    scenes.par_iter().for_each(|drawn| {
        let mut scene: Scene = toml::from_str(&drawn.text).unwrap();
        scene.accuracy = Accuracy::Draft;
        let quality = prepared(&scene).unwrap().mesh.quality().unwrap();
        assert!(
            quality.min_scaled_jacobian > 0.02 && quality.max_aspect < 1e6,
            "{quality:?}\n{}",
            drawn.text
        );
    });
}
