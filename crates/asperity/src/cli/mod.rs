//! The binary: flags, folders, progress, printing.

pub mod args;
pub mod calibrate;
pub mod crush;
pub mod extract;
pub mod failure;
pub mod flags;
pub mod folder;
pub mod identify;
pub mod interrupt;
pub mod manual;
pub mod mesh;
pub mod new;
pub mod progress;
pub mod reference;
pub mod reproduce;
pub mod rough;
pub mod schema;
pub mod study;
pub mod terminal;
pub mod trade;

use args::{Cli, Command};
use clap::{CommandFactory, Parser};
use std::process::ExitCode;

/// Reads the arguments, runs the command, gives its exit status.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    // long lines stay whole: the terminal wraps them, and a search finds them
    let _ = miette::set_hook(Box::new(|_| {
        Box::new(miette::MietteHandlerOpts::new().wrap_lines(false).context_lines(1).build())
    }));
    if let Some(threads) = cli.command.threads() {
        // fails only where the pool exists already
        let _ = rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build_global();
    }
    let result = match &cli.command {
        Command::Crush(args) => crush::crush(args),
        Command::Mesh(args) => mesh::mesh(args),
        Command::Rough(args) => rough::rough(args),
        Command::Extract(args) => extract::extract(args),
        Command::Calibrate(args) => calibrate::calibrate(args),
        Command::Study(args) => study::study(args),
        Command::Identify(args) => identify::identify(args),
        Command::Trade(args) => trade::trade(args),
        Command::Reproduce(args) => reproduce::reproduce(args),
        Command::New(args) => new::new(args),
        Command::Schema(args) => schema::schema(args),
        Command::Completions(args) => {
            manual::completions(args, Cli::command());
            Ok(())
        }
        Command::Man(args) => manual::man(args, Cli::command()),
        Command::Reference(args) => reference::reference(args, Cli::command()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let code = failure::exit_code(&error);
            terminal::complain(failure::report(error).trim_end());
            code
        }
    }
}
