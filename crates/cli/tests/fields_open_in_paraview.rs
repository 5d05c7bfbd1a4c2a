//! The state script for ParaView opens what a crush leaves and draws its fields.
//!
//! Needs `pvpython` in the path and a display or `xvfb-run`; says so and passes where there is none.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};
use std::collections::HashSet;
use std::path::Path;
use std::process::Command;

/// `pvpython` with a display to draw on.
fn paraview() -> Option<Command> {
    let exists = |name: &str| Command::new(name).arg("--help").output().is_ok();
    if !exists("pvpython") {
        return None;
    }
    if std::env::var_os("DISPLAY").is_some() {
        return Some(Command::new("pvpython"));
    }
    let mut command = Command::new("xvfb-run");
    command.args(["-a", "pvpython"]);
    exists("xvfb-run").then_some(command)
}

/// Colours of a PNG.
fn colours(path: &Path) -> HashSet<[u8; 3]> {
    let file = std::io::BufReader::new(std::fs::File::open(path).unwrap());
    let mut reader = png::Decoder::new(file).read_info().unwrap();
    let mut dots = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut dots).unwrap();
    dots[..info.buffer_size()].chunks_exact(info.color_type.samples()).map(|d| [d[0], d[1], d[2]]).collect()
}

/// The bands of the largest and of the smallest values are there, so that the view holds the contact and the
/// far field.
#[test]
fn both_views_show_the_whole_scale() {
    if paraview().is_none() {
        eprintln!("skipped: no pvpython in the path, or neither a display nor xvfb-run");
        return;
    }
    let place = Place::with_scene(SCENE.replace("every = 0", "every = 4"));
    assert_eq!(place.run(&["crush", "scene.toml", "--out", "out"]).status, 0);
    for (name, least) in [("von-mises", [68, 8, 90]), ("plastic-strain", [222, 228, 234])] {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../contrib/paraview/section.py");
        let picture = place.path(&format!("{name}.png"));
        let output = paraview()
            .unwrap()
            .arg(script)
            .arg(place.path("out"))
            .args(["--field", name, "--to"])
            .arg(&picture)
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let found = colours(&picture);
        let near =
            |wanted: [u8; 3]| found.iter().any(|c| c.iter().zip(wanted).all(|(a, b)| a.abs_diff(b) <= 12));
        let most = [[240, 228, 40], [214, 226, 44]];
        assert!(near(least) && most.into_iter().any(near), "{name}: {} colours", found.len());
    }
}
