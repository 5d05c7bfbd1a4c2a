//! `asperity completions` and `asperity man`: completions for shells and pages of the manual, made from the
//! arguments.

use crate::terminal;
use asperity::error::{Error, InputError};
use clap::{Args, Command};
use clap_complete::Shell;

/// Arguments of `asperity completions`.
#[derive(Debug, Args)]
pub struct Completions {
    /// The shell; for example: asperity completions bash > ~/.local/share/bash-completion/completions/asperity
    #[arg(value_enum)]
    pub shell: Shell,
}

/// Arguments of `asperity man`.
#[derive(Debug, Args)]
pub struct ManPage {
    /// A command of asperity [default: all of it]; for example: asperity man crush | man -l -
    pub command: Option<String>,
}

/// Prints the completions of the command line `cli`.
///
/// # Errors
/// A disk that refuses.
pub fn completions(args: &Completions, mut cli: Command) -> Result<(), Error> {
    let mut text = Vec::new();
    clap_complete::generate(args.shell, &mut cli, "asperity", &mut text);
    terminal::print(&text)
}

/// Prints a page of the manual of the command line `cli`.
///
/// # Errors
/// A command that there is not, or a disk that refuses.
pub fn man(args: &ManPage, mut cli: Command) -> Result<(), Error> {
    cli.build();
    let command = match &args.command {
        None => cli,
        Some(name) => {
            let known: Vec<&str> = cli.get_subcommands().map(Command::get_name).collect();
            let found = cli.find_subcommand(name);
            found.cloned().ok_or_else(|| {
                InputError::new(format!("asperity has no command `{name}`"))
                    .help(format!("known here: {}", known.join(", ")))
            })?
        }
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(command)
        .render(&mut text)
        .map_err(|e| Error::Unfinished(format!("the page could not be made: {e}")))?;
    terminal::print(&text)
}
