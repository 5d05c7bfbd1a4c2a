//! The place of results, anything that can give a path to each file by its name, and rows as CSV.

use crate::batch::journal::{Journal, Opened, fingerprint};
use crate::error::{Error, InputError};
use crate::results::numbers::shortest;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer, Serialize};
use std::fmt::Display;
use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

/// A place that takes the files of a result, each known by its name.
pub trait Sink {
    /// The path that the file `name` is to be written to.
    ///
    /// # Errors
    /// A disk that refuses.
    fn path(&mut self, name: &str) -> Result<PathBuf, Error>;

    /// Removes the file `name` again, which was written.
    ///
    /// # Errors
    /// A disk that refuses.
    fn remove(&mut self, name: &str) -> Result<(), Error> {
        let path = self.path(name)?;
        std::fs::remove_file(&path).map_err(|e| Error::disk(&path, e))
    }
}

/// Writing to any [`Sink`].
pub trait SinkExt: Sink {
    /// Writes the file `name` with what `write` gives it.
    ///
    /// # Errors
    /// A disk that refuses.
    fn write<E: Display>(
        &mut self,
        name: &str,
        write: impl FnOnce(&mut dyn Write) -> Result<(), E>,
    ) -> Result<(), Error> {
        let path = self.path(name)?;
        let file = File::create(&path).map_err(|e| Error::disk(&path, e))?;
        let mut out = BufWriter::new(file);
        write(&mut out).map_err(|e| Error::disk(&path, e))?;
        out.flush().map_err(|e| Error::disk(&path, e))
    }

    /// Writes `text` as the file `name`.
    ///
    /// # Errors
    /// A disk that refuses.
    fn text(&mut self, name: &str, text: &str) -> Result<(), Error> {
        self.write(name, |out| out.write_all(text.as_bytes()))
    }

    /// Writes `picture`, or gives why there is none.
    ///
    /// # Errors
    /// A disk that refuses, or the reason.
    fn picture(&mut self, name: &str, picture: Result<Vec<u8>, String>) -> Result<(), Error> {
        let bytes = picture.map_err(Error::Unfinished)?;
        self.write(name, |out| out.write_all(&bytes))
    }

    /// Writes `rows` as the CSV file `name`: its columns are their fields.
    ///
    /// # Errors
    /// A disk that refuses, or rows that are not flat.
    fn csv<T: Serialize>(&mut self, name: &str, rows: &[T]) -> Result<(), Error> {
        self.write(name, |out| {
            let mut table = csv::Writer::from_writer(out);
            rows.iter().try_for_each(|row| table.serialize(row))?;
            table.flush().map_err(csv::Error::from)
        })
    }
}

impl<S: Sink + ?Sized> SinkExt for S {}

/// A plain folder: files of the same name are replaced.
#[derive(Clone, Debug)]
pub struct Directory(PathBuf);

impl Directory {
    /// The folder at `path`, made if it is not there.
    ///
    /// # Errors
    /// A folder that cannot be made.
    pub fn create(path: &Path) -> Result<Directory, Error> {
        std::fs::create_dir_all(path).map_err(|e| Error::disk(path, e))?;
        Ok(Directory(path.to_path_buf()))
    }
}

impl Sink for Directory {
    fn path(&mut self, name: &str) -> Result<PathBuf, Error> {
        let path = self.0.join(name);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|e| Error::disk(folder, e))?;
        }
        Ok(path)
    }
}

/// A row of a file: every field declared once under its name in the file, with its value in terms of what the
/// row is made from.
#[macro_export]
macro_rules! row {
    ($(#[$about:meta])* $row:ident($($from:ident: $record:ty),*) {
        $($(#[$($field_about:tt)*])* $field:ident: $kind:ty = $value:expr,)*
    }) => {
        #[derive(Clone, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
        $(#[$about])*
        pub struct $row {
            $($(#[$($field_about)*])* pub $field: $kind,)*
        }

        impl $row {
            /// The row of what it is made from.
            pub fn new($($from: $record),*) -> $row {
                $row { $($field: $value,)* }
            }
        }

        impl $crate::results::columns::Described for $row {
            const COLUMNS: &'static [$crate::results::columns::Column] = &[$($crate::results::columns::Column {
                quantity: stringify!($field),
                unit: $crate::results::columns::Unit::Plain,
                about: concat!($($crate::about_in!($($field_about)*)),*),
            }),*];
        }
    };
}
pub use row;

/// Writes beside the file and renames, so that it is whole or as it was.
///
/// # Errors
/// A disk that refuses.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let partial = path_beside(path, ".partial");
    std::fs::write(&partial, bytes)
        .and_then(|()| std::fs::rename(&partial, path))
        .map_err(|e| Error::disk(path, e))
}

/// The path with `ending` after its last name.
pub fn path_beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_os_string();
    name.push(ending);
    name.into()
}

/// The journal at `path` of the work that `definition` says, with what it holds.
///
/// # Errors
/// A file that cannot be read or written.
pub(crate) fn open_journal(path: Option<&Path>, definition: &str) -> Result<Option<Opened>, InputError> {
    let opened = path.map(|path| {
        Journal::open(path, fingerprint(definition))
            .map_err(|e| InputError::new(format!("cannot write the journal {}: {e}", path.display())))
    });
    opened.transpose()
}

/// Writes rows as CSV under the names of their fields: numbers in the shortest digits that read back to the
/// same bits, those that are not finite as empty cells. Without rows there is no header.
///
/// # Errors
/// A writer that fails, or rows that are not flat.
pub fn write_csv<T: Serialize>(out: impl Write, rows: &[T]) -> csv::Result<()> {
    let mut plain = csv::Writer::from_writer(Vec::new());
    rows.iter().try_for_each(|row| plain.serialize(row))?;
    let plain = plain.into_inner().map_err(|e| e.into_error())?;
    let mut records = csv::Reader::from_reader(&plain[..]);
    let mut out = csv::Writer::from_writer(out);
    out.write_record(records.headers()?)?;
    for record in records.records() {
        out.write_record(record?.iter().map(cell))?;
    }
    Ok(out.flush()?)
}

/// `value` as indented JSON, its keys in the order of its fields.
///
/// # Errors
/// A value that JSON cannot hold.
pub fn json<T: Serialize>(value: &T) -> Result<String, Error> {
    serde_json::to_string_pretty(value).map_err(no_json)
}

/// The same with the keys in alphabetical order.
///
/// # Errors
/// A value that JSON cannot hold.
pub fn sorted_json<T: Serialize>(value: &T) -> Result<String, Error> {
    json(&serde_json::to_value(value).map_err(no_json)?)
}

fn no_json(error: serde_json::Error) -> Error {
    Error::Unfinished(format!("a result is not JSON: {error}"))
}

/// The text of a cell with its number, if it is one, as files have it.
fn cell(text: &str) -> String {
    match text.parse::<f64>() {
        Ok(value) if !value.is_finite() || text.contains(['.', 'e']) => shortest(value),
        _ => text.to_string(),
    }
}

/// Reads the rows of a CSV file.
///
/// # Errors
/// A file that cannot be read, a column that is missing, a cell that is no value of its column.
pub fn read_csv<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, Error> {
    let rows = csv::Reader::from_path(path).and_then(|reader| reader.into_deserialize().collect());
    rows.map_err(|e| InputError::new(format!("cannot read {}: {e}", path.display())).into())
}

/// JSON has no NaN.
pub(crate) fn nan_for_null<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}
