//! `asperity reference`: the pages of the book that list commands, keys, columns and units, written from what the program knows of
//! itself. A test holds the pages in `docs` against them.

mod columns;
mod commands;
mod keys;
mod units;

use crate::error::Error;
use crate::output::{Directory, SinkExt};
use clap::{Args, Command};
use std::path::PathBuf;

/// Arguments of `asperity reference`.
#[derive(Debug, Args)]
pub struct Reference {
    /// Folder for the pages
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
}

/// First line of every page.
const WRITTEN: &str = "<!-- written by `asperity reference`: do not edit -->\n\n";

/// Writes the pages of the command line `cli`.
///
/// # Errors
/// A disk that refuses.
pub fn reference(args: &Reference, cli: Command) -> Result<(), Error> {
    let mut folder = Directory::create(&args.out)?;
    let pages = [
        ("commands", commands::page(cli)),
        ("keys", keys::page()),
        ("columns", columns::page()),
        ("units", units::page()),
    ];
    pages.iter().try_for_each(|(name, text)| folder.text(&format!("{name}.md"), &format!("{WRITTEN}{text}")))
}

/// A table of Markdown.
fn table(head: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> String {
    let line = |cells: &mut dyn Iterator<Item = String>| {
        format!("| {} |\n", cells.map(|cell| in_cell(&cell)).collect::<Vec<_>>().join(" | "))
    };
    let mut text = line(&mut head.iter().map(ToString::to_string));
    text += &format!("|{}\n", "-|".repeat(head.len()));
    rows.into_iter().for_each(|row| text += &line(&mut row.into_iter()));
    text + "\n"
}

/// Text that stays within its cell.
fn in_cell(text: &str) -> String {
    text.replace('|', "\\|").replace('\n', " ").trim().into()
}

/// Words for the text of a page: what would be read as a tag is written out.
fn words(text: &str) -> String {
    text.replace('<', "&lt;").replace('*', "\\*").replace(" _", " \\_")
}

/// Letters, digits and units as code.
fn code(text: &str) -> String {
    format!("`{text}`")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cell_holds_bars_and_lines() {
        let text = table(&["a", "b"], [vec!["x|y".into(), "1\n2".into()]]);
        assert_eq!(text, "| a | b |\n|-|-|\n| x\\|y | 1 2 |\n\n");
    }
}
