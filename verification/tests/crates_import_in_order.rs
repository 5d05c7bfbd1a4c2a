//! Claim: imports between the crates go one way, as the map of `docs/src/design/index.md` and the READMEs
//! say. Cargo refuses circles alone; this test reads the manifests and refuses the rest: a ground crate that
//! learns mechanics, a paper that reaches below the library, a second crate that names a package which one
//! crate stands for.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use std::collections::BTreeSet;
use std::path::Path;
use toml::Table;

/// The folder of each crate and the crates of the workspace that it may import, without their prefix
/// `asperity-`.
const MAY_IMPORT: [(&str, &[&str]); 15] = [
    ("crates/numerics", &[]),
    ("crates/formats", &["numerics"]),
    ("crates/material", &["numerics", "formats"]),
    ("crates/mesh", &["numerics", "formats", "material"]),
    ("crates/solver", &["numerics", "material", "mesh"]),
    ("crates/simulation", &["numerics", "material", "mesh", "solver"]),
    ("crates/calibration", &["numerics", "formats", "material", "mesh", "solver", "simulation"]),
    (
        "crates/identification",
        &["numerics", "formats", "material", "mesh", "solver", "simulation", "calibration"],
    ),
    ("crates/roughness", &["numerics", "formats", "material"]),
    ("crates/decks", &["numerics", "material", "mesh", "solver", "simulation"]),
    ("crates/draw", &["numerics", "formats", "material", "mesh", "solver", "simulation", "roughness"]),
    (
        "crates/asperity",
        &[
            "numerics",
            "formats",
            "material",
            "mesh",
            "solver",
            "simulation",
            "calibration",
            "identification",
            "roughness",
            "decks",
            "draw",
        ],
    ),
    ("crates/paper", &["asperity"]),
    ("crates/cli", &["asperity", "paper"]),
    ("python", &["asperity"]),
];

/// Packages that one crate names for all; the verification may hold its own numbers against them.
const ONE_NAMES: [(&str, &str); 3] =
    [("faer", "crates/numerics"), ("sprs", "crates/numerics"), ("vtkio", "crates/mesh")];

fn manifest(folder: &str) -> Table {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(folder).join("Cargo.toml");
    std::fs::read_to_string(path).unwrap().parse().unwrap()
}

/// Names of the packages in a table of dependencies.
fn dependencies(manifest: &Table, table: &str) -> BTreeSet<String> {
    let names = manifest.get(table).and_then(|t| t.as_table()).into_iter().flat_map(Table::keys);
    names.cloned().collect()
}

/// The crates of the workspace among `names`, without their prefix.
fn of_the_workspace(names: &BTreeSet<String>) -> BTreeSet<&str> {
    names
        .iter()
        .filter_map(|name| if name == "asperity" { Some("asperity") } else { name.strip_prefix("asperity-") })
        .collect()
}

#[test]
fn every_crate_imports_what_it_may() {
    for (folder, allowed) in MAY_IMPORT {
        let manifest = manifest(folder);
        let allowed: BTreeSet<&str> = allowed.iter().copied().collect();
        for table in ["dependencies", "build-dependencies"] {
            let names = dependencies(&manifest, table);
            let beyond: Vec<_> = of_the_workspace(&names).difference(&allowed).copied().collect();
            assert!(beyond.is_empty(), "{folder} may not import {beyond:?}: see its README");
        }
        // tests of the command hold it against closed forms; no other crate knows the verification
        let names = dependencies(&manifest, "dev-dependencies");
        let mut for_tests = of_the_workspace(&names);
        if folder == "crates/cli" {
            for_tests.remove("verification");
        }
        let beyond: Vec<_> = for_tests.difference(&allowed).copied().collect();
        assert!(beyond.is_empty(), "tests of {folder} may not import {beyond:?}");
    }
}

#[test]
fn every_crate_of_the_folder_is_in_the_order() {
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("../crates");
    for entry in std::fs::read_dir(crates).unwrap() {
        let entry = entry.unwrap();
        let folder = format!("crates/{}", entry.file_name().to_str().unwrap());
        let listed = MAY_IMPORT.iter().any(|(name, _)| *name == folder);
        assert!(listed || !entry.path().join("Cargo.toml").exists(), "{folder} has no place in the order");
    }
}

#[test]
fn one_crate_stands_for_each_of_these_packages() {
    for (package, only) in ONE_NAMES {
        for (folder, _) in MAY_IMPORT {
            let manifest = manifest(folder);
            let named = ["dependencies", "dev-dependencies", "build-dependencies"]
                .iter()
                .any(|table| dependencies(&manifest, table).contains(package));
            assert_eq!(named, folder == only, "{package} in {folder}");
        }
    }
}
