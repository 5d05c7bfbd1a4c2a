//! Claims: a scene that starts from a result has its body and presses it again; the result of that can be
//! started from too; what is no finished result, and a body given twice, is refused at its line.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use serde_json::Value;

const AGAIN: &str = r#"accuracy = "draft"
[initial]
from = "first"
[tool]
shape = "sphere"
radius = "20 um"
[loading]
depth = "0.5 um"
unload = true
[numerics]
steps = 8
elements_in_contact = 6
"#;

fn crushed() -> Place {
    let place = Place::with_scene(SCENE);
    std::fs::write(place.path("again.toml"), AGAIN).unwrap();
    let end = place.run(&["crush", "scene.toml", "--out", "first", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    place
}

fn summary(place: &Place, folder: &str) -> Value {
    serde_json::from_str(&place.text(&format!("{folder}/summary.json"))).unwrap()
}

#[test]
fn a_result_is_started_from_and_started_from_again() {
    let place = crushed();
    let run = |args: &[&str]| {
        let end = place.run(args);
        assert_eq!(end.status, 0, "{}", end.err);
    };
    run(&["crush", "again.toml", "--out", "second", "--quiet"]);
    run(&["crush", "again.toml", "--set", "initial.from=second", "--out", "third", "--quiet"]);
    // a result is not replaced by one that starts from it
    let end =
        place.run(&["crush", "again.toml", "--set", "initial.from=second", "--out", "second", "--force"]);
    assert_eq!(end.status, 2, "{}", end.err);
    assert!(end.err.contains("starts from") && end.err.contains("--out"), "{}", end.err);
    let [first, second, third] = ["first", "second", "third"].map(|folder| summary(&place, folder));
    for key in ["material", "asperity", "symmetry"] {
        assert_eq!(first["scene"][key], second["scene"][key], "{key}");
    }
    let loads = second["scene"]["initial"]["load"].as_array().unwrap();
    assert_eq!(loads.len(), 1);
    assert_eq!(loads[0]["loading"]["depth"], first["scene"]["loading"]["depth"]);
    assert_eq!(third["scene"]["initial"]["load"].as_array().unwrap().len(), 2);
    // the dent of the second load fits the ball of the third
    let force = |summary: &Value| summary["peak_force_N"].as_f64().unwrap();
    assert!(force(&third) > 1.5 * force(&second), "{} {}", force(&third), force(&second));

    // a summary gives the same bits without the folder that it came from
    std::fs::remove_dir_all(place.path("first")).unwrap();
    run(&["crush", "second/summary.json", "--out", "copy", "--quiet"]);
    assert_eq!(place.text("second/curve.csv"), place.text("copy/curve.csv"));
}

#[test]
fn what_cannot_be_started_from_is_refused_at_its_line() {
    let place = crushed();
    let refused = |scene: &str, words: &[&str]| {
        std::fs::write(place.path("bad.toml"), scene).unwrap();
        let end = place.run(&["crush", "bad.toml", "--out", "bad"]);
        assert_eq!(end.status, 2, "{scene}\n{}", end.err);
        for word in words {
            assert!(end.err.contains(word), "{word}\n{}", end.err);
        }
        assert!(!place.path("bad").exists());
    };
    refused(&AGAIN.replace("first", "nowhere"), &["bad.toml:3", "nowhere", "finished"]);
    let twice = format!("{AGAIN}[material]\nyoungs_modulus = \"1 GPa\"\npoissons_ratio = 0.3\n");
    refused(&twice, &["bad.toml:13", "material", "initial.from"]);
    refused(&format!("{SCENE}[initial]\n"), &["initial", "names no earlier load"]);
    let mut stopped = summary(&place, "first");
    stopped["stopped"] = Value::from("stopped loading at 1 um");
    std::fs::write(place.path("first/summary.json"), stopped.to_string()).unwrap();
    refused(AGAIN, &["bad.toml:3", "stopped loading"]);
}
