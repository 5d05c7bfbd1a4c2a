//! Tables of numbers that a scene names, with what is needed to point at their lines later.

use crate::error::InputError;
use crate::input::RELATIVE_PATH_NOTE;
use crate::input::toml_file::TomlFile;
use asperity_formats::text::{TextError, decode};
use asperity_simulation::scene::{Scene, SceneError};
use std::io::Read;
use std::path::Path;

/// A table that was read.
pub struct TableFile {
    /// Its path, for people.
    name: String,
    /// Its text.
    pub text: String,
    /// Its encoding, or the sheet of a workbook.
    encoding: String,
    /// Key of the scene that names it.
    key: String,
}

/// One line on a text table as it was understood: its file, its encoding, its columns.
pub fn understood(name: &str, encoding: &str, columns: &str) -> String {
    format!("{name}: {encoding} text: {columns}")
}

impl TableFile {
    /// Reads the table that the scene names under `key`, of at most `limit` bytes.
    ///
    /// # Errors
    /// A file that cannot be read, is no text or is larger, pointing at the key.
    pub fn read(
        scene: &TomlFile<Scene>,
        key: &str,
        named: &Path,
        limit: u64,
    ) -> Result<TableFile, InputError> {
        let path = scene.resolve(named);
        let mut table = TableFile {
            name: path.display().to_string(),
            text: String::new(),
            encoding: String::new(),
            key: key.into(),
        };
        let unreadable = |e: std::io::Error| {
            scene.error_at(key, &format!("{}: cannot be read: {e}; {RELATIVE_PATH_NOTE}", path.display()))
        };
        let opened = std::fs::File::open(&path).map_err(unreadable)?;
        let mut bytes = Vec::new();
        opened.take(limit + 1).read_to_end(&mut bytes).map_err(unreadable)?;
        if bytes.len() as u64 > limit {
            return Err(table.refuse(scene, &format!("is larger than {} MB: thin it out", limit >> 20)));
        }
        let decoded = decode(&bytes).map(|(text, encoding)| (text.into_owned(), encoding.into_owned()));
        (table.text, table.encoding) = decoded.map_err(|e| table.refuse(scene, &e.message))?;
        Ok(table)
    }

    /// One line on the table as it was understood.
    pub fn understood(&self, columns: &str) -> String {
        understood(&self.name, &self.encoding, columns)
    }

    /// An error about the table as a whole, at the key that names it.
    pub fn refuse(&self, scene: &TomlFile<Scene>, reason: &str) -> InputError {
        scene.error_at(&self.key, &format!("{}: {reason}", self.name))
    }

    /// An error of the reader of tables, at its line where it has one.
    pub fn error(&self, scene: &TomlFile<Scene>, error: &TextError) -> InputError {
        match error.line {
            Some(line) => self.at_line(line, &error.message),
            None => self.refuse(scene, &error.message),
        }
    }

    /// An error that shows a line (from 1) of the table.
    pub fn at_line(&self, line: usize, message: &str) -> InputError {
        let start = self.text.split_inclusive('\n').take(line - 1).map(str::len).sum();
        InputError::new(message).pointing_at(&self.name, &self.text, start..self.text.len())
    }

    /// An error of the scene about the `values` that stand in the place of this table: at the line of its
    /// point, whose `lines` are given, or about the table as a whole.
    pub fn point_at(
        &self,
        scene: &TomlFile<Scene>,
        values: &str,
        lines: &[usize],
        error: &SceneError,
    ) -> Option<InputError> {
        let rest = error.path.strip_prefix(values)?;
        if rest.is_empty() {
            return Some(self.refuse(scene, &error.message));
        }
        let point = rest.strip_prefix('[')?.strip_suffix(']')?;
        let line = *lines.get(point.parse::<usize>().ok()?)?;
        Some(self.at_line(line, &error.message))
    }
}
