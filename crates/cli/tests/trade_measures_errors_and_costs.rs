//! Claim: `trade` leaves a row a setting, the front is what nothing beats, and what the scene fixes is not
//! varied.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::{Place, SCENE};

/// Everything fixed but steps and penetration: a trade of seconds.
fn scene() -> String {
    let rest = "element = \"q8r\"\nnewton_tolerance = 1e-6\ndomain = 60\n";
    SCENE.replace("steps = 8\n", "") + rest
}

#[test]
fn table_front_and_picture() {
    let place = Place::with_scene(scene());
    let done = place.run(&["trade", "scene.toml", "--combinations", "2", "--out", "out", "--threads", "2"]);
    assert_eq!(done.status, 0, "{}", done.err);
    assert!(done.out.contains("the converged force is known to"), "{}", done.out);
    assert_eq!(place.names("out"), [".asperity-run", "trade.csv", "trade.md", "trade.svg"]);
    assert!(!place.path("out.journal").exists());

    let table = place.text("out/trade.csv");
    let mut lines = table.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let header = lines.next().unwrap();
    let column = |name: &str| header.iter().position(|h| *h == name).unwrap();
    let rows: Vec<Vec<&str>> = lines.collect();
    let number = |row: &Vec<&str>, name: &str| row[column(name)].parse::<f64>().unwrap();
    assert!(rows.len() >= 15, "{table}");
    for row in &rows {
        assert_eq!((row[column("elements_in_contact")], row[column("status")]), ("6", "ok"));
        // the promise of draft, and a tenth of it for what is read after the peak: the worst row has 3.8 % of
        // the force, 0.35 % of the elastic fraction and 0.26 % of the depth
        assert!((1e-6..0.05).contains(&number(row, "force_error")) && number(row, "core_s") > 0.0);
        let after = ["elastic_fraction_error", "residual_depth_error"].map(|name| number(row, name));
        assert!(after.iter().all(|error| (0.0..0.005).contains(error)), "{row:?}");
    }
    for level in ["draft", "3%", "standard", "reference"] {
        assert!(rows.iter().any(|r| r[0] == "level" && r[1] == level), "{level} is missing");
    }
    let front: Vec<_> = rows.iter().filter(|r| r[column("on_front")] == "true").collect();
    assert!(!front.is_empty());
    for row in &rows {
        let beaten = |f: &&Vec<&str>| {
            number(f, "core_s") <= number(row, "core_s")
                && number(f, "force_error") <= number(row, "force_error")
        };
        assert!(front.iter().copied().any(|f| beaten(&f)), "{row:?}");
    }
    assert!(place.text("out/trade.svg").contains("core seconds"));
}

#[test]
fn trade_refuses_an_imported_mesh() {
    let place = Place::with_scene(scene());
    assert_eq!(place.run(&["mesh", "scene.toml", "-o", "body.msh", "--quiet"]).status, 0);
    let done = place.run(&["trade", "scene.toml", "--set", "mesh.file=body.msh"]);
    assert_eq!(done.status, 2);
    assert!(done.err.contains("leave [mesh] out"), "{}", done.err);
    assert!(place.names("out").is_empty());
}
