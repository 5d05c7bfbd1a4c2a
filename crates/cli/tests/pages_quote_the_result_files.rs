//! The tables of README.md, of the paper and of the book are those of files that programs wrote
//! (`verification/results`, renewed by `scripts/renew`). Outside quotations README.md states no result in
//! figures.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

/// Numbers that are no results: `words` of the page, and the file with its words that they are taken from.
const GIVEN: [(&str, &str, &str); 4] = [
    ("Rust 1.90 or later", "Cargo.toml", "rust-version = \"1.90\""),
    ("5 % of the force", "crates/simulation/src/scene/accuracy.rs", "Accuracy::Draft => 0.05"),
    ("for 1 %", "crates/simulation/src/scene/accuracy.rs", "Accuracy::Standard => 0.01"),
    ("for 0.2 %", "crates/simulation/src/scene/accuracy.rs", "Accuracy::Reference => 0.002"),
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

/// The names of the pages of the book.
fn book() -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut pages = Vec::new();
    for folder in ["", "verified", "theory", "design", "tutorials", "questions", "reference"] {
        for entry in std::fs::read_dir(root.join("docs/src").join(folder)).unwrap() {
            let name = entry.unwrap().file_name().into_string().unwrap();
            if name.ends_with(".md") {
                pages.push(format!("docs/src/{folder}/{name}"));
            }
        }
    }
    pages
}

#[test]
fn quotations_are_those_of_their_files() {
    for page in ["README.md", "docs/paper.md"].map(String::from).into_iter().chain(book()) {
        for (name, inside) in quotations(&text(&page)).0 {
            assert!(inside == result(&name), "{page} quotes {name} otherwise: scripts/renew --quotes");
        }
    }
}

#[test]
fn the_front_page_quotes_the_overview_and_the_paper_the_numbers() {
    let names = |page: &str| quotations(&text(page)).0.into_iter().map(|(name, _)| name).collect::<Vec<_>>();
    assert_eq!(names("README.md"), ["overview"]);
    assert_eq!(names("docs/paper.md"), ["overview", "numbers"]);
}

/// Every table of `verification/results` stands on a page of the book, so that none is measured for nobody,
/// above a link to its file. None is included: an include shows nothing to those who read the page in the
/// repository.
#[test]
fn the_book_quotes_every_result() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let book: String = book().iter().map(|page| text(page)).collect();
    assert!(
        !book.contains("{{#include"),
        "a page of the book includes a file: quote it by `<!-- results: … -->`"
    );
    for entry in std::fs::read_dir(root.join("verification/results")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let Some(stem) = name.strip_suffix(".md").filter(|stem| *stem != "overview") else { continue };
        let quoted = [" -->", "#"].iter().any(|end| book.contains(&format!("<!-- results: {stem}{end}")));
        let link =
            format!("<!-- end -->\n\n<a class=\"file\" href=\"../../../verification/results/{name}\">");
        assert!(quoted && book.contains(&link), "no page of the book quotes {name} with its link");
    }
}

#[test]
fn every_result_names_its_program() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../verification/results");
    let pages = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    for path in pages.filter(|path| path.extension().is_some_and(|e| e == "md")) {
        let text = std::fs::read_to_string(&path).unwrap();
        let named = text.starts_with("<!-- written by `") || text.starts_with("<!-- measured by hand");
        assert!(named, "{}", path.display());
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

/// True where a number with a point, a share or a multiple ends at or begins in this word.
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
    // the licence's version
    page = page.replace("Apache-2.0", "");
    let words: Vec<&str> = page.split_whitespace().collect();
    for pair in words.windows(2) {
        assert!(!is_result(pair[0], pair[1]), "`{} {}` comes from no file", pair[0], pair[1]);
    }
}

/// The pages of the notebooks hold their cells: an edited notebook is run again with `scripts/run-notebooks
/// --pages`.
#[test]
fn the_pages_of_notebooks_hold_their_cells() {
    for name in ["a-scene-of-my-own", "the-paper-in-a-minute"] {
        let page = text(&format!("docs/src/tutorials/{name}.md"));
        let notebook: serde_json::Value =
            serde_json::from_str(&text(&format!("python/notebooks/{name}.ipynb"))).unwrap();
        for cell in notebook["cells"].as_array().unwrap() {
            let source: String =
                cell["source"].as_array().unwrap().iter().filter_map(|line| line.as_str()).collect();
            assert!(page.contains(&source), "{name}: the page lacks {source}");
        }
    }
}
