//! The scene that a study varies, of any kind that can be run.

use super::row::{Outcome, flat};
use crate::crush::{crush_sharing, write_rows};
use crate::error::{Error, InputError};
use crate::input::scene::Scene;
use crate::input::toml_file::{TomlFile, to_toml};
use crate::results::output::write_csv;
use crate::rough::{RoughScene, press};
use asperity_solver::body::analysis::Analyses;
use indexmap::IndexMap;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A scene of any kind.
#[derive(Debug)]
pub enum Subject {
    /// Of `asperity crush`.
    Crush(Box<Scene>),
    /// Of `asperity rough`.
    Rough(Box<RoughScene>),
}

impl Subject {
    /// Reads the scene at `path` with overrides `key.path=value`; its tables tell its kind.
    ///
    /// # Errors
    /// A file that cannot be read or is no scene, pointing at the line.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Subject, Error> {
        let tables: TomlFile<IndexMap<String, Value>> = TomlFile::read(path, overrides)?;
        if ["surface", "closure"].iter().any(|key| tables.value.contains_key(*key)) {
            let scene = RoughScene::read(path, overrides)?;
            scene.validate()?;
            return Ok(Subject::Rough(Box::new(scene)));
        }
        Scene::read(path, overrides).map(|scene| Subject::Crush(Box::new(scene)))
    }

    /// The command that runs one of them.
    pub fn command(&self) -> &'static str {
        match self {
            Subject::Crush(_) => "crush",
            Subject::Rough(_) => "rough",
        }
    }

    /// Name of its file without extension.
    pub fn name(&self) -> String {
        match self {
            Subject::Crush(scene) => scene.name(),
            Subject::Rough(scene) => scene.name(),
        }
    }

    /// The scene with more overrides `key.path=value`, checked.
    ///
    /// # Errors
    /// An override that names no key, or a value that makes no sense.
    pub fn with(&self, overrides: &[String]) -> Result<Subject, InputError> {
        let input = |e: Error| match e {
            Error::Input(e) => e,
            Error::Unfinished(reason) => InputError::new(reason),
        };
        match self {
            Subject::Crush(scene) => {
                scene.with(overrides).map(|scene| Subject::Crush(Box::new(scene))).map_err(input)
            }
            Subject::Rough(scene) => {
                let scene = scene.with(overrides)?;
                scene.validate()?;
                Ok(Subject::Rough(Box::new(scene)))
            }
        }
    }

    /// The scene as a file, and a number that stands for what it holds beside that.
    pub(super) fn text(&self) -> Result<(String, u64), Error> {
        match self {
            Subject::Crush(scene) => Ok((scene.to_toml()?, 0)),
            Subject::Rough(scene) => {
                Ok((to_toml(scene.tables()).map_err(Error::Unfinished)?, scene.heights_mark()))
            }
        }
    }

    /// The text values of the scene, among which are the names of its files.
    pub(super) fn words(&self) -> Vec<String> {
        let tables = match self {
            Subject::Crush(scene) => serde_json::to_value(scene.tables()),
            Subject::Rough(scene) => serde_json::to_value(scene.tables()),
        };
        let mut found = Vec::new();
        words(&tables.unwrap_or_default(), &mut found);
        found
    }

    /// A path of the scene as one that can be opened.
    pub(super) fn resolve(&self, path: &Path) -> PathBuf {
        match self {
            Subject::Crush(scene) => scene.resolve(path),
            Subject::Rough(scene) => scene.resolve(path),
        }
    }

    /// Runs it, with its curve as the text of a file if `curve`; `None` where `go_on` ended it. Runs of one
    /// study share `analyses`.
    pub(super) fn run(&self, curve: bool, analyses: &Analyses, go_on: &dyn Fn() -> bool) -> Option<Outcome> {
        let mut ended = false;
        let mut observe = || {
            ended = ended || !go_on();
            !ended
        };
        let outcome = match self {
            Subject::Crush(scene) => crush_sharing(scene, analyses, &mut |_| observe()).and_then(|crush| {
                let status = crush.summary.stopped.clone().unwrap_or_else(|| "ok".into());
                let symmetry = crush.summary.scene.symmetry;
                let text = written(curve, |out| write_rows(out, &crush.curve, symmetry))?;
                Ok(Outcome { curve: text, ..Outcome::new(flat(&crush.summary)?, status) })
            }),
            Subject::Rough(scene) => press(scene, &mut |_| observe()).and_then(|rough| {
                let mut columns = flat(&rough.summary)?;
                let several = scene.tables().closure.is_several();
                for (row, closure) in rough.table.iter().zip(&rough.summary.closures) {
                    for (name, value) in flat(closure)? {
                        let name = if several { format!("{}.{name}", row.closure.name()) } else { name };
                        // of one closure its own number, as the nominal area of a half-space
                        if !value.is_null() || !columns.contains_key(&name) {
                            columns.insert(name, value);
                        }
                    }
                }
                let status =
                    if rough.table.is_empty() { rough.summary.warnings.join("; ") } else { "ok".into() };
                let text = written(curve, |out| write_csv(out, &rough.load_curve))?;
                Ok(Outcome { curve: text, ..Outcome::new(columns, status) })
            }),
        };
        (!ended).then(|| outcome.unwrap_or_else(|e| Outcome::new(IndexMap::new(), e.to_string())))
    }
}

fn written(
    wanted: bool,
    write: impl FnOnce(&mut Vec<u8>) -> csv::Result<()>,
) -> Result<Option<String>, Error> {
    let mut out = Vec::new();
    if !wanted {
        return Ok(None);
    }
    write(&mut out).map_err(|e| Error::Unfinished(e.to_string()))?;
    Ok(Some(String::from_utf8_lossy(&out).into_owned()))
}

fn words(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::String(text) => found.push(text.clone()),
        Value::Array(list) => list.iter().for_each(|value| words(value, found)),
        Value::Object(table) => table.values().for_each(|value| words(value, found)),
        _ => {}
    }
}

/// True where a file can be told from a scene by its keys: a study names one.
pub(super) fn is_study(path: &Path) -> Result<bool, InputError> {
    let tables: TomlFile<IndexMap<String, Value>> = TomlFile::read(path, &[])?;
    Ok(["scene", "vary"].iter().any(|key| tables.value.contains_key(*key)))
}
