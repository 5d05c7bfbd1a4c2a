//! Claims about TOML files and overrides.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity::error::InputError;
use asperity::input::toml_file::*;
use serde::Deserialize;
use std::path::Path;

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Leaf {
    size: f64,
    name: Option<String>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Tree {
    count: usize,
    #[serde(default)]
    leaf: Vec<Leaf>,
    trunk: Option<Leaf>,
    list: Option<Vec<f64>>,
}

const FILE: &str =
    "count = 3\n\n[[leaf]]\nsize = 1.5\n[[leaf]]\nsize = 2 # the second\n\n[trunk]\nsize = 9\n";

/// An error as a person sees it: place, text of the place, message, help.
fn shown(error: &InputError) -> String {
    let place = error.place.as_ref().map(|p| {
        let line = 1 + p.text[..p.span.start].matches('\n').count();
        format!("{}:{line}: {}", p.name, p.text)
    });
    format!("{} {error} {}", place.unwrap_or_default(), error.help.as_deref().unwrap_or_default())
}

fn read(text: &[u8], overrides: &[&str]) -> Result<TomlFile<Tree>, String> {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("tree.toml");
    std::fs::write(&path, text).unwrap();
    let overrides: Vec<String> = overrides.iter().map(|s| s.to_string()).collect();
    TomlFile::read(&path, &overrides).map_err(|e| shown(&e))
}

#[test]
fn overrides_change_add_and_append() {
    let set = [
        "count=4",
        "leaf[1].size = 7",
        "leaf.0.name=oak tree",
        "leaf[2].size=8e-1",
        "trunk.name=\"5\"",
        "list=[1, 2.5]",
        "trunk.size= -.5 ",
    ];
    let tree = read(FILE.as_bytes(), &set).unwrap().value;
    let leaf = |size, name: Option<&str>| Leaf { size, name: name.map(Into::into) };
    assert_eq!(tree.count, 4);
    assert_eq!(tree.leaf, [leaf(1.5, Some("oak tree")), leaf(7.0, None), leaf(0.8, None)]);
    assert_eq!((tree.trunk, tree.list), (Some(leaf(-0.5, Some("5"))), Some(vec![1.0, 2.5])));
    let built = read(b"count = 1\n", &["leaf[0].size=+1.", "trunk.size=2"]).unwrap().value;
    assert_eq!((built.leaf, built.trunk), (vec![leaf(1.0, None)], Some(leaf(2.0, None))));
}

#[test]
fn a_wrong_override_is_shown_as_it_was_typed() {
    for (set, message) in [
        ("count", "key.path=value"),
        ("=4", "key.path=value"),
        ("count=", "key.path=value"),
        ("leaf[5].size=1", "from 0 to 2"),
        ("leaf.size=1", "from 0 to 2"),
        ("count.x=1", "is a integer, not a table"),
        ("trunk.colour=1", "unknown key `colour`"),
        ("trunk.size=wide", "expected a number"),
    ] {
        let error = read(FILE.as_bytes(), &[set]).unwrap_err();
        assert!(
            error.contains(message) && error.contains("--set:1") && error.contains(set),
            "{set}: {error}"
        );
    }
}

#[test]
fn errors_point_at_the_line() {
    for (old, new, line, message) in [
        ("count = 3", "count = -3", 1, "count"),
        ("count = 3", "count = 3\ncuont = 3", 2, "unknown key `cuont`"),
        ("size = 2", "siez = 2", 6, "did you mean `size`"),
        ("size = 9", "", 8, "`size` is missing"),
        ("size = 9", "size = ", 9, "tree.toml:9"),
        ("size = 9", "size = \"9\"", 9, "without quotes"),
        ("[trunk]", "[trunk", 8, "tree.toml:8"),
        ("[trunk]", "[count]", 8, "tree.toml:8"),
    ] {
        let error = read(FILE.replacen(old, new, 1).as_bytes(), &[]).unwrap_err();
        assert!(error.contains(&format!("tree.toml:{line}:")) && error.contains(message), "{new}: {error}");
    }
    let error = read(b"[trunk]\nsize = 1\n", &[]).unwrap_err();
    assert!(error.contains("`count` is missing") && error.contains("tree.toml"), "{error}");
}

#[test]
fn what_is_no_text_is_refused() {
    assert!(read(b"", &[]).unwrap_err().contains("empty"));
    assert!(read(b" \n\n", &[]).unwrap_err().contains("empty"));
    assert!(read(b"count = 1\n\xff\xfe", &[]).unwrap_err().contains("line 2, byte 11"));
    assert!(read(b"\x00\x01[[[", &[]).unwrap_err().contains("tree.toml:1"));
    let missing = TomlFile::<Tree>::read(Path::new("/nowhere/tree.toml"), &[]).unwrap_err();
    assert!(missing.to_string().contains("/nowhere/tree.toml"));
    assert!(TomlFile::<Tree>::read(Path::new("/"), &[]).unwrap_err().to_string().contains("cannot read /"));
    if Path::new("/dev/zero").exists() {
        let endless = TomlFile::<Tree>::read(Path::new("/dev/zero"), &[]).unwrap_err();
        assert!(endless.to_string().contains("larger than 16 MB"));
    }
}

#[test]
fn a_later_error_points_at_the_value_or_the_table_that_lacks_it() {
    let file = read(FILE.as_bytes(), &["trunk.size=4"]).unwrap();
    for (path, place) in [
        ("leaf[1].size", "tree.toml:6:"),
        ("leaf[1]", "tree.toml:5:"),
        ("leaf[0].name", "tree.toml:3:"),
        ("count", "tree.toml:1:"),
        ("trunk.size", "--set:1:"),
        ("trunk", "tree.toml:8:"),
        ("list", "tree.toml: list: odd"),
    ] {
        let error = shown(&file.error_at(path, "odd"));
        assert!(error.contains(place) && error.contains(&format!("{path}: odd")), "{path}: {error}");
    }
}

#[test]
fn a_decimal_comma_is_told() {
    for (text, way) in [("count = 3\ntrunk.size = 0,34\n", "0.34"), ("trunk.size = -2,5 # mm\n", "-2.5")] {
        let told = read(text.as_bytes(), &[]).unwrap_err();
        assert!(told.ends_with(&format!("write the decimal point: {way}")), "{told}");
    }
    let told = read(b"trunk.size = 1,000\n", &[]).unwrap_err();
    assert!(told.ends_with("write numbers without a comma: 1.000 or 1000"), "{told}");
    let told = read(b"list = [1,2\n", &[]).unwrap_err();
    assert!(!told.contains("decimal point"), "{told}");
}
