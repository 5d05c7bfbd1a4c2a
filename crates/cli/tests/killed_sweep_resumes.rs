//! The remains of a sweep when it is killed, when the disk refuses, and when it is done in parts: the same
//! bytes, seconds excepted.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// 24 cases of 12 metals.
const SWEEP: &str = r#"slopes_deg = [4, 9]
youngs_modulus = ["70 GPa", "210 GPa"]
yield_stress = ["200 MPa", "300 MPa", "700 MPa"]
hardening_exponent = [0.1, 0.5]
accuracy = "draft"
"#;

/// The result files with their contents, the seconds taken out.
fn results(place: &Place, folder: &str) -> Vec<(String, String)> {
    let mut files = Vec::new();
    for name in place.names(folder) {
        let text = place.text(&format!("{folder}/{name}"));
        let seconds = text.lines().next().and_then(|head| head.split(',').position(|name| name == "wall_s"));
        let without_seconds = |line: &str| {
            let mut columns: Vec<&str> = line.split(',').collect();
            seconds.map(|column| columns.remove(column));
            columns.join(",")
        };
        let text = match name.as_str() {
            "cases.csv" => text.lines().map(without_seconds).collect::<Vec<_>>().join("\n"),
            _ => text,
        };
        files.push((name, text));
    }
    assert!(files.iter().any(|f| f.0 == "cases.csv" && f.1.lines().count() == 25), "{files:?}");
    assert!(files.iter().any(|f| f.0 == "fit.json") && files.len() >= 6);
    files
}

fn asperity(place: &Place, args: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_asperity"));
    command.current_dir(place.path("")).args(args).stdout(Stdio::null()).stderr(Stdio::null());
    command
}

#[test]
fn a_sweep_killed_twenty_times_ends_with_the_same_bytes() {
    let place = Place::with_scene(SWEEP);
    let clock = Instant::now();
    assert_eq!(place.run(&["calibrate", "scene.toml", "--out", "whole"]).status, 0);
    let whole = clock.elapsed();
    let mut moment = 1_u64;
    for _ in 0..20 {
        let mut child = asperity(&place, &["calibrate", "scene.toml", "--out", "killed"]).spawn().unwrap();
        // anywhere from the first moment to a quarter of an undisturbed run
        moment = moment.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let share = (moment >> 40) as f64 / (1_u64 << 24) as f64;
        std::thread::sleep(Duration::from_secs_f64(0.25 * share * whole.as_secs_f64()));
        child.kill().unwrap();
        child.wait().unwrap();
    }
    let end = place.run(&["calibrate", "scene.toml", "--out", "killed", "--threads", "1"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert_eq!(results(&place, "killed"), results(&place, "whole"));
    // journal and unfinished files are gone
    assert_eq!(place.names(""), ["killed", "scene.toml", "whole"]);
}

#[test]
fn a_sweep_in_parts_is_the_sweep() {
    let place = Place::with_scene(SWEEP);
    assert_eq!(place.run(&["calibrate", "scene.toml", "--out", "whole"]).status, 0);
    for part in ["1", "2", "3"] {
        let shard = format!("{part}/3");
        let end = place.run(&["calibrate", "scene.toml", "--shard", &shard, "--out", part]);
        assert_eq!(end.status, 0, "{}", end.err);
    }
    let missing = place.run(&["calibrate", "merge", "1", "3", "--out", "merged"]);
    assert!(missing.status == 2 && missing.err.contains("8 of 24"), "{}", missing.err);
    assert_eq!(place.run(&["calibrate", "merge", "3", "1", "2", "--out", "merged"]).status, 0);
    assert_eq!(results(&place, "merged"), results(&place, "whole"));

    // as the tasks of an array job, with a stand-in for Slurm that runs them at once
    let stand_in = place.path("sbatch");
    std::fs::write(&stand_in, SBATCH).unwrap();
    let status = Command::new("chmod").arg("+x").arg(&stand_in).status().unwrap();
    assert!(status.success());
    let path = format!("{}:{}", place.path("").display(), std::env::var("PATH").unwrap());
    let status = Command::new("bash")
        .arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../contrib/cluster/slurm-study"))
        .args(["--calibrate", "--out", "array", "--parts", "2", "--wait", "--", "scene.toml"])
        .current_dir(place.path(""))
        .envs([("PATH", path.as_str()), ("ASPERITY", env!("CARGO_BIN_EXE_asperity"))])
        .status()
        .unwrap();
    assert!(status.success());
    assert!(place.path("array/part-2").exists());
    assert_eq!(results(&place, "array/merged"), results(&place, "whole"));
}

/// `sbatch` that runs the job, or each task of an array, before it returns.
const SBATCH: &str = r#"#!/bin/sh
last=1
while [ $# -gt 0 ]; do
  case $1 in
    --array=1-*) last=${1#--array=1-} ;;
    --wrap) work=$2; shift ;;
  esac
  shift
done
for task in $(seq "$last"); do SLURM_ARRAY_TASK_ID=$task sh -c "$work" >&2; done
echo 1
"#;

/// A limit on the size of files stands for a full disk: the journal holds a few rows of the 24.
#[test]
fn a_disk_that_refuses_is_named_and_loses_no_case() {
    let place = Place::with_scene(SWEEP);
    let output = Command::new("sh")
        .args(["-c", "trap '' XFSZ; ulimit -f 2; exec \"$0\" calibrate scene.toml --out full --threads 1"])
        .arg(env!("CARGO_BIN_EXE_asperity"))
        .current_dir(place.path(""))
        .output()
        .unwrap();
    let err = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.contains("full.journal") && err.contains("resumes"), "{err}");
    let kept = place.text("full.journal").lines().count() - 1;
    assert!((1..24).contains(&kept), "{kept} rows");
    let end = place.run(&["calibrate", "scene.toml", "--out", "full"]);
    assert!(end.status == 0 && end.err.contains(&format!("{kept} cases of an earlier start")), "{}", end.err);
    assert_eq!(place.run(&["calibrate", "scene.toml", "--out", "whole"]).status, 0);
    assert_eq!(results(&place, "full"), results(&place, "whole"));
}

#[test]
fn a_folder_that_cannot_be_made_is_named_before_the_first_case() {
    let place = Place::with_scene(SWEEP);
    std::fs::write(place.path("file"), "").unwrap();
    let end = place.run(&["calibrate", "scene.toml", "--out", "file/deeper"]);
    assert!(end.status == 2 && end.err.contains("file"), "{}", end.err);
    assert_eq!(place.names(""), ["file", "scene.toml"]);
}
