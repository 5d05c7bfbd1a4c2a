//! Claims: a body that earlier loads left goes on where they ended.
//!
//! References: the reload of one run, the load that goes on at once, the virgin body where the earlier load
//! left no trace.

use asperity_material::HardeningMode;
use asperity_material::units::{Length, Stress};
use asperity_simulation::record::rows::Phase;
use asperity_simulation::run::{Outcome, Run};
use asperity_simulation::scene::{Asperity, Loading, Material, Scene, Symmetry, Tool};
use std::ops::ControlFlow;

fn crushed(scene: &Scene) -> Outcome {
    let outcome = Run::new(scene).run(&mut |_| ControlFlow::Continue(())).unwrap();
    assert!(outcome.stopped.is_none(), "{:?}", outcome.stopped);
    outcome
}

fn steel() -> Material {
    Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(300e6), 0.3)
}

fn loading_to(depth: f64) -> Loading {
    Loading::to_depth(Length(depth)).unloaded()
}

/// The asperity of the paper, 5 um deep.
fn asperity(material: Material) -> Scene {
    let cone = Asperity::cone(Length(20e-6), 10.0).rounded(Length(10e-6));
    let mut scene = Scene::new(Symmetry::Axisymmetric, material, Tool::plane(), loading_to(5e-6)).with(cone);
    (scene.numerics.elements_in_contact, scene.numerics.steps) = (Some(24), Some(72));
    scene
}

fn assert_near(a: f64, b: f64, tolerance: f64) {
    assert!((a / b - 1.0).abs() <= tolerance, "{a} {b}");
}

/// The same tool back to the same place: the states are those of the reload, on a mesh and with a penalty of
/// their own. The depth of the second load is the small difference of two; a thousandth of the first depth is
/// 1 % of it, so of the force, and two runs of this level know it to two.
#[test]
fn the_tool_that_comes_back_finds_the_reload_of_one_run() {
    let mut kinematic = steel();
    kinematic.hardening_mode = HardeningMode::Kinematic;
    kinematic.kinematic_share = Some(0.3);
    for material in [steel(), kinematic] {
        let scene = asperity(material);
        let once = Scene { loading: Loading { reloads: 1, ..scene.loading }, ..scene.clone() };
        let once = crushed(&once);
        let reload = once.rows.iter().rfind(|row| row.phase == Phase::Reload).unwrap();
        let residual = once.summary.residual_depth.unwrap();
        let again = crushed(&scene.loaded_again(Tool::plane(), loading_to(5e-6 - residual))).summary;
        assert_near(again.peak_force, reload.force, 0.02);
        // both are known to a third of an element, of 24 across the contact
        assert_near(again.contact_area, reload.contact_area, 0.03);
        let [here, there] = [&again, &once.summary]
            .map(|run| (run.unloading_stiffness.unwrap(), run.errors.unloading_stiffness.unwrap()));
        assert_near(here.0, there.0, here.1 + there.1);
    }
}

/// Beyond the first depth the load goes on as if the tool had never left: within the errors that both state.
#[test]
fn a_deeper_second_load_joins_the_load_that_went_there_at_once() {
    let scene = asperity(steel());
    let residual = crushed(&scene).summary.residual_depth.unwrap();
    let deep = crushed(&Scene { loading: loading_to(7e-6), ..scene.clone() }).summary;
    let again = crushed(&scene.loaded_again(Tool::plane(), loading_to(7e-6 - residual))).summary;
    assert_near(again.peak_force, deep.peak_force, 0.01);
    assert_near(again.residual_depth.unwrap() + residual, deep.residual_depth.unwrap(), 0.005);
    assert!(again.energy_balance_error < 3e-3, "{}", again.energy_balance_error);
}

/// An elastic body forgets, whatever pressed it: Newton's tolerance, and a mesh that two tools share.
#[test]
fn an_elastic_body_is_virgin_after_its_loads() {
    let body = Material::elastic_body(Stress(210e9), 0.3);
    let ball = Tool::sphere(Length(100e-6));
    let virgin = Scene::new(Symmetry::Axisymmetric, body.clone(), ball.clone(), loading_to(1e-6));
    let [first, second] = [Tool::sphere(Length(300e-6)), Tool::cone(5.0)];
    let scene = Scene::new(Symmetry::Axisymmetric, body, first, loading_to(1e-6));
    let again = scene.loaded_again(second, loading_to(1e-6)).loaded_again(ball, loading_to(1e-6));
    let (virgin, again) = (crushed(&virgin).summary, crushed(&again).summary);
    assert_near(again.peak_force, virgin.peak_force, 0.004);
    assert!(again.residual_depth.unwrap().abs() < 1e-10, "{again:?}");
}

/// A dent hardens: a second ball of the same size needs more force for the same small depth than on virgin
/// metal.
#[test]
fn a_ball_in_the_dent_of_another_finds_harder_and_rounder_metal() {
    let ball = || Tool::sphere(Length(50e-6));
    let virgin = Scene::new(Symmetry::Axisymmetric, steel(), ball(), loading_to(2e-6));
    let small = crushed(&Scene { loading: loading_to(0.2e-6), ..virgin.clone() }).summary;
    let again = crushed(&virgin.loaded_again(ball(), loading_to(0.2e-6))).summary;
    assert!(again.peak_force > 3.0 * small.peak_force, "{} {}", again.peak_force, small.peak_force);
}
