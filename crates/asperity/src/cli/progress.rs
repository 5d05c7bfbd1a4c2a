//! One line on the terminal while a run lasts; nothing where there is no terminal to draw on.

use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;

/// Steps of a full bar.
const FULL: u64 = 10_000;

/// A line with a bar, what has been reached, and the time left.
#[derive(Debug)]
pub struct Progress {
    bar: ProgressBar,
}

/// Where lines are drawn: on stderr; nowhere if `quiet` or if stderr is no terminal.
fn target(quiet: bool) -> ProgressDrawTarget {
    let shown = !quiet && std::io::stderr().is_terminal();
    if shown { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() }
}

/// A line for each of several parts that run side by side.
#[derive(Debug)]
pub struct Lines {
    lines: MultiProgress,
}

impl Lines {
    /// Lines on stderr; silent if `quiet` or if stderr is no terminal.
    pub fn new(quiet: bool) -> Self {
        Lines { lines: MultiProgress::with_draw_target(target(quiet)) }
    }

    /// A new line that begins with `name`.
    pub fn add(&self, name: &str) -> Progress {
        let template = format!("{name:<28} {{bar:24.cyan/dim}} {{percent:>3}} %  {{msg}}  {{eta}} left");
        Progress::styled(self.lines.add(ProgressBar::new(FULL)), &template)
    }

    /// Prints what is to stay, above the lines.
    pub fn say(&self, text: &str) {
        self.lines.suspend(|| crate::cli::terminal::complain(text));
    }
}

impl Progress {
    /// A line on stderr; silent if `quiet` or if stderr is no terminal.
    pub fn new(quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(FULL), target(quiet));
        Progress::styled(bar, "{bar:24.cyan/dim} {percent:>3} %  {msg}  {eta} left")
    }

    fn styled(bar: ProgressBar, template: &str) -> Self {
        if let Ok(style) = ProgressStyle::with_template(template) {
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
