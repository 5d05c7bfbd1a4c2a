//! The examples of README.md run as they stand: the commands here, the Rust program as the example
//! `front_page`, the Python one in the tests of the package.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;
use std::path::Path;

fn readme() -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../../README.md")).unwrap()
}

/// The code blocks of the front page in `language`.
fn blocks(language: &str) -> Vec<String> {
    let fence = format!("```{language}\n");
    readme().split(fence.as_str()).skip(1).map(|rest| rest.split("```").next().unwrap().to_string()).collect()
}

#[test]
fn the_commands_of_the_front_page_run() {
    let place = Place::with_scene("");
    let block = blocks("sh").into_iter().find(|block| block.contains("asperity new")).unwrap();
    for line in block.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        assert_eq!(words[0], "asperity");
        let end = place.run(&words[1..]);
        assert_eq!(end.status, 0, "{line}: {}", end.err);
    }
    let summary: serde_json::Value = serde_json::from_str(&place.text("out/single/summary.json")).unwrap();
    // what is stated is what the run is off by, of the right size: a finer run says how far that is
    let finer = place.run(&[
        "crush",
        "single.toml",
        "--accuracy",
        "reference",
        "--no-refine",
        "--out",
        "finer",
        "--json",
    ]);
    assert_eq!(finer.status, 0, "{}", finer.err);
    let finer: serde_json::Value = serde_json::from_str(&finer.out).unwrap();
    for (error, key, over) in [
        ("force", "peak_force_N", "peak_force_N"),
        ("contact_area", "contact_area_um2", "contact_area_um2"),
        ("residual_depth", "residual_depth_um", "peak_depth_um"),
    ] {
        let of = |summary: &serde_json::Value, key: &str| summary[key].as_f64().unwrap();
        let true_error = (of(&summary, key) - of(&finer, key)).abs() / of(&finer, over);
        let [stated, finer_stated] = [&summary, &finer].map(|s| s["errors"][error].as_f64().unwrap());
        assert!(true_error < stated + finer_stated, "{error}: {true_error} {stated} {finer_stated}");
        // a constant would pass that: from 10 elements to 36 an error of the order 0.8 falls to a third, and
        // half leaves room for its chance
        assert!(
            finer_stated > 0.0 && finer_stated < 0.5 * stated && stated < 0.05,
            "{error}: {finer_stated} {stated}"
        );
    }
}

#[test]
fn the_rust_program_of_the_front_page_is_an_example_that_runs() {
    let example = include_str!("../../asperity/examples/front_page.rs");
    assert_eq!(
        blocks("rust"),
        [example.split_once("\n\nuse ").map(|(_, rest)| format!("use {rest}")).unwrap()]
    );
    let printed = common::printed_by_the_example("front_page");
    let force: f64 = printed.strip_suffix(" N\n").unwrap().parse().unwrap();
    // the force of the paper's asperity at 5 um, from two other codes: 5.51 N
    assert!((force / 5.51 - 1.0).abs() < 0.01, "{force}");
}
