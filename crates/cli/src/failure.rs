//! The way an error is told to a person, and the exit status it gives.

use asperity::error::{Error, InputError};
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode};
use std::fmt;
use std::process::ExitCode;

/// The exit status of the contract: 1 the run could not finish, 2 the input is wrong.
pub fn exit_code(error: &Error) -> ExitCode {
    match error {
        Error::Input(_) => ExitCode::from(2),
        Error::Unfinished(_) => ExitCode::from(1),
    }
}

/// The text for a person: the line with a caret where there is one.
pub fn report(error: Error) -> String {
    match error {
        Error::Input(error) => {
            let text = error.place.as_ref().map(|p| NamedSource::new(&p.name, p.text.clone()));
            format!("{:?}", miette::Report::new(Told { error, text }))
        }
        Error::Unfinished(reason) => format!("asperity: {reason}"),
    }
}

#[derive(Debug, thiserror::Error)]
#[error("{error}")]
struct Told {
    error: InputError,
    text: Option<NamedSource<String>>,
}

impl Diagnostic for Told {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.text.as_ref().map(|text| text as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.error.place.as_ref()?.span.clone();
        Some(Box::new(std::iter::once(LabeledSpan::underline(span))))
    }
}
