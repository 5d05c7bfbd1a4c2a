//! Errors of a scene.

use thiserror::Error;

/// A value of a scene that makes no sense.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{path}: {message}")]
pub struct SceneError {
    /// Where: keys joined by dots, for example `surface.generate.ra`.
    pub path: String,
    /// The mistake: names the value, the allowed range and a way out.
    pub message: String,
}

impl SceneError {
    /// An error of the value at `path`.
    pub fn new(path: &str, message: impl ToString) -> SceneError {
        SceneError { path: path.into(), message: message.to_string() }
    }
}

/// The same as an answer.
pub(super) fn error<T>(path: &str, message: impl ToString) -> Result<T, SceneError> {
    Err(SceneError::new(path, message))
}
