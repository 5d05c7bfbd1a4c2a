//! The plan of a study: a scene, the keys that it varies, and how their values are combined.

use super::points::{Points, Sample};
use super::subject::{Subject, is_study};
use super::vary::{Values, Vary, wrong};
use crate::batch::journal::fingerprint_of_file;
use crate::error::{Error, InputError};
use crate::input::toml_file::TomlFile;
use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeSet, HashMap};
use std::path::{Path, PathBuf};

/// A study ready to be run.
#[derive(Debug)]
pub struct Plan {
    pub(super) subject: Subject,
    pub(super) points: Points,
    pub(super) definition: Definition,
}

/// The record of a study for those who join its parts: the content of `study.json`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Definition {
    pub version: String,
    pub command: String,
    pub vary: Vec<Vary>,
    pub sample: Sample,
    pub curves: bool,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub show: Option<String>,
    /// The scene that is varied, as a file.
    pub scene: String,
    /// A number for each file that the scene or a value names.
    pub files: Vec<(String, u64)>,
}

impl Definition {
    /// All that the results of one run depend on, beside the values of its keys.
    pub fn of_run(&self) -> String {
        let Definition { version, command, curves, scene, files, .. } = self;
        format!("study {version} {command} {curves} {files:?} {scene}")
    }

    pub fn keys(&self) -> Vec<&str> {
        self.vary.iter().map(|one| one.key.as_str()).collect()
    }

    /// The run of these values as overrides.
    pub fn overrides(&self, values: &[String]) -> Vec<String> {
        self.vary.iter().zip(values).map(|(one, value)| format!("{}={value}", one.key)).collect()
    }
}

/// A study file (TOML).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "A study of `asperity study`")]
pub struct StudyFile {
    /// The scene that is varied, relative to this file.
    pub scene: PathBuf,
    /// Keys and their values: a list, or a text as behind --vary, such as "1 um..5 um/5".
    #[schemars(with = "std::collections::BTreeMap<String, Value>")]
    #[serde(default)]
    pub vary: IndexMap<String, Value>,
    /// Keys and the value that they have in all runs.
    #[schemars(with = "std::collections::BTreeMap<String, Value>")]
    #[serde(default)]
    pub set: IndexMap<String, Value>,
    /// Combination of the values; every combination where it is absent.
    #[serde(default)]
    pub sample: SampleTable,
    /// True where the curve of every run is kept.
    #[serde(default)]
    pub curves: bool,
    /// Column of the results that the picture shows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub show: Option<String>,
}

/// Combination of the values, as a file says it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SampleTable {
    /// Every combination, values in step, a Latin hypercube, or Sobol's sequence.
    pub kind: SampleKind,
    /// Number of points that are drawn.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<usize>,
    /// Other seeds draw other points.
    #[serde(default)]
    pub seed: u64,
}

/// Combination of the values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SampleKind {
    /// Every combination.
    #[default]
    Grid,
    /// The first values of all keys, then the second ones.
    List,
    /// A Latin hypercube.
    Lhs,
    /// Sobol's sequence.
    Sobol,
}

impl SampleTable {
    /// # Errors
    /// Points missing where they are drawn, or given where they are not.
    pub fn sample(&self) -> Result<Sample, InputError> {
        let drawn = matches!(self.kind, SampleKind::Lhs | SampleKind::Sobol);
        match (self.kind, self.points) {
            (SampleKind::Lhs, Some(points)) => Ok(Sample::Lhs { points, seed: self.seed }),
            (SampleKind::Sobol, Some(points)) => Ok(Sample::Sobol { points }),
            (SampleKind::Grid, None) => Ok(Sample::Grid),
            (SampleKind::List, None) => Ok(Sample::List),
            _ if drawn => Err(InputError::new("sample: how many points are to be drawn is missing")
                .help("--sample lhs 100, or [sample] with kind = \"lhs\" and points = 100")),
            _ => Err(InputError::new("sample.points: only lhs and sobol draw points")),
        }
    }
}

impl StudyFile {
    /// Reads the file at `path`; of a scene it is the study that varies nothing yet.
    ///
    /// # Errors
    /// A file that cannot be read, unknown keys, values of another kind.
    pub fn read(path: &Path) -> Result<StudyFile, InputError> {
        if !is_study(path)? {
            return Ok(StudyFile {
                scene: path.into(),
                vary: IndexMap::new(),
                set: IndexMap::new(),
                sample: SampleTable::default(),
                curves: false,
                show: None,
            });
        }
        let file: TomlFile<StudyFile> = TomlFile::read(path, &[])?;
        let scene = file.resolve(&file.value.scene);
        Ok(StudyFile { scene, ..file.value })
    }

    /// The values of every key.
    ///
    /// # Errors
    /// Values of another kind, naming the key.
    pub fn vary(&self) -> Result<Vec<Vary>, InputError> {
        flattened(&self.vary).iter().map(|(key, value)| Vary::new(key, value)).collect()
    }

    /// The values that are the same in all runs, as overrides.
    pub fn overrides(&self) -> Vec<String> {
        let text = |value: &Value| value.as_str().map_or_else(|| value.to_string(), str::to_string);
        flattened(&self.set).iter().map(|(key, value)| format!("{key}={}", text(value))).collect()
    }
}

/// Keys with points for tables within tables, so that both ways to write them in TOML are the same.
fn flattened(table: &IndexMap<String, Value>) -> Vec<(String, Value)> {
    table
        .iter()
        .flat_map(|(key, value)| match value {
            Value::Object(inner) => {
                let inner = inner.iter().map(|(k, v)| (format!("{key}.{k}"), v.clone())).collect();
                flattened(&inner)
            }
            _ => vec![(key.clone(), value.clone())],
        })
        .collect()
}

/// Points that are tried before a study begins.
const MAX_POINTS_TRIED: usize = 200_000;
/// Failures after which no further points are tried.
const FAILURES: usize = 2_000;

impl Plan {
    /// A study of `subject`.
    ///
    /// # Errors
    /// Nothing to vary, values that cannot be combined, and a value that makes no sense with any of the
    /// others that it is tried with; a combination that makes no sense is a row with its reason.
    pub fn new(subject: Subject, vary: Vec<Vary>, sample: Sample) -> Result<Plan, Error> {
        let points = Points::new(&vary, sample)?;
        let (scene, heights) = subject.text()?;
        let mut files: Vec<(String, u64)> = files(&subject, &vary)?;
        if heights != 0 {
            files.push(("heights".into(), heights));
        }
        let version = env!("CARGO_PKG_VERSION").into();
        let command = subject.command().into();
        let definition =
            Definition { version, command, vary, sample, curves: false, show: None, scene, files };
        let plan = Plan { subject, points, definition };
        plan.check()?;
        Ok(plan)
    }

    /// The same, keeping the curve of every run.
    #[must_use]
    pub fn with_curves(mut self) -> Plan {
        self.definition.curves = true;
        self
    }

    /// The same with this column of the results in its picture.
    #[must_use]
    pub fn showing(mut self, column: &str) -> Plan {
        self.definition.show = Some(column.into());
        self
    }

    /// The number of its runs.
    pub fn runs(&self) -> usize {
        self.points.len()
    }

    /// Every value of a list, and every range, with at least one combination that makes sense.
    fn check(&self) -> Result<(), InputError> {
        let vary = &self.definition.vary;
        let listed: Vec<bool> = vary.iter().map(|one| one.count().is_some()).collect();
        let mut good: BTreeSet<(usize, String)> = BTreeSet::new();
        let mut bad: Vec<((usize, String), usize)> = Vec::new();
        let mut errors: Vec<InputError> = Vec::new();
        let mut seen: HashMap<(usize, String), usize> = HashMap::new();
        for i in 0..self.points.len().min(MAX_POINTS_TRIED) {
            let values = self.points.get(i);
            let levels: Vec<(usize, String)> = (0..vary.len())
                .map(|key| (key, if listed[key] { values[key].clone() } else { String::new() }))
                .collect();
            if levels.iter().all(|level| good.contains(level)) {
                continue;
            }
            match self.subject.with(&self.definition.overrides(&values)) {
                Ok(_) => good.extend(levels),
                Err(e) => {
                    for level in levels {
                        seen.entry(level.clone()).or_insert_with(|| {
                            bad.push((level, errors.len()));
                            errors.len()
                        });
                    }
                    errors.push(e);
                }
            }
            if errors.len() >= FAILURES {
                break;
            }
        }
        // of several values without a combination the one that an error names
        let hopeless = bad.iter().filter(|(level, _)| !good.contains(level));
        let named = |(key, _): &(usize, String), error: &InputError| {
            let text = error.place.as_ref().map_or(error.message.clone(), |place| place.text.clone());
            text.starts_with(&vary[*key].key)
        };
        let mut hopeless: Vec<_> = hopeless.collect();
        hopeless.sort_by_key(|(level, error)| !named(level, &errors[*error]));
        let Some(&&(ref level, error)) = hopeless.first() else { return Ok(()) };
        let key = &vary[level.0].key;
        let mut error = errors.swap_remove(error);
        if let Some(place) = error.place.as_mut().filter(|place| place.name == "--set") {
            place.name = "--vary".into();
        }
        if !error.message.contains(key.as_str()) {
            error.message = format!("{key}: {}", error.message);
        }
        Err(error)
    }
}

/// The files that the scene or a value names, with a number for the content of each.
fn files(subject: &Subject, vary: &[Vary]) -> Result<Vec<(String, u64)>, InputError> {
    let mut words: BTreeSet<String> = subject.words().into_iter().collect();
    for one in vary {
        // a number between two others names no file
        if let Values::List(levels) = &one.values {
            words.extend(levels.iter().map(|level| level.trim_matches('"').to_string()));
        }
    }
    let mut found = Vec::new();
    for word in words.into_iter().filter(|word| !word.is_empty()) {
        let path = subject.resolve(Path::new(&word));
        if path.is_file() {
            let number = fingerprint_of_file(&path)
                .map_err(|e| wrong(&word, &format!("cannot read {}: {e}", path.display())))?;
            found.push((word, number));
        }
    }
    Ok(found)
}
