//! A scene made ready: its problem prepared, and its body taken through the loads that went before.

use crate::scene::{Scene, SceneError};
use crate::setup::discretisation::Discretisation;
use crate::setup::prepare::{Expected, prepare};
use crate::setup::problem::Problem;
use crate::setup::units::Units;
use crate::simulate::{CrushError, simulate};
use asperity_mesh::Mesh;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::state::Unloaded;
use std::ops::ControlFlow;

/// [`prepare`], its body as the earlier loads of `scene` leave it. All loads share one mesh, made for all of
/// them.
///
/// # Errors
/// A scene that cannot be meshed, an earlier load that cannot be brought to its end and back: path and
/// reason.
pub(super) fn ready(
    scene: &Scene,
    numbers: Discretisation,
    mesh: Option<Mesh>,
    expected: &Expected,
    (units, analyses): (Units, &Analyses),
) -> Result<Problem, CrushError> {
    let mut problem = prepare(scene, numbers, mesh, expected, units)?;
    let mut left: Option<Unloaded> = None;
    for (index, expected) in expected.earlier.iter().enumerate() {
        let mesh = Some(problem.mesh.clone());
        let mut load = prepare(&scene.at_load(index), numbers, mesh, expected, units)?;
        // of the same substrate, which is a given one for a mesh that is given
        load.rules.far_field = problem.rules.far_field;
        load.specimen.earlier = left;
        let simulation = simulate(&load, analyses, 0, &mut |_| ControlFlow::Continue(()))?;
        if let Some(reason) = simulation.stopped {
            let path = format!("initial.load[{index}]");
            return Err(SceneError { path, message: format!("stopped on its way: {reason}") }.into());
        }
        let model = &simulation.path.model;
        left = Some(model.state().unloaded(model.body()));
    }
    problem.specimen.earlier = left;
    Ok(problem)
}
