//! Results as JSON: a type per file, keys in alphabetical order.

use crate::error::Error;
use serde::Serialize;

/// `value` as indented text.
pub(crate) fn text<T: Serialize>(value: &T) -> Result<String, Error> {
    let sorted = serde_json::to_value(value).and_then(|value| serde_json::to_string_pretty(&value));
    sorted.map_err(|e| Error::Unfinished(format!("a result is not JSON: {e}")))
}
