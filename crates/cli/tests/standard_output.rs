//! Output that cannot be written ends a command with status 1 and a reason; a reader that has seen enough
//! does not.

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use std::fs::File;
use std::io::Read;
use std::process::{Command, Stdio};

fn asperity(place: &Place, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(place.path(".")).args(args).stderr(Stdio::piped());
    command
}

/// Every command that prints, each in its own way.
const PRINTING: [&[&str]; 11] = [
    &["crush", "scene.toml", "--json", "--out", "json"],
    &["crush", "scene.toml", "--out", "text"],
    &["mesh", "scene.toml", "-o", "scene.msh"],
    &["study", "scene.toml", "--vary", "loading.depth=1 um,2 um", "--out", "study"],
    &["reproduce", "--list"],
    &["new", "cone"],
    &["schema"],
    &["completions", "bash"],
    &["man", "crush"],
    &["--help"],
    &["--version"],
];

#[test]
fn a_full_disk_behind_stdout_is_told_with_status_1() {
    let place = Place::with_scene(SCENE);
    for args in PRINTING {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = asperity(&place, args).stdout(full).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{args:?}: {said}");
        assert!(said.contains("cannot write to standard output"), "{args:?}: {said}");
    }
    // the results are in their place all the same
    assert!(place.path("json/summary.json").exists() && place.path("study/results.csv").exists());
}

#[test]
fn a_pipe_that_is_closed_is_no_failure() {
    let place = Place::with_scene(SCENE);
    for args in [&["schema"][..], &["man"], &["--help"]] {
        let mut child = asperity(&place, args).stdout(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let mut said = String::new();
        child.stderr.take().unwrap().read_to_string(&mut said).unwrap();
        assert_eq!((child.wait().unwrap().code(), said.as_str()), (Some(0), ""), "{args:?}");
    }
}
