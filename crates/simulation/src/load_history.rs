//! A scene made ready: its problem prepared, and its body taken through the loads that went before.

use crate::scene::{Scene, SceneError};
use crate::setup::discretisation::Discretisation;
use crate::setup::prepare::{Expected, prepare_with};
use crate::setup::problem::Problem;
use crate::simulate::{CrushError, simulate};
use asperity_mesh::Mesh;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::body::state::Unloaded;
use std::ops::ControlFlow;

/// [`prepare_with`], its body as the earlier loads of `scene` leave it. All loads share one mesh, made for
/// all of them.
///
/// # Errors
/// A scene that cannot be meshed, an earlier load that cannot be brought to its end and back: path and
/// reason.
pub(super) fn ready(
    scene: &Scene,
    numbers: Discretisation,
    mesh: Option<Mesh>,
    expected: &Expected,
    analyses: &Analyses,
) -> Result<Problem, CrushError> {
    let mut problem = prepare_with(scene, numbers, mesh, expected)?;
    let (length, symmetry) = (problem.units.length, problem.symmetry);
    let mut left: Option<Unloaded> = None;
    for (index, expected) in expected.earlier.iter().enumerate() {
        let mut mesh = problem.mesh.clone();
        mesh.nodes.iter_mut().flatten().for_each(|x| *x *= length);
        let mut load = prepare_with(&scene.at_load(index), numbers, Some(mesh), expected)?;
        let own = load.units.length;
        // of the same substrate, which is a given one for a mesh that is given
        load.rules.far_field = problem.rules.far_field * own / length;
        load.specimen.earlier = left.map(|left| left.scaled(length / own, symmetry));
        let simulation = simulate(&load, analyses, 0, &mut |_| ControlFlow::Continue(()))?;
        if let Some(reason) = simulation.stopped {
            let path = format!("initial.load[{index}]");
            return Err(SceneError { path, message: format!("stopped on its way: {reason}") }.into());
        }
        let model = &simulation.path.model;
        left = Some(model.state().unloaded(model.body()).scaled(own / length, symmetry));
    }
    problem.specimen.earlier = left;
    Ok(problem)
}
