//! The numbers of README.md are those of files that `asperity reproduce` wrote at `standard`:
//! `cp out/reproduce/report/claims.{md,json} verification/`, then the table into README.md.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::path::Path;

fn text(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The number that follows `words` in `text`, as it is written.
fn quoted<'a>(text: &'a str, words: &str) -> &'a str {
    let rest = text.split(words).nth(1).unwrap_or_else(|| panic!("the page does not say `{words}`"));
    let rest = rest.trim_start_matches([' ', '|']);
    let end = rest.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(rest.len());
    rest[..end].trim_end_matches('.')
}

#[test]
fn the_table_of_claims_is_that_of_the_report() {
    let page = text("README.md");
    let block = page.split("<!-- claims -->\n").nth(1).unwrap().split("<!-- /claims -->").next().unwrap();
    assert_eq!(block, text("verification/claims.md"));
}

/// Each number is ours, rounded to the digits that the page gives.
#[test]
fn every_number_is_one_that_was_written() {
    let page = text("README.md");
    let written: serde_json::Value = serde_json::from_str(&text("verification/claims.json")).unwrap();
    for (words, name) in [
        ("| F at 1 µm, N |", "force_at_1_um_N"),
        ("| F at 2 µm, N |", "force_at_2_um_N"),
        ("| F at 5 µm, N |", "force_at_5_um_N"),
        ("| residual depth, µm |", "residual_depth_um"),
        ("| elastic share of the work, % |", "elastic_share_percent"),
        ("\nc = ", "coefficient"),
        ("with a 95 % interval of ", "coefficient_low"),
        ("with a 95 % interval of 0.129 to ", "coefficient_high"),
    ] {
        let number = quoted(&page, words);
        let digits = number.split('.').nth(1).map_or(0, str::len);
        let ours = written["numbers"][name].as_f64().unwrap_or_else(|| panic!("{name} was not written"));
        assert_eq!(number, format!("{ours:.digits$}"), "{name}");
    }
}
