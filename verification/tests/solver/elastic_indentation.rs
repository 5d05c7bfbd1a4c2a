//! Claim: an elastic flat body follows Hertz under a sphere and Sneddon under a cone of 1 degree to 1 % in
//! force, and what the method of Oliver and Pharr makes of the two curves is the true reduced modulus to 2 %
//! and the true contact area to 4 %. At the numbers of a level the contact area is true within the error that
//! the run states. A flat punch whose edge is rounded by 1 % of its radius has F = 2 E* a h to 4 %, and one
//! of any edge S = 2 E* a to 1 % and its area within what is stated. The stiffness of unloading is the
//! slope of the loading, at any number of elements in contact, under tools of every kind, in both symmetries.
//!
//! Source: `contact` (Johnson 1985; Sneddon 1965); Oliver and Pharr 1992, whose h_c is exact for both.
//! Tolerance 1 %: as in `elastic_flattening`, compared from a fifth of the peak on. Modulus: unloading
//! stiffness 1 %, and half the 2 % of the area that the force leaves uncertain through h - ε F/S. Area: twice
//! the 1 % of the radius, which is measured to a fifth of the edge element (an eighteenth of the radius), on
//! top of the same 2 %. Punch: a lies between the radii of its flat part and of its flank, 1 % apart, and the
//! pressure rises without end toward an edge that the mesh resolves to a part of the radius.

use asperity_material::units::Length;
use asperity_numerics::least_squares::{powers, solve};
use asperity_simulation::record::rows::Phase;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, Scene, Symmetry, Tool};
use asperity_verification::contact::{cone_force, cone_radius, hertz_force, hertz_radius};
use asperity_verification::single_asperity::{crush, scene};
use std::f64::consts::PI;

/// A flat elastic body that is loaded by `tool` and unloaded once.
fn loaded_and_unloaded(tool: Tool, accuracy: Accuracy, depth: f64) -> Scene {
    let mut scene = scene(accuracy).unwrap();
    scene.material.yield_stress = None;
    scene.material.hardening_exponent = None;
    scene.asperity.clear();
    scene.tool = tool;
    scene.loading.depth = Some(Length(depth));
    scene.loading.unload = true;
    scene
}

/// A flat elastic body under `tool`, and back.
fn indent(tool: Tool, depth: f64) -> (Scene, Outcome) {
    let mut scene = loaded_and_unloaded(tool, Accuracy::Standard, depth);
    scene.numerics.domain = Some(400.0);
    scene.numerics.steps = Some(16);
    scene.numerics.elements_in_contact = Some(48);
    // the mean penetration is taken off the depth, twice too much under a growing elastic cone: at a fifth of
    // the peak its force is then too high by ten times the penetration over the peak depth
    scene.numerics.penetration = Some(0.0005);
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none());
    (scene, outcome)
}

fn check(scene: &Scene, outcome: &Outcome, force: impl Fn(f64) -> f64) {
    let summary = &outcome.summary;
    for row in outcome.rows.iter().filter(|r| r.depth >= 0.2 * summary.peak_depth && r.force > 0.0) {
        let error = row.force / force(row.depth) - 1.0;
        assert!(error.abs() < 0.01, "{:?} force off by {error:e} at {:e}", row.phase, row.depth);
    }
    let read = summary.oliver_pharr.unwrap();
    let modulus = read.reduced_modulus / scene.material.elastic().reduced_modulus() - 1.0;
    let area = read.contact_area / summary.contact_area - 1.0;
    assert!(modulus.abs() < 0.02 && area.abs() < 0.04, "modulus {modulus:e}, area {area:e}");
}

#[test]
fn a_sphere_follows_hertz() {
    let radius = 1e-3;
    let tool = Tool::sphere(Length(radius));
    let (scene, outcome) = indent(tool, 0.2e-6); // a = 0.014 R
    let modulus = scene.material.elastic().reduced_modulus();
    check(&scene, &outcome, |h| hertz_force(modulus, radius, h));
}

#[test]
fn a_cone_follows_sneddon() {
    let tool = Tool::cone(1.0);
    let (scene, outcome) = indent(tool, 0.2e-6);
    let modulus = scene.material.elastic().reduced_modulus();
    check(&scene, &outcome, |h| cone_force(modulus, 1.0_f64.to_radians().tan(), h));
}

#[test]
fn a_punch_presses_with_its_whole_face() {
    let (radius, depth) = (20e-6, 0.1e-6);
    let mut scene = scene(Accuracy::Standard).unwrap();
    scene.material.yield_stress = None;
    scene.material.hardening_exponent = None;
    scene.asperity.clear();
    scene.tool = Tool::punch(Length(radius), Length(0.01 * radius));
    scene.loading.depth = Some(Length(depth));
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none());
    let stiffness = 2.0 * scene.material.elastic().reduced_modulus() * radius;
    for row in outcome.rows.iter().filter(|row| row.depth >= 0.2 * depth && row.force > 0.0) {
        let error = row.force / (stiffness * row.depth) - 1.0;
        assert!(error.abs() < 0.04, "{:?} force off by {error:e} at {:e}", row.phase, row.depth);
    }
    assert!(outcome.summary.elements < 20_000, "{}", outcome.summary.elements);
}

/// An elastic body gives back what it took: S is dF/dh of the loading, here of a parabola through ln F over
/// ln h from half of the depth on, at whatever part of its edge the contact ends. 0.5 % at `standard` and
/// 0.2 % at `reference`: the stiffness of the edges that touch is 0.7 to 1.5 % above it.
#[test]
fn the_stiffness_of_unloading_is_the_slope_of_the_loading() {
    let ball = Tool::sphere(Length(30e-6));
    let bounds = [(Accuracy::Standard, 0.005), (Accuracy::Reference, 0.002)];
    let counts = [21, 23, 25, 27].map(|count| (ball.clone(), 0, Some(count)));
    let levels = [(ball.clone(), 0, None), (ball, 1, None), (Tool::cone(15.0), 0, None)];
    for (tool, level, elements) in counts.into_iter().chain(levels) {
        let (accuracy, bound) = bounds[level];
        let mut scene = unloading(tool.clone(), accuracy, 0.4e-6);
        scene.numerics.elements_in_contact = elements;
        let error = stiffness_over_slope(&scene);
        assert!(error.abs() < bound, "{tool:?} {elements:?} at {accuracy:?}: {error:e}");
    }
}

/// The same in one round.
fn unloading(tool: Tool, accuracy: Accuracy, depth: f64) -> Scene {
    let mut scene = loaded_and_unloaded(tool, accuracy, depth);
    scene.numerics.refine = Some(false);
    scene
}

/// S over dF/dh of the loading, less 1.
fn stiffness_over_slope(scene: &Scene) -> f64 {
    let depth = scene.loading.depth.unwrap().0;
    let outcome = crush(scene).unwrap();
    assert!(outcome.stopped.is_none());
    let late = outcome.rows.iter().filter(|row| row.phase == Phase::Load && row.depth > 0.5 * depth);
    let points: Vec<_> =
        late.map(|row| (powers::<3>((row.depth / depth).ln()), row.force.ln(), 1.0)).collect();
    let [peak, exponent, _] = solve(&points).unwrap();
    outcome.summary.unloading_stiffness.unwrap() * depth / (exponent * peak.exp()) - 1.0
}

/// Points of a paraboloid, or of a parabola, of this radius at its apex.
fn parabola(radius: f64, reach: f64) -> Tool {
    let point = |i: u32| {
        let r = reach * f64::from(i) / 240.0;
        [r, r * r / (2.0 * radius)]
    };
    Tool::measured((0..=240).map(point).collect())
}

/// As above at `standard` under other tools, and in plane strain, where the stiffness goes by the logarithm
/// of the width. 0.5 %: what is asked, in the mean of three meshes, since the slope of a loading curve
/// ripples as its front crosses edges (by 0.6 % of a punch in plane strain).
#[test]
fn the_stiffness_of_unloading_is_the_slope_of_the_loading_under_every_tool() {
    let um = |x: f64| Length(x * 1e-6);
    let plane = |tool: Tool| (tool, Symmetry::PlaneStrain);
    for (tool, symmetry) in [
        (parabola(30e-6, 12e-6), Symmetry::Axisymmetric),
        (Tool::punch(um(20.0), um(10.0)), Symmetry::Axisymmetric),
        plane(Tool::sphere(um(30.0))),
        plane(Tool::cone(5.0)),
        plane(Tool::punch(um(20.0), um(5.0))),
        plane(Tool::punch(um(20.0), um(0.2))),
        plane(parabola(30e-6, 16e-6)),
    ] {
        let mut scene = unloading(tool.clone(), Accuracy::Standard, 0.4e-6);
        if symmetry == Symmetry::PlaneStrain {
            scene = Scene { symmetry, ..scene }.on(um(400.0), um(400.0));
        }
        let errors = [20, 22, 24].map(|elements| {
            scene.numerics.elements_in_contact = Some(elements);
            stiffness_over_slope(&scene)
        });
        let error = errors.iter().sum::<f64>() / errors.len() as f64;
        assert!(error.abs() < 0.005, "{tool:?}: {errors:?}");
    }
}

/// Contact radius of a rigid punch with a rounded edge at a depth: h = a ∫ f'(r)/√(a² - r²) dr over 0 to a
/// (Sneddon 1965), where the flat face has no slope; r = a sin θ, midpoint rule.
fn punch_radius(radius: f64, edge: f64, depth: f64) -> f64 {
    let flat = radius - edge;
    let depth_of = |a: f64| {
        let start = (flat / a).asin();
        let count = 4000;
        let step = (0.5 * PI - start) / f64::from(count);
        let slope = |x: f64| x / (edge * edge - x * x).sqrt();
        (0..count)
            .map(|i| a * slope(a * (start + (f64::from(i) + 0.5) * step).sin() - flat) * step)
            .sum::<f64>()
    };
    let [mut low, mut high] = [flat, radius];
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if depth_of(middle) < depth { low = middle } else { high = middle }
    }
    low
}

/// The contact of a punch ends in one edge of the mesh all the way, so that two meshes say nothing of the
/// order of its error. S is within what is stated, at `standard` and `reference` within 1.2 % (0.2 to 1.1 %
/// were measured), and within 1.5 % of that of a disc as wide as the contact of the run (0.3 to 1.3 %;
/// springs along a normal that turns within the last edge made it 2 % on the finest mesh); the area is within
/// what is stated on 11 of 12 meshes. (Under the edge of 5 µm it is 7.6 % too small at 3 %, of which 3.1 % is
/// stated.)
#[test]
fn a_punch_has_the_stiffness_and_the_area_of_its_radius() {
    let (radius, depth) = (20e-6, 0.1e-6);
    let mut outside = Vec::new();
    for edge in [0.2e-6, 1e-6, 5e-6] {
        let a = punch_radius(radius, edge, depth);
        for accuracy in [Accuracy::Draft, Accuracy::Within(0.03), Accuracy::Standard, Accuracy::Reference] {
            let scene = unloading(Tool::punch(Length(radius), Length(edge)), accuracy, depth);
            let summary = crush(&scene).unwrap().summary;
            let modulus = scene.material.elastic().reduced_modulus();
            let over =
                |radius: f64| (summary.unloading_stiffness.unwrap() / (2.0 * modulus * radius) - 1.0).abs();
            let [stiffness, beyond_area] = [over(a), over((summary.contact_area / PI).sqrt())];
            let fine = accuracy.promise() <= Accuracy::Standard.promise();
            let stated = summary.errors.unloading_stiffness.unwrap().min(if fine { 0.012 } else { 1.0 });
            assert!(stiffness < stated, "{edge:e} at {accuracy:?}: {stiffness:e}, stated {stated:e}");
            assert!(beyond_area < 0.015, "{edge:e} at {accuracy:?}: {beyond_area:e}");
            let area = (summary.contact_area / (PI * a * a) - 1.0).abs();
            if area > summary.errors.contact_area {
                outside.push((edge, accuracy, area, summary.errors.contact_area));
            }
        }
    }
    assert!(outside.len() <= 1, "{outside:?}");
}

/// The contact area against the closed forms, with the elements of a level and the three next numbers: within
/// the error that the run states on 14 of 16 meshes, the nine of ten that are asked of an area. The tools are
/// so gentle that the closed forms hold: on a cone of 1° the surface moves inward by as much as makes the
/// area 0.4 % smaller.
#[test]
fn the_area_of_a_level_is_within_its_stated_error() {
    let (ball, slope) = (1.0, 0.05);
    let radius_of_ball = |h: f64| hertz_radius(ball, h);
    let radius_of_cone = |h: f64| cone_radius(f64::to_radians(slope).tan(), h);
    let tools: [(Tool, &dyn Fn(f64) -> f64); 2] =
        [(Tool::sphere(Length(ball)), &radius_of_ball), (Tool::cone(slope), &radius_of_cone)];
    let levels = [(Accuracy::Draft, 10), (Accuracy::Standard, 20)];
    let (mut outside, mut promised) = (Vec::new(), Vec::new());
    for ((tool, radius), (accuracy, least)) in tools.iter().flat_map(|t| levels.map(|level| (t, level))) {
        for elements in least..least + 4 {
            let mut scene = scene(accuracy).unwrap();
            scene.material.yield_stress = None;
            scene.material.hardening_exponent = None;
            scene.asperity.clear();
            scene.tool = tool.clone();
            scene.loading.depth = Some(Length(0.2e-6));
            scene.loading.unload = false;
            scene.numerics.elements_in_contact = Some(elements);
            let summary = crush(&scene).unwrap().summary;
            let stated = summary.errors.contact_area;
            let error = (summary.contact_area / (PI * radius(summary.peak_depth).powi(2)) - 1.0).abs();
            promised.push(stated / accuracy.promise());
            if error > stated {
                outside.push((accuracy, elements, error, stated));
            }
        }
    }
    assert!(outside.len() <= 2, "{outside:?}");
    let mean = promised.iter().sum::<f64>() / promised.len() as f64;
    assert!(mean < 1.5, "stated over promised: {promised:?}");
}
