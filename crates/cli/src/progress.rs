//! One line on the terminal while a run lasts; nothing where there is no terminal to draw on.

use crate::{interrupt, terminal};
use asperity::Progress;
use asperity::error::Error;
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
        let template = format!("{name:<36} {{bar:24.cyan/dim}} {{percent:>3}} %  {{msg}}  {{eta}} left");
        Line::styled(self.lines.add(ProgressBar::new(FULL)), &template)
    }

    /// A line for all of them together, whose message tells the time left.
    pub fn add_whole(&self, name: &str) -> Line {
        let template = format!("{name:<36} {{bar:24.cyan/dim}} {{percent:>3}} %  {{msg}}");
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

    /// Prints what is to stay, above the line.
    pub fn say(&self, text: &str) {
        self.bar.suspend(|| terminal::complain(text));
    }

    /// Takes the line away.
    pub fn finish(self) {
        self.bar.finish_and_clear();
    }
}

/// The line of runs that are kept on disk, from where they go on after a stop.
#[derive(Debug)]
pub struct BatchProgress {
    line: Line,
    quiet: bool,
    /// Says what an earlier start left; not before the first run is known, and not if quiet.
    greets: bool,
    /// A run, and several.
    names: [&'static str; 2],
    /// The folder or file that keeps them.
    place: PathBuf,
    /// Numbers of those that are done, and of all.
    reached: [usize; 2],
}

impl BatchProgress {
    /// A line on stderr for runs called `names` (one, several) that are kept in `place`; silent if `quiet`.
    /// From now on an interrupt is a wish.
    pub fn new(quiet: bool, names: [&'static str; 2], place: PathBuf) -> Self {
        interrupt::catch();
        BatchProgress { line: Line::new(quiet), quiet, greets: !quiet, names, place, reached: [0; 2] }
    }

    /// Shows how far the runs have come, with `detail` of the last one. Returns whether to go on.
    pub fn show<N>(&mut self, reached: &Progress<'_, N>, detail: impl FnOnce(&N) -> String) -> bool {
        let [one, several] = self.names;
        let Progress { share, done, all, news, notice } = *reached;
        self.reached = [done, all];
        if let Some(notice) = notice.filter(|_| !self.quiet) {
            self.line.say(&format!("warning: {notice}"));
        }
        if std::mem::take(&mut self.greets) && done > 0 {
            self.line.say(&format!("{done} {several} of an earlier start are in {}", self.place.display()));
        }
        let detail = || news.map_or_else(String::new, |news| format!("  {}", detail(news)));
        self.line.show(share, || format!("{one} {done} of {all}{}", detail()));
        !interrupt::requested()
    }

    /// Takes the line away; gives the error of runs that an interrupt ended before they were all done.
    pub fn finish(self) -> Option<Error> {
        let ([done, all], several) = (self.reached, self.names[1]);
        self.line.finish();
        (interrupt::requested() && done < all).then(|| {
            Error::Unfinished(format!(
                "stopped after {done} of {all} {several}, which are in {}; the same command goes on from there",
                self.place.display()
            ))
        })
    }
}
