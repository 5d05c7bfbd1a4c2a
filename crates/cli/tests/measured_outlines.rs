//! Claims: an asperity and a tool given as points of a file crush and press like the formula that the points
//! were taken from; the summary holds the points and gives the same bits without the file; what is no outline
//! is refused at its line.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use serde_json::Value;
use std::fmt::Write;

const ASPERITY: &str = "[[asperity]]\nheight = \"20 um\"\nslope_deg = 10\ntip_radius = \"10 um\"\n";
const TOOL: &str = "shape = \"plane\"\n";

/// Points of a file, um.
fn csv(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    let mut text = String::from("r_um,z_um\n");
    for [r, z] in points {
        let _ = writeln!(text, "{r},{z}");
    }
    text
}

/// Height of the asperity of [`SCENE`]: a cone of 10°, its tip a ball of 10 um.
fn height(r: f64) -> f64 {
    let (sine, cosine) = 10f64.to_radians().sin_cos();
    let flank = 20.0 - 10.0 * (1.0 - cosine) - (r - 10.0 * sine) * sine / cosine;
    if r <= 10.0 * sine { 10.0 + (100.0 - r * r).sqrt() } else { flank }
}

/// Places from the axis to 114 um, forty of them on the tip.
fn places() -> Vec<f64> {
    let tip = 10.0 * 10f64.to_radians().sin();
    let mut places: Vec<f64> = (0..40).map(|i| tip * f64::from(i) / 40.0).collect();
    places.extend((0..=200).map(|i| tip + (114.0 - tip) * f64::from(i) / 200.0));
    places
}

fn summary(place: &Place, folder: &str) -> Value {
    serde_json::from_str(&place.text(&format!("{folder}/summary.json"))).unwrap()
}

/// Crushes scene.toml into `out`.
fn crushed(scene: &str, file: &str) -> (Place, Value) {
    let place = Place::with_scene(scene);
    std::fs::write(place.path("p.csv"), file).unwrap();
    let end = place.run(&["crush", "scene.toml", "--out", "out", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let summary = summary(&place, "out");
    (place, summary)
}

/// 0.2 %, and 0.5 % of the area: six elements across the contact, whose columns may fall a little differently
/// under the tip.
fn same(a: &Value, b: &Value) {
    for (key, tolerance) in [
        ("peak_force_N", 2e-3),
        ("contact_area_um2", 5e-3),
        ("residual_depth_um", 2e-3),
        ("unloading_stiffness_N_per_um", 2e-3),
    ] {
        let [a, b] = [a, b].map(|s| s[key].as_f64().unwrap());
        assert!((a / b - 1.0).abs() < tolerance, "{key}: {a} {b}");
    }
}

#[test]
fn a_cone_of_points_crushes_like_the_cone() {
    let (_, formula) = crushed(SCENE, "");
    let scene = SCENE.replacen(ASPERITY, "[[asperity]]\nprofile = \"p.csv\"\n", 1);
    let (place, points) = crushed(&scene, &csv(places().into_iter().map(|r| [r, height(r)])));
    same(&points, &formula);
    let outline = &points["outlines"][0];
    assert_eq!((outline["table"].as_str(), outline["points"].as_u64()), (Some("asperity[0]"), Some(241)));
    assert!(outline["farthest_um"].as_f64().unwrap() < 1e-3, "{outline}");
    // without the file
    std::fs::remove_file(place.path("p.csv")).unwrap();
    let end = place.run(&["crush", "out/summary.json", "--out", "again", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert_eq!(place.text("out/curve.csv"), place.text("again/curve.csv"));
}

#[test]
fn scatter_of_a_thousandth_of_the_height_moves_the_peak_by_less_than_a_percent() {
    let (_, formula) = crushed(SCENE, "");
    let mut state = 5_u64;
    let mut error = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        0.02 * 3f64.sqrt() * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    };
    let scene = SCENE.replacen(ASPERITY, "[[asperity]]\nprofile = \"p.csv\"\n", 1);
    let (_, points) = crushed(&scene, &csv(places().into_iter().map(|r| [r, height(r) + error()])));
    let force = |s: &Value| s["peak_force_N"].as_f64().unwrap();
    assert!((force(&points) / force(&formula) - 1.0).abs() < 0.01);
    let tolerance = points["outlines"][0]["tolerance_um"].as_f64().unwrap();
    assert!((0.014..0.028).contains(&tolerance), "{tolerance}");
}

#[test]
fn a_cone_of_points_presses_like_the_cone() {
    let flat = SCENE.replacen(ASPERITY, "", 1).replace("5 um", "2 um");
    let (_, formula) = crushed(&flat.replacen(TOOL, "shape = \"cone\"\nslope_deg = 15\n", 1), "");
    let tan = 15f64.to_radians().tan();
    let tip = csv((0..=100).map(|i| 0.4 * f64::from(i)).map(|r| [r, r * tan]));
    let (_, points) = crushed(&flat.replacen(TOOL, "shape = \"profile\"\nfile = \"p.csv\"\n", 1), &tip);
    same(&points, &formula);
    assert_eq!(points["outlines"][0]["corners_um"], serde_json::json!([0.0]));
    let area = |s: &Value| s["oliver_pharr"]["contact_area_um2"].as_f64().unwrap();
    assert!((area(&points) / area(&formula) - 1.0).abs() < 1e-3);
}

/// Berkovich's and Vickers' pyramids have 24.5 h² in section: a cone of 70.3°.
#[test]
fn pyramids_press_as_the_cone_of_their_area_and_soft_ones_give_way() {
    let flat = SCENE.replacen(ASPERITY, "", 1).replace("5 um", "1 um");
    let with = |tool: &str| crushed(&flat.replacen(TOOL, tool, 1), "").1;
    let (berkovich, vickers) = (with("shape = \"berkovich\"\n"), with("shape = \"vickers\"\n"));
    for summary in [&berkovich, &vickers] {
        assert!((summary["equivalent_half_apex_deg"].as_f64().unwrap() - 70.3).abs() < 0.01);
    }
    same(&berkovich, &vickers);
    same(&with("shape = \"cone\"\nhalf_apex_deg = 70.296\n"), &berkovich);
    let soft = "shape = \"berkovich\"\nyoungs_modulus = \"1141 GPa\"\npoissons_ratio = 0.07\n";
    let (soft, frame) = (with(soft), with("shape = \"berkovich\"\nmachine_compliance = \"0.5 nm/mN\"\n"));
    let value = |s: &Value, key: &str| s[key].as_f64().unwrap();
    for summary in [&soft, &frame] {
        assert!((value(summary, "peak_depth_um") - 1.0).abs() < 1e-9);
        assert!(value(summary, "peak_force_N") < value(&berkovich, "peak_force_N"));
        assert!(
            value(summary, "unloading_stiffness_N_per_um")
                < value(&berkovich, "unloading_stiffness_N_per_um")
        );
    }
    // 1/E_r = (1 - 0.3²)/210 + (1 - 0.07²)/1141 in 1/GPa
    let reduced = soft["oliver_pharr"]["true_reduced_modulus_GPa"].as_f64().unwrap();
    assert!((reduced * (0.91 / 210.0 + 0.9951 / 1141.0) - 1.0).abs() < 1e-9, "{reduced}");
}

/// 24.5 h_c² + 2 h_c + 0.3 √h_c, h_c in um, in the place of the pyramid's own section; the run is the same.
#[test]
fn a_reading_goes_by_the_area_function() {
    let flat = SCENE.replacen(ASPERITY, "", 1).replace("5 um", "1 um");
    let with = |tool: &str| crushed(&flat.replacen(TOOL, tool, 1), "").1;
    let sharp = with("shape = \"berkovich\"\n");
    let worn = "shape = \"berkovich\"\narea_function = { unit = \"um\", coefficients = [24.5, 2.0, 0.3] }\n";
    let worn = with(worn);
    assert_eq!(worn["peak_force_N"], sharp["peak_force_N"]);
    let read = |s: &Value, key: &str| s["oliver_pharr"][key].as_f64().unwrap();
    let depth = read(&worn, "contact_depth_um");
    assert_eq!(depth, read(&sharp, "contact_depth_um"));
    let area = 24.5 * depth * depth + 2.0 * depth + 0.3 * depth.sqrt();
    assert!((read(&worn, "contact_area_um2") / area - 1.0).abs() < 1e-12);
    let force = worn["peak_force_N"].as_f64().unwrap();
    assert!((read(&worn, "hardness_MPa") / (1e6 * force / area) - 1.0).abs() < 1e-12);
    let modulus = read(&sharp, "reduced_modulus_GPa") * (read(&sharp, "contact_area_um2") / area).sqrt();
    assert!((read(&worn, "reduced_modulus_GPa") / modulus - 1.0).abs() < 1e-12);
    for (tool, said) in [
        ("shape = \"plane\"\narea_function = { unit = \"nm\", coefficients = [24.5] }\n", "plane"),
        (
            "shape = \"berkovich\"\narea_function = { unit = \"inch\", coefficients = [24.5] }\n",
            "must be one of",
        ),
        ("shape = \"berkovich\"\narea_function = { unit = \"nm\", coefficients = [] }\n", "from 1 to 9"),
        ("shape = \"berkovich\"\narea_function = { unit = \"nm\" }\n", "coefficients"),
    ] {
        let place = Place::with_scene(flat.replacen(TOOL, tool, 1));
        let end = place.run(&["crush", "scene.toml", "--out", "out"]);
        assert!(end.status == 2 && end.err.contains(said), "{}", end.err);
    }
}

#[test]
fn a_line_is_the_surface_with_its_asperities() {
    let wave = |x: f64| (0.2 * x).sin() + 0.3 * (0.08 * x + 1.0).sin();
    let line: String = (0..=800).map(|i| 0.25 * f64::from(i)).map(|x| format!("{x},{}\n", wave(x))).collect();
    let scene = SCENE
        .replace("axisymmetric", "plane-strain")
        .replacen(
            ASPERITY,
            "[[profile]]\nfile = \"p.csv\"\n[substrate]\nradius = \"1 mm\"\ndepth = \"1 mm\"\n",
            1,
        )
        .replace("5 um", "0.5 um");
    let (place, free) = crushed(&scene, &format!("x_um,z_um\n{line}"));
    let rows = place.text("out/asperities.csv");
    let count =
        1 + rows.lines().skip(1).filter_map(|l| l.split(',').nth(2)?.parse().ok()).fold(0, usize::max);
    assert_eq!(count, 7, "{}", free["outlines"]);
    let end = place.run(&["crush", "scene.toml", "--set", "lateral=symmetric", "--out", "cell", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
}

#[test]
fn what_is_no_outline_is_refused_at_its_line() {
    let ring: String =
        (0..60).map(|i| format!("{i},{}\n", 0.3 * f64::from(20 - (i - 20i32).abs()))).collect();
    let rows: [(&str, bool, &[&str]); 12] = [
        ("", false, &["scene.toml:10:", "p.csv: is empty"]),
        ("r,z\n0,20\n114,0\n", false, &["p.csv:1:", "has no unit", "r_um"]),
        ("r_um,z_um\n0,20\n", false, &["scene.toml:10:", "not 1"]),
        ("r_um,z_um\n0,20\n50,15\n40,16\n114,0\n", false, &["p.csv:4:", "at 40 um", "sort", "overhangs"]),
        ("r_um,z_um\n0,20\n50,15\n50,0\n", false, &["p.csv:4:", "upright"]),
        ("r_um,z_um\n0,20\n50,nan\n114,0\n", false, &["p.csv:3:", "\"nan\"", "was not measured"]),
        ("r_um,z_um\n0,20\n50,\n114,0\n", false, &["p.csv:3:", "was not measured"]),
        ("r_um,z_um\n60,20\n80,15\n114,0\n", false, &["p.csv:2:", "on the axis"]),
        ("r_um,z_um\n0,20\n10,20\n10.1,1\n20,0\n", false, &["degrees", "cut the outline off"]),
        (&format!("r_um,z_um\n{ring}"), false, &["p.csv:2:", "hole in the middle"]),
        ("r_um,z_um\n0,0\n10,4\n20,5\n30,6\n40,7\n50,8\n", true, &["p.csv:3:", "dent", "convex"]),
        ("r_um,z_um\n0,4\n10,1\n20,0\n30,1\n40,4\n50,9\n", true, &["p.csv:4:", "on the axis"]),
    ];
    for (file, tool, words) in rows {
        let scene = if tool {
            SCENE.replacen(ASPERITY, "", 1).replacen(TOOL, "shape = \"profile\"\nfile = \"p.csv\"\n", 1)
        } else {
            SCENE.replacen(ASPERITY, "[[asperity]]\nprofile = \"p.csv\"\n", 1)
        };
        let place = Place::with_scene(scene);
        std::fs::write(place.path("p.csv"), file).unwrap();
        let end = place.run(&["crush", "scene.toml", "--out", "out"]);
        assert_eq!(end.status, 2, "{file}\n{}", end.err);
        for word in words {
            assert!(end.err.contains(word), "{word} is not in\n{}\nof\n{file}", end.err);
        }
        assert!(!place.path("out").exists());
    }
}
