//! A scene may name a table of hardening: it is read from beside the scene, stands in the summary, which so
//! is reproducible without the file, and a wrong one is refused at its line.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};

const LAW: &str = "yield_stress = \"300 MPa\"\nhardening_exponent = 0.3\nhardening_law = \"hollomon\"\n";

/// The scene with other lines for the metal.
fn scene(material: &str) -> String {
    assert!(SCENE.contains(LAW));
    SCENE.replacen(LAW, material, 1)
}

fn place(table: &str) -> Place {
    let place = Place::with_scene(scene("hardening_law = \"table\"\nhardening_file = \"curve.csv\"\n"));
    std::fs::write(place.path("curve.csv"), table).unwrap();
    place
}

#[test]
fn the_summary_holds_the_table_and_gives_the_same_bits() {
    let place = place("plastic_strain,yield_stress_MPa\n0,300\n0.01,420\n0.3,910\n");
    let end = place.run(&["crush", "scene.toml", "--out", "file", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let summary: serde_json::Value = serde_json::from_str(&place.text("file/summary.json")).unwrap();
    let material = &summary["scene"]["material"];
    assert_eq!(material["hardening_law"], "table");
    assert!(material["hardening_file"].is_null(), "{material}");
    let table = material["hardening_table"].as_array().unwrap();
    assert_eq!(table.len(), 3);
    // the table of the summary, as it stands, in the place of the file
    let inline = format!("hardening_law = \"table\"\nhardening_table = {}\n", material["hardening_table"]);
    std::fs::write(place.path("inline.toml"), scene(&inline)).unwrap();
    let end = place.run(&["crush", "inline.toml", "--out", "inline", "--quiet"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert_eq!(place.text("file/curve.csv"), place.text("inline/curve.csv"));
}

/// The same points as above, counted as a tension test counts them.
#[test]
fn total_strain_gives_the_points_of_plastic_strain_and_says_so() {
    let modulus = 210e3;
    let row = |plastic: f64, stress: f64| format!("{},{stress}\n", plastic + stress / modulus);
    let elastic = row(0.0, 0.0) + &row(0.0, 150.0);
    let flow = row(0.0, 300.0) + &row(0.01, 420.0) + &row(0.3, 910.0);
    let place = place(&format!("total_strain,true_stress_MPa\n{elastic}{flow}"));
    let end = place.run(&["crush", "scene.toml", "--out", "out"]);
    assert_eq!(end.status, 0, "{}", end.err);
    let said = "first yield in line 4 at 300 MPa, 2 before it left out";
    assert!(end.out.contains(said) || end.err.contains(said), "{}{}", end.out, end.err);
    let summary: serde_json::Value = serde_json::from_str(&place.text("out/summary.json")).unwrap();
    let table = summary["scene"]["material"]["hardening_table"].as_array().unwrap();
    let strains: Vec<f64> = table.iter().map(|point| point[0].as_f64().unwrap()).collect();
    assert_eq!((strains.len(), strains[0]), (3, 0.0), "{strains:?}");
    assert!((strains[1] - 0.01).abs() < 1e-15 && (strains[2] - 0.3).abs() < 1e-15, "{strains:?}");
}

#[test]
fn a_wrong_table_is_refused_at_its_line() {
    let head = "plastic_strain,yield_stress_MPa\n";
    for (table, words) in [
        ("", &["scene.toml:7:", "curve.csv: is empty", "plastic_strain,yield_stress_MPa"][..]),
        ("strength,stress\n0,300\n", &["curve.csv:1:", "no header that names a plastic strain"]),
        ("strain,stress_MPa\n0,300\n", &["curve.csv:1:", "plastic_strain", "total_strain"]),
        ("total_strain,stress_MPa\n0,0\n0.01,300\n", &["curve.csv:3:", "Young's modulus, ", "elastic line"]),
        ("Nenndehnung,Nennspannung (MPa)\n0,0\n", &["curve.csv:1:", "ln(1 + ε)"]),
        ("plastic_strain,yield_stress\n0,300\n", &["curve.csv:1:", "has no unit", "MPa, GPa"]),
        (&format!("{head}0,300\n0.1;400\n"), &["curve.csv:1:", "no header"]),
        (&format!("{head}0,x\n"), &["curve.csv:2:", "\"x\" is not a number"]),
        (&format!("{head}0.002,300\n"), &["curve.csv:2:", "must start at 0, not at 0.002"]),
        (&format!("{head}0,300\n0.2,400\n\n0.1,500\n"), &["curve.csv:5:", "0.1 follows 0.2", "sort"]),
        (&format!("{head}0,300\n0.2,400\n0.3,399\n"), &["curve.csv:4:", "399 follows 400", "end the table"]),
        (&format!("{head}0,0.3\n0.2,0.1\n"), &["curve.csv:3:", "must not fall"]),
        (&format!("{head}0,0.1\n"), &["curve.csv:2:", "from 0.21 to 42000 MPa", "not 0.1 MPa", "its unit"]),
        (&format!("{head}0,300\n1,3e5\n"), &["curve.csv:3:", "at most Young's modulus", "not 300000 MPa"]),
    ] {
        let end = place(table).run(&["crush", "scene.toml", "--out", "out"]);
        assert_eq!(end.status, 2, "{table}\n{}", end.err);
        for word in words {
            assert!(end.err.contains(word), "{table}: {word} is not in\n{}", end.err);
        }
    }
}

#[test]
fn a_table_excludes_yield_stress_and_exponent() {
    let table = "hardening_law = \"table\"\n";
    for (material, words) in [
        (table.to_string(), &["scene.toml:6:", "hardening_file = "][..]),
        (format!("{table}hardening_file = \"none.csv\"\n"), &["scene.toml:7:", "none.csv: cannot be read"]),
        (format!("{table}hardening_file = \".\"\n"), &["scene.toml:7:", "cannot be read"]),
        (
            format!("{table}hardening_file = \"curve.csv\"\nyield_stress = \"300 MPa\"\n"),
            &["scene.toml:8:", "does not go with", "first point is the yield stress"],
        ),
        (
            format!("{table}hardening_file = \"curve.csv\"\nhardening_table = [[0, \"300 MPa\"]]\n"),
            &["scene.toml:7:", "does not go with `hardening_table`"],
        ),
        (format!("{table}hardening_table = [[0, 300]]\n"), &["scene.toml:7:", "a stress as a string"]),
        (format!("{table}hardening_table = [[0, \"300 MPa\"], [0, \"400 MPa\"]]\n"), &["0 follows 0"]),
        (format!("{LAW}hardening_file = \"curve.csv\"\n"), &["scene.toml:9:", "hardening_law = \"table\""]),
    ] {
        let place = Place::with_scene(scene(&material));
        std::fs::write(place.path("curve.csv"), "plastic_strain,yield_stress_MPa\n0,300\n").unwrap();
        let end = place.run(&["mesh", "scene.toml", "-o", "mesh.msh"]);
        assert_eq!(end.status, 2, "{material}\n{}", end.err);
        for word in words {
            assert!(end.err.contains(word), "{material}: {word} is not in\n{}", end.err);
        }
    }
}
