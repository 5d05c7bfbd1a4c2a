//! `asperity scales` writes the columns and keys that its users rely on, and refuses what has no scales.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::Place;
use std::collections::BTreeMap;

/// Small enough to be pressed in a moment.
const SCENE: &str = r#"closure = "half-space-plastic"
[surface.generate]
kind = "self-affine"
hurst = 0.8
rolloff = "16 um"
cutoff = "2 um"
ra = "0.2 um"
size = ["64 um", "64 um"]
pixels = [64, 64]
seed = 2
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
yield_stress = "300 MPa"
[load]
pressure = "100 MPa"
[output]
maps = false
"#;

const COLUMNS: &str = "cutoff_um,rms_slope,mean_slope_deg,closure,contact_area_ratio,mean_pressure_MPa,pressure_p99_MPa,\
                       mean_gap_um,leak_x_m3,leak_y_m3,stiffness_MPa_per_um,elastic_share,elastoplastic_share,\
                       plastic_share";

#[test]
fn every_scale_has_its_rows_and_every_quantity_its_verdict() {
    let place = Place::with_scene(SCENE);
    let end = place.run(&["scales", "scene.toml", "--out", "out", "--report"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert!(place.text("out/scales.csv").starts_with(COLUMNS));
    let names = place.names("out");
    for name in ["area.svg", "report.html", "slopes.csv", "spectrum.csv", "summary.json"] {
        assert!(names.iter().any(|have| have == name), "{names:?}");
    }
    let mut read = csv::Reader::from_path(place.path("out/scales.csv")).unwrap();
    let rows: Vec<BTreeMap<String, String>> = read.deserialize().map(Result::unwrap).collect();
    let number = |row: &BTreeMap<String, String>, name: &str| row[name].parse::<f64>().unwrap();
    for closure in ["half-space", "half-space-plastic", "johnson", "persson", "persson-plastic", "bearing"] {
        let of: Vec<_> = rows.iter().filter(|row| row["closure"] == closure).collect();
        assert!(of.len() >= 6, "{closure}: {}", of.len());
        for row in &of {
            let load = number(row, "contact_area_ratio") * number(row, "mean_pressure_MPa");
            assert!((load / 100.0 - 1.0).abs() < 1e-3, "{row:?}");
        }
        // finer waves leave less contact
        let area = |row: &BTreeMap<String, String>| number(row, "contact_area_ratio");
        assert!(area(of[of.len() - 1]) <= area(of[0]), "{closure}");
    }
    for row in rows.iter().filter(|row| row["closure"] == "half-space") {
        let shares = ["elastic_share", "elastoplastic_share", "plastic_share"].map(|name| number(row, name));
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
    }
    let summary: serde_json::Value = serde_json::from_str(&place.text("out/summary.json")).unwrap();
    let verdicts = summary["verdicts"].as_object().unwrap();
    for name in ["rms_slope", "contact_area_ratio", "contact_area_ratio_plastic", "mean_gap_um"] {
        let verdict = &verdicts[name];
        assert!(
            ["class", "from_um", "error", "exponent"].iter().all(|key| verdict.get(key).is_some()),
            "{verdict}"
        );
    }
    assert!(summary["hurst"]["low"].is_number() && summary["rolloff_um"]["low"].is_number());
    assert!(end.out.contains("Cut-off to use"), "{}", end.out);
}

#[test]
fn what_has_no_scales_is_refused_where_it_is_wrong() {
    let place = Place::with_scene(SCENE);
    std::fs::write(place.path("small.toml"), SCENE.replace("[64, 64]", "[128, 64]")).unwrap();
    std::fs::write(place.path("line.csv"), "0,1,2,1,0,2\n").unwrap();
    for (args, words) in [
        (&["scene.toml", "--set", "load.pressure=0 MPa"][..], &["load", "nothing touches"][..]),
        (&["scene.toml", "--set", "scales.tip_radius=0 um"], &["scales.tip_radius", "above 0"]),
        (&["scene.toml", "small.toml"], &["64 x 64", "128 x 64"]),
        (
            &["line.csv", "--set", "surface.pixel_size=\"1 um\"", "--set", "surface.height_unit=um"],
            &["2 x 2"],
        ),
    ] {
        let end = place.run(&[&["scales", "--out", "out"], args].concat());
        assert_eq!(end.status, 2, "{args:?}: {}", end.err);
        assert!(words.iter().all(|word| end.err.contains(word)), "{args:?}: {}", end.err);
        assert!(place.names("out").is_empty());
    }
}
