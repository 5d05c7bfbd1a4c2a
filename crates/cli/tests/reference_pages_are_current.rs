//! The pages of the book that list commands, keys, columns and units are what the program writes.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use common::Place;
use std::path::Path;

#[test]
fn the_program_writes_the_pages_that_the_book_holds() {
    let place = Place::with_scene("");
    let end = place.run(&["reference", "--out", "pages"]);
    assert_eq!((end.status, end.err.as_str()), (0, ""));
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/src/reference");
    let names = place.names("pages");
    assert_eq!(names, ["columns.md", "commands.md", "keys.md", "units.md"]);
    for name in names {
        let held = std::fs::read_to_string(book.join(&name)).unwrap();
        let written = place.text(&format!("pages/{name}"));
        assert!(held == written, "{name} is stale: asperity reference --out docs/src/reference");
    }
}

#[test]
fn every_column_and_every_key_says_what_it_means() {
    let place = Place::with_scene("");
    place.run(&["reference", "--out", "pages"]);
    for name in ["columns.md", "commands.md", "keys.md"] {
        for line in place.text(&format!("pages/{name}")).lines().filter(|line| line.starts_with("| `")) {
            let meaning = line.split(" | ").nth(1).unwrap();
            assert!(meaning.len() > 3, "{name}: {line}");
        }
    }
}
