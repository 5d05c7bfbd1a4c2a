//! `asperity schema`: what a file may hold, as a JSON schema that editors complete and check with.
//!
//! The schemas are made from the types that read the files; the descriptions of the keys are their
//! docstrings.

use crate::terminal;
use asperity::error::Error;
use clap::{Args, ValueEnum};
use schemars::generate::SchemaSettings;
use schemars::transform::RecursiveTransform;
use schemars::{JsonSchema, Schema};
use serde_json::Value;

/// Arguments of `asperity schema`.
#[derive(Debug, Args)]
pub struct SchemaCommand {
    /// The kind of file
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
    /// of `asperity study`
    Study,
    /// of `asperity identify`
    Fit,
}

/// Prints the schema.
///
/// # Errors
/// A disk that refuses.
pub fn schema(args: &SchemaCommand) -> Result<(), Error> {
    let text = serde_json::to_string_pretty(&of_kind(args.kind));
    terminal::say(&text.map_err(|e| Error::Unfinished(e.to_string()))?)?;
    Ok(())
}

pub(super) fn of_kind(kind: SchemaKind) -> Schema {
    match kind {
        SchemaKind::Scene => of_type::<asperity::simulation::scene::Scene>(),
        SchemaKind::Rough => of_type::<asperity::roughness::scene::Scene>(),
        SchemaKind::Sweep => of_type::<asperity::calibration::sweep::Sweep>(),
        SchemaKind::Study => of_type::<asperity::study::StudyFile>(),
        SchemaKind::Fit => of_type::<asperity::identify::FitFile>(),
    }
}

/// The schema of a file that holds a `T`, each table where it stands: editors follow references less well.
fn of_type<T: JsonSchema>() -> Schema {
    SchemaSettings::draft2020_12()
        .with(|settings| settings.inline_subschemas = true)
        .with_transform(RecursiveTransform(without_null))
        .into_generator()
        .into_root_schema_for::<T>()
}

/// TOML has no null: a key without a value is left out.
fn without_null(schema: &mut Schema) {
    if let Some(Value::Array(types)) = schema.get_mut("type") {
        types.retain(|name| name != "null");
        if let [only] = &types[..] {
            let only = only.clone();
            schema.insert("type".into(), only);
        }
    }
    if let Some(Value::Array(choices)) = schema.get_mut("enum") {
        choices.retain(|choice| !choice.is_null());
    }
    let Some(Value::Array(forms)) = schema.get_mut("anyOf") else { return };
    forms.retain(|form| form["type"] != "null");
    if let [Value::Object(only)] = &mut forms[..] {
        let only = std::mem::take(only);
        schema.remove("anyOf");
        for (key, value) in only {
            // what the key says of itself goes before what its type says
            if schema.get(&key).is_none() {
                schema.insert(key, value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The tables of a schema by the path that leads to each.
    fn tables<'s>(schema: &'s Value, path: &str, found: &mut Vec<(String, &'s Value)>) {
        let Some(properties) = schema["properties"].as_object() else { return };
        found.push((path.to_string(), schema));
        for (key, value) in properties {
            tables(value, &format!("{path}.{key}"), found);
            tables(&value["items"], &format!("{path}.{key}[]"), found);
        }
    }

    #[test]
    fn every_table_is_there_closed_and_every_key_described() {
        for (kind, count) in
            [(SchemaKind::Scene, 16), (SchemaKind::Rough, 13), (SchemaKind::Sweep, 1), (SchemaKind::Fit, 7)]
        {
            let schema = of_kind(kind).to_value();
            let text = schema.to_string();
            assert!(!text.contains("null") && !text.contains("$ref"), "{schema:#}");
            let mut found = Vec::new();
            tables(&schema, "", &mut found);
            assert_eq!(found.len(), count, "{kind:?}");
            for (path, table) in found {
                assert_eq!(table["additionalProperties"], false, "{path}");
                for (key, value) in table["properties"].as_object().unwrap() {
                    assert!(value["description"].as_str().is_some_and(|d| d.len() > 5), "{path}.{key}");
                }
            }
        }
    }

    #[test]
    fn quantities_are_strings_with_a_unit_and_choices_are_words() {
        let scene = of_kind(SchemaKind::Scene).to_value();
        let modulus = &scene["properties"]["material"]["properties"]["youngs_modulus"];
        assert_eq!((modulus["type"].as_str(), &modulus["examples"][0]), (Some("string"), &"210 GPa".into()));
        assert!(modulus["pattern"].as_str().unwrap().contains("MPa|GPa"), "{modulus}");
        let force = &scene["properties"]["loading"]["properties"]["force"];
        assert!(force["pattern"].as_str().unwrap().contains("N/mm"), "{force}");
        let words: Vec<&str> = scene["properties"]["symmetry"]["oneOf"]
            .as_array()
            .unwrap()
            .iter()
            .map(|choice| choice["const"].as_str().unwrap())
            .collect();
        assert_eq!(words, ["axisymmetric", "plane-strain"]);
        // the material may be that of an earlier result
        assert_eq!(scene["required"], serde_json::json!(["loading"]));
        assert_eq!(scene["anyOf"][0]["required"], serde_json::json!(["material"]));
    }
}
