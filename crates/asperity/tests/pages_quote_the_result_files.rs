//! The numbers of README.md and of the pages of the verification are those of files that programs wrote
//! (`verification/results`, renewed by `scripts/renew`). Outside those quotations README.md states no result in figures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

/// Numbers that are no results: `words` of the page, and the file with its words that they are taken from.
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

/// The text between `start` and `end`, and the page without it.
fn cut(page: &str, start: &str, end: &str) -> Option<(String, String)> {
    let (before, rest) = page.split_once(start)?;
    let (inside, after) = rest.split_once(end)?;
    Some((inside.into(), format!("{before}\n{after}")))
}

/// The quotations of a page: names and texts, and the page without them.
fn quotations(page: &str) -> (Vec<(String, String)>, String) {
    let (mut quoted, mut page) = (Vec::new(), page.to_string());
    while let Some((block, rest)) = cut(&page, "<!-- results: ", "<!-- end -->") {
        let (name, inside) = block.split_once(" -->\n").unwrap();
        quoted.push((name.into(), inside.into()));
        page = rest;
    }
    (quoted, page)
}

/// `verification/results/NAME.md` without its first line; of NAME#heading the section under that heading.
fn result(name: &str) -> String {
    let (file, heading) = name.split_once('#').unwrap_or((name, ""));
    let whole = text(&format!("verification/results/{file}.md"));
    let body = whole.split_once('\n').unwrap().1;
    let section = if heading.is_empty() {
        Some(body)
    } else {
        let mut parts = body.split("\n## ").filter_map(|part| part.split_once('\n'));
        parts.find(|(title, _)| title.to_lowercase().replace(' ', "-") == heading).map(|p| p.1)
    };
    let section = section.unwrap_or_else(|| panic!("{file}.md has no section {heading}"));
    format!("{}\n", section.trim_matches('\n'))
}

/// README.md and the pages of the verification.
fn pages() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification");
    let names = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
    let pages = names.filter(|name| name.ends_with(".md")).map(|name| format!("verification/{name}"));
    pages.chain(["README.md".to_string()]).collect()
}

#[test]
fn quotations_are_those_of_their_files() {
    for page in pages() {
        for (name, inside) in quotations(&text(&page)).0 {
            assert!(inside == result(&name), "{page} quotes {name} otherwise: scripts/renew --quotes");
        }
    }
}

#[test]
fn the_front_page_quotes_claims_numbers_trade_and_peers() {
    let names: Vec<String> = quotations(&text("README.md")).0.into_iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["claims", "numbers", "peers#summary", "trade"]);
}

#[test]
fn every_result_names_its_program() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/results");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let named = text.starts_with("<!-- written by `") || text.starts_with("<!-- measured by hand");
        assert!(named || path.extension().is_some_and(|e| e != "md"), "{}", path.display());
    }
}

/// The tables on the page and claims.json are of one run.
#[test]
fn claims_and_numbers_are_of_one_report() {
    let written: serde_json::Value = serde_json::from_str(&text("verification/results/claims.json")).unwrap();
    let ours: Vec<f64> =
        written["numbers"].as_object().unwrap().values().map(|v| v.as_f64().unwrap()).collect();
    let table = result("numbers");
    let rows: Vec<&str> = table.lines().skip(2).collect();
    assert_eq!(rows.len(), ours.len());
    for row in rows {
        let number = row.trim_end_matches([' ', '|']).rsplit(' ').next().unwrap();
        let decimals = number.split_once('.').map_or(0, |(_, digits)| digits.len());
        assert!(ours.iter().any(|value| format!("{value:.decimals$}") == number), "{row}");
    }
    let claims: Vec<&serde_json::Value> = written["claims"].as_array().unwrap().iter().collect();
    let table = result("claims");
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
fn text_outside_quotations_holds_no_result() {
    let mut page = quotations(&text("README.md")).1;
    for (start, end) in [("```", "```"); 20].into_iter().chain([("`", "`"); 400]).chain([("](", ")"); 60]) {
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
