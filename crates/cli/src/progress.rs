//! One line on the terminal while a run lasts; nothing where there is no terminal to draw on.

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;

/// Steps of a full bar.
const FULL: u64 = 10_000;

/// A line with a bar, what has been reached, and the time left.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// A line on stderr; silent if `quiet` or if stderr is no terminal.
    pub fn new(quiet: bool) -> Self {
        let shown = !quiet && std::io::stderr().is_terminal();
        let target = if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(FULL), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:24.cyan/dim} {percent:>3} %  {msg}  {eta} left")
        {
            bar.set_style(style.progress_chars("━╸─"));
        }
        Progress { bar }
    }

    /// Shows that `share` (0 to 1) of the work is done, and `message`, which is made only if somebody sees it.
    pub fn show(&self, share: f64, message: impl FnOnce() -> String) {
        if self.bar.is_hidden() {
            return;
        }
        self.bar.set_message(message());
        self.bar.set_position((share.clamp(0.0, 1.0) * FULL as f64) as u64);
    }

    /// Takes the line away.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}
