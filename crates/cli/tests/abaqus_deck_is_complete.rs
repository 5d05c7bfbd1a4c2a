//! Claim: `asperity mesh --format abaqus` writes the scene as a user of Abaqus writes it: a rigid tool with a
//! reference node, a step for each direction in which an amplitude moves it along the schedule of the scene.
//!
//! Source: the keyword and element references of Abaqus 2024 (`*RIGID BODY`; RAX2, R2D2: the positive side
//! lies to the left of the way from the first node to the second; `*AMPLITUDE`: four pairs to a line). Abaqus
//! itself is not run: the numbers are those of the deck for CalculiX, which is.

#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{Place, SCENE};

/// The lines of a deck of the scene in `place`.
fn deck(place: &Place, format: &str) -> Vec<String> {
    let end = place.run(&["mesh", "scene.toml", "--format", format, "-o", "deck.inp"]);
    assert_eq!((end.status, end.err.as_str()), (0, ""), "{}", end.err);
    place.text("deck.inp").lines().map(String::from).collect()
}

/// The numbers of the data lines after each line that begins with `keyword`.
fn blocks(deck: &[String], keyword: &str) -> Vec<Vec<Vec<f64>>> {
    let numbers = |line: &String| line.split(',').filter_map(|word| word.trim().parse().ok()).collect();
    let starts = deck.iter().enumerate().filter(|(_, line)| line.starts_with(keyword)).map(|(i, _)| i + 1);
    starts.map(|i| deck[i..].iter().take_while(|l| !l.starts_with('*')).map(numbers).collect()).collect()
}

/// The travels of the tool in the deck for CalculiX, one to a step.
fn travels(deck: &[String]) -> Vec<f64> {
    let lines = deck.iter().filter(|line| line.starts_with("TOOL, 2, 2, "));
    lines.map(|line| line.rsplit(',').next().unwrap().trim().parse().unwrap()).collect()
}

#[test]
fn the_reference_node_takes_the_way_of_the_scene() {
    for reloads in [0, 2] {
        let place =
            Place::with_scene(SCENE.replace("unload = true", &format!("unload = true\nreloads = {reloads}")));
        let (abaqus, calculix) = (deck(&place, "abaqus"), deck(&place, "inp"));
        let names: Vec<&str> =
            abaqus.iter().filter_map(|l| l.strip_prefix("*STEP, NAME=")?.split(',').next()).collect();
        let expected: &[&str] = match reloads {
            0 => &["LOADING", "UNLOADING"],
            _ => &["LOADING", "UNLOADING-0", "RELOADING-1", "UNLOADING-1", "RELOADING-2", "UNLOADING-2"],
        };
        assert_eq!(names, expected);
        let amplitudes = blocks(&abaqus, "*AMPLITUDE, NAME=");
        let whole: Vec<f64> = blocks(&abaqus, "*BOUNDARY, AMPLITUDE=").iter().map(|b| b[0][2]).collect();
        assert_eq!((amplitudes.len(), whole.len()), (names.len(), names.len()));
        let mut way = Vec::new();
        let mut from = 0.0;
        for (lines, whole) in amplitudes.iter().zip(&whole) {
            assert!(lines[..lines.len() - 1].iter().all(|line| line.len() == 8), "four pairs to a line");
            let pairs: Vec<f64> = lines.concat();
            let times: Vec<f64> = pairs.iter().step_by(2).copied().collect();
            assert!(times.iter().enumerate().all(|(i, time)| *time == i as f64), "{times:?}");
            let values: Vec<f64> = pairs.iter().skip(1).step_by(2).map(|value| value * whole).collect();
            // a step goes on where the one before it ended
            assert!((values[0] - from).abs() <= 1e-9 * whole.abs(), "{} {from}", values[0]);
            from = values[values.len() - 1];
            way.extend_from_slice(&values[1..]);
        }
        let other = travels(&calculix);
        assert_eq!(way.len(), other.len());
        assert!(
            way.iter().zip(&other).all(|(a, b)| (a - b).abs() <= 1e-9 * whole[0].abs()),
            "{way:?} {other:?}"
        );
    }
}

#[test]
fn the_tool_is_a_rigid_body_that_faces_the_metal() {
    let ridges = SCENE
        .replace("axisymmetric", "plane-strain")
        .replace("[tool]", "[substrate]\nradius = \"2 mm\"\ndepth = \"2 mm\"\n[tool]");
    for (scene, link, body) in [(SCENE.to_string(), "RAX2", "CAX8R"), (ridges, "R2D2", "CPE8R")] {
        let deck = deck(&Place::with_scene(scene), "abaqus");
        for line in ["*RIGID BODY, REF NODE=REF, ELSET=TOOL", "TOOL, SPOS", "REF, 1", "REF, 6", "U2, RF2"] {
            assert!(deck.iter().any(|l| l == line), "{line}");
        }
        assert!(
            !deck.iter().any(|l| l.contains("RIGID\n") || l.contains("CalculiX") || l.contains("NAME=RIGID"))
        );
        let nodes: Vec<Vec<f64>> = blocks(&deck, "*NODE").concat();
        let place = |number: f64| nodes.iter().find(|n| n[0] == number).map(|n| [n[1], n[2]]).unwrap();
        let links = blocks(&deck, &format!("*ELEMENT, TYPE={link}")).concat();
        assert!(!links.is_empty());
        // from right to left: turned by 90 degrees to the left that is down
        assert!(links.iter().all(|l| place(l[1])[0] > place(l[2])[0]), "{links:?}");
        // the axis is where it is
        let cells = blocks(&deck, &format!("*ELEMENT, TYPE={body}")).concat();
        let least = cells.iter().flat_map(|cell| &cell[1..]).map(|n| place(*n)[0]).fold(f64::MAX, f64::min);
        assert!(body == "CPE8R" || least == 0.0, "{least}");
    }
}

#[test]
fn what_abaqus_cannot_express_is_refused_with_the_way_out() {
    let scene = SCENE.replace("[[asperity]]", "hardening_mode = \"kinematic\"\n[[asperity]]");
    let place = Place::with_scene(scene);
    let end = place.run(&["mesh", "scene.toml", "--format", "abaqus"]);
    assert_eq!(end.status, 2);
    for word in ["material.hardening_mode", "--format inp", "Abaqus"] {
        assert!(end.err.contains(word), "{word}: {}", end.err);
    }
    let deck = deck(&place, "inp");
    assert!(deck.iter().any(|line| line == "*PLASTIC, HARDENING=KINEMATIC"));
}
