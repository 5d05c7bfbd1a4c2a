//! Slips on the command line: a key of the file given as a flag, a command that is called otherwise.

use crate::schema::{SchemaKind, of_kind};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use serde_json::Value;
use std::path::Path;

/// `wrong` with the way out that the words of the command line, `words`, ask for.
pub fn with_way_out(mut wrong: clap::Error, words: &[String]) -> clap::Error {
    let text = |kind: ContextKind| wrong.get(kind).map(ToString::to_string);
    let way_out = match wrong.kind() {
        ErrorKind::UnknownArgument => text(ContextKind::InvalidArg).and_then(|flag| key_of(&flag, words)),
        ErrorKind::InvalidSubcommand => {
            text(ContextKind::InvalidSubcommand).filter(|word| word == "run" || Path::new(word).is_file()).map(|_| {
                "a scene is computed by `asperity crush SCENE`, a measured surface by `asperity rough SURFACE`"
                    .into()
            })
        }
        _ => None,
    };
    if let Some(way_out) = way_out {
        for kind in [ContextKind::SuggestedArg, ContextKind::SuggestedSubcommand, ContextKind::TrailingArg] {
            wrong.remove(kind);
        }
        wrong.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![way_out.into()]));
    }
    wrong
}

/// The sentence for a `flag` that is a key of the file which the command reads.
fn key_of(flag: &str, words: &[String]) -> Option<String> {
    let kind = match words.get(1)?.as_str() {
        "crush" | "mesh" | "trade" => SchemaKind::Scene,
        "rough" | "joint" | "scales" => SchemaKind::Rough,
        "calibrate" => SchemaKind::Sweep,
        "identify" => SchemaKind::Fit,
        _ => return None,
    };
    let name = flag.trim_start_matches('-').replace('-', "_");
    let mut paths = Vec::new();
    keys(&of_kind(kind).to_value(), "", &mut paths);
    // the key itself, else one that begins with it: slopes for slopes_deg
    let last = |path: &str| path.rsplit('.').next().unwrap_or(path).to_string();
    if let Some((first, _)) = paths.iter().find(|(path, _)| path.starts_with(&format!("{name}."))) {
        return Some(format!("\"{name}\" is a table: give its keys by --set, like --set \"{first}=...\""));
    }
    let (path, is_list) = paths
        .iter()
        .find(|(path, _)| last(path) == name)
        .or_else(|| paths.iter().find(|(path, _)| name.len() > 2 && last(path).starts_with(&name)))?;
    let place = words.iter().position(|word| word.split('=').next() == Some(flag))?;
    let value = match words[place].split_once('=') {
        Some((_, value)) => Some(value.to_string()),
        None => words.get(place + 1).filter(|word| !word.starts_with('-')).cloned(),
    };
    let value = match value {
        Some(value) if *is_list && !value.starts_with('[') => format!("[{value}]"),
        Some(value) => value,
        None => "...".into(),
    };
    Some(format!("the keys of the file are changed by --set: --set \"{path}={value}\""))
}

/// The keys of a `schema` with the tables that lead to them, outer tables first, and whether each
/// holds a list.
fn keys(schema: &Value, within: &str, found: &mut Vec<(String, bool)>) {
    let Some(properties) = schema["properties"].as_object() else { return };
    let path = |key: &str| if within.is_empty() { key.to_string() } else { format!("{within}.{key}") };
    found.extend(properties.iter().map(|(key, value)| (path(key), value["type"] == "array")));
    for (key, value) in properties {
        keys(value, &path(key), found);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Cli;
    use clap::Parser;

    fn told(line: &str) -> String {
        let words: Vec<String> = line.split('|').map(String::from).collect();
        let Err(wrong) = Cli::try_parse_from(&words) else { panic!("{line} is right") };
        with_way_out(wrong, &words).to_string()
    }

    #[test]
    fn a_key_given_as_a_flag_leads_to_set() {
        for (line, way_out) in [
            ("asperity|crush|a.toml|--depth|3 um", "--set \"loading.depth=3 um\""),
            ("asperity|crush|a.toml|--depth=3 um", "--set \"loading.depth=3 um\""),
            ("asperity|rough|a.toml|--pressure|5 MPa", "--set \"load.pressure=5 MPa\""),
            ("asperity|calibrate|--slopes|2", "--set \"slopes_deg=[2]\""),
            ("asperity|rough|a.toml|--load|5 MPa", "--set \"load."),
            ("asperity|run|a.toml", "asperity crush SCENE"),
        ] {
            let told = told(line);
            assert!(told.contains(way_out), "{line}: {told}");
            assert!(!told.contains("similar argument") && !told.contains("'-- "), "{line}: {told}");
        }
        // a slip in a flag keeps the suggestion that clap makes
        assert!(told("asperity|crush|a.toml|--acuracy|draft").contains("--accuracy"));
    }
}
