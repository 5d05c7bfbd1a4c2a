//! The commands with their arguments, from the definition of the command line.

use super::markdown::{code, table, words};
use clap::{Arg, Command};

/// The page.
pub fn page(mut cli: Command) -> String {
    cli.build();
    let mut text = String::from("# Commands\n\n");
    text += "`asperity COMMAND --help` prints the same in a terminal, `asperity man COMMAND` as a page of the manual.\n\n";
    text += &format!("```text\n{}\n```\n\n", plain(cli.get_after_help()));
    let commands =
        || cli.get_subcommands().filter(|command| !command.is_hide_set() && command.get_name() != "help");
    text += &table(
        &["command", "what it does"],
        commands().map(|command| vec![link(command.get_name()), words(&plain(command.get_about()))]),
    );
    for command in commands() {
        text += &section(command, "##", &format!("asperity {}", command.get_name()));
    }
    text
}

fn link(name: &str) -> String {
    format!("[`{name}`](#asperity-{name})")
}

/// A command with its arguments and its subcommands.
fn section(command: &Command, heading: &str, name: &str) -> String {
    let mut text = format!("{heading} {name}\n\n{}.\n\n", words(&plain(command.get_about())));
    let usage = command.clone().render_usage().to_string();
    text += &format!("```text\n{}\n```\n\n", usage.trim_start_matches("Usage: "));
    let arguments: Vec<Vec<String>> = command
        .get_arguments()
        .filter(|argument| {
            !argument.is_hide_set() && !["help", "version"].contains(&argument.get_id().as_str())
        })
        .map(|argument| vec![code(&spelled(argument)), meaning(argument)])
        .collect();
    if !arguments.is_empty() {
        text += &table(&["argument", "meaning"], arguments);
    }
    if let Some(examples) = command.get_after_help() {
        text += &format!("```text\n{}\n```\n\n", plain(Some(examples)));
    }
    for inner in command.get_subcommands().filter(|inner| inner.get_name() != "help") {
        text += &section(inner, "###", &format!("{name} {}", inner.get_name()));
    }
    text
}

/// An argument as it is typed.
fn spelled(argument: &Arg) -> String {
    let values = argument.get_value_names().unwrap_or_default().join(" ");
    let takes = argument.get_action().takes_values();
    match (argument.get_short(), argument.get_long()) {
        (short, Some(long)) => {
            let short = short.map(|letter| format!("-{letter}, ")).unwrap_or_default();
            if takes { format!("{short}--{long} {values}") } else { format!("{short}--{long}") }
        }
        _ => values,
    }
}

/// Its help, with the words it may take and its default.
fn meaning(argument: &Arg) -> String {
    let mut text = words(&plain(argument.get_help()));
    let choices: Vec<String> = argument
        .get_possible_values()
        .iter()
        .filter(|_| argument.get_action().takes_values() && !argument.is_hide_possible_values_set())
        .map(|value| match value.get_help() {
            Some(help) => format!("`{}` ({})", value.get_name(), words(&help.to_string())),
            None => code(value.get_name()),
        })
        .collect();
    if !choices.is_empty() {
        text += &format!(": {}", choices.join(", "));
    }
    let defaults = argument.get_default_values();
    if argument.get_action().takes_values() && !defaults.is_empty() {
        text += &format!(" [default: {}]", defaults[0].to_string_lossy());
    }
    text
}

fn plain(text: Option<&clap::builder::StyledStr>) -> String {
    text.map(ToString::to_string).unwrap_or_default()
}
