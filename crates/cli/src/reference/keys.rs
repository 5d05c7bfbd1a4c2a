//! Every key of every file, from the schemas.

use super::markdown::{code, table, words};
use crate::schema::{SchemaKind, of_kind};
use serde_json::Value;

/// The files, and what to say of each.
const FILES: [(SchemaKind, &str, &str); 5] = [
    (SchemaKind::Scene, "Scene", "A scene is what `asperity crush`, `mesh` and `trade` read."),
    (SchemaKind::Rough, "Rough surface", "A scene of a rough surface is what `asperity rough` reads."),
    (SchemaKind::Sweep, "Sweep", "A sweep is what `asperity calibrate` reads. Every key is optional."),
    (SchemaKind::Study, "Study", "A study is what `asperity study` reads, beside the scene that it names."),
    (SchemaKind::Fit, "Fit", "A fit is what `asperity identify` reads, beside the curves that it names."),
];

/// The page.
pub fn page() -> String {
    let mut text = String::from(
        "# Keys of the files\n\nFiles are [TOML](https://toml.io). A quantity is a string with its [unit](units.md), `\"20 um\"`; a \
         number without a unit is dimensionless. A key that the program does not know is an error. Paths are relative to the file \
         that names them. Keys that must be there stand first. `asperity schema` prints the same as a JSON schema, with which an \
         editor completes and checks a file.\n\n",
    );
    for (kind, title, about) in FILES {
        text += &format!("## {title}\n\n{about}\n\n");
        let schema = of_kind(kind).to_value();
        text += &keys_of(&schema, &schema, "", title);
    }
    text
}

/// The keys of the table at `path`, each table with its brackets, of the file `title` with the schema `root`,
/// then those of the tables in it.
fn keys_of(root: &Value, schema: &Value, path: &str, title: &str) -> String {
    let Some(properties) = schema["properties"].as_object() else { return String::new() };
    let required =
        |key: &str| schema["required"].as_array().is_some_and(|all| all.iter().any(|one| one == key));
    let mut keys: Vec<(&String, &Value)> = properties.iter().collect();
    keys.sort_by_key(|(key, _)| (!required(key), key.as_str()));
    let mut text = String::new();
    let name = path.trim_matches(['[', ']']);
    if !path.is_empty() {
        let about = schema["description"].as_str().unwrap_or_default();
        text += &format!("### {title}: `{path}`\n\n{}\n\n", words(about));
    }
    // a table that stands at the top too
    if let Some((_, last)) = name.rsplit_once('.')
        && root["properties"][last]["properties"] == schema["properties"]
    {
        return format!("{text}Its keys are those of `[{last}]`.\n\n");
    }
    let row = |(key, value): &(&String, &Value)| {
        let default = if required(key) { "required".into() } else { default_of(value) };
        let meaning = words(value["description"].as_str().unwrap_or_default());
        vec![code(key), meaning, kind_of(value), default]
    };
    text += &table(&["key", "meaning", "value", "default"], keys.iter().map(row));
    for (key, value) in keys {
        let inner = if name.is_empty() { key.clone() } else { format!("{name}.{key}") };
        text += &keys_of(root, value, &format!("[{inner}]"), title);
        text += &keys_of(root, &value["items"], &format!("[[{inner}]]"), title);
    }
    text
}

/// The values that a key takes.
fn kind_of(value: &Value) -> String {
    let choices = ["oneOf", "anyOf"].iter().filter_map(|form| value[form].as_array()).flatten();
    let choices: Vec<String> = choices.map(kind_of).filter(|kind| !kind.is_empty()).collect();
    if !choices.is_empty() {
        return choices.join(", ");
    }
    if let Some(words) = value["enum"].as_array() {
        return words
            .iter()
            .filter_map(Value::as_str)
            .map(|word| code(&format!("\"{word}\"")))
            .collect::<Vec<_>>()
            .join(", ");
    }
    if let Some(word) = value["const"].as_str() {
        return code(&format!("\"{word}\""));
    }
    match value["type"].as_str() {
        Some("string") if value["pattern"].is_string() && !example(value).is_empty() => {
            format!("quantity, {}", example(value))
        }
        Some("string") if value["examples"].is_array() => format!("text, {}", example(value)),
        Some("string") => "text".into(),
        Some("integer") => format!("whole number{}", range(value)),
        Some("number") => format!("number{}", range(value)),
        Some("boolean") => "`true`, `false`".into(),
        Some("array") if value["prefixItems"].is_array() => "list of two".into(),
        Some("array") if value["items"]["properties"].is_object() => "tables".into(),
        Some("array") => format!("list: {}", kind_of(&value["items"])),
        Some("object") => "table".into(),
        _ => example(value),
    }
}

fn example(value: &Value) -> String {
    value["examples"][0].is_null().then(String::new).unwrap_or_else(|| format!("`{}`", value["examples"][0]))
}

/// The ends of the range of a number.
fn range(value: &Value) -> String {
    let end = |names: [(&str, &str); 2]| {
        names.iter().find_map(|(name, sign)| Some(format!("{sign} {}", value[*name].as_f64()?)))
    };
    let low = end([("minimum", "≥"), ("exclusiveMinimum", ">")]);
    let high = end([("maximum", "≤"), ("exclusiveMaximum", "<")]);
    let ends: Vec<String> = [low, high].into_iter().flatten().collect();
    if ends.is_empty() { String::new() } else { format!(" {}", ends.join(", ").replace('<', "&lt;")) }
}

fn default_of(value: &Value) -> String {
    match &value["default"] {
        Value::Null | Value::Object(_) => String::new(),
        Value::Array(list) if list.len() > 6 => String::new(),
        default => code(&default.to_string()),
    }
}
