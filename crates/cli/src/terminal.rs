//! Talking to a person: the one place that prints.

// what a command line is for; a closed pipe is no reason to fail
use std::io::Write;

/// A line on stdout.
pub fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}

/// A warning about a run that goes on, on stderr.
pub fn warn(warning: &impl std::fmt::Display) {
    complain(&format!("warning: {warning}"));
}

/// A line on stderr.
pub fn complain(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}
