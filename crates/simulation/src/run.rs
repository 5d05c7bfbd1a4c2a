//! One run: a scene from its keys to its outcome. The only entry; each line of [`Run::run`] is a stage with a
//! file of its own.

use crate::companion::{companion, run_beside};
use crate::depth_for_force::expect;
use crate::error_estimate::{Setting, extrapolate_and_bound, rescale_to_force};
use crate::load_history::ready;
use crate::record::oliver_pharr::as_an_instrument;
use crate::scene::{Scene, SceneError, Target};
use crate::setup::discretisation::Discretisation;
use crate::setup::prepare::prepare;
use crate::setup::problem::Problem;
use crate::simulate::simulate;
use asperity_mesh::Mesh;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::point::material::Metal;

pub use crate::record::recorder::{Event, FieldFrame, Outcome, Stopped, Watcher};
pub use crate::simulate::CrushError;

/// A run to be made. Without more than its scene: `Run::new(&scene).run(…)`.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// A mesh, in metres, in the place of the one that would be built.
    pub mesh: Option<Mesh>,
    /// A metal that the keys of a scene cannot say (E = 1, that of the scene is its unit), in the place of
    /// the scene's in the run and in its companion; the mesh and the penalty are laid out for the scene's.
    pub metal: Option<&'a Metal>,
    /// Analyses of meshes that other runs may have made: a clone of theirs spares making them again.
    pub analyses: Analyses,
}

impl<'a> Run<'a> {
    /// The run of a scene as it stands.
    pub fn new(scene: &'a Scene) -> Run<'a> {
        Run { scene, mesh: None, metal: None, analyses: Analyses::default() }
    }

    /// Runs it.
    ///
    /// The observer hears of every increment, and of fields every `output.every` increments and at the peak
    /// and the end (if `output.every` is not 0); it ends the run by breaking.
    ///
    /// # Errors
    /// Only if the run cannot begin: what stops it later is in the outcome, with all that was reached.
    pub fn run(self, observer: &mut Watcher<'_>) -> Result<Outcome, CrushError> {
        let Run { scene, mesh, metal, analyses } = self;
        scene.validate()?;
        let target = scene.loading.target()?;
        let expected = expect(scene, mesh.as_ref(), &analyses)?;
        let other = mesh.as_ref().map(Mesh::with_other_element);
        let same_mesh = other.is_some();
        let numbers = Discretisation::new(scene);
        let with_metal = |problem: Problem| match metal {
            Some(metal) => Problem { metal: metal.clone(), ..problem },
            None => problem,
        };
        let problem = with_metal(ready(scene, numbers, mesh, &expected, &analyses)?);
        let companion = companion(scene, numbers, other, &expected, &analyses).map(with_metal);
        let (mut outcome, compared) = run_beside(companion, target, &analyses, || {
            Ok(simulate(&problem, &analyses, scene.output.interval(), observer)?.outcome(observer))
        })?;
        if let Some(companion) = compared {
            let Discretisation { element, penetration, steps, .. } = numbers;
            let setting = Setting { symmetry: scene.symmetry, element, penetration, steps, same_mesh };
            outcome = extrapolate_and_bound(outcome, &companion, setting);
        }
        if let (Target::Force(force), None) = (target, &outcome.stopped) {
            outcome = rescale_to_force(outcome, force, scene.symmetry);
        }
        // of the force and the depth that are stated
        outcome.summary.oliver_pharr =
            as_an_instrument(&problem, scene.tool.area_function.as_ref(), &outcome.summary);
        Ok(outcome)
    }

    /// The problem as it is laid out: with the metal of the scene, and a body before all loads.
    ///
    /// # Errors
    /// A scene that cannot be meshed: path and reason.
    pub fn problem(self) -> Result<Problem, SceneError> {
        let expected = expect(self.scene, self.mesh.as_ref(), &self.analyses)?;
        prepare(self.scene, self.mesh, expected)
    }
}
