//! The mesh of a scene, read or built.

use crate::error::Error;
use crate::input::scene::Scene;
use asperity_simulation::run::Run;
use asperity_simulation::setup::problem::Problem;

pub use asperity_mesh::{
    ElementKind, FieldArray, Mesh, MshError, Quality, VtuError, read_msh, write_msh, write_vtu,
};

/// The mesh that a crush of `scene` begins with, in metres, z up and 0 at the highest summit.
///
/// # Errors
/// A scene that cannot be meshed, pointing at its line.
pub fn mesh(scene: &Scene) -> Result<Mesh, Error> {
    let problem = problem(scene)?;
    Ok(problem.mesh.scaled(problem.units.length))
}

/// The scene made ready for the solver.
pub(crate) fn problem(scene: &Scene) -> Result<Problem, Error> {
    let run = Run { mesh: scene.mesh().cloned(), ..Run::new(scene.tables()) };
    run.problem().map_err(|e| scene.error(&e).into())
}
