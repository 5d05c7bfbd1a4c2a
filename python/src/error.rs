//! Errors of the library as exceptions.

use asperity::{Error, InputError as Wrong};
use pyo3::create_exception;
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;

create_exception!(
    asperity,
    InputError,
    PyValueError,
    "A scene or an argument is wrong; the message names the key, the allowed range and a way out."
);
create_exception!(
    asperity,
    UnfinishedError,
    PyRuntimeError,
    "The work could not be finished; the message says where and why."
);

/// Adds the exceptions to the module.
pub fn add(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("InputError", module.py().get_type::<InputError>())?;
    module.add("UnfinishedError", module.py().get_type::<UnfinishedError>())
}

/// Names of texts that the library writes from the tables of a call.
const OF_TABLES: [&str; 3] = ["scene", "fit", "sweep"];

/// An error of the library as an exception.
pub fn raised(error: impl Into<Error>) -> PyErr {
    match error.into() {
        Error::Input(error) => {
            let of_tables =
                error.place.as_ref().is_some_and(|place| OF_TABLES.contains(&place.name.as_str()));
            InputError::new_err(if of_tables { error.in_tables().full() } else { error.full() })
        }
        Error::Unfinished(reason) => UnfinishedError::new_err(reason),
    }
}

/// Input that is wrong.
pub fn wrong(message: impl Into<String>) -> PyErr {
    raised(Wrong::new(message))
}
