//! `asperity reference`: the pages of the book that list commands, keys, columns and units, written from what
//! the program knows of itself. A test holds the pages in `docs` against them.

mod columns;
mod commands;
mod keys;
mod markdown;
mod units;

use asperity::error::Error;
use asperity::output::{Directory, SinkExt};
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
