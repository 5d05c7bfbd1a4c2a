//! The error of a value in a scene.

use asperity_material::range::SceneError;

/// An error of the value at `path` as an answer.
pub(super) fn error<T>(path: &str, message: impl ToString) -> Result<T, SceneError> {
    Err(SceneError::new(path, message))
}
