//! The reason why an MSH file cannot be read.

/// An MSH file that cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}{message}", if *line > 0 { format!("line {line}: ") } else { String::new() })]
pub struct MshError {
    /// Line of the file, counted from 1; 0 where no line is to blame.
    pub line: usize,
    /// Found and expected content.
    pub message: String,
}

impl MshError {
    pub(super) fn new(line: usize, message: impl Into<String>) -> Self {
        MshError { line, message: message.into() }
    }

    /// An error of the file as a whole.
    pub(super) fn whole(message: impl Into<String>) -> Self {
        MshError::new(0, message)
    }
}
