//! Shared by the programs of `examples/`: their arguments, the tables they write to `verification/results`,
//! times.

// tables are printed as they grow, because some take hours
#![allow(clippy::print_stdout)]

use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Tables in Markdown, printed line by line and at the end written to the file that `--out FILE` names.
#[derive(Debug)]
pub struct Report {
    text: String,
    file: Option<PathBuf>,
}

impl Report {
    /// Of the example `name`, run with the rest of its arguments, which are returned: all but `--out FILE`.
    /// The first line of the file names the program, its version and `accuracy`, what the runs have in
    /// common.
    pub fn of_example(name: &str, accuracy: &str) -> (Report, Vec<String>) {
        let (file, rest) = arguments(std::env::args().skip(1));
        let words: String = rest.iter().flat_map(|word| [" ", shown(word)]).collect();
        let separator = if rest.is_empty() { "" } else { " --" };
        let text = format!(
            "<!-- written by `cargo run --release -p asperity-verification --example {name}{separator}{words}`, asperity {}, {accuracy} -->\n\n",
            env!("CARGO_PKG_VERSION")
        );
        (Report { text, file }, rest)
    }

    /// A heading with an empty line on both sides.
    pub fn section(&mut self, title: &str) {
        self.line(&format!("\n## {title}\n"));
    }

    /// The head of a table: its columns between bars, `| a | b |`.
    pub fn table(&mut self, columns: &str) {
        self.line(columns);
        self.line(&format!("{}|", "|-".repeat(columns.matches('|').count().saturating_sub(1))));
    }

    /// A row of a table, bars included, or any other line.
    pub fn line(&mut self, line: &str) {
        println!("{line}");
        self.text += line;
        self.text += "\n";
    }

    /// Writes the file, whole or not at all.
    ///
    /// # Errors
    /// It cannot be written.
    pub fn finish(self) -> io::Result<()> {
        self.file.map_or(Ok(()), |file| replace(&file, &self.text))
    }
}

/// A word of the command; of a path from the root its last part, for the folders before it are of one
/// machine.
fn shown(word: &str) -> &str {
    let path = Path::new(word);
    path.file_name().filter(|_| path.is_absolute()).and_then(|name| name.to_str()).unwrap_or(word)
}

/// The file of `--out FILE`, and the other words.
fn arguments(mut words: impl Iterator<Item = String>) -> (Option<PathBuf>, Vec<String>) {
    let (mut file, mut rest) = (None, Vec::new());
    while let Some(word) = words.next() {
        if word == "--out" {
            file = words.next().map(PathBuf::from);
        } else {
            rest.push(word);
        }
    }
    (file, rest)
}

/// Writes `content` beside `file` and puts it in its place, so that a reader sees the old file or the new
/// one.
///
/// # Errors
/// The folder cannot be made or the file not be written.
pub fn replace(file: &Path, content: impl AsRef<[u8]>) -> io::Result<()> {
    if let Some(folder) = file.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let mut part = file.as_os_str().to_owned();
    part.push(".part");
    std::fs::write(&part, content)?;
    std::fs::rename(&part, file)
}

/// The value below which the share `share` of `values` lies.
pub fn quantile(values: impl Iterator<Item = f64>, share: f64) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().saturating_sub(1);
    sorted.get((share * last as f64).round() as usize).copied().unwrap_or(f64::NAN)
}

/// The value of `work`, and the seconds it took.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let clock = Instant::now();
    let done = work();
    (done, clock.elapsed().as_secs_f64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_named_file_is_taken_out_of_the_arguments() {
        let words = ["draft", "--out", "a.md", "3"].map(String::from);
        let (file, rest) = arguments(words.into_iter());
        assert_eq!((file, rest), (Some(PathBuf::from("a.md")), vec!["draft".to_string(), "3".to_string()]));
    }

    #[test]
    fn a_table_has_a_rule_below_its_head() {
        let mut report = Report { text: String::new(), file: None };
        report.table("| a | b |");
        assert_eq!(report.text, "| a | b |\n|-|-|\n");
    }
}
