//! Ctrl-C: the first one asks the running command to end with what it has reached, the second one kills it.

use crate::terminal;
use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};

static STOP_REQUESTED: AtomicBool = AtomicBool::new(false);

/// Exit status of a program that Ctrl-C killed.
const KILLED_STATUS: i32 = 130;

/// Catches Ctrl-C from now on; for a command that looks at [`requested`] as it goes.
pub fn catch() {
    // fails only where it is caught already
    let _ = ctrlc::set_handler(|| {
        if STOP_REQUESTED.swap(true, Ordering::Relaxed) {
            exit(KILLED_STATUS);
        }
        terminal::complain("interrupted: the command ends with what it is at; Ctrl-C again ends it at once");
    });
}

/// True where the user has asked for the end.
pub fn requested() -> bool {
    STOP_REQUESTED.load(Ordering::Relaxed)
}
