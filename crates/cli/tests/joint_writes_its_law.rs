//! `asperity joint` writes the columns and files that its users rely on, and refuses what has no law.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::Place;
use std::collections::BTreeMap;

/// Small enough to be pressed in a moment.
const SCENE: &str = r#"closure = "half-space"
[surface]
periodic = true
[surface.generate]
kind = "self-affine"
hurst = 0.8
rolloff = "16 um"
cutoff = "8 um"
ra = "0.2 um"
size = ["32 um", "32 um"]
pixels = [32, 32]
seed = 2
[material]
youngs_modulus = "70 GPa"
poissons_ratio = 0.33
hardness = "1 GPa"
[load]
pressure = "100 MPa"
[joint]
loads = 7
[thermal]
conductivity = ["50 W/(m K)", "150 W/(m K)"]
[output]
maps = false
"#;

const COLUMNS: &str = "phase,pressure_MPa,mean_gap_um,approach_um,contact_area_ratio,stiffness_MPa_per_um,\
                       elastic_stiffness_MPa_per_um,conductance_W_per_m2K,leak_x_m3,leak_y_m3,error";

fn rows(place: &Place, file: &str) -> Vec<BTreeMap<String, String>> {
    csv::Reader::from_path(place.path(file)).unwrap().deserialize().map(Result::unwrap).collect()
}

#[test]
fn the_law_has_its_columns_and_every_file_its_rows() {
    let place = Place::with_scene(SCENE);
    let end = place.run(&["joint", "scene.toml", "--out", "out", "--report"]);
    assert_eq!(end.status, 0, "{}", end.err);
    assert!(place.text("out/joint.csv").starts_with(COLUMNS));
    let names = place.names("out");
    for name in ["abaqus.inp", "calculix.inp", "conductance.svg", "joint.json", "moose.csv", "report.html"] {
        assert!(names.iter().any(|have| have == name), "{names:?}");
    }
    let number = |row: &BTreeMap<String, String>, name: &str| row[name].parse::<f64>().unwrap_or(f64::NAN);
    let all = rows(&place, "out/joint.csv");
    let loads = || all.iter().filter(|row| row["phase"] == "load" && number(row, "pressure_MPa") > 0.0);
    assert_eq!(loads().count(), 7);
    assert!(all.iter().any(|row| row["phase"] == "unload"));
    // five of the loads have a leak, 0 where it is tight
    assert_eq!(loads().filter(|row| !row["leak_x_m3"].is_empty()).count(), 5);
    // k S/E* with k = 2 50 150/200 and E* = 70 GPa/(1 - 0.33²)
    for row in loads() {
        let h = 75.0 * number(row, "elastic_stiffness_MPa_per_um") * 1e6 / (70e3 / (1.0 - 0.33 * 0.33));
        assert!((number(row, "conductance_W_per_m2K") / h - 1.0).abs() < 1e-9, "{row:?}");
    }
    let moose = rows(&place, "out/moose.csv");
    let rising =
        |two: &[BTreeMap<String, String>]| number(&two[1], "approach_m") > number(&two[0], "approach_m");
    assert!(moose.len() > 7 && moose.windows(2).all(rising));
    let summary: serde_json::Value = serde_json::from_str(&place.text("out/joint.json")).unwrap();
    // a few pixels of a small map; the law itself is held to 0.1 % where it is tested
    assert!(summary["energy_error"].as_f64().unwrap().abs() < 0.02, "{summary}");
    let flowing =
        place.run(&["joint", "scene.toml", "--set", "closure=half-space-plastic", "--out", "flowing"]);
    assert_eq!(flowing.status, 0, "{}", flowing.err);
    let last = rows(&place, "flowing/joint.csv").pop().unwrap();
    assert!(last["phase"] == "unload" && number(&last, "approach_um") > 0.0, "{last:?}");
}

#[test]
fn what_has_no_law_is_refused_where_it_is_wrong() {
    let place = Place::with_scene(SCENE);
    let small = SCENE.replace("[32, 32]", "[16, 32]");
    std::fs::write(place.path("small.toml"), small).unwrap();
    for (args, words) in [
        (&["--set", "load.pressure=0 MPa"][..], &["load", "nothing touches"][..]),
        (
            &["--set", "closure=half-space-plastic", "--set", "load.pressure=2 GPa"],
            &["load.pressure", "1000 MPa"],
        ),
        (&["--set", "thermal.conductivity=[\"50\", \"50 W/(m K)\"]"], &["no unit", "W/(m K)"]),
        (&["--set", "joint.tiles=9"], &["joint.tiles", "between 1 and 8"]),
        (&["--set", "joint.tiles=3"], &["joint.tiles", "10 points", "16"]),
        (&["--set", "joint.loads=2"], &["joint.loads", "between 5 and 200"]),
        (&["small.toml"], &["of one size", "32 x 32", "16 x 32"]),
    ] {
        let end = place.run(&[&["joint", "scene.toml", "--out", "out"], args].concat());
        assert_eq!(end.status, 2, "{args:?}: {}", end.err);
        assert!(words.iter().all(|word| end.err.contains(word)), "{args:?}: {}", end.err);
        assert!(place.names("out").is_empty());
    }
}

/// Four quarters of a map are what four maps of those places are, each levelled by its plane: the same rows
/// with the same repeatability.
#[test]
fn tiles_are_maps_of_their_places() {
    let place = Place::with_scene("");
    let height = |x: usize, y: usize| ((x * x + 3 * y * (x % 5) + 7 * y * y) % 23) as f64 / 40.0;
    let text = |columns: std::ops::Range<usize>, rows: std::ops::Range<usize>| -> String {
        let row = |y: usize| columns.clone().map(|x| height(x, y).to_string()).collect::<Vec<_>>().join(",");
        rows.map(|y| row(y) + "\n").collect()
    };
    // an odd last column and row fill no tile
    std::fs::write(place.path("whole.csv"), text(0..41, 0..37)).unwrap();
    for (name, x, y) in [("a", 0, 0), ("b", 20, 0), ("c", 0, 18), ("d", 20, 18)] {
        std::fs::write(place.path(&format!("{name}.csv")), text(x..x + 20, y..y + 18)).unwrap();
    }
    let keys = ["surface.pixel_size=[\"1 um\", \"1 um\"]", "surface.height_unit=um", "load.pressure=500 MPa"];
    let keys: Vec<&str> = keys.iter().chain(&["joint.loads=7"]).flat_map(|key| ["--set", key]).collect();
    let tiles = ["joint", "whole.csv", "--set", "joint.tiles=2", "--out", "tiles"];
    let maps = ["joint", "a.csv", "b.csv", "c.csv", "d.csv", "--out", "maps"];
    for args in [&tiles[..], &maps] {
        let end = place.run(&[args, &keys].concat());
        assert_eq!(end.status, 0, "{}", end.err);
    }
    let said = std::fs::read_to_string(place.path("tiles/joint.json")).unwrap();
    assert!(said.contains("4 tiles of 20 x 18 points"), "{said}");
    let [tiles, maps] = ["tiles", "maps"].map(|folder| rows(&place, &format!("{folder}/joint.csv")));
    assert_eq!(tiles.len(), maps.len());
    let mut spread: f64 = 0.0;
    for (tile, map) in tiles.iter().zip(&maps) {
        for (name, value) in tile {
            let [a, b] = [value, &map[name]].map(|text| text.parse::<f64>());
            match (a, b) {
                // heights levelled once more differ by rounding
                (Ok(a), Ok(b)) => assert!((a - b).abs() <= 1e-4 * b.abs().max(1e-12), "{name}: {a} {b}"),
                _ => assert_eq!(value, &map[name], "{name}"),
            }
        }
        spread = spread.max(tile["repeatability"].parse().unwrap_or(0.0));
    }
    assert!(spread > 0.0);
}

/// The sentence of `rough`, by every command that reads a map.
#[test]
fn what_was_understood_of_a_file_is_said() {
    let place = Place::with_scene(SCENE);
    // bumps, each of a column's height
    let height = |x: usize, y: usize| 0.1 + ((x % 8) * (7 - x % 8) + (y % 8) * (7 - y % 8)) as f64 / 50.0;
    let row = |y: usize| (0..32).map(|x| height(x, y).to_string()).collect::<Vec<_>>().join(",");
    let text: String = (0..32).map(|y| row(y) + "\n").collect();
    std::fs::write(place.path("map.csv"), text).unwrap();
    let treatment = ["--set", "surface.pixel_size=[\"1 um\", \"1 um\"]", "--set", "surface.height_unit=um"];
    for command in ["rough", "joint", "scales", "extract"] {
        let end = place.run(&[&[command, "map.csv", "--out", command, "--force"][..], &treatment].concat());
        assert!(end.out.starts_with("read as "), "{command}: {} {}", end.out, end.err);
        let file = if command == "joint" { "joint.json" } else { "summary.json" };
        let summary = place.text(&format!("{command}/{file}"));
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        assert!(summary["understood"][0].is_string(), "{command}: {summary}");
    }
}
