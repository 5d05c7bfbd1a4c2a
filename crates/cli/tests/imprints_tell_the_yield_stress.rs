//! `asperity identify` with the imprint of a cone: what one curve leaves open it closes, what belongs to
//! another indent is rejected, and the metal goes on into a scene.
//!
//! Curve and imprint are the program's own, at a finer level than that of the fit: E 120 GPa, σ_y 400 MPa, n
//! 0.2 (`swift`). A sharp cone's curve has one number of loading and one shape of unloading for two unknowns
//! of flow (Jiao and Vlassak 2024).

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;
use std::fmt::Write;

const FIT: &str = r#"accuracy = "draft"
samples = 0
[material]
youngs_modulus = ["100 GPa", "140 GPa"]
poissons_ratio = 0.3
yield_stress = ["50 MPa", "2 GPa"]
hardening_exponent = [0.0, 0.5]
hardening_law = "swift"
[[curve]]
file = "curve.csv"
tool = { shape = "cone", half_apex_deg = 70.3 }
noise = "0.5 %"
"#;

const CONE: &str = "shape = \"cone\", half_apex_deg = 70.3";
const BALL: &str = "shape = \"sphere\", radius = \"10 um\"";

/// Crushes the twin under the cone, and writes its curve and the profile that it leaves, every height (um) as
/// `read`.
fn twin(place: &Place, read: impl Fn(f64) -> f64) {
    twin_under(CONE, place, read);
}

/// The same under `tool`.
fn twin_under(tool: &str, place: &Place, read: impl Fn(f64) -> f64) {
    let scene = format!(
        "symmetry = \"axisymmetric\"\naccuracy = \"standard\"\ntool = {{ {tool} }}\n[material]\nyoungs_modulus = \"120 GPa\"\npoissons_ratio = 0.3\nyield_stress = \"400 MPa\"\nhardening_exponent = 0.2\nhardening_law = \"swift\"\n[loading]\ndepth = \"1 um\"\nunload = true\n[output]\nevery = 1000\nfields = [\"displacement\"]\n"
    );
    std::fs::write(place.path("scene.toml"), scene).unwrap();
    let end = place.run(&["crush", "scene.toml", "--out", "twin", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let rows = |name: &str, columns: [&str; 2]| {
        let text = place.text(&format!("twin/{name}"));
        let mut lines = text.lines();
        let head: Vec<String> = lines.next().unwrap().split(',').map(String::from).collect();
        let at = columns.map(|c| head.iter().position(|h| h == c).unwrap());
        lines
            .map(|line| {
                let cells: Vec<&str> = line.split(',').collect();
                at.map(|i| cells[i].parse::<f64>().unwrap())
            })
            .collect::<Vec<_>>()
    };
    let mut text = String::from("depth_um,force_N\n");
    for [h, f] in rows("curve.csv", ["depth_um", "force_N"]) {
        let _ = writeln!(text, "{h},{f}");
    }
    std::fs::write(place.path("curve.csv"), text).unwrap();
    let mut names = place.names("twin");
    names.retain(|name| name.starts_with("surface_") && name.ends_with(".csv"));
    names.sort();
    let mut text = String::from("Abstand (µm);Höhe (nm)\n");
    // three contact radii
    let far = if tool == BALL { 14.0 } else { 9.0 };
    for [r, z] in rows(names.last().unwrap(), ["r_um", "z_um"]).into_iter().filter(|[r, _]| *r < far) {
        let _ = writeln!(text, "{r};{}", 1e3 * read(z));
    }
    std::fs::write(place.path("profile.csv"), text).unwrap();
}

fn fit(place: &Place, more: &str, out: &str) -> serde_json::Value {
    fit_of(place, &format!("{FIT}{more}"), out)
}

fn fit_of(place: &Place, text: &str, out: &str) -> serde_json::Value {
    std::fs::write(place.path("fit.toml"), text).unwrap();
    let end = place.run(&["identify", "fit.toml", "--out", out, "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    serde_json::from_str(&place.text(&format!("{out}/fit.json"))).unwrap()
}

fn ends(found: &serde_json::Value, name: &str) -> [f64; 3] {
    ["value", "low", "high"].map(|key| found["parameters"][name][key].as_f64().unwrap())
}

#[test]
fn an_imprint_tells_the_yield_stress_that_its_curve_leaves_open() {
    let place = Place::with_scene("");
    twin(&place, |z| z);
    let alone = fit(&place, "", "alone");
    let both = fit(&place, "imprint = { file = \"profile.csv\", noise = \"10 nm\" }\n", "both");
    for found in [&alone, &both] {
        assert_eq!(found["residual"]["fits"], true, "{}", found["residual"]);
        let [_, low, high] = ends(found, "yield_stress");
        assert!(low <= 400.0 && 400.0 <= high, "{low} to {high}");
    }
    assert_eq!(alone["parameters"]["yield_stress"]["identifiable"], false);
    let ([_, low, high], [value, less, more]) = (ends(&alone, "yield_stress"), ends(&both, "yield_stress"));
    assert!(
        (value / 400.0 - 1.0).abs() < 0.1 && more - less < 0.3 * (high - low),
        "{value}: {less} to {more}"
    );
    // the imprint decides it, the curve decides E
    let decided = both["decided"].as_array().unwrap();
    let widening = |k: usize, name: &str| decided[k]["widening"][name].as_f64().unwrap();
    assert!(widening(1, "yield_stress") > 2.0 && widening(0, "youngs_modulus") > 2.0, "{decided:?}");
    assert!(place.names("both").contains(&"imprint.svg".to_string()));
    // 1/E* of the twin is the metal's alone: 1/131.9 GPa; were 1/1146.6 GPa of it diamond's, E were larger
    let note = both["notes"].to_string();
    assert!(note.contains("rigid") && note.contains("13 % larger"), "{note}");
    // the metal goes on into a scene
    let end = place.run(&["crush", "scene.toml", "--metal", "both/fit.json", "--out", "next", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let peaks = ["twin", "next"].map(|folder| {
        let text = place.text(&format!("{folder}/summary.json"));
        serde_json::from_str::<serde_json::Value>(&text).unwrap()["peak_force_N"].as_f64().unwrap()
    });
    assert!((peaks[1] / peaks[0] - 1.0).abs() < 0.02, "{peaks:?}");
}

/// Height (nm) over the place (um) of the profile, straight between its points.
fn profile(place: &Place) -> impl Fn(f64) -> f64 {
    let text = place.text("profile.csv");
    let point = |line: &str| {
        let (r, z) = line.split_once(';').unwrap();
        [r.parse().unwrap(), z.parse().unwrap()]
    };
    let points: Vec<[f64; 2]> = text.lines().skip(1).map(point).collect();
    move |r| {
        let k = points.partition_point(|p| p[0] < r).clamp(1, points.len() - 1);
        let ([a, low], [b, high]) = (points[k - 1], points[k]);
        low + (r.min(b) - a) / (b - a) * (high - low)
    }
}

/// A ball's imprint of a depth 10 % less than that of the curve is of another indent, and so is one whose
/// pile-up is 0.05 of the depth higher (of 0.1; n less by 0.05): another metal explains each halfway, so that
/// the sum of squares alone is hardly too large, but none explains both. Under one sharp cone a metal of
/// other flow explains curve and pile-up. The far field tells as little noise as there is, though the pile-up
/// ends in it.
#[test]
fn an_imprint_of_another_depth_or_pile_up_is_rejected() {
    let pile_up = |z: f64| if z > 0.0 { 1.5 * z } else { z };
    let reads: [&dyn Fn(f64) -> f64; 3] = [&|z| z, &|z| 0.9 * z, &pile_up];
    for (k, read) in reads.into_iter().enumerate() {
        let place = Place::with_scene("");
        twin_under(BALL, &place, read);
        // points that are dense enough to tell their noise
        let height = profile(&place);
        let rows = (0..140).map(|i| 0.1 * f64::from(i)).map(|r| format!("{r:.1};{:.3}\n", height(r)));
        std::fs::write(place.path("profile.csv"), rows.fold("r (um);z (nm)\n".into(), |t: String, r| t + &r))
            .unwrap();
        for noise in [", noise = \"5 nm\"", ""] {
            let text = FIT.replace(CONE, BALL) + &format!("imprint = {{ file = \"profile.csv\"{noise} }}\n");
            let found = fit_of(&place, &text, "out");
            let accord = &found["residual"]["accords"][0];
            assert_eq!(found["residual"]["fits"], k == 0, "{k}: {}", found["residual"]);
            assert_eq!(accord["holds"], k == 0, "{accord}");
            let [growth, limit] = ["growth", "growth_limit"].map(|key| accord[key].as_f64().unwrap());
            assert_eq!(growth <= limit, k == 0, "{accord}");
        }
    }
}

/// A map as some instruments give it: rows of heights without units, counted down, tilted, off the centre. A
/// list of points x, y, z of the same map tells the same metal.
#[test]
fn a_map_of_other_habits_is_read_as_the_fit_says() {
    let place = Place::with_scene("");
    twin(&place, |z| z);
    let height = profile(&place);
    let (mut rows, mut points) = (String::new(), String::from("X [um]\tY [um]\tZ [nm]\n"));
    for i in 0..91 {
        for k in 0..91 {
            let [x, y] = [0.2 * f64::from(k), 0.2 * f64::from(i)];
            let z = height((x - 9.3).hypot(y - 8.6)) + 4.0 * x - 3.0 * y + 700.0;
            let _ = write!(rows, "{}{:.3}", if k == 0 { "" } else { "," }, -z);
            let _ = writeln!(points, "{x:.2}\t{y:.2}\t{z:.3}");
        }
        rows.push('\n');
    }
    std::fs::write(place.path("map.csv"), rows).unwrap();
    std::fs::write(place.path("points.xyz"), points).unwrap();
    let of = |imprint: &str, out: &str| {
        fit(&place, &format!("imprint = {{ {imprint}, noise = \"10 nm\" }}\n"), out)
    };
    let map = of("file = \"map.csv\", pixel_size = \"0.2 um\", height_unit = \"nm\", z_down = true", "map");
    let list = of("file = \"points.xyz\"", "list");
    for found in [&map, &list] {
        assert_eq!(found["residual"]["fits"], true, "{}", found["residual"]);
        let [_, low, high] = ends(found, "yield_stress");
        assert!(low <= 400.0 && 400.0 <= high, "{low} to {high}");
    }
    let said = |of: &str| {
        std::fs::write(place.path("fit.toml"), format!("{FIT}imprint = {{ file = \"map.csv\"{of} }}\n"))
            .unwrap();
        let end = place.run(&["identify", "fit.toml", "--out", "no", "--quiet"]);
        assert_eq!(end.status, 2, "{}", end.err);
        end.err.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    assert!(said("").contains("pixel_size"), "{}", said(""));
    let upside_down = said(", pixel_size = \"0.2 um\", height_unit = \"nm\"");
    assert!(upside_down.contains("z_down = true"), "{upside_down}");
}

#[test]
fn imprints_that_cannot_be_compared_are_refused_with_a_way_out() {
    let place = Place::with_scene("");
    twin(&place, |z| z);
    let refused = |text: &str, word: &str| {
        std::fs::write(place.path("fit.toml"), text).unwrap();
        let end = place.run(&["identify", "fit.toml", "--out", "out", "--quiet"]);
        assert_eq!(end.status, 2, "{text}\n{}", end.err);
        let said = end.err.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(word), "{word}: {said}");
    };
    let imprint = "imprint = \"profile.csv\"\n";
    refused(
        &format!("{FIT}{imprint}").replace("\"cone\", half_apex_deg = 70.3", "\"berkovich\""),
        "of a pyramid",
    );
    let features = FIT.replace("file = \"curve.csv\"", "features = { loading_curvature = \"30 GPa\" }");
    refused(&format!("{features}{imprint}"), "max_depth");
    std::fs::write(place.path("flat.csv"), "r_um,z_um\n".to_string() + &"1,0\n2,0.1\n".repeat(20)).unwrap();
    refused(&format!("{FIT}imprint = \"flat.csv\"\n"), "out to three radii");
    refused(&format!("{FIT}imprint = \"none.csv\"\n"), "cannot be read");
}
