//! Claim: `rough --judge crush` crushes summits of the surface, and the two closures that know the metal
//! carry what finite elements carry: "calibrated" and "half-space-plastic", each from its own model.
//!
//! Source: finite elements at `draft` of the extracted profiles. Tolerance: 10 % of the force and 15 % of the
//! area, twice what the models differ by on this surface (2 to 4 %, 3 to 11 %) and what `draft` promises;
//! closures that do not know where metal yields are 40 % and more off, which the test sees too.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;
use std::collections::HashMap;

const SCENE: &str = r#"closure = "half-space-plastic"
[surface.generate]
kind = "ground"
ra = "0.3 um"
mean_slope_deg = 3
size = ["400 um", "400 um"]
pixels = [256, 256]
seed = 8
[material]
youngs_modulus = "210 GPa"
poissons_ratio = 0.3
yield_stress = "600 MPa"
hardening_exponent = 0.1
[load]
pressure = "100 MPa"
"#;

/// Force and area over those of finite elements, at the largest depth of each summit, of `closure`.
fn over_finite_elements(table: &str, closure: &str) -> Vec<[f64; 2]> {
    let mut deepest: HashMap<String, [f64; 2]> = HashMap::new();
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    for row in reader.deserialize::<HashMap<String, String>>() {
        let row = row.unwrap();
        if row["closure"] == closure && row["status"] == "ok" {
            let ratio = |what: &str| row[what].parse::<f64>().unwrap();
            let ratios = [ratio("force_over_finite_elements"), ratio("area_over_finite_elements")];
            deepest.insert(row["asperity"].clone(), ratios);
        }
    }
    deepest.into_values().collect()
}

#[test]
fn closures_of_the_metal_carry_what_finite_elements_carry() {
    let place = Place::with_scene(SCENE);
    let done = place.run(&["rough", "scene.toml", "--judge", "crush", "--out", "out"]);
    assert_eq!(done.status, 0, "{}", done.err);
    assert!(done.out.contains("finite elements of") && done.out.contains("believe"), "{}", done.out);
    let table = place.text("out/judge/compared.csv");
    for closure in ["calibrated", "half-space-plastic"] {
        let found = over_finite_elements(&table, closure);
        assert!(found.len() >= 2, "{closure}: {found:?}");
        for [force, area] in found {
            assert!((force - 1.0).abs() < 0.1, "{closure}: force {force}");
            assert!((area - 1.0).abs() < 0.15, "{closure}: area {area}");
        }
    }
    let elastic = over_finite_elements(&table, "half-space");
    assert!(elastic.iter().all(|[force, _]| *force > 1.3), "{elastic:?}");
}
