//! The paper's asperity as a scene.

use asperity_solver::crush::{CrushError, Outcome, run};
use asperity_solver::scene::{Accuracy, Scene};
use std::ops::ControlFlow;

/// The scene of the first figure of the paper, at `accuracy`, without field output.
///
/// # Errors
/// The committed scene file does not read.
pub fn scene(accuracy: Accuracy) -> Result<Scene, toml::de::Error> {
    let mut scene: Scene = toml::from_str(include_str!("../../meshes/single-asperity.toml"))?;
    scene.accuracy = accuracy;
    scene.output.fields = Some(Vec::new());
    scene.output.every = Some(0);
    Ok(scene)
}

/// Runs `scene` without an observer.
///
/// # Errors
/// The run could not begin.
pub fn crush(scene: &Scene) -> Result<Outcome, CrushError> {
    run(scene, None, &mut |_| ControlFlow::Continue(()))
}
