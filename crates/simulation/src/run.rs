//! One run: a scene from its keys to its outcome. The only entry; each line of [`Run::run`] is a stage with a
//! file of its own.

use crate::companion::{companion, run_beside};
use crate::depth_for_force::expect;
use crate::error_estimate::{Setting, extrapolate_and_bound, rescale_to_force};
use crate::load_history::ready;
use crate::record::oliver_pharr::as_an_instrument;
use crate::scene::{Scene, SceneError, Target};
use crate::setup::discretisation::Discretisation;
use crate::setup::prepare::{Expected, prepare};
use crate::setup::problem::Problem;
use crate::setup::units::Units;
use crate::simulate::simulate;
use asperity_mesh::Mesh;
use asperity_solver::body::analysis::Analyses;
use asperity_solver::point::material::Metal;

pub use crate::record::outcome::{Event, FieldFrame, Outcome, Stopped, Watcher};
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

    /// Runs it once.
    ///
    /// The observer hears of every increment, and of fields every `output.every` increments and at the peak
    /// and the end (if `output.every` is not 0); it ends the run by breaking.
    ///
    /// # Errors
    /// Only if the run cannot begin: what stops it later is in the outcome, with all that was reached.
    pub fn run(self, observer: &mut Watcher<'_>) -> Result<Outcome, CrushError> {
        let numbers = Discretisation::new(self.scene);
        Ok(self.begin()?.round(numbers, None, observer)?.outcome)
    }

    /// The run, ready for its rounds: all that they share.
    pub(crate) fn begin(self) -> Result<Rounds<'a>, CrushError> {
        self.scene.validate()?;
        let units = Units::of_scene(self.scene)?;
        Ok(self.begin_in(units)?)
    }

    /// [`Run::begin`] in these `units`; its scene is valid.
    fn begin_in(self, units: Units) -> Result<Rounds<'a>, SceneError> {
        let Run { scene, mesh, metal, analyses } = self;
        let target = scene.loading.target()?;
        let expected = expect(scene, mesh.as_ref(), units, &analyses)?;
        let mesh = mesh.map(|mesh| mesh.scaled(units.length.recip()));
        Ok(Rounds { scene, target, units, expected, mesh, metal, analyses })
    }

    /// The problem as it is laid out: with the metal of the scene, and a body before all loads.
    ///
    /// # Errors
    /// A scene that cannot be meshed: path and reason.
    pub fn problem(self) -> Result<Problem, SceneError> {
        let units = Units::of_scene(self.scene)?;
        let Rounds { scene, mesh, expected, .. } = self.begin_in(units)?;
        prepare(scene, Discretisation::new(scene), mesh, &expected, units)
    }
}

/// A run that has begun: all but the numbers of its discretisation.
pub(crate) struct Rounds<'a> {
    scene: &'a Scene,
    target: Target,
    units: Units,
    expected: Expected,
    mesh: Option<Mesh>,
    metal: Option<&'a Metal>,
    analyses: Analyses,
}

/// A run with its companion.
pub(crate) struct Round {
    /// The outcome as it is stated.
    pub outcome: Outcome,
    /// The run as it was found: a companion of one with numbers twice as fine.
    pub main: Outcome,
    /// Operations of both.
    pub work: f64,
}

impl Rounds<'_> {
    /// A run with these `numbers`, compared with a `coarser` one that has numbers half as good, or else with
    /// a companion of its own.
    pub fn round(
        &self,
        numbers: Discretisation,
        coarser: Option<&Outcome>,
        observer: &mut Watcher<'_>,
    ) -> Result<Round, CrushError> {
        let Rounds { scene, target, units, ref expected, ref analyses, .. } = *self;
        let other = self.mesh.as_ref().map(Mesh::with_other_element);
        let same_mesh = other.is_some();
        let with_metal = |problem: Problem| match self.metal {
            Some(metal) => Problem { metal: metal.clone(), ..problem },
            None => problem,
        };
        let problem = with_metal(ready(scene, numbers, self.mesh.clone(), expected, (units, analyses))?);
        let companion = match coarser {
            Some(_) => None,
            None => companion(scene, numbers, other, expected, (units, analyses)).map(with_metal),
        };
        let (main, beside) = run_beside(companion, target, analyses, || {
            Ok(simulate(&problem, analyses, scene.output.interval(), observer)?.outcome(observer))
        })?;
        let work = main.operations + beside.as_ref().map_or(0.0, |companion| companion.operations);
        let mut outcome = main.clone();
        if let Some(companion) = beside.as_ref().or(coarser) {
            let Discretisation { element, penetration, .. } = numbers;
            let log_step = numbers.last_log_step();
            let setting = Setting { symmetry: scene.symmetry, element, penetration, log_step, same_mesh };
            outcome = extrapolate_and_bound(outcome, companion, setting);
        }
        if let (Target::Force(force), None) = (target, &outcome.stopped) {
            outcome = rescale_to_force(outcome, force, scene.symmetry);
        }
        // of the force and the depth that are stated
        outcome.summary.oliver_pharr =
            as_an_instrument(&problem, scene.tool.area_function.as_ref(), &outcome.summary);
        Ok(Round { outcome, main, work })
    }
}

#[cfg(test)]
mod tests {
    //! Claim: a run knows no unit of length. With the unit 1024 times as long or as short every number of its
    //! outcome and of its fields has the same bits. Source: a power of two changes no digit of a product, a
    //! sum or a quotient.
    use super::*;
    use crate::scene::{
        Accuracy, Asperity, EarlierLoad, Initial, Lateral, Loading, Material, Numerics, Symmetry, Tool,
        ToolForce,
    };
    use asperity_material::units::{Compliance, Force, Length, LineForce, Stress};
    use std::ops::ControlFlow;

    fn um(micrometres: f64) -> Length {
        Length(micrometres * 1e-6)
    }

    /// A quick scene on steel.
    fn scene(symmetry: Symmetry, tool: Tool, loading: Loading) -> Scene {
        let steel = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.2);
        let mut scene = Scene::new(symmetry, steel, tool, loading).with_accuracy(Accuracy::Draft);
        scene.numerics = Numerics {
            elements_in_contact: Some(6),
            steps: Some(12),
            domain: Some(20.0),
            ..Numerics::default()
        };
        scene.output.every = Some(4);
        scene
    }

    /// All that a run gives but its seconds.
    fn bits(scene: &Scene, shift: i32) -> String {
        let units = Units::of_scene(scene).unwrap();
        let length = units.length * 2.0_f64.powi(shift);
        let mut text = String::new();
        let outcome = Run::new(scene)
            .begin_in(Units::new(length, units.stress, scene.symmetry))
            .unwrap()
            .round(Discretisation::new(scene), None, &mut |event| {
                text += &format!("{event:#?}\n");
                ControlFlow::Continue(())
            })
            .unwrap()
            .outcome;
        assert!(outcome.stopped.is_none(), "{:?}", outcome.stopped);
        text += &format!("{outcome:#?}");
        text.lines().filter(|line| !line.contains("_s: ")).collect::<Vec<_>>().join("\n")
    }

    fn assert_no_unit(scene: &Scene) {
        scene.validate().unwrap();
        let own = bits(scene, 0);
        for shift in [-10, 10] {
            let other = bits(scene, shift);
            let first = own.lines().zip(other.lines()).find(|(a, b)| a != b);
            assert!(own == other, "unit times 2^{shift}: {first:?}");
        }
    }

    const ROUND: Symmetry = Symmetry::Axisymmetric;
    const PLANE: Symmetry = Symmetry::PlaneStrain;

    #[test]
    fn an_asperity_that_is_unloaded_has_no_unit() {
        let cone = Asperity::cone(um(20.0), 10.0).rounded(um(10.0));
        assert_no_unit(&scene(ROUND, Tool::plane(), Loading::to_depth(um(5.0)).unloaded()).with(cone));
    }

    #[test]
    fn a_force_under_an_elastic_tool_on_a_machine_has_no_unit() {
        let mut tool = Tool::sphere(um(30.0));
        tool.youngs_modulus = Some(Stress(1141e9));
        tool.poissons_ratio = Some(0.07);
        tool.machine_compliance = Some(Compliance(1e-7));
        for loading in
            [Loading::to_force(ToolForce::Total(Force(0.1))), Loading::to_depth(um(0.7)).unloaded()]
        {
            assert_no_unit(&scene(ROUND, tool.clone(), loading));
        }
    }

    #[test]
    fn indenting_cones_have_no_unit() {
        let force = || Loading::to_force(ToolForce::Total(Force(0.2)));
        let mut rounded = Tool::cone(15.0);
        rounded.tip_radius = Some(um(0.7));
        for tool in [Tool::cone(8.0), Tool::cone(20.0), rounded, Tool::punch(um(9.0), um(1.0))] {
            assert_no_unit(&scene(ROUND, tool.clone(), force()));
            assert_no_unit(&scene(ROUND, tool, Loading::to_depth(um(0.3)).unloaded()));
        }
    }

    #[test]
    fn rings_and_ridges_have_no_unit() {
        let row = |symmetry, loading| {
            let cone = |height| Asperity { spacing: Some(um(3.0)), ..Asperity::cone(um(height), 12.0) };
            scene(symmetry, Tool::plane(), loading)
                .with(cone(20.0).rounded(um(4.0)))
                .with(cone(19.0))
                .with(cone(19.7))
        };
        assert_no_unit(&row(ROUND, Loading::to_depth(um(2.0)).unloaded()));
        let block = |loading| row(PLANE, loading).on(um(900.0), um(800.0));
        assert_no_unit(&block(Loading::to_depth(um(2.0)).unloaded()));
        assert_no_unit(&block(Loading::to_force(ToolForce::PerLength(LineForce(8e4)))));
        let mut mirrored = block(Loading::to_depth(um(2.0)));
        mirrored.lateral = Lateral::Symmetric;
        assert_no_unit(&mirrored);
    }

    #[test]
    fn loads_that_went_before_have_no_unit() {
        let mut scene = scene(ROUND, Tool::sphere(um(40.0)), Loading::to_depth(um(1.2)).unloaded());
        let earlier = |tool, depth| EarlierLoad { tool, loading: Loading::to_depth(um(depth)) };
        let load = vec![earlier(Tool::cone(9.0), 0.8), earlier(Tool::sphere(um(60.0)), 0.5)];
        scene.initial = Some(Initial { from: None, load });
        assert_no_unit(&scene);
    }

    #[test]
    fn an_imported_mesh_has_no_unit() {
        let cone = Asperity::cone(um(20.0), 10.0).rounded(um(10.0));
        let scene = scene(ROUND, Tool::plane(), Loading::to_depth(um(3.0))).with(cone);
        let problem = Run::new(&scene).problem().unwrap();
        let mesh = problem.mesh.scaled(problem.units.length);
        let forces = [-10, 0, 10].map(|shift| {
            let units = problem.units;
            let units = Units::new(units.length * 2.0_f64.powi(shift), units.stress, scene.symmetry);
            let run = Run { mesh: Some(mesh.clone()), ..Run::new(&scene) };
            let rounds = run.begin_in(units).unwrap();
            let made = rounds.round(Discretisation::new(&scene), None, &mut |_| ControlFlow::Continue(()));
            made.unwrap().outcome.summary.peak_force
        });
        assert_eq!([forces[0]; 3], forces);
    }
}
