//! Errors of the library: wrong input, or work that could not be finished.

use asperity_identification::search::SearchError;
use std::fmt;
use std::ops::Range;
use std::path::Path;

/// The two ways to fail.
#[derive(thiserror::Error)]
pub enum Error {
    /// A file or a value is wrong; nothing was computed.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The work could not be finished; the text says where and why.
    #[error("{0}")]
    Unfinished(String),
}

impl Error {
    /// Work that an error of the operating system ended, without the number that the system gives it.
    pub fn unfinished(text: impl Into<String>) -> Self {
        Error::Unfinished(without_numbers(text.into()))
    }

    /// A result that could not be put on disk.
    pub fn disk(path: &Path, error: impl fmt::Display) -> Self {
        Error::unfinished(format!("cannot write {}: {error}", path.display()))
    }
}

/// `text` without the numbers that an operating system gives its errors: ` (os error 2)`.
fn without_numbers(text: String) -> String {
    const BEGIN: &str = " (os error ";
    let mut parts = text.split(BEGIN);
    let first = parts.next().unwrap_or_default().to_string();
    parts.fold(first, |text, part| text + part.split_once(')').map_or(part, |(_, rest)| rest))
}

impl From<SearchError> for Error {
    fn from(error: SearchError) -> Error {
        let text = error.to_string();
        match error {
            SearchError::NoMetal => {
                InputError::new(text).help("check the units of youngs_modulus and yield_stress").into()
            }
            SearchError::Interrupted | SearchError::NoAnswer(_) => Error::Unfinished(text),
        }
    }
}

/// The whole text, with the line and the way out: `main` prints it where it returns an error.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::Input(error) => fmt::Debug::fmt(error, f),
            Error::Unfinished(text) => f.write_str(text),
        }
    }
}

/// As for [`Error`].
impl fmt::Debug for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.full())
    }
}

/// Something wrong in what the user gave, with its place in a text where it has one.
#[derive(thiserror::Error)]
#[error("{message}")]
pub struct InputError {
    /// The fault, with the allowed range.
    pub message: String,
    /// A way out.
    pub help: Option<String>,
    /// Its place.
    pub place: Option<Box<Place>>,
}

/// A piece of a text.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Name of the file, or `--set`.
    pub name: String,
    /// The whole text.
    pub text: String,
    /// Bytes of the text.
    pub span: Range<usize>,
}

impl InputError {
    /// An error without a place.
    pub fn new(message: impl Into<String>) -> Self {
        InputError { message: without_numbers(message.into()), help: None, place: None }
    }

    /// Adds a way out.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }

    /// The whole text for those who cannot draw a caret: the fault, the line that it is in, the way out.
    pub fn full(&self) -> String {
        let mut text = self.message.clone();
        if let Some(place) = &self.place {
            let before = &place.text[..place.span.start.min(place.text.len())];
            let number = 1 + before.matches('\n').count();
            let line = place.text.lines().nth(number - 1).unwrap_or_default().trim();
            text += &format!("\n{}, line {number}: {line}", place.name);
        }
        if let Some(help) = &self.help {
            text += &format!("\nhelp: {help}");
        }
        text
    }

    /// The same of a text that was written from tables in code: the path of the key stands for a line that
    /// nobody has seen.
    #[must_use]
    pub fn in_tables(mut self) -> Self {
        let Some(place) = self.place.take() else { return self };
        let before = &place.text[..place.span.start.min(place.text.len())];
        let line = place.text.lines().nth(before.matches('\n').count()).unwrap_or_default().trim();
        let is_head = |text: &&str| text.starts_with('[') && text.ends_with(']');
        let head = before.lines().map(str::trim).rfind(is_head).unwrap_or_default();
        let name = head.trim_matches(['[', ']']);
        let path = match before.lines().filter(|text| text.trim() == head).count() {
            _ if head.is_empty() || is_head(&line) => String::new(),
            count if head.starts_with("[[") => format!("{name}[{}].", count - 1),
            _ => format!("{name}."),
        };
        self.message += &format!("\n{path}{line}");
        self
    }

    /// Points at `span` (bytes) of `text`, which is called `name`; of a span over several lines, at its first
    /// one.
    #[must_use]
    pub fn pointing_at(mut self, name: &str, text: &str, span: Range<usize>) -> Self {
        let start = span.start.min(text.len());
        let line_end = text[start..].find('\n').map_or(text.len(), |i| start + i);
        let end = span.end.clamp(start, line_end);
        self.place = Some(Box::new(Place { name: name.into(), text: text.into(), span: start..end }));
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_an_operating_system_stay_out() {
        let error = std::io::Error::from_raw_os_error(2);
        assert!(error.to_string().contains("os error"));
        for text in [
            InputError::new(format!("a: {error}; b: {error}")).to_string(),
            Error::disk(Path::new("file"), &error).to_string(),
        ] {
            assert!(!text.contains("os error") && !text.contains(')'), "{text}");
        }
        assert_eq!(without_numbers("a (b) c (os error 17); d".into()), "a (b) c; d");
    }
}
