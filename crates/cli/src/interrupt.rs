//! Ctrl-C: the first one asks the running command to end with what it has reached, the second one kills it.

use std::process::exit;
use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Exit status of a program that Ctrl-C killed.
const KILLED: i32 = 130;

/// Catches Ctrl-C from now on; for a command that looks at [`requested`] as it goes.
pub fn catch() {
    // fails only where it is caught already
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::Relaxed) {
            exit(KILLED);
        }
    });
}

/// Whether the user has asked for the end.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}
