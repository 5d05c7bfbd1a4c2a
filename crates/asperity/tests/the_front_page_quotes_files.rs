//! The numbers of README.md are those of files: of what `asperity reproduce` wrote at `standard`
//! (`cp out/reproduce/report/{claims,numbers}.md out/reproduce/report/claims.json verification/`, then the tables into
//! README.md), of the trade and of the comparison with CalculiX. Outside those blocks it states no result in figures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

/// Numbers that are no results: `words` of the page, and what some file says in their place.
const GIVEN: [(&str, &str, &str); 5] = [
    ("Rust 1.90 or later", "Cargo.toml", "rust-version = \"1.90\""),
    ("ν 0.3,", "meshes/single-asperity.toml", "poissons_ratio = 0.3"),
    ("n 0.3,", "meshes/single-asperity.toml", "hardening_exponent = 0.3"),
    ("mean pressure 0.13 E*", "verification/ROUGH.md", "`published` (0.13 on the island)"),
    ("exact 0.5 E* tan β", "verification/ROUGH.md", "the exact elastic mean pressure is 0.5 E* tan β"),
];

fn text(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// What stands between `start` and `end`, and the page without it.
fn cut(page: &str, start: &str, end: &str) -> Option<(String, String)> {
    let (before, rest) = page.split_once(start)?;
    let (inside, after) = rest.split_once(end)?;
    Some((inside.into(), format!("{before}\n{after}")))
}

fn block(name: &str) -> String {
    let found = cut(&text("README.md"), &format!("<!-- {name} -->\n"), &format!("<!-- /{name} -->"));
    found.unwrap_or_else(|| panic!("the page has no block {name}")).0
}

#[test]
fn tables_are_those_of_their_files() {
    for name in ["claims", "numbers", "trade"] {
        assert_eq!(block(name), text(&format!("verification/{name}.md")), "{name}");
    }
    assert!(text("verification/PEERS.md").contains(&block("peers")), "{}", block("peers"));
}

/// The tables on the page and claims.json are of one run.
#[test]
fn numbers_are_those_of_the_report() {
    let written: serde_json::Value = serde_json::from_str(&text("verification/claims.json")).unwrap();
    let ours: Vec<f64> =
        written["numbers"].as_object().unwrap().values().map(|v| v.as_f64().unwrap()).collect();
    let table = text("verification/numbers.md");
    let rows: Vec<&str> = table.lines().skip(2).collect();
    assert_eq!(rows.len(), ours.len());
    for row in rows {
        let number = row.trim_end_matches([' ', '|']).rsplit(' ').next().unwrap();
        let decimals = number.split_once('.').map_or(0, |(_, digits)| digits.len());
        assert!(ours.iter().any(|value| format!("{value:.decimals$}") == number), "{row}");
    }
    let claims: Vec<&serde_json::Value> = written["claims"].as_array().unwrap().iter().collect();
    let table = text("verification/claims.md");
    assert_eq!(table.lines().count(), claims.len() + 2);
    for claim in claims {
        assert!(table.contains(claim["ours"].as_str().unwrap()), "{claim}");
    }
}

/// Whether a number with a point, a share or a multiple ends at or begins in this word.
fn is_result(word: &str, next: &str) -> bool {
    let bare = word.trim_matches(|c: char| !c.is_ascii_digit());
    let number = bare.contains(|c: char| c.is_ascii_digit());
    let unit = next.trim_matches(|c: char| !c.is_alphanumeric() && c != '%');
    number
        && (bare.contains('.') || word.contains('%') || unit == "%" || unit == "times" || unit == "seconds")
}

#[test]
fn what_is_not_quoted_holds_no_result() {
    let mut page = text("README.md");
    for (start, end) in [("<!-- claims -->", "<!-- /claims -->"), ("<!-- numbers -->", "<!-- /numbers -->")]
        .into_iter()
        .chain([("<!-- trade -->", "<!-- /trade -->"), ("<!-- peers -->", "<!-- /peers -->")])
        .chain([("```", "```"); 20].into_iter().chain([("`", "`"); 400]))
        .chain([("](", ")"); 60])
    {
        if let Some((_, rest)) = cut(&page, start, end) {
            page = rest;
        }
    }
    for (words, file, there) in GIVEN {
        assert!(page.contains(words), "the page no longer says `{words}`");
        assert!(text(file).contains(there), "{file} no longer says `{there}`");
        page = page.replace(words, "");
    }
    // the levels' promises and the licence's version
    page = page.replace("Apache-2.0", "").replace("Gmsh 4.1", "");
    let words: Vec<&str> = page.split_whitespace().collect();
    for pair in words.windows(2) {
        assert!(!is_result(pair[0], pair[1]), "`{} {}` comes from no file", pair[0], pair[1]);
    }
}
