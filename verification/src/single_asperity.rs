//! The paper's asperity as a scene.

use asperity_material::units::{Force, LineForce};
use asperity_simulation::run::{CrushError, Outcome, Run};
use asperity_simulation::scene::{Accuracy, Scene, SceneError, Symmetry, ToolForce};
use asperity_simulation::setup::problem::{Goal, Problem};
use std::error::Error;
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

/// The same without unloading.
///
/// # Errors
/// The committed scene file does not read.
pub fn loaded(accuracy: Accuracy) -> Result<Scene, toml::de::Error> {
    let mut scene = scene(accuracy)?;
    scene.loading.unload = false;
    Ok(scene)
}

/// `scene` driven by `force` (N, or N/m in plane strain) in the place of its depth.
pub fn driven_by(scene: &Scene, force: f64) -> Scene {
    let mut driven = scene.clone();
    driven.loading.depth = None;
    driven.loading.force = Some(match scene.symmetry {
        Symmetry::Axisymmetric => ToolForce::Total(Force(force)),
        Symmetry::PlaneStrain => ToolForce::PerLength(LineForce(force)),
    });
    driven
}

/// Load steps of [`finely_meshed`], and how far they go as a share of the depth for which the mesh is made.
/// Further, long steps pass so many elements of a fine mesh at once that they are halved, and the number of
/// steps would not be fixed.
pub const STEPS: usize = 4;
/// See [`STEPS`].
pub const FRACTION: f64 = 0.01;

/// The asperity at `reference` with so many elements across the contact, loaded a little.
///
/// # Errors
/// The committed scene file does not read, or cannot be meshed.
pub fn finely_meshed(elements: usize) -> Result<Problem, Box<dyn Error + Send + Sync>> {
    let mut scene = scene(Accuracy::Reference)?;
    scene.numerics.elements_in_contact = Some(elements);
    let mut problem = prepared(&scene)?;
    (problem.goal, problem.numbers.steps) = (Goal::Depth(FRACTION * problem.depth), STEPS);
    Ok(problem)
}

/// Runs `scene` without an observer.
///
/// # Errors
/// The run could not begin.
pub fn crush(scene: &Scene) -> Result<Outcome, CrushError> {
    Run::new(scene).run(&mut |_| ControlFlow::Continue(()))
}

/// `scene` as the solver sees it.
///
/// # Errors
/// A scene that cannot be meshed.
pub fn prepared(scene: &Scene) -> Result<Problem, SceneError> {
    Run::new(scene).problem()
}
