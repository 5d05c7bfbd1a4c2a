//! `asperity mesh --format inp` writes a scene that CalculiX runs.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{Place, SCENE};
use std::process::Command;

/// A deck of `scene` with these overrides, by its lines.
fn deck(place: &Place, overrides: &[&str]) -> Vec<String> {
    let sets: Vec<&str> = overrides.iter().flat_map(|o| ["--set", o]).collect();
    let end = place.run(&[&["mesh", "scene.toml", "--format", "inp"][..], &sets].concat());
    assert_eq!((end.status, end.err.as_str()), (0, ""), "{}", end.err);
    assert!(end.out.contains("scene.inp"), "{}", end.out);
    place.text("scene.inp").lines().map(String::from).collect()
}

/// The data lines after the first line that begins with `keyword`.
fn block<'d>(deck: &'d [String], keyword: &str) -> Vec<&'d str> {
    let start = deck.iter().position(|l| l.starts_with(keyword)).unwrap_or_else(|| panic!("{keyword}"));
    deck[start + 1..].iter().map(String::as_str).take_while(|l| !l.starts_with('*')).collect()
}

fn numbers(line: &str) -> Vec<f64> {
    line.split(',').filter(|w| !w.trim().is_empty()).map(|w| w.trim().parse().unwrap()).collect()
}

/// Cells and nodes of the mesh that the scene makes.
fn sizes(place: &Place) -> [usize; 2] {
    let end = place.run(&["mesh", "scene.toml", "-o", "body.vtu"]);
    let words: Vec<&str> = end.out.split_whitespace().collect();
    [words[1].parse().unwrap(), words[6].parse().unwrap()]
}

#[test]
fn the_deck_has_every_part_node_and_step() {
    let place = Place::with_scene(SCENE);
    let deck = deck(&place, &[]);
    for part in [
        "*HEADING",
        "scene: crush by a rigid tool, written by asperity",
        "** units: um, MPa",
        "*NSET, NSET=AXIS",
        "*NSET, NSET=BASE",
        "*NSET, NSET=OUTER",
        "*NSET, NSET=CONTACT",
        "*SURFACE, NAME=CONTACT, TYPE=ELEMENT",
        "*SURFACE, NAME=TOOL, TYPE=ELEMENT",
        "*MATERIAL, NAME=METAL",
        "*SOLID SECTION, ELSET=BODY, MATERIAL=METAL",
        "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
        "*CONTACT PAIR, INTERACTION=FRICTIONLESS, TYPE=SURFACE TO SURFACE",
        "BASE, 1, 2",
        "AXIS, 1",
        "*NODE PRINT, NSET=TOOL, TOTALS=YES, FREQUENCY=1000",
        "*CONTACT PRINT, SLAVE=CONTACT, MASTER=TOOL, FREQUENCY=1000",
        "*EL PRINT, ELSET=BODY, TOTALS=ONLY, FREQUENCY=1000",
        "*CONTACT FILE, FREQUENCY=1000",
    ] {
        assert!(deck.iter().any(|l| l.starts_with(part)), "{part}");
    }
    let [cells, nodes] = sizes(&place);
    assert_eq!(block(&deck, "*NODE, NSET=ALL").len(), nodes);
    assert_eq!(block(&deck, "*ELEMENT, TYPE=CAX8R").len(), cells);
    assert!(deck.iter().flat_map(|l| l.split(',')).all(deck_field));
    // 8 steps down, 6 back at draft and one without the tool
    let steps = |word: &str| deck.iter().filter(|l| l.starts_with(word)).count();
    assert_eq!([steps("*STEP, NLGEOM"), steps("*STATIC"), steps("*END STEP")], [15; 3]);
    assert_eq!(numbers(block(&deck, "*ELASTIC")[0]), [210e3, 0.3]);
    // no node is left on the axis, and the summit stays where it was
    let body: Vec<Vec<f64>> = block(&deck, "*NODE, NSET=ALL").into_iter().map(numbers).collect();
    let smallest = body.iter().map(|n| n[1]).fold(f64::INFINITY, f64::min);
    let summit = body.iter().map(|n| n[2]).fold(f64::NEG_INFINITY, f64::max);
    assert!(smallest > 0.0 && smallest < 0.01 && summit.abs() < 1e-9, "{smallest} {summit}");
}

/// Words may be long, numbers have 20 characters at most.
fn deck_field(field: &str) -> bool {
    field.trim().parse::<f64>().is_err() || field.len() <= 20
}

/// The table, interpolated as a code does, is σ = R (σ/E + ε_p)ⁿ within the error that the deck states.
#[test]
fn the_table_is_the_law_within_the_error_it_states() {
    let place = Place::with_scene(SCENE);
    let deck = deck(&place, &[]);
    let stated = deck.iter().find(|l| l.contains("the law is met to")).unwrap();
    let stated: f64 = stated.rsplit(' ').next().unwrap().parse().unwrap();
    let table: Vec<Vec<f64>> = block(&deck, "*PLASTIC").into_iter().map(numbers).collect();
    assert!(table.len() <= 200 && stated < 2e-4, "{} {stated}", table.len());
    let factor = 210e3_f64.powf(0.3) * 300_f64.powf(0.7);
    let mut worst = 0.0_f64;
    for pair in table.windows(2) {
        for share in [0.0, 0.25, 0.5, 0.75] {
            let [stress, strain] = [0, 1].map(|i| pair[0][i] + share * (pair[1][i] - pair[0][i]));
            // the law at the interpolated point: the total strain that belongs to this plastic one, by fixed
            // point
            let mut exact = stress;
            for _ in 0..60 {
                exact = factor * (exact / 210e3 + strain).powf(0.3);
            }
            worst = worst.max((stress / exact - 1.0).abs());
        }
    }
    assert!(worst <= 1.05 * stated && worst > 0.5 * stated, "{worst} {stated}");
}

#[test]
fn elements_supports_and_tool_follow_the_scene() {
    let place = Place::with_scene(SCENE);
    let linear = deck(&place, &["numerics.element=q4", "loading.unload=false"]);
    assert!(linear.iter().any(|l| l == "*ELEMENT, TYPE=CAX4, ELSET=BODY"));
    assert_eq!(linear.iter().filter(|l| l.starts_with("*STEP")).count(), 8);

    let elastic = SCENE.replace("yield_stress = \"300 MPa\"\n", "").replace("hardening_exponent = 0.3\n", "");
    let place = Place::with_scene(elastic);
    assert!(!deck(&place, &[]).iter().any(|l| l.starts_with("*PLASTIC")));

    let ridges = SCENE
        .replace("axisymmetric", "plane-strain")
        .replace("[tool]", "[substrate]\nradius = \"2 mm\"\ndepth = \"2 mm\"\n[tool]");
    let place = Place::with_scene(ridges);
    let plane = deck(&place, &["lateral=symmetric"]);
    for line in ["*ELEMENT, TYPE=CPE8R, ELSET=BODY", "*ELEMENT, TYPE=CPE4, ELSET=TOOL", "AXIS, 1", "OUTER, 1"]
    {
        assert!(plane.iter().any(|l| l == line), "{line}");
    }
    let free = deck(&place, &[]);
    assert!(!free.iter().any(|l| l == "AXIS, 1" || l == "OUTER, 1"));

    let place =
        Place::with_scene(SCENE.replace("shape = \"plane\"", "shape = \"sphere\"\nradius = \"200 um\""));
    assert!(block(&deck(&place, &[]), "*ELEMENT, TYPE=CAX4, ELSET=TOOL").len() >= 48);
}

#[test]
fn a_scene_that_a_deck_cannot_express_is_refused() {
    let place = Place::with_scene(SCENE.replace("depth = \"5 um\"", "force = \"4 N\""));
    let end = place.run(&["mesh", "scene.toml", "--format", "inp"]);
    assert_eq!(end.status, 2);
    for word in ["loading.force", "by given depths", "peak_depth_um", "scene.toml:16"] {
        assert!(end.err.contains(word), "{word}: {}", end.err);
    }
    assert_eq!(place.run(&["mesh", "scene.toml", "--format", "msh"]).status, 0);
    let end = place.run(&["mesh", "scene.toml"]);
    assert!(end.status == 2 && end.err.contains("--format"), "{}", end.err);
    let end = place.run(&["mesh", "scene.toml", "--format", "stl"]);
    assert!(end.status == 2 && end.err.contains("inp"), "{}", end.err);
}

/// The first step in CalculiX: the force is that of this program's own first increment to some percent, and
/// the body balances.
#[test]
fn calculix_runs_the_first_step() {
    let place = Place::with_scene(SCENE);
    let mut deck = deck(&place, &["numerics.steps=1", "loading.depth=1 um"]).join("\n");
    deck.truncate(deck.find("*END STEP").unwrap());
    std::fs::write(place.path("first.inp"), deck + "*END STEP\n").unwrap();
    let run = Command::new("ccx")
        .arg("first")
        .current_dir(place.path("."))
        .env("OMP_NUM_THREADS", "1")
        .env("CCX_NPROC_RESULTS", "1")
        .output();
    let Ok(run) = run else {
        println!("skipped: ccx (Debian: calculix-ccx) is not on the PATH");
        return;
    };
    let said = String::from_utf8_lossy(&run.stdout);
    assert!(run.status.success() && said.contains("Job finished") && !said.contains("*ERROR"), "{said}");
    let results = place.text("first.dat");
    let (_, after) = results.split_once("total force (fx,fy,fz) for set TOOL").unwrap();
    let line = after.lines().skip(1).find(|l| !l.trim().is_empty()).unwrap();
    let force = 180e-6 * line.split_whitespace().nth(1).unwrap().parse::<f64>().unwrap();
    // 0.276 N of a fine run; one step from nothing to 1 µm loses a part of it
    assert!((0.15..0.30).contains(&-force), "{force}");
    for word in ["total internal energy for set BODY", "statistics for slave set CONTACT"] {
        assert!(results.contains(word), "{word}");
    }
}
