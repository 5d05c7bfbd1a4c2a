//! Ctrl-C ends every long command with status 1 and a word on what is kept and how to go on; what was kept is
//! not done again.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// The status and the words of `args`, interrupted as soon as `begun` holds.
fn interrupted(place: &Place, args: &[&str], begun: impl Fn() -> bool) -> (Option<i32>, String) {
    let child = Command::new(env!("CARGO_BIN_EXE_asperity"))
        .current_dir(place.path("."))
        .args(args)
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while !begun() {
        assert!(start.elapsed() < Duration::from_secs(120), "{args:?} did not begin");
        sleep(Duration::from_millis(10));
    }
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let output = child.wait_with_output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// True where the file holds at least `count` lines.
fn holds(place: &Place, name: &str, count: usize) -> bool {
    std::fs::read_to_string(place.path(name)).is_ok_and(|text| text.lines().count() >= count)
}

#[test]
fn a_sweep_keeps_its_cases() {
    let place = Place::with_scene("accuracy = \"draft\"\n");
    let args = ["calibrate", "scene.toml", "--out", "out", "--threads", "1"];
    let (status, said) = interrupted(&place, &args, || holds(&place, "out.journal", 3));
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("out.journal; the same command goes on from there"), "{said}");
    assert_eq!(place.names(""), ["out.journal", "scene.toml"], "no results of a part");
    let kept = place.text("out.journal").lines().count() - 1;
    let (_, said) = interrupted(&place, &args, || holds(&place, "out.journal", kept + 3));
    assert!(said.contains(&format!("{kept} cases of an earlier start")), "{said}");
}

#[test]
fn a_trade_keeps_its_runs_and_ends_those_at_hand() {
    let place = Place::with_scene(SCENE.replace("steps = 8", "steps = 24"));
    let args = ["trade", "scene.toml", "--out", "out", "--combinations", "0"];
    let (status, said) = interrupted(&place, &args, || holds(&place, "out.journal", 2));
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("out.journal; the same command goes on from there"), "{said}");
    assert_eq!(place.names(""), ["out.journal", "scene.toml"]);
    let kept = place.text("out.journal").lines().count() - 1;
    let end = place.run(&args);
    assert_eq!(end.status, 0, "{}", end.err);
    assert!(end.err.contains(&format!("{kept} run")), "{}", end.err);
}

#[test]
fn a_rough_surface_and_a_fit_say_that_they_begin_anew() {
    let place = Place::with_scene("");
    for (kind, command) in [("rough", "rough"), ("fit", "identify")] {
        assert_eq!(place.run(&["new", kind]).status, 0);
        let file = format!("{kind}.toml");
        // a fit takes two seconds: on a busy machine it may be done before it is interrupted
        let mut tries = (0..3).map(|_| {
            let _ = std::fs::remove_dir_all(place.path("out"));
            interrupted(&place, &[command, &file, "--out", "out"], || place.path("out.partial").exists())
        });
        let (status, said) = tries.find(|(status, _)| *status != Some(0)).unwrap();
        assert_eq!(status, Some(1), "{command}: {said}");
        assert!(said.contains("stopped") && said.contains("the same command begins anew"), "{said}");
    }
}

#[test]
fn a_reproduction_keeps_its_parts() {
    let place = Place::with_scene("");
    let args = ["reproduce", "--only", "table1", "--accuracy", "draft", "--out", "out", "--threads", "1"];
    let begun = || place.names("out/parts").iter().any(|name| name.ends_with(".partial"));
    let (status, said) = interrupted(&place, &args, begun);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("parts are done and kept in out; the same command goes on from there"), "{said}");
    // a part that was ended is not taken for one that is done
    assert!(place.names("out/parts").iter().all(|name| !name.ends_with(".done")), "{said}");
}
