//! The table of hardening that a scene names, read into the scene.

use crate::error::InputError;
use crate::input::toml_file::TomlFile;
use asperity_law::units::Stress;
use asperity_law::{CurveFile, LARGEST_TABLE};
use asperity_solver::scene::{HardeningChoice, Material, Scene, SceneError};
use std::io::Read;

/// No line of a table is longer, on average.
const LONGEST_LINE: u64 = 100;

/// A table that was read, with what is needed to point at its lines later.
pub struct ReadCurve {
    name: String,
    text: String,
    file: CurveFile,
}

/// The table that the scene names; `None` where it names none, or names one that it cannot use, which validation says.
///
/// # Errors
/// A file that cannot be read or holds no curve of hardening, pointing at its line.
pub fn read(scene: &TomlFile<Scene>) -> Result<Option<ReadCurve>, InputError> {
    let material = &scene.value.material;
    let table = material.hardening_law == HardeningChoice::Table && material.hardening_table.is_none();
    let Some(named) = material.hardening_file.as_ref().filter(|_| table) else { return Ok(None) };
    let path = scene.resolve(named);
    let name = path.display().to_string();
    let refuse = |reason: String| scene.error_at("material.hardening_file", &format!("{name}: {reason}"));
    let unreadable = |e: std::io::Error| refuse(format!("cannot be read: {e}"));
    let limit = LONGEST_LINE * LARGEST_TABLE as u64;
    let mut text = String::new();
    let opened = std::fs::File::open(&path).map_err(unreadable)?;
    opened.take(limit + 1).read_to_string(&mut text).map_err(unreadable)?;
    if text.len() as u64 > limit {
        return Err(refuse(format!("is larger than {} MB: thin it out", limit >> 20)));
    }
    match CurveFile::parse(&text) {
        Ok(file) => Ok(Some(ReadCurve { name, text, file })),
        Err(error) => Err(match error.line {
            Some(line) => at_line(&name, &text, line, &error.message),
            None => refuse(error.message),
        }),
    }
}

impl ReadCurve {
    /// Puts the table in the place of its file.
    pub fn put_into(&self, material: &mut Material) {
        material.hardening_file = None;
        material.hardening_table =
            Some(self.file.points.iter().map(|&[strain, stress]| (strain, Stress(stress))).collect());
    }

    /// An error of the scene that is about a point of this table, at its line.
    pub fn point_at(&self, error: &SceneError) -> Option<InputError> {
        let point = error.path.strip_prefix("material.hardening_table[")?.strip_suffix(']')?;
        let line = *self.file.lines.get(point.parse::<usize>().ok()?)?;
        Some(at_line(&self.name, &self.text, line, &error.message))
    }
}

/// An error that shows a line (from 1) of a table.
fn at_line(name: &str, text: &str, line: usize, message: &str) -> InputError {
    let start = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
    InputError::new(message).at(name, text, start..text.len())
}
