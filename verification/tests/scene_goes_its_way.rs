//! Claim: the page *A scene's way* (`docs/src/design/scene.md`) lists files that are there with functions
//! that they have, marks each file that is entered again, and stays short: at most 28 lines, 13 of them
//! entered again.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;

const LINES: usize = 28;
const ENTERED_AGAIN: usize = 13;

/// The text between backticks in a cell.
fn quoted(cell: &str) -> &str {
    cell.split('`').nth(1).unwrap()
}

#[test]
fn each_function_is_in_its_file() {
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = std::fs::read_to_string(top.join("docs/src/design/scene.md")).unwrap();
    let rows: Vec<Vec<&str>> = page
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains(".rs`"))
        .map(|line| line.split('|').map(str::trim).collect())
        .collect();
    let mut entered = BTreeSet::new();
    let mut again = 0;
    for (index, row) in rows.iter().enumerate() {
        let [_, number, file, function, _, _] = row[..] else { panic!("a row of four cells: {row:?}") };
        assert_eq!(number, (index + 1).to_string());
        let is_again = !entered.insert(quoted(file));
        again += usize::from(is_again);
        assert_eq!(file.ends_with("(again)"), is_again, "{file}");
        let source = std::fs::read_to_string(top.join("crates").join(quoted(file))).unwrap();
        let head = format!("fn {}", quoted(function));
        let has =
            source.match_indices(&head).any(|(at, _)| source[at + head.len()..].starts_with(['(', '<']));
        assert!(has, "{} has no function {}", quoted(file), quoted(function));
    }
    assert!(
        (1..=LINES).contains(&rows.len()) && again <= ENTERED_AGAIN,
        "{} lines, {again} again",
        rows.len()
    );
}
