//! Claim: at the extremes of every parameter a crush converges to a value that is known otherwise, or stops
//! with a reason that is named; never NaN, never a hang. `cargo test --release -p asperity-verification
//! --test extremes -- --nocapture` prints the table.
//!
//! Sources: Sneddon 1965 (elastic cone, F = (2/π) E* h²/tan β for small slopes), Hertz; sharp cones of
//! another code (the table of `asperity_verification::calibration::PEERS`); the same scene away from the
//! extreme. Draft accuracy promises 5 %, which is the tolerance wherever a force is compared with a value
//! from elsewhere; energy balances to 3 % (draft: 0.8 % on the committed scene), to 10 % where the steps
//! themselves are the extreme.

// in a test a panic is the message, and the table is the point
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use asperity_formats::units::rounded;
use asperity_material::HardeningMode;
use asperity_material::units::{Length, Stress};
use asperity_simulation::record::curve::Curve;
use asperity_simulation::record::rows::{CurveRow, Phase};
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Accuracy, ElementChoice, HardeningChoice, Scene, Substrate, ToolShape};
use asperity_verification::calibration::PEERS;
use asperity_verification::contact::{cone_force, hertz_force};
use asperity_verification::single_asperity::{crush, loaded};

const YOUNG: f64 = 210e9;

/// The paper's asperity, changed, at draft accuracy and without unloading.
fn changed(change: impl Fn(&mut Scene)) -> Scene {
    let mut scene = loaded(Accuracy::Draft).unwrap();
    change(&mut scene);
    scene
}

/// A sharp cone crushed over a quarter of its height, elastic.
fn elastic_cone(slope_deg: f64, poissons_ratio: f64) -> Scene {
    changed(|s| {
        s.asperity[0].slope_deg = Some(slope_deg);
        s.asperity[0].tip_radius = None;
        s.material.poissons_ratio = poissons_ratio;
        s.material.yield_stress = None;
        s.material.hardening_exponent = None;
    })
}

/// A sharp cone of the law `swift`.
fn plastic_cone(slope_deg: f64, exponent: f64, e_over_sy: f64) -> Scene {
    changed(|s| {
        s.asperity[0].slope_deg = Some(slope_deg);
        s.asperity[0].tip_radius = None;
        s.material.yield_stress = Some(Stress(YOUNG / e_over_sy));
        s.material.hardening_exponent = Some(exponent);
        s.material.hardening_law = HardeningChoice::Swift;
    })
}

fn standard(scene: Scene) -> Scene {
    Scene { accuracy: Accuracy::Standard, ..scene }
}

fn peak(outcome: &Outcome) -> f64 {
    outcome.summary.peak_force
}

fn force(scene: &Scene) -> f64 {
    peak(&crush(scene).unwrap())
}

fn sneddon(scene: &Scene) -> f64 {
    let slope = scene.asperity[0].slope_deg.unwrap().to_radians().tan();
    cone_force(scene.material.elastic().reduced_modulus(), slope, 5e-6)
}

/// One row: the scene, what is compared with what, and the bounds of the ratio and of the energy.
struct Row {
    name: &'static str,
    scene: Scene,
    /// Measured over expected.
    ratio: Box<dyn Fn(&Outcome) -> f64>,
    bound: f64,
    energy: f64,
}

fn row(name: &'static str, scene: Scene, bound: f64, ratio: impl Fn(&Outcome) -> f64 + 'static) -> Row {
    Row { name, scene, ratio: Box::new(ratio), bound, energy: 0.03 }
}

fn against_sneddon(name: &'static str, scene: Scene) -> Row {
    let expected = sneddon(&scene);
    row(name, scene, 0.05, move |o| peak(o) / expected)
}

/// Against a sharp cone of the other code.
fn against_peer(name: &'static str, slope_deg: f64, exponent: f64, e_over_sy: f64) -> Row {
    let found = PEERS
        .iter()
        .find(|p| p.beta_deg == slope_deg && p.exponent == exponent && p.e_over_sy == e_over_sy)
        .unwrap();
    let expected = found.k_over_e * YOUNG * 25e-12;
    row(name, plastic_cone(slope_deg, exponent, e_over_sy), 0.05, move |o| peak(o) / expected)
}

/// The force against that of another scene.
fn compared(name: &'static str, scene: Scene, other: Scene, bound: f64) -> Row {
    row(name, scene, bound, move |o| peak(o) / force(&other))
}

/// Against the same scene with the other element, whose mesh differs as well: draft promises 5 %, and flanks
/// that lie down at last are known to 2 to 9 % at standard, as these runs state.
fn beside_other_element(name: &'static str, scene: Scene, element: ElementChoice) -> Row {
    let mut other = scene.clone();
    other.numerics.element = Some(element);
    compared(name, scene, other, 0.05)
}

#[expect(clippy::too_many_lines, reason = "a table: a row per entry")]
fn rows() -> Vec<Row> {
    let paper = || changed(|_| {});
    let steps = |count: usize| changed(|s| s.numerics.steps = Some(count));
    let penetration = |share: f64| changed(|s| s.numerics.penetration = Some(share));
    let q4 = |mut scene: Scene| {
        scene.numerics.element = Some(ElementChoice::Q4);
        scene
    };
    let nearly_incompressible = |nu: f64| changed(|s| s.material.poissons_ratio = nu);
    vec![
        against_sneddon("ν 0.4999999, elastic, Q8R", elastic_cone(1.0, 0.499_999_9)),
        against_sneddon("ν 0.4999999, elastic, Q4", q4(elastic_cone(1.0, 0.499_999_9))),
        against_sneddon("ν -0.9, elastic", elastic_cone(1.0, -0.9)),
        compared(
            "ν 0.4999999, plastic, beside 0.49",
            nearly_incompressible(0.499_999_9),
            nearly_incompressible(0.49),
            // two draft runs, each within 2 to 3 % by its own statement
            0.03,
        ),
        against_peer("n 0, E/σ_y 300", 10.0, 0.0, 300.0),
        against_peer("n 0.5, E/σ_y 1000", 10.0, 0.5, 1000.0),
        // where the cones of the other code at 10° lie over the representative stress, which puts them on one
        // line to 8 %; with the exponent of its neighbour, 0.5, the force is 24 % off
        row(
            "n 0.6, beside other metals of its representative stress",
            plastic_cone(10.0, 0.6, 1000.0),
            0.1,
            |o| peak(o) / (by_representative_stress(0.6, 1000.0) * YOUNG * 25e-12),
        ),
        // in total strain σ = E^n σ_y^(1-n) ε^n tends to Eε: nearly all of the strain stays elastic
        against_sneddon(
            "n 0.99: the elastic cone",
            changed(|s| {
                s.asperity[0].slope_deg = Some(1.0);
                s.asperity[0].tip_radius = None;
                s.material.hardening_exponent = Some(0.99);
            }),
        ),
        against_sneddon("E/σ_y 10 under 1°: no yielding", {
            let mut scene = plastic_cone(1.0, 0.3, 10.0);
            scene.material.hardening_law = HardeningChoice::Hollomon;
            scene
        }),
        // at `standard`: the two runs of `draft` state 6 and 9 %, more than the bound
        row(
            "E/σ_y 1e5, n 0: F/σ_y as at 1e4, at standard",
            standard(plastic_cone(10.0, 0.0, 1e5)),
            0.05,
            |o| 10.0 * peak(o) / force(&standard(plastic_cone(10.0, 0.0, 1e4))),
        ),
        against_sneddon("slope 0.1°, elastic", elastic_cone(0.1, 0.3)),
        cut_cone("slope 45°, to half its height: radius of the cut cone", sharp_to_half(45.0)),
        cut_cone("slope 60°, to half its height: radius of the cut cone", sharp_to_half(60.0)),
        row("tip radius 0: exponent of F(h) 2", plastic_cone(10.0, 0.3, 300.0), 0.02, |o| {
            let at = |share: f64| o.rows.iter().find(|r| r.depth >= share * 5e-6).unwrap();
            let (low, high) = (at(0.2), at(0.999));
            (high.force / low.force).ln() / (high.depth / low.depth).ln() / 2.0
        }),
        row(
            "tip radius 1000 heights: Hertz",
            changed(|s| {
                s.asperity[0].slope_deg = Some(2.5);
                s.asperity[0].tip_radius = Some(Length(20e-3 * 0.9));
                s.material.yield_stress = None;
                s.material.hardening_exponent = None;
                s.loading.depth = Some(Length(2e-6));
            }),
            0.05,
            |o| peak(o) / hertz_force(YOUNG / 0.91, 18e-3, 2e-6),
        ),
        compared("penetration 0.03 of the depth", penetration(0.03), paper(), 0.05),
        compared("penetration 1e-6 of the depth", penetration(1e-6), paper(), 0.05),
        // before the base plane touches the tool, which is steep in the depth
        row("depth 100 % of the height, at 90 % of it beside Q4", whole_height(), 0.05, move |o| {
            let at = |rows: &[CurveRow]| Curve::force(rows).value(18e-6);
            at(&o.rows) / at(&crush(&q4(whole_height())).unwrap().rows)
        }),
        // steps of 0.45 in ln h before the peak lose 6 % of the force, and the run states 23 %
        Row { energy: 0.05, ..compared("one step", steps(1), paper(), 0.2) },
        Row { energy: 0.05, ..compared("eight steps", steps(8), paper(), 0.08) },
        compared("1000 steps", steps(1000), paper(), 0.05),
        compared(
            "a body 1000 times wider than deep",
            changed(|s| {
                s.substrate = Some(Substrate { radius: Some(Length(2.0)), depth: Some(Length(2e-3)) });
            }),
            paper(),
            0.05,
        ),
        row(
            "a body 1000 times deeper than wide: as deep as without, and the shortening of a bar",
            changed(|s| {
                s.substrate = Some(Substrate { radius: Some(Length(2e-3)), depth: Some(Length(2.0)) });
            }),
            0.05,
            |o| {
                let own = Curve::force(&crush(&changed(|_| {})).unwrap().rows).depth_of(peak(o)).unwrap();
                let shortening = peak(o) * 2.0 / (YOUNG * std::f64::consts::PI * 2e-3_f64.powi(2));
                o.summary.peak_depth / (own + shortening)
            },
        ),
        beside_other_element(
            "flanks of 60° side by side, to 80 % of their height, Q8R beside Q4",
            changed(|s| {
                s.asperity[0].slope_deg = Some(60.0);
                s.asperity[0].tip_radius = Some(Length(2e-6));
                s.asperity.push(s.asperity[0].clone());
                s.loading.depth = Some(Length(16e-6));
                s.numerics.element = Some(ElementChoice::Q8r);
            }),
            ElementChoice::Q4,
        ),
        against_peer("n 0, E/σ_y 100 under 3°", 3.0, 0.0, 100.0),
        against_peer("n 0.1, E/σ_y 1000 under 3°", 3.0, 0.1, 1000.0),
        against_peer("n 0.5, E/σ_y 1000 under 6°", 6.0, 0.5, 1000.0),
        compared(
            "ν 0.49, plastic, beside 0.4999",
            nearly_incompressible(0.49),
            nearly_incompressible(0.4999),
            0.05,
        ),
        against_sneddon("slope 0.1°, E/σ_y 300: no yielding", {
            let mut scene = plastic_cone(0.1, 0.3, 300.0);
            scene.material.hardening_law = HardeningChoice::Hollomon;
            scene
        }),
        row("depth 1e-4 of the height, elastic: Hertz on the tip", shallow(), 0.05, |o| {
            peak(o) / hertz_force(YOUNG / 0.91, 10e-6, 2e-9)
        }),
        beside_other_element(
            "a cap as high as half its radius, to 60 % of it, beside Q4",
            cap(0.6),
            ElementChoice::Q4,
        ),
        cut_cone("slope 60°, to half its height, Q4: radius of the cut cone", q4(sharp_to_half(60.0))),
        beside_other_element(
            "slope 60°, to 95 % of its height, at standard beside Q4",
            nearly_flat(60.0),
            ElementChoice::Q4,
        ),
        beside_other_element(
            "slope 75°, to 95 % of its height, at standard beside Q4",
            nearly_flat(75.0),
            ElementChoice::Q4,
        ),
        beside_other_element("a ball pressed in to its radius, beside Q4", ball(), ElementChoice::Q4),
        beside_other_element("a cone of 50° pressed in, beside Q8R", steep_tool(), ElementChoice::Q8r),
        compared("10000 steps", steps(10_000), paper(), 0.05),
        scaled("lengths of 1e-12", 1e-12, 1.0),
        scaled("lengths of 1e12", 1e12, 1.0),
        scaled("stresses of 1e-12", 1.0, 1e-12),
        scaled("stresses of 1e12", 1.0, 1e12),
        row(
            "unloaded and loaded again ten times: the force of the first peak",
            reloaded(10),
            0.02,
            last_peak_over_first,
        ),
        row(
            "half of the hardening kinematic, reloaded: the force of the first peak",
            half_kinematic(),
            0.02,
            last_peak_over_first,
        ),
    ]
}

/// Force where the last of the deepest reloads ends over that of the first loading.
fn last_peak_over_first(o: &Outcome) -> f64 {
    let reloads = o.rows.iter().filter(|r| r.phase == Phase::Reload);
    reloads.max_by(|a, b| a.depth.total_cmp(&b.depth)).unwrap().force / peak(o)
}

/// K/E of a crushed cone of 10° with the exponent and E/σ_y, from the cones of another code at 10° whose
/// representative stresses, σ_y(1 + E ε_r/σ_y)^n at ε_r = 0.13 tan β, are the nearest below and above: ln K
/// is a line over its logarithm.
fn by_representative_stress(exponent: f64, e_over_sy: f64) -> f64 {
    let strain = 0.13 * 10f64.to_radians().tan();
    let log_stress = |n: f64, ratio: f64| ((1.0 + ratio * strain).powf(n) / ratio).ln();
    let mut cones: Vec<[f64; 2]> = PEERS
        .iter()
        .filter(|p| p.beta_deg == 10.0)
        .map(|p| [log_stress(p.exponent, p.e_over_sy), p.k_over_e.ln()])
        .collect();
    cones.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let x = log_stress(exponent, e_over_sy);
    let [a, b] = cones.windows(2).find(|w| w[0][0] <= x && x <= w[1][0]).map(|w| [w[0], w[1]]).unwrap();
    (a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1])).exp()
}

/// The radius of the contact of a cone pressed flat to half its height, against the half of its base radius
/// at which the plane cuts it. It is no smaller, and no larger than if the metal of the tip filled the
/// frustum below evenly: a third of the area at the cut, √(4/3) = 1.155 times the radius. The middle of the
/// two, give or take half of their distance.
fn cut_cone(name: &'static str, scene: Scene) -> Row {
    let cut = 10e-6 / scene.asperity[0].slope_deg.unwrap().to_radians().tan();
    let most = (4.0_f64 / 3.0).sqrt();
    let middle = 0.5 * (1.0 + most);
    row(name, scene, (most - 1.0) / (most + 1.0), move |o| o.summary.contact_radius / (middle * cut))
}

/// A sharp cone of this slope, to half its height.
fn sharp_to_half(slope_deg: f64) -> Scene {
    changed(|s| {
        s.asperity[0].slope_deg = Some(slope_deg);
        s.asperity[0].tip_radius = None;
        s.loading.depth = Some(Length(10e-6));
    })
}

/// The paper's asperity, all of its height.
fn whole_height() -> Scene {
    changed(|s| s.loading.depth = s.asperity[0].height)
}

/// A sharp cone of this slope, to 95 % of its height. (Draft states 6 to 16 % there.)
fn nearly_flat(slope_deg: f64) -> Scene {
    changed(|s| {
        s.accuracy = Accuracy::Standard;
        s.asperity[0].slope_deg = Some(slope_deg);
        s.asperity[0].tip_radius = None;
        s.loading.depth = Some(Length(19e-6));
    })
}

/// A ball pressed into a flat body to its own radius.
fn ball() -> Scene {
    changed(|s| {
        s.asperity.clear();
        s.tool.shape = ToolShape::Sphere;
        s.tool.radius = Some(Length(20e-6));
        s.loading.depth = Some(Length(20e-6));
    })
}

/// A sharp cone pressed into a flat body.
fn steep_tool() -> Scene {
    changed(|s| {
        s.asperity.clear();
        s.tool.shape = ToolShape::Cone;
        s.tool.slope_deg = Some(50.0);
    })
}

/// An elastic crush of the tip alone.
fn shallow() -> Scene {
    changed(|s| {
        s.material.yield_stress = None;
        s.material.hardening_exponent = None;
        s.loading.depth = Some(Length(2e-9));
    })
}

/// A cap of 50 µm radius and 25 µm height, crushed to this share of it.
fn cap(share: f64) -> Scene {
    changed(|s| {
        s.asperity[0].radius = Some(Length(50e-6));
        s.asperity[0].height = Some(Length(25e-6));
        (s.asperity[0].slope_deg, s.asperity[0].tip_radius) = (None, None);
        s.loading.depth = Some(Length(share * 25e-6));
    })
}

/// The paper's asperity `length` times as large, of a metal `stress` times as stiff: the force in its own
/// units.
fn scaled(name: &'static str, length: f64, stress: f64) -> Row {
    let times = |x: Option<Length>| x.map(|x| Length(length * x.0));
    let scene = changed(|s| {
        s.asperity[0].height = times(s.asperity[0].height);
        s.asperity[0].tip_radius = times(s.asperity[0].tip_radius);
        s.loading.depth = times(s.loading.depth);
        s.material.youngs_modulus.0 *= stress;
        s.material.yield_stress = s.material.yield_stress.map(|y| Stress(stress * y.0));
    });
    row(name, scene, 1e-6, move |o| peak(o) / (stress * length * length) / force(&changed(|_| {})))
}

fn reloaded(times: usize) -> Scene {
    changed(|s| {
        s.loading.unload = true;
        s.loading.reloads = times;
    })
}

fn half_kinematic() -> Scene {
    let mut scene = reloaded(1);
    scene.material.hardening_mode = HardeningMode::Kinematic;
    scene.material.kinematic_share = Some(0.5);
    scene
}

/// The rim that is squeezed out of a steep cap lies down on the base plane and presses it.
#[test]
fn a_rim_that_lies_down_on_the_base_carries_on() {
    // touches at 80 % of the height of this cap with the mesh of `standard`
    let mut scene = standard(cap(0.85));
    scene.material.hardening_exponent = Some(0.1);
    let outcome = crush(&scene).unwrap();
    assert!(outcome.stopped.is_none(), "{:?}", outcome.stopped);
    assert!(outcome.summary.energy_balance_error < 1e-2, "{}", outcome.summary.energy_balance_error);
}

#[test]
fn extreme_scenes_converge_or_stop_with_a_reason() {
    let rows = rows();
    println!("| extreme | ends | measured over expected | bound | energy balance | increments | halvings |");
    println!("|-|-|-|-|-|-|-|");
    let (mut failures, mut converged) = (Vec::new(), 0);
    for row in &rows {
        let outcome = crush(&row.scene).unwrap();
        let summary = &outcome.summary;
        let finite = outcome.rows.iter().all(|r| r.depth.is_finite() && r.force.is_finite());
        let (end, ratio, good) = match &outcome.stopped {
            None => {
                converged += 1;
                let ratio = (row.ratio)(&outcome);
                let near = (ratio - 1.0).abs() <= row.bound;
                (
                    "reached".to_string(),
                    format!("{ratio:.4}"),
                    near && summary.energy_balance_error <= row.energy,
                )
            }
            // a named reason and more than half of the way
            Some(stop) => {
                let end = format!("at {:.2} µm: {}", 1e6 * stop.depth, stop.reason);
                let asked = row.scene.loading.depth.map_or(0.0, |depth| depth.0);
                (end, String::new(), stop.depth > 0.5 * asked && !stop.reason.to_string().is_empty())
            }
        };
        println!(
            "| {} | {end} | {ratio} | {} | {:.1e} | {} | {} |",
            row.name,
            rounded(row.bound, 2),
            summary.energy_balance_error,
            summary.increments,
            summary.cutbacks
        );
        if !finite || !good {
            failures.push(row.name);
        }
    }
    println!("\n{converged} of {} reached their depth.", rows.len());
    assert!(failures.is_empty(), "{failures:?}");
    assert!(100 * converged >= 95 * rows.len(), "{converged} of {} reached their depth", rows.len());
}
