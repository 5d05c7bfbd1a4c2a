//! `press` with the half-space: its rows, the judgement of closures, rows that fail alone, the leak, the
//! words at the end.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity::joint::joint;
use asperity::{Rough, RoughScene, press};
use asperity_roughness::Closure;
use std::path::Path;

fn pressed(top: &str, rest: &str) -> Result<Rough, asperity::Error> {
    pressed_metal("hardness = \"2 GPa\"", top, rest)
}

fn pressed_metal(strength: &str, top: &str, rest: &str) -> Result<Rough, asperity::Error> {
    press(&scene(strength, top, rest), &mut |_| true)
}

fn scene(strength: &str, top: &str, rest: &str) -> RoughScene {
    let text = format!(
        r#"{top}
[surface]
periodic = true
[surface.generate]
kind = "self-affine"
ra = "0.3 um"
hurst = 0.8
rolloff = "30 um"
cutoff = "8 um"
size = ["96 um", "96 um"]
pixels = [96, 96]
seed = 1
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
{strength}
{rest}"#
    );
    RoughScene::from_toml(&text, Path::new("")).unwrap()
}

fn row(rough: &Rough, closure: Closure) -> &asperity::rough::TableRow {
    rough.table.iter().find(|row| row.closure == closure).unwrap()
}

/// Pixels whose pressure is all at the limit: what a little more load is put on first must not count as
/// contact. One point of this curve once had the whole surface in contact, each idle pixel under next to
/// nothing.
#[test]
fn the_contact_grows_with_the_load_where_few_pixels_carry_it() {
    let milled = r#"closure = "half-space-plastic"
[surface.generate]
kind = "milled"
ra = "1 um"
mean_slope_deg = 4
size = ["0.3 mm", "0.3 mm"]
pixels = [64, 64]
seed = 1
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
hardness = "1280 MPa"
[load]
pressure = "100 MPa"
"#;
    let rough = press(&RoughScene::from_toml(milled, Path::new("")).unwrap(), &mut |_| true).unwrap();
    let areas: Vec<f64> = rough.load_curve.iter().map(|point| point.contact_area_ratio).collect();
    assert!(areas.len() >= 8 && areas.is_sorted() && areas[areas.len() - 1] < 0.1, "{areas:?}");
}

/// Heights a thousand times too large or too small make a slope that no machined surface has.
#[test]
fn a_map_in_the_wrong_unit_is_doubted() {
    let folder = tempfile::tempdir().unwrap();
    let rows: Vec<String> = (0..24)
        .map(|j| {
            let heights = (0..24).map(|i| format!("{:.4}", 0.3 * f64::from(i * j % 7)));
            heights.collect::<Vec<_>>().join(",")
        })
        .collect();
    std::fs::write(folder.path().join("map.csv"), rows.join("\n")).unwrap();
    let doubted = |unit: &str| {
        let text = format!(
            r#"closure = "published"
surface = {{ file = "map.csv", pixel_size = ["10 um", "10 um"], height_unit = "{unit}" }}
material = {{ youngs_modulus = "210 GPa", poissons_ratio = 0.3, hardness = "2 GPa" }}
load = {{ pressure = "0.5 MPa" }}"#
        );
        let rough = press(&RoughScene::from_toml(&text, folder.path()).unwrap(), &mut |_| true).unwrap();
        rough.summary.warnings.iter().any(|warning| warning.contains("height_unit"))
    };
    assert!(!doubted("um") && doubted("mm") && doubted("nm"));
}

#[test]
fn every_closure_is_judged_by_the_half_space_of_its_metal() {
    let rough = pressed("closure = \"all\"", "[load]\npressure = \"150 MPa\"\nunload = true").unwrap();
    let soft = row(&rough, Closure::HalfSpacePlastic);
    let hard = row(&rough, Closure::HalfSpace);
    assert!(hard.load_error.unwrap() < 1e-6 && soft.residual.unwrap() <= 1e-6);
    assert!(soft.contact_area_ratio > hard.contact_area_ratio);
    assert!((soft.max_pressure_over_nominal.unwrap() - 2000.0 / 150.0).abs() < 1e-3);
    for (closure, reference) in
        [(Closure::Published, soft), (Closure::Johnson, soft), (Closure::Sneddon, hard)]
    {
        let one = row(&rough, closure);
        // one area for column and verdict: that without what the rims of pixels add
        let ratio = one.contact_area_ratio / reference.contact_area_ratio_corrected.unwrap();
        assert_eq!(one.judged_by, Some(reference.closure));
        assert!((one.area_over_half_space.unwrap() / ratio - 1.0).abs() < 1e-9, "{closure:?}");
        assert!((one.pressure_over_half_space.unwrap() * ratio - 1.0).abs() < 1e-5);
    }
    // elastic: everything returns; plastic: work is lost and summits stay lower
    assert_eq!((hard.elastic_energy_share, hard.residual_displacement_um), (Some(1.0), Some(0.0)));
    assert!(soft.elastic_energy_share.unwrap() < 0.99 && soft.residual_displacement_um.unwrap() > 0.0);
    let points = |closure| rough.load_curve.iter().filter(|p| p.closure == closure).count();
    assert_eq!((points(Closure::HalfSpace), points(Closure::HalfSpacePlastic)), (18, 18));
    let verdict = rough.summary.verdict.as_ref().unwrap();
    assert!(verdict.contains("true contact on") && verdict.contains("mean gap"), "{verdict}");
    // the closure that the verdict names has there the area of its column
    let off = |row: &&asperity::rough::TableRow| (row.area_over_half_space.unwrap_or(9.0)).ln().abs();
    let islands = rough
        .table
        .iter()
        .filter(|row| row.judged_by == Some(Closure::HalfSpacePlastic) && row.residual.is_none());
    let nearest = islands.min_by(|a, b| off(a).total_cmp(&off(b))).unwrap();
    let said = format!(
        "{:+.0} % off that of half-space-plastic",
        100.0 * (nearest.area_over_half_space.unwrap() - 1.0)
    );
    assert!(verdict.contains(&said) && verdict.contains(nearest.closure.name()), "{verdict} {said}");
    // beside other closures the leak is not computed, and the verdict says how to have it
    assert!(soft.leak_x_m3.is_none() && verdict.contains("half_space.leak=true"), "{verdict}");
    let shown = format!("{:.3}", 100.0 * soft.contact_area_ratio_corrected.unwrap());
    assert!(rough.text().contains(&shown), "{}", rough.text());
}

#[test]
fn a_closure_that_cannot_carry_the_load_fails_alone() {
    let rough = pressed("closure = \"all\"", "[load]\npressure = \"2.5 GPa\"").unwrap();
    let failed = row(&rough, Closure::HalfSpacePlastic);
    assert!(failed.status.contains("out of reach") && failed.contact_area_ratio.is_nan());
    assert_eq!(row(&rough, Closure::HalfSpace).status, "ok");
    // its row reads back from the summary
    let summary: asperity::rough::Summary = serde_json::from_str(&rough.json().unwrap()).unwrap();
    assert_eq!(summary.closures.len(), rough.table.len());
    // alone it is an error that says why
    let alone = pressed("closure = \"half-space-plastic\"", "[load]\npressure = \"2.5 GPa\"")
        .unwrap_err()
        .to_string();
    assert!(alone.contains("load.pressure") && alone.contains("2000 MPa"), "{alone}");
}

/// Each flow that a joint prints has its error beside it, in percent of the row's own.
#[test]
fn the_flows_of_a_joint_stand_beside_their_errors() {
    let fluid = "[load]\npressure = \"100 MPa\"\n[fluid]\nviscosity = \"1 mPa s\"\npressures = [\"2 MPa\", \"1 MPa\"]";
    let joint =
        joint(&[scene("hardness = \"2 GPa\"", "closure = \"half-space\"", fluid)], &mut |_| true).unwrap();
    let text = joint.text();
    let head = text.lines().find(|line| line.starts_with("phase")).unwrap();
    assert!(
        head.trim_end().ends_with("flow x, ml/min  flow y, ml/min   error of x, %   error of y, %"),
        "{head}"
    );
    let row = joint.rows.iter().rfind(|row| row.leak_x_error.is_some()).unwrap();
    let ends = text.lines().filter_map(|line| line.split_whitespace().rev().nth(1)?.parse::<f64>().ok());
    let error = 100.0 * row.leak_x_error.unwrap();
    assert!(ends.into_iter().any(|shown| (shown / error - 1.0).abs() < 1e-3), "{error} in {text}");
}

#[test]
fn a_fluid_leaks_by_the_gap_and_more_load_leaks_less() {
    let fluid = "[fluid]\nviscosity = \"1 mPa s\"\npressures = [\"2 MPa\", \"1 MPa\"]";
    let leak = |load: &str| {
        let rest = format!("[load]\npressure = \"{load}\"\n{fluid}");
        let rough = pressed("closure = \"half-space\"", &rest).unwrap();
        let row = row(&rough, Closure::HalfSpace).clone();
        let flux = row.leak_x_m3.unwrap() * 1e6 / 1e-3;
        assert!(rough.summary.verdict.unwrap().contains(&format!("{flux:.2e} m³/s")));
        assert!(row.leak_x_error.unwrap() > 0.0 && row.leak_x_error.unwrap() < 1.0, "{:?}", row.leak_x_error);
        assert!(row.hydraulic_gap_x_um.unwrap() < row.mean_gap_um.unwrap() && row.percolates_x == Some(true));
        (row.leak_x_m3.unwrap(), row.stiffness_MPa_per_um.unwrap())
    };
    let (light, heavy) = (leak("20 MPa"), leak("100 MPa"));
    assert!(heavy.0 < light.0 && heavy.1 > light.1, "{light:?} {heavy:?}");
    // nothing else needs the stiffness
    let lean = "[load]\npressure = \"20 MPa\"\n[half_space]\nleak = false\nstiffness = false";
    let lean = pressed("closure = \"half-space\"", lean).unwrap();
    let row_without = row(&lean, Closure::HalfSpace);
    assert_eq!(row_without.stiffness_MPa_per_um, None);
    // a scene that forbids the leak is not told to ask for it
    let rest = format!("[load]\npressure = \"20 MPa\"\n[half_space]\nleak = false\n{fluid}");
    let dry = pressed("closure = \"half-space\"", &rest).unwrap();
    let area = |rough: &Rough| row(rough, Closure::HalfSpace).contact_area_ratio_corrected;
    assert!(area(&dry) == area(&lean) && row(&dry, Closure::HalfSpace).stiffness_MPa_per_um.is_some());
    let verdict = dry.summary.verdict.unwrap();
    assert!(verdict.contains("half_space.leak = false") && !verdict.contains("leak=true"), "{verdict}");
    let unused = |text: &String| text.contains("[fluid] is not used: half_space.leak = false");
    assert!(dry.summary.warnings.iter().any(unused), "{:?}", dry.summary.warnings);
    for (wrong, place) in [
        ("[fluid]\nviscosity = \"1 mPa\"\npressures = [\"2 MPa\", \"1 MPa\"]", "viscosity"),
        ("[half_space]\ntolerance = 0.5", "half_space.tolerance"),
        ("[half_space]\nload_points = 9", "half_space.load_points"),
    ] {
        let rest = format!("[load]\npressure = \"20 MPa\"\n{wrong}");
        let text = format!(
            "closure = \"half-space\"\n[surface]\nfile = \"z.npy\"\n[material]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n{rest}"
        );
        let message = RoughScene::from_toml(&text, Path::new(""))
            .and_then(|scene| scene.validate().map(|()| scene))
            .err()
            .unwrap()
            .to_string();
        assert!(message.contains(place), "{message}");
    }
}

/// Metal of known hardening carries under its patches what the atlas of cones has at their slope: near 3 σ_y
/// without hardening, more with it; the summary says which limit it was. A hardness is taken as it is.
#[test]
fn the_limit_of_pressure_knows_the_hardening() {
    let one = |metal: &str| {
        let strength = format!("yield_stress = \"300 MPa\"\n{metal}");
        let load = "[load]\npressure = \"50 MPa\"";
        let rough = pressed_metal(&strength, "closure = \"half-space-plastic\"", load).unwrap();
        let limit = rough.summary.closures[0].limit_MPa.unwrap();
        let from = rough.summary.closures[0].limit_from.clone().unwrap();
        let area = rough.table[0].contact_area_ratio;
        (limit, from, area, rough.summary.verdict.unwrap())
    };
    let (unknown, from, ..) = one("");
    assert_eq!((unknown, from.as_str()), (900.0, "3 yield_stress"));
    let (perfect, from, wide, verdict) = one("hardening_exponent = 0.0");
    // 3 under gentle cones, a tenth less toward 10°
    assert!((0.88..1.02).contains(&(perfect / 900.0)) && from == "atlas of cones", "{perfect}");
    assert!(verdict.contains("plateau of the atlas of cones"), "{verdict}");
    let (hardening, _, narrow, _) = one("hardening_exponent = 0.3");
    assert!(hardening > 1.5 * perfect && narrow < 0.8 * wide, "{hardening} {narrow} {wide}");
    let (hardness, from, _, verdict) = one("hardness = \"1100 MPa\"\nhardening_exponent = 0.3");
    assert!(verdict.contains("two metals"), "{verdict}");
    assert_eq!((hardness, from.as_str()), (1100.0, "hardness"));
}

/// A map of waves with one spike, pressed with `keys` of the surface and `top` keys.
fn spiked(top: &str, keys: &str) -> Rough {
    const NODES: usize = 64;
    let wave = |i: usize| (i as f64 * 0.4).sin();
    let mut heights: Vec<f64> =
        (0..NODES * NODES).map(|i| 0.2e-6 * wave(i % NODES) * wave(i / NODES)).collect();
    heights[20 * NODES + 30] = 5e-6;
    let text = format!(
        "closure = \"published\"\n{top}\n[surface]\nlevel = \"none\"\n{keys}\n[material]\nyoungs_modulus = \"210 GPa\"\n\
         poissons_ratio = 0.3\nhardness = \"2 GPa\"\n[load]\npressure = \"100 MPa\"\n"
    );
    let scene = RoughScene::from_toml(&text, Path::new("")).unwrap();
    press(&scene.with_heights(NODES, [1e-6; 2], heights), &mut |_| true).unwrap()
}

#[test]
fn a_spike_counts_as_missing_where_outliers_are_limited() {
    assert_eq!(spiked("", "").summary.outliers, 0);
    let without = spiked("", "outliers = 8");
    assert_eq!((without.summary.outliers, without.summary.missing), (1, 0));
    assert!(without.summary.sz_um < 1.0, "{}", without.summary.sz_um);
}

/// The pressure of an island is even, an ellipsoid (3/2 of the mean at most) or that of a cone, which peaks
/// higher.
#[test]
fn the_peak_goes_by_the_pressure_profile() {
    let peak = |profile: &str| {
        let rough = spiked(&format!("pressure_profile = \"{profile}\""), "outliers = 8");
        row(&rough, Closure::Published).max_pressure_over_nominal.unwrap()
    };
    let [even, ellipsoid, cone] = ["uniform", "hertz", "cone"].map(peak);
    assert!(even < ellipsoid && ellipsoid < cone, "{even} {ellipsoid} {cone}");
}

/// A wavy map of which the points for which `lost` holds were not measured, pressed by `closure`.
fn with_holes(closure: &str, keys: &str, lost: impl Fn(usize, usize) -> bool) -> Rough {
    const NODES: usize = 48;
    let height = |i: usize| {
        let [x, y] = [i % NODES, i / NODES].map(|i| i as f64);
        let wave = 0.3e-6 * ((0.5 * x).sin() * (0.4 * y).cos() + 0.3 * (0.9 * x + 1.1 * y).sin());
        if lost(i % NODES, i / NODES) { f64::NAN } else { wave }
    };
    let text = format!(
        "closure = \"{closure}\"\n[surface]\n{keys}\n[material]\nyoungs_modulus = \"210 GPa\"\npoissons_ratio = 0.3\n\
         hardness = \"2 GPa\"\n[load]\npressure = \"20 MPa\"\n"
    );
    let scene = RoughScene::from_toml(&text, Path::new("")).unwrap();
    let heights = (0..NODES * NODES).map(height).collect();
    press(&scene.with_heights(NODES, [1e-6; 2], heights), &mut |_| true).unwrap()
}

/// With three points in ten missing a cell with four corners is rarer than a point: each row says over which
/// area its pressure is nominal, and the warning says what stands on what.
#[test]
fn the_load_is_the_pressure_times_the_nominal_area_of_the_row() {
    let rough = with_holes("all", "", |x, y| (7 * x + 5 * y + x * y) % 10 < 3);
    let (space, islands) = (row(&rough, Closure::HalfSpacePlastic), row(&rough, Closure::Johnson));
    let pixels = 48.0 * 48.0 - rough.summary.missing as f64;
    assert!((space.nominal_area_um2.unwrap() / pixels - 1.0).abs() < 1e-12);
    assert!(islands.nominal_area_um2.unwrap() < 0.6 * pixels);
    for one in &rough.contacts {
        let closure = one.closure;
        let force = match &one.body {
            // a pixel is 1 µm²; pressures are kept with seven digits
            asperity::rough::Body::HalfSpace(space) => {
                space.contact.pressures.iter().map(|p| f64::from(*p)).sum::<f64>() * 1e-12
            }
            asperity::rough::Body::Islands(islands) => {
                let carried = |p: &asperity_roughness::LoadedPixel| f64::from(p.pressure) * 1e-12;
                islands.field.pixels.iter().map(carried).sum()
            }
            asperity::rough::Body::Failed(_) => continue,
        };
        let told = 20e6 * row(&rough, closure).nominal_area_um2.unwrap() * 1e-12;
        assert!((force / told - 1.0).abs() < 1e-4, "{closure:?} {force} {told}");
    }
    let warned = rough.summary.warnings.iter().find(|w| w.contains("have no height")).unwrap();
    assert!(warned.contains("nominal_area_um2") && warned.contains("leak"), "{warned}");
}

/// A scratch of points without a height closes every path: whether one is open is not known, and no number
/// says that the joint is tight.
#[test]
fn missing_points_do_not_make_a_joint_tight() {
    let scratch = |x: usize, _| x == 20;
    let rough = with_holes("half-space", "", scratch);
    let one = row(&rough, Closure::HalfSpace);
    let verdict = rough.summary.verdict.clone().unwrap();
    assert!(verdict.contains("along x is not known") && !verdict.contains("tight"), "{verdict}");
    assert_eq!((one.percolates_x, one.leak_x_m3, one.percolates_y), (None, None, Some(true)));
    for rough in
        [with_holes("half-space", "missing = \"fill\"", scratch), with_holes("half-space", "", |_, _| false)]
    {
        let one = row(&rough, Closure::HalfSpace);
        assert!(one.percolates_x == Some(true) && one.leak_x_m3.unwrap() > 0.0);
    }
    let filled = with_holes("half-space", "missing = \"fill\"", scratch).summary.warnings;
    assert!(filled.iter().any(|w| w.contains("were filled")), "{filled:?}");
    assert!(
        with_holes("half-space", "", |_, _| false).summary.warnings.iter().all(|w| !w.contains("no height"))
    );
}

/// One surface and one metal: a hardness that contradicts yield stress and hardening is remarked, and the
/// errors of both answers reach each other. No closure is believed on the ground of two metals.
#[test]
fn answers_with_and_without_a_hardness_agree_within_their_errors() {
    let one = |metal: &str| {
        let strength = format!("yield_stress = \"300 MPa\"\nhardening_exponent = 0.2\n{metal}");
        pressed_metal(&strength, "closure = \"all\"", "[load]\npressure = \"50 MPa\"").unwrap()
    };
    let (bare, hard) = (one(""), one("hardness = \"1000 MPa\""));
    let area = |rough: &Rough| {
        let row = row(rough, Closure::HalfSpacePlastic).clone();
        (
            row.contact_area_ratio_corrected.unwrap(),
            row.area_error.unwrap(),
            row.mean_pressure_error_MPa.unwrap(),
        )
    };
    let ((a, a_error, a_pressure), (b, b_error, _)) = (area(&bare), area(&hard));
    assert!((a - b).abs() > 0.1 * a && (a - b).abs() <= a_error + b_error, "{a} ± {a_error} {b} ± {b_error}");
    assert!((a_pressure / (50.0 / a) / (a_error / a) - 1.0).abs() < 1e-6);
    let contradiction = |rough: &Rough| rough.summary.warnings.iter().any(|w| w.contains("contradicts"));
    assert!(contradiction(&hard) && !contradiction(&bare));
    let verdict = hard.summary.verdict.clone().unwrap();
    assert!(verdict.contains("cannot be judged") && verdict.contains("not both"), "{verdict}");
    let stated = one("hardness = \"1000 MPa\"\nhardness_error = \"20 MPa\"");
    assert!(area(&stated).1 < b_error);
}

/// A contact that is at the limit nearly everywhere has the area load over limit, on any surface.
#[test]
fn a_saturated_contact_says_so() {
    let verdict = |hardness: &str| {
        let metal = format!("hardness = \"{hardness}\"");
        pressed_metal(&metal, "closure = \"half-space-plastic\"", "[load]\npressure = \"20 MPa\"")
            .unwrap()
            .summary
            .verdict
    };
    assert!(verdict("300 MPa").unwrap().contains("saturated"));
    assert!(!verdict("50 GPa").unwrap().contains("saturated"));
}

#[test]
fn slips_of_metal_and_filter_are_told() {
    let told = |strength: &str, top: &str, filter: &str| {
        let load = "[load]\npressure = \"20 MPa\"\n[half_space]\nload_points = 1\n[output]\nmaps = false\n";
        let scene = scene(strength, &format!("judge = false\n{top}"), load);
        let scene = if filter.is_empty() { scene } else { scene.with(&[filter.to_string()]).unwrap() };
        press(&scene, &mut |_| true).unwrap().summary.warnings.join("\n")
    };
    let [elastic, limited] = ["half-space", "half-space-plastic"].map(|name| format!("closure = \"{name}\""));
    // an elastic contact of this slope has GPa where it touches
    for strength in ["yield_stress = \"300 MPa\"", "hardness = \"1 GPa\""] {
        assert!(told(strength, &elastic, "").contains("there it yields"), "{strength}");
        assert!(!told(strength, &limited, "").contains("there it yields"), "{strength}");
    }
    assert!(!told("", &elastic, "").contains("there it yields"));
    assert!(told("hardness = \"150 GPa\"", &limited, "").contains("look at its unit"));
    assert!(!told("hardness = \"12 GPa\"", &limited, "").contains("look at its unit"));
    for (filter, is_short) in [("surface.l_filter=2.5 um", true), ("surface.l_filter=40 um", false)] {
        assert_eq!(told("", &elastic, filter).contains("from point to point"), is_short, "{filter}");
    }
}
