//! Where results are put: anything that can give a path to each file by its name.

use crate::error::Error;
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
        Ok(self.0.join(name))
    }
}

/// Writes beside the file and renames, so that it is whole or as it was.
///
/// # Errors
/// A disk that refuses.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut beside = path.as_os_str().to_os_string();
    beside.push(".partial");
    std::fs::write(&beside, bytes)
        .and_then(|()| std::fs::rename(&beside, path))
        .map_err(|e| Error::disk(path, e))
}
