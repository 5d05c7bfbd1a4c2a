//! One line on the terminal while a run lasts; nothing where there is no terminal to draw on.

use crate::{interrupt, terminal};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
use std::path::PathBuf;

/// Steps of a full bar.
const FULL: u64 = 10_000;

/// A line with a bar, what has been reached, and the time left.
#[derive(Debug)]
pub struct Line {
    bar: ProgressBar,
}

/// Target of the lines: stderr; nothing if `quiet` or if stderr is no terminal.
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
    pub fn add(&self, name: &str) -> Line {
        let template = format!("{name:<28} {{bar:24.cyan/dim}} {{percent:>3}} %  {{msg}}  {{eta}} left");
        Line::styled(self.lines.add(ProgressBar::new(FULL)), &template)
    }

    /// Prints what is to stay, above the lines.
    pub fn say(&self, text: &str) {
        self.lines.suspend(|| terminal::complain(text));
    }
}

impl Line {
    /// A line on stderr; silent if `quiet` or if stderr is no terminal.
    pub fn new(quiet: bool) -> Self {
        let bar = ProgressBar::with_draw_target(Some(FULL), target(quiet));
        Line::styled(bar, "{bar:24.cyan/dim} {percent:>3} %  {msg}  {eta} left")
    }

    fn styled(bar: ProgressBar, template: &str) -> Self {
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars("━╸─"));
        }
        Line { bar }
    }

    /// Shows that `share` (0 to 1) of the work is done, and `message`, which is made only if somebody sees
    /// it.
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

/// The line of runs that are kept in a folder, from which they go on after a stop.
#[derive(Debug)]
pub struct BatchProgress {
    line: Line,
    /// Says what an earlier start left; not before the first run is known, and not if quiet.
    greets: bool,
    /// A run, and several.
    names: [&'static str; 2],
    folder: PathBuf,
}

impl BatchProgress {
    /// A line on stderr for runs called `names` (one, several) in `folder`; silent if `quiet`. From now on an
    /// interrupt is a wish.
    pub fn new(quiet: bool, names: [&'static str; 2], folder: PathBuf) -> Self {
        interrupt::catch();
        BatchProgress { line: Line::new(quiet), greets: !quiet, names, folder }
    }

    /// Shows that `done` of `all` runs are finished. Returns whether to go on.
    pub fn show(&mut self, done: usize, all: usize) -> bool {
        let [one, several] = self.names;
        if std::mem::take(&mut self.greets) && done > 0 {
            let folder = self.folder.display();
            terminal::complain(&format!("{done} {several} of an earlier start are in {folder}"));
        }
        self.line.show(done as f64 / all.max(1) as f64, || format!("{one} {done} of {all}"));
        !interrupt::requested()
    }

    /// Takes the line away.
    pub fn finish(self) {
        self.line.finish();
    }
}
