//! Flags that several commands share.

use crate::folder::Folder;
use crate::terminal;
use asperity::error::{Error, InputError};
use asperity::input::scene::Scene;
use asperity::output::SinkExt;
use asperity::simulation::scene::{Accuracy, AccuracyError};
use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Args, Command};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Flags that change what a file says.
#[derive(Clone, Debug, Args)]
pub struct SceneFlags {
    /// Error of the force: draft (5 %), standard (1 %), reference (0.2 %) or a percentage like 0.5%, from 0.2% to 5% [default: what the scene says, else standard]
    #[arg(long, value_name = "LEVEL", value_parser = AccuracyParser, hide_possible_values = true)]
    pub accuracy: Option<Accuracy>,
    /// Change a value of the file, for example --set "loading.depth=2 um"; repeatable
    #[arg(long = "set", value_name = "KEY.PATH=VALUE")]
    pub overrides: Vec<String>,
}

impl SceneFlags {
    /// All changes as overrides; the accuracy wins.
    pub fn changes(&self) -> Vec<String> {
        let accuracy = self.accuracy.map(|level| format!("accuracy={level}"));
        self.overrides.iter().cloned().chain(accuracy).collect()
    }

    /// The scene at `path` with these changes.
    ///
    /// # Errors
    /// A scene that cannot be read or makes no sense, pointing at the line.
    pub fn read(&self, path: &Path) -> Result<Scene, Error> {
        let name = path.display();
        let help = format!(
            "a map of heights is pressed by asperity rough {name}; asperity extract {name} makes scenes of its asperities"
        );
        Scene::read(path, &self.changes()).map_err(|e| told_of_table(e, path, help))
    }
}

/// An error of reading `path`, which by its name may be measured data where a TOML file is expected: then
/// `help` is the way out.
pub fn told_of_table(error: Error, path: &Path, help: String) -> Error {
    let data = path.extension().is_some_and(|end| end != "toml" && end != "json");
    match error {
        Error::Input(_) if data && path.is_file() => {
            InputError::new(format!("{} is no TOML file", path.display())).help(help).into()
        }
        error => error,
    }
}

/// Flags of every command that fills a folder.
#[derive(Debug, Args)]
pub struct RunFlags {
    /// Folder for the results [default: in out/, named after the scene or the command]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Threads to use [default: all cores]; the results do not depend on it
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=4096))]
    pub threads: Option<u16>,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
    /// Write into a folder that holds other files too: those of the same name are overwritten; results of the same command are replaced without it
    #[arg(long)]
    pub force: bool,
    /// Print the summary as JSON on stdout
    #[arg(long)]
    pub json: bool,
}

impl RunFlags {
    /// The folder for results that are called `name`.
    pub fn target(&self, name: &str) -> PathBuf {
        self.out.clone().unwrap_or_else(|| Path::new("out").join(name))
    }

    /// Prints the result as the flags ask: as JSON, for a person with the folder that holds it, or not at
    /// all.
    ///
    /// # Errors
    /// Those of `json`, or a disk that refuses.
    pub fn say(
        &self,
        target: &Path,
        json: impl FnOnce() -> Result<String, Error>,
        text: impl FnOnce() -> String,
    ) -> Result<(), Error> {
        if self.json {
            terminal::say(json()?.trim_end())?;
        } else if !self.quiet {
            terminal::say(&format!("{}\nresults   {}", text().trim_end(), target.display()))?;
        }
        Ok(())
    }
}

/// The flag of commands whose result is a page too.
#[derive(Debug, Args)]
pub struct ReportFlag {
    /// Write report.html too: a page that stands alone, with the numbers and their errors first and curves that tell their values;
    /// a rerun into a folder with a page writes it anew
    #[arg(long)]
    pub report: bool,
}

impl ReportFlag {
    /// Writes the page where it is asked for, and anew where results with a page are replaced.
    ///
    /// # Errors
    /// Those of `page`, or a disk that refuses.
    pub fn write(
        &self,
        folder: &mut Folder,
        page: impl FnOnce() -> Result<String, Error>,
    ) -> Result<(), Error> {
        const NAME: &str = "report.html";
        if self.report || folder.replaces(NAME) { folder.text(NAME, &page()?) } else { Ok(()) }
    }
}

/// Reads an accuracy, and tells the shell the levels that have a name.
#[derive(Clone, Copy, Debug)]
pub struct AccuracyParser;

impl TypedValueParser for AccuracyParser {
    type Value = Accuracy;

    fn parse_ref(
        &self,
        command: &Command,
        arg: Option<&Arg>,
        value: &OsStr,
    ) -> Result<Accuracy, clap::Error> {
        (parse_accuracy as fn(&str) -> Result<Accuracy, String>).parse_ref(command, arg, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(["draft", "standard", "reference"].into_iter().map(PossibleValue::new)))
    }
}

/// An accuracy within the range that can be asked for.
///
/// # Errors
/// A sentence for the user.
fn parse_accuracy(text: &str) -> Result<Accuracy, String> {
    let accuracy: Accuracy = text.parse().map_err(|e: AccuracyError| e.to_string())?;
    accuracy.check().map_err(|e| e.message)?;
    Ok(accuracy)
}
