//! The binary: flags, folders, progress, printing.

mod args;
mod calibrate;
mod crush;
mod extract;
mod failure;
mod flags;
mod folder;
mod identify;
mod interrupt;
mod joint;
mod manual;
mod mesh;
mod new;
mod progress;
mod reference;
mod reproduce;
mod rough;
mod scales;
mod schema;
mod slips;
mod study;
mod terminal;
mod trade;

use args::{Cli, Command};
use asperity::error::Error;
use clap::{CommandFactory, Parser};
use std::process::ExitCode;

/// Bytes of the stack of a thread: those of the first thread of a process.
const STACK: usize = 8 << 20;

/// Reads the arguments, runs the command, gives its exit status.
fn main() -> ExitCode {
    // long lines stay whole: the terminal wraps them, and a search finds them
    let _ = miette::set_hook(Box::new(|_| {
        Box::new(miette::MietteHandlerOpts::new().wrap_lines(false).context_lines(1).build())
    }));
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        // help and version go to stdout
        Err(told) if !told.use_stderr() => return ended(terminal::written(told.print())),
        Err(wrong) => {
            let words: Vec<String> =
                std::env::args_os().map(|word| word.to_string_lossy().into_owned()).collect();
            slips::with_way_out(wrong, &words).exit()
        }
    };
    let threads = cli.command.threads().map_or(0, usize::from);
    // the command runs on a thread of the pool: one outside would have to be woken whenever the others are
    // done
    let result = match rayon::ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build() {
        Ok(pool) => pool.install(|| run(&cli.command)),
        Err(_) => run(&cli.command),
    };
    ended(result)
}

/// Tells the error of a command, if it has one; gives the exit status.
fn ended(result: Result<(), Error>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let code = failure::exit_code(&error);
            terminal::complain(failure::report(error).trim_end());
            code
        }
    }
}

/// Runs `command`.
fn run(command: &Command) -> Result<(), Error> {
    match command {
        Command::Crush(args) => crush::crush(args),
        Command::Mesh(args) => mesh::mesh(args),
        Command::Rough(args) => rough::rough(args),
        Command::Joint(args) => joint::joint(args),
        Command::Scales(args) => scales::scales(args),
        Command::Extract(args) => extract::extract(args),
        Command::Calibrate(args) => calibrate::calibrate(args),
        Command::Study(args) => study::study(args),
        Command::Identify(args) => identify::identify(args),
        Command::Trade(args) => trade::trade(args),
        Command::Reproduce(args) => reproduce::reproduce(args),
        Command::New(args) => new::new(args),
        Command::Schema(args) => schema::schema(args),
        Command::Completions(args) => manual::completions(args, Cli::command()),
        Command::Man(args) => manual::man(args, Cli::command()),
        Command::Reference(args) => reference::reference(args, Cli::command()),
    }
}
