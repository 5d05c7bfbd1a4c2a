//! The folder that results go to, the files that they replace, and those that they never touch.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use std::fs;

/// Results of a run without fields; `gaps.csv` is there where the contact fell into parts.
const RESULTS: [&str; 5] = [".asperity-run", "curve.csv", "curve.svg", "gaps.csv", "summary.json"];

#[test]
fn a_run_replaces_an_earlier_one_and_leaves_the_files_of_others() {
    let place = Place::with_scene(SCENE.replace("every = 0", "every = 4"));
    assert_eq!(place.run(&["crush", "scene.toml"]).status, 0);
    assert!(place.names("out/scene").iter().any(|n| n.starts_with("fields_")));
    assert_eq!(place.names("out"), ["scene"]);
    // again, without fields: those of the first run go
    assert_eq!(place.run(&["crush", "scene.toml", "--set", "output.every=0"]).status, 0);
    let first = place.names("out/scene");
    assert!(first.len() >= 4 && first.iter().all(|n| RESULTS.contains(&n.as_str())), "{first:?}");

    fs::write(place.path("out/scene/thesis.tex"), "years").unwrap();
    let before = place.text("out/scene/summary.json");
    let end = place.run(&["crush", "scene.toml"]);
    assert_eq!(end.status, 2, "{}", end.err);
    assert!(end.err.contains("thesis.tex") && end.err.contains("--force"), "{}", end.err);
    assert_eq!((place.text("out/scene/summary.json"), place.names("out").len()), (before, 1));

    assert_eq!(place.run(&["crush", "scene.toml", "--force", "--set", "output.every=0"]).status, 0);
    assert_eq!(place.text("out/scene/thesis.tex"), "years");
    assert_eq!(place.names("out/scene").len(), first.len() + 1);
}

#[test]
fn a_folder_that_cannot_be_written_is_named_before_the_run() {
    let place = Place::with_scene(SCENE);
    let end = place.run(&["crush", "scene.toml", "--out", "scene.toml"]);
    assert_eq!(end.status, 2, "{}", end.err);
    assert!(end.err.contains("scene.toml") && end.err.contains("--out"), "{}", end.err);
    assert_eq!(place.text("scene.toml"), SCENE);
    if fs::metadata("/proc/version").is_ok() {
        let end = place.run(&["crush", "scene.toml", "--out", "/proc/asperity"]);
        assert_eq!(end.status, 2, "{}", end.err);
        assert!(end.err.contains("/proc/asperity"), "{}", end.err);
    }
    assert_eq!(place.names("."), ["scene.toml"]);
}
