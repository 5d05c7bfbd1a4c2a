//! Talking to a person: the one place that prints.

use asperity::error::Error;
use std::io::{self, ErrorKind, Write};

/// A line on stdout.
///
/// # Errors
/// Those of [`print`].
pub fn say(text: &str) -> Result<(), Error> {
    print(format!("{text}\n").as_bytes())
}

/// Bytes on stdout as they are. A closed pipe is no reason to fail: its reader has what it wanted.
///
/// # Errors
/// A disk that refuses, behind a redirection.
pub fn print(bytes: &[u8]) -> Result<(), Error> {
    let mut out = io::stdout();
    written(out.write_all(bytes).and_then(|()| out.flush()))
}

/// The outcome of writing to stdout.
///
/// # Errors
/// As for [`print`].
pub fn written(outcome: io::Result<()>) -> Result<(), Error> {
    match outcome {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Error::unfinished(format!("cannot write to standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// A warning about a run that goes on, on stderr.
pub fn warn(warning: &impl std::fmt::Display) {
    complain(&format!("warning: {warning}"));
}

/// A line on stderr.
pub fn complain(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}
