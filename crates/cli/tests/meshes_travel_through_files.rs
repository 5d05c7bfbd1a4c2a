//! `asperity mesh` writes what `asperity crush` and other programs read.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};

#[test]
fn a_mesh_that_was_written_and_read_gives_the_same_curve() {
    let place = Place::with_scene(SCENE);
    let end = place.run(&["mesh", "scene.toml", "-o", "body.msh"]);
    assert_eq!((end.status, end.err.as_str()), (0, ""));
    for word in ["cells", "sides", "um", "scaled Jacobian", "aspect ratio", "body.msh"] {
        assert!(end.out.contains(word), "{word}: {}", end.out);
    }
    assert_eq!(place.run(&["crush", "scene.toml", "--out", "built"]).status, 0);
    let end = place.run(&["crush", "scene.toml", "--set", "mesh.file=body.msh", "--out", "read"]);
    assert_eq!(end.status, 0, "{}", end.err);
    // metres in the file cost the last digit of a coordinate; near zero force that is magnified
    let (built, read) =
        (load_branch(&place.text("built/curve.csv")), load_branch(&place.text("read/curve.csv")));
    assert_eq!(built.len(), read.len());
    for (a, b) in built.iter().zip(&read) {
        assert!((a[0] - b[0]).abs() <= 1e-9 * a[0] && (a[1] - b[1]).abs() <= 1e-9 * a[1], "{a:?} {b:?}");
    }
}

/// Depth and force of the loading rows.
fn load_branch(curve: &str) -> Vec<[f64; 2]> {
    let rows = curve.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    rows.filter(|cells| cells[1] == "load").map(|c| [c[2].parse().unwrap(), c[3].parse().unwrap()]).collect()
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
