//! Ctrl-C ends a crush with its curve, its fields and a summary that says where it stopped.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use asperity::crush::{CurveRow, Summary, read_rows};
use common::{Place, SCENE};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

#[test]
fn an_interrupted_crush_keeps_curve_fields_and_the_place_where_it_stopped() {
    // far more steps than can be taken before the signal
    let place =
        Place::with_scene(SCENE.replace("steps = 8", "steps = 10000").replace("every = 0", "every = 3"));
    let child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .current_dir(place.path("."))
        .args(["crush", "scene.toml", "--out", "out"])
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !place.path("out.partial/fields_0003.vtu").exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "no fields yet");
        std::thread::sleep(Duration::from_millis(10));
    }
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let output = child.wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{said}");
    assert!(said.contains("stopped loading at") && said.contains("interrupted"), "{said}");

    let summary = Summary::read(&place.path("out/summary.json")).unwrap();
    let curve: Vec<CurveRow> = read_rows(&place.path("out/curve.csv")).unwrap();
    let last = curve.last().unwrap();
    assert!(summary.stopped.as_ref().unwrap().contains("of 5.0000 um"), "{said}");
    assert!(curve.len() >= 4 && last.depth < 5e-6 && last.depth == summary.peak_depth);
    // the fields of where it stopped are there too
    let collection = place.text("out/fields.pvd");
    assert!(collection.contains(&format!("fields_{:04}.vtu", last.increment)), "{collection}");
    assert!(place.path("out/curve.svg").exists());
}
