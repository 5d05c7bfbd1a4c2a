//! `asperity mesh` writes what `asperity crush` and other programs read.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};

#[test]
fn a_mesh_that_was_written_and_read_gives_the_same_curve() {
    let place = Place::with_scene(SCENE);
    // a body of given size: that of a mesh, and no part of a half space
    let sized = ["--set", "substrate.radius=1 mm", "--set", "substrate.depth=1 mm"];
    let end = place.run(&[&["mesh", "scene.toml", "-o", "body.msh"], &sized[..]].concat());
    assert_eq!((end.status, end.err.as_str()), (0, ""));
    for word in ["cells", "sides", "um", "scaled Jacobian", "aspect ratio", "body.msh"] {
        assert!(end.out.contains(word), "{word}: {}", end.out);
    }
    assert_eq!(place.run(&[&["crush", "scene.toml", "--out", "built"], &sized[..]].concat()).status, 0);
    let end = place.run(&["crush", "scene.toml", "--set", "mesh.file=body.msh", "--out", "read"]);
    assert_eq!(end.status, 0, "{}", end.err);
    // metres in the file cost the last digit of a coordinate; factors in single precision may make
    // 6e-8 of an entry of it, and what Newton's tolerance leaves then differs: 2e-8 of a force at most
    let (built, read) =
        (load_branch(&place.text("built/curve.csv")), load_branch(&place.text("read/curve.csv")));
    assert_eq!(built.len(), read.len());
    for (a, b) in built.iter().zip(&read) {
        assert!((a[0] - b[0]).abs() <= 1e-7 * a[0] && (a[1] - b[1]).abs() <= 1e-7 * a[1], "{a:?} {b:?}");
    }
}

#[test]
fn a_mesh_in_other_units_and_at_another_height_is_the_same_body() {
    let place = Place::with_scene(SCENE);
    assert_eq!(place.run(&["mesh", "scene.toml", "-o", "body.msh"]).status, 0);
    std::fs::write(place.path("lifted.msh"), lifted(&place.text("body.msh"))).unwrap();
    let crush = ["crush", "scene.toml", "--set", "loading.unload=false", "--set"];
    let runs = [("body.msh", "1 m", "plain"), ("lifted.msh", "1 um", "lifted")];
    for (file, unit, out) in runs {
        let (file, unit) = (format!("mesh.file={file}"), format!("mesh.unit={unit}"));
        let end = place.run(&[&crush[..], &[&file, "--set", &unit, "--out", out]].concat());
        assert_eq!(end.status, 0, "{}", end.err);
    }
    let (plain, lifted) =
        (load_branch(&place.text("plain/curve.csv")), load_branch(&place.text("lifted/curve.csv")));
    for (a, b) in plain.iter().zip(&lifted) {
        assert!((a[0] - b[0]).abs() <= 1e-7 * a[0] && (a[1] - b[1]).abs() <= 1e-7 * a[1], "{a:?} {b:?}");
    }
}

/// The mesh in µm, 700 µm higher.
fn lifted(msh: &str) -> String {
    let (before, rest) = msh.split_once("$Nodes\n").unwrap();
    let (nodes, after) = rest.split_once("$EndNodes").unwrap();
    let lift = |line: &str| {
        let words: Vec<f64> = line.split_whitespace().map(|w| w.parse().unwrap()).collect();
        match words[..] {
            [r, z, 0.0] => format!("{:?} {:?} 0\n", r * 1e6, z * 1e6 + 700.0),
            _ => format!("{line}\n"),
        }
    };
    format!("{before}$Nodes\n{}$EndNodes{after}", nodes.lines().map(lift).collect::<String>())
}

/// Depth and force of the loading rows.
fn load_branch(curve: &str) -> Vec<[f64; 2]> {
    let rows = curve.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    // the nodal force: the reported one is extrapolated, of a mesh that was read with the other element
    // beside it
    rows.filter(|cells| cells[1] == "load").map(|c| [c[2].parse().unwrap(), c[13].parse().unwrap()]).collect()
}

#[test]
fn every_format_is_written_whole_and_replaced() {
    let place = Place::with_scene(SCENE);
    for (name, word) in
        [("a.vtu", "UnstructuredGrid"), ("a.inp", "*ELEMENT, TYPE=CAX8R"), ("a.MSH", "$MeshFormat")]
    {
        std::fs::write(place.path(name), "old").unwrap();
        let end = place.run(&["mesh", "scene.toml", "-o", name, "--quiet"]);
        assert_eq!((end.status, end.out.as_str(), end.err.as_str()), (0, "", ""), "{name}");
        assert!(place.text(name).contains(word), "{name}");
    }
    assert_eq!(place.names("."), ["a.MSH", "a.inp", "a.vtu", "scene.toml"]);
    let end = place.run(&["mesh", "scene.toml", "-o", "b.inp", "--set", "numerics.element=q4"]);
    assert!(end.status == 0 && place.text("b.inp").contains("TYPE=CAX4"), "{}", end.err);
}

#[test]
fn a_file_that_nobody_named_replaces_its_like_alone() {
    let place = Place::with_scene(SCENE);
    let write = |format: &str, force: &[&str]| {
        place.run(&[&["mesh", "scene.toml", "--format", format, "--quiet"], force].concat())
    };
    assert_eq!((write("inp", &[]).status, write("inp", &[]).status), (0, 0));
    // a deck for another program, and a file of the user
    for start in [place.text("scene.inp"), "precious".to_string()] {
        std::fs::write(place.path("scene.inp"), &start).unwrap();
        let end = write("abaqus", &[]);
        assert!(end.status == 2 && end.err.contains("--force"), "{}", end.err);
        assert_eq!(place.text("scene.inp"), start);
        assert_eq!(write("abaqus", &["--force"]).status, 0);
    }
}
