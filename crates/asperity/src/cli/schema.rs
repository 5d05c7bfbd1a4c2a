//! `asperity schema`: what a file may hold, as a JSON schema that editors complete and check with.
//!
//! The schemas are kept by hand, for their words; a test holds their keys against the types that read the files.

use crate::cli::terminal;
use clap::{Args, ValueEnum};

/// Arguments of `asperity schema`.
#[derive(Debug, Args)]
pub struct SchemaCommand {
    /// Which file
    #[arg(value_enum, default_value = "scene")]
    pub kind: SchemaKind,
}

/// Files that the program reads.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum SchemaKind {
    /// of `asperity crush` and `asperity mesh`
    Scene,
    /// of `asperity rough`
    Rough,
    /// of `asperity calibrate`
    Sweep,
}

/// Prints the schema.
pub fn schema(args: &SchemaCommand) {
    terminal::say(text(args.kind).trim_end());
}

fn text(kind: SchemaKind) -> &'static str {
    match kind {
        SchemaKind::Scene => include_str!("schema/scene.json"),
        SchemaKind::Rough => include_str!("schema/rough.json"),
        SchemaKind::Sweep => include_str!("schema/sweep.json"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Error;
    use crate::input::toml_file::TomlFile;
    use serde::de::DeserializeOwned;
    use serde_json::Value;
    use std::collections::BTreeSet;
    use std::path::Path;

    /// The keys that the type behind `toml` knows in the table at `path`, by what it says of a foreign one.
    fn known<T: DeserializeOwned + std::fmt::Debug>(toml: &str, path: &str) -> BTreeSet<String> {
        let key = if path.is_empty() { "zzz=1".to_string() } else { format!("{path}.zzz=1") };
        let error = TomlFile::<T>::parse(Path::new("scene"), toml.into(), &[key]).unwrap_err();
        let report = crate::cli::failure::report(error.into());
        let list = report.to_lowercase();
        let list = list.split("known here: ").nth(1).unwrap_or_else(|| panic!("{path}: {report}"));
        list.split([',', '\n']).map(|key| key.trim().to_string()).filter(|key| !key.is_empty()).collect()
    }

    /// The tables of a schema and the path that leads to each.
    fn tables(schema: &Value, path: &str, found: &mut Vec<(String, BTreeSet<String>)>) {
        let Some(properties) = schema["properties"].as_object() else { return };
        found.push((path.to_string(), properties.keys().cloned().collect()));
        for (key, value) in properties {
            let inner = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
            tables(value, &inner, found);
            tables(&value["items"], &format!("{inner}[0]"), found);
        }
    }

    fn agrees<T: DeserializeOwned + std::fmt::Debug>(kind: SchemaKind, toml: &str) {
        let schema: Value = serde_json::from_str(text(kind)).unwrap();
        let mut found = Vec::new();
        tables(&schema, "", &mut found);
        for (path, keys) in found {
            assert_eq!(known::<T>(toml, &path), keys, "{path}");
        }
    }

    #[test]
    fn the_keys_are_those_of_the_types() {
        agrees::<asperity_solver::scene::Scene>(
            SchemaKind::Scene,
            include_str!("../../scenes/single-asperity.toml"),
        );
        agrees::<asperity_roughness::scene::Scene>(
            SchemaKind::Rough,
            include_str!("../../scenes/rough-milled.toml"),
        );
        agrees::<asperity_calibration::sweep::Sweep>(SchemaKind::Sweep, "poissons_ratio = 0.3\n");
    }

    /// A word that the schema allows is one that the program reads.
    #[test]
    fn every_choice_is_read() {
        let scene = include_str!("../../scenes/single-asperity.toml");
        for (kind, keys) in [(SchemaKind::Scene, ["symmetry", "accuracy", "lateral"])] {
            let schema: Value = serde_json::from_str(text(kind)).unwrap();
            for key in keys {
                let property = &schema["properties"][key];
                // a level by name stands beside a percentage
                let words = property["enum"].as_array().or(property["anyOf"][0]["enum"].as_array());
                for word in words.unwrap() {
                    let change = format!("{key}={}", word.as_str().unwrap());
                    let read = TomlFile::<asperity_solver::scene::Scene>::parse(
                        Path::new("scene"),
                        scene.into(),
                        &[change],
                    );
                    assert!(read.is_ok(), "{key} {word}");
                }
            }
        }
    }
}
