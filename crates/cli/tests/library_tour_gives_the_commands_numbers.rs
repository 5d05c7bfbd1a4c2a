//! The example `library_tour`, which calls the library alone, prints the numbers that the commands write for
//! the same inputs.
//!
//! Equality to the last digit: the commands call the same functions. The inputs below are those of the
//! example.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};

const SWEEP: &str = "slopes_deg = [8]\nyoungs_modulus = [\"210 GPa\"]\nyield_stress = [\"200 MPa\", \"400 MPa\", \"800 MPa\"]\n\
    hardening_exponent = [0.1, 0.4]\naccuracy = \"draft\"\n";

/// Column `name` of the table `text`.
fn column(text: &str, name: &str) -> Vec<String> {
    let mut table = csv::Reader::from_reader(text.as_bytes());
    let place = table.headers().unwrap().iter().position(|head| head == name).unwrap();
    table.records().map(|row| row.unwrap()[place].to_string()).collect()
}

fn json(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap()
}

#[test]
fn the_example_prints_what_the_commands_write() {
    let example = include_str!("../../asperity/examples/library_tour.rs");
    let surface = example.split("r#\"").nth(1).and_then(|rest| rest.split("\"#").next()).unwrap();
    assert!(example.lines().filter(|line| !line.trim().is_empty()).count() < 60, "a tour is short");
    // the scene of the other tests without its coarse numerics is that of the example
    let place = Place::with_scene(SCENE.split("[numerics]").next().unwrap());
    std::fs::write(place.path("sweep.toml"), SWEEP).unwrap();
    std::fs::write(place.path("surface.toml"), surface).unwrap();
    for (command, input) in [("crush", "scene.toml"), ("calibrate", "sweep.toml"), ("rough", "surface.toml")]
    {
        assert_eq!(place.run(&[command, input, "--out", command, "--quiet"]).status, 0, "{command}");
    }
    let mut expected =
        vec![format!("peak force {} N", json(&place.text("crush/summary.json"))["peak_force_N"])];
    let parsed = |text: String| text.parse::<f64>().unwrap();
    for k in column(&place.text("calibrate/cases.csv"), "K_over_E") {
        expected.push(format!("K/E {}", parsed(k)));
    }
    let fit = json(&place.text("calibrate/fit.json"));
    expected.push(format!("scatter {}", fit["per_angle"][0]["scatter"]));
    assert!(fit["coefficient"].is_null());
    expected.push(format!("c None: {}", fit["reason"].as_str().unwrap()));
    let table = place.text("rough/table.csv");
    let closures = column(&table, "closure");
    for (closure, ratio) in closures.into_iter().zip(column(&table, "contact_area_ratio")) {
        expected.push(format!("{closure} {}", parsed(ratio)));
    }
    let printed = common::printed_by_the_example("library_tour");
    assert_eq!(printed.lines().collect::<Vec<_>>(), expected);
}
