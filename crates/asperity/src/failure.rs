//! Why a command ends without its result, and how it is told.

use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode, SourceSpan};
use std::fmt;
use std::ops::Range;
use std::path::Path;
use std::process::ExitCode;

/// The two ways to fail, with their exit status.
#[derive(Debug)]
pub enum Failure {
    /// Status 2: a file, a flag or a folder is wrong; nothing was written.
    Input(InputError),
    /// Status 1: the run could not finish; the text says where and why.
    Unfinished(String),
}

impl Failure {
    /// The exit status of the contract.
    pub fn exit_code(&self) -> ExitCode {
        match self {
            Failure::Input(_) => ExitCode::from(2),
            Failure::Unfinished(_) => ExitCode::from(1),
        }
    }

    /// The text for a person: the line with a caret where there is one.
    pub fn report(self) -> String {
        match self {
            Failure::Input(error) => format!("{:?}", miette::Report::new(error)),
            Failure::Unfinished(reason) => format!("asperity: {reason}"),
        }
    }

    /// A result that could not be put on disk.
    pub fn disk(path: &Path, error: impl fmt::Display) -> Self {
        Failure::Unfinished(format!("cannot write {}: {error}", path.display()))
    }
}

impl From<InputError> for Failure {
    fn from(error: InputError) -> Self {
        Failure::Input(error)
    }
}

/// Something wrong in what the user gave, with its place in a file where it has one.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct InputError {
    message: String,
    help: Option<String>,
    place: Option<Box<Place>>,
}

/// A piece of a text.
#[derive(Debug)]
struct Place {
    text: NamedSource<String>,
    span: SourceSpan,
}

impl Diagnostic for InputError {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.place.as_ref().map(|place| &place.text as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let place = self.place.as_ref()?;
        Some(Box::new(std::iter::once(LabeledSpan::underline(place.span))))
    }
}

impl InputError {
    /// An error without a place.
    pub fn new(message: impl Into<String>) -> Self {
        InputError { message: message.into(), help: None, place: None }
    }

    /// Adds a way out.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// Points at `span` (bytes) of `text`, which is called `name`; of a span over several lines, at its first one.
    #[must_use]
    pub fn at(mut self, name: &str, text: &str, span: Range<usize>) -> Self {
        let start = span.start.min(text.len());
        let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
        let end = span.end.clamp(start, line_end);
        let span = (start, end - start).into();
        self.place = Some(Box::new(Place { text: NamedSource::new(name, text.to_string()), span }));
        self
    }
}
