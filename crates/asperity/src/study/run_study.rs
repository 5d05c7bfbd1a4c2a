//! A study from its plan to its rows, its files, and its parts joined.

use super::picture;
use super::plan::{Definition, Plan};
use super::points::Points;
use super::row::{self, Outcome, Run, columns};
use crate::batch::journal::fingerprint;
use crate::batch::{self, Batch, Options, Shard, all_found, not_a_part};
use crate::error::{Error, InputError};
use crate::input::suggest::nearest;
use crate::progress::{Observer, Progress};
use crate::results::numbers::significant;
use crate::results::output::{Sink, SinkExt, write_whole};
use asperity_solver::body::analysis::Analyses;
use std::collections::HashMap;
use std::fmt::{Display, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The runs of a study.
#[derive(Clone, Debug)]
pub struct Study {
    /// The varied keys.
    pub keys: Vec<String>,
    /// One for every run, in the order of the plan: `results.csv` and `times.csv`.
    pub runs: Vec<Run>,
    /// True where the observer ended the study before all runs were done.
    pub stopped: bool,
    /// Seconds it took.
    pub wall_s: f64,
    definition: Definition,
}

/// The journal of a study in the folder of its results.
const JOURNAL: &str = "study.journal";
/// The plan of the study.
const DEFINITION: &str = "study.json";
/// The folder of the curves in the folder of the results.
const CURVES: &str = "curves";

/// Runs all that the folder of `options` does not hold yet, a thread a run.
///
/// `observer` is asked at the beginning, as runs go on and when they end, from the thread that runs them;
/// `false` ends the study, which keeps the runs that are done.
///
/// # Errors
/// A folder that cannot be written (it keeps every finished run), or curves without a folder. A run that
/// fails is a row with its reason.
///
/// # Examples
/// ```
/// use asperity::study::{Options, Plan, Sample, Subject, Vary, study};
/// use asperity::Scene;
///
/// let text = include_str!("../../scenes/single-asperity.toml");
/// let mut scene = Scene::from_toml(text, std::path::Path::new("")).unwrap();
/// scene.set("accuracy", "draft")?;
/// let vary = vec![Vary::parse("loading.depth=0.5 um,1 um")?];
/// let plan = Plan::new(Subject::Crush(Box::new(scene)), vary, Sample::Grid)?;
/// let study = study(&plan, &Options::default(), &mut |_| true)?;
/// let force = |i: usize| study.runs[i].number("peak_force_N").unwrap();
/// assert!(study.runs.len() == 2 && force(1) > force(0));
/// # Ok::<(), asperity::Error>(())
/// ```
pub fn study(plan: &Plan, options: &Options, observer: &mut Observer<'_, Run>) -> Result<Study, Error> {
    let start = Instant::now();
    let definition = &plan.definition;
    let folder = options.folder.as_deref();
    if definition.curves && folder.is_none() {
        return Err(InputError::new("curves are kept in files: give a folder for them").into());
    }
    if let Some(folder) = folder {
        write_whole(&folder.join(DEFINITION), crate::results::output::json(definition)?.as_bytes())?;
    }
    let values: Vec<Vec<String>> =
        Shard::case_numbers(options.part, plan.points.len()).map(|i| plan.points.get(i)).collect();
    let journal = folder.map(|folder| folder.join(JOURNAL));
    let analyses = Analyses::for_threads(batch::thread_count(options.threads));
    let batch = Batch {
        definition: &definition.of_run(),
        cases: &values,
        key: &|values: &Vec<String>| key(definition, values),
        solve: &|values: &Vec<String>, go_on: &dyn Fn() -> bool| {
            solve(plan, values, folder, &analyses, go_on)
        },
        threads: options.threads,
        journal: journal.as_deref(),
    };
    let finished = batch::run(&batch, &mut |reached: &Progress<'_, (Vec<String>, Outcome)>| {
        let ended = reached.news.map(|(values, outcome)| Run::new(values.clone(), outcome.clone()));
        observer(&reached.telling(ended.as_ref()))
    })?;
    let runs =
        finished.rows.into_iter().map(|(i, (_, outcome))| Run::new(values[i].clone(), outcome)).collect();
    Ok(Study {
        stopped: finished.stopped,
        wall_s: start.elapsed().as_secs_f64(),
        ..Study::new(definition.clone(), runs)
    })
}

/// Names a run in the journal.
fn key(definition: &Definition, values: &[String]) -> String {
    definition.overrides(values).join("; ")
}

/// One run with its values, its curve in the folder.
fn solve(
    plan: &Plan,
    values: &[String],
    folder: Option<&Path>,
    analyses: &Analyses,
    go_on: &dyn Fn() -> bool,
) -> Option<(Vec<String>, Outcome)> {
    let start = Instant::now();
    let definition = &plan.definition;
    let outcome = match plan.subject.with(&definition.overrides(values)) {
        Ok(scene) => scene.run(definition.curves, analyses, go_on)?,
        Err(e) => Outcome::new(Default::default(), e.to_string()),
    };
    let mut outcome = Outcome { wall_s: start.elapsed().as_secs_f64(), ..outcome };
    if let (Some(text), Some(folder)) = (&outcome.curve, folder) {
        // named by what was run, so that a study that grows keeps the names
        let name = format!("{CURVES}/{:016x}.csv", fingerprint(key(definition, values)));
        let path = folder.join(&name);
        let written = std::fs::create_dir_all(folder.join(CURVES)).map_err(|e| Error::disk(&path, e));
        match written.and_then(|()| write_whole(&path, text.as_bytes())) {
            Ok(()) => outcome.curve = Some(name),
            Err(e) => outcome = Outcome { curve: None, status: e.to_string(), ..outcome },
        }
    }
    Some((values.to_vec(), outcome))
}

impl Study {
    fn new(definition: Definition, runs: Vec<Run>) -> Study {
        let keys = definition.keys().into_iter().map(str::to_string).collect();
        Study { keys, runs, stopped: false, wall_s: 0.0, definition }
    }

    /// The column that the picture shows.
    pub fn shown(&self) -> Option<&str> {
        // of a half-space the area that is corrected for pixels
        const USUAL_COLUMNS: [&str; 4] =
            ["peak_force_N", "peak_force_N_per_mm", "contact_area_ratio_corrected", "contact_area_ratio"];
        let columns = columns(&self.runs);
        let usual = || {
            let named = USUAL_COLUMNS.into_iter().find_map(|name| columns.get(name));
            let of_closure = |end: &str| columns.iter().find(|name| name.ends_with(end));
            named
                .or_else(|| of_closure(".contact_area_ratio_corrected"))
                .or_else(|| of_closure(".contact_area_ratio"))
        };
        match &self.definition.show {
            Some(name) => columns.get(name.as_str()).copied(),
            None => usual().or_else(|| columns.first()).copied(),
        }
    }

    /// The text of `results.csv`.
    ///
    /// # Errors
    /// None that is known: every row has the same columns.
    pub fn results_csv(&self) -> Result<String, Error> {
        row::results(&self.keys, &self.runs).map_err(|e| Error::Unfinished(e.to_string()))
    }

    /// The text of `times.csv`.
    ///
    /// # Errors
    /// None that is known: every row has the same columns.
    pub fn times_csv(&self) -> Result<String, Error> {
        row::times(&self.keys, &self.runs).map_err(|e| Error::Unfinished(e.to_string()))
    }

    /// The picture, where there is something to draw.
    ///
    /// # Errors
    /// A column that is to be drawn and is none, a drawing that fails.
    pub fn svg(&self) -> Result<Option<String>, Error> {
        let Some(column) = self.shown() else {
            let Some(name) = self.definition.show.as_ref().filter(|_| self.runs.iter().any(Run::ok)) else {
                return Ok(None);
            };
            let known: Vec<&str> = columns(&self.runs).into_iter().collect();
            let error = InputError::new(format!("`{name}` is no column of the results"));
            let near =
                nearest(name, &known).map_or_else(String::new, |near| format!("did you mean `{near}`? "));
            let way = "the runs are kept: the same command with another --show draws at once";
            return Err(error.help(format!("{near}{way}; there are {}", known.join(", "))).into());
        };
        picture::draw(&self.definition.vary, &self.runs, column).map(Some).map_err(Error::Unfinished)
    }

    /// Writes `results.csv`, `times.csv` and, where there is something to draw, `study.svg`.
    ///
    /// # Errors
    /// A disk that refuses, a column that is to be drawn and is none.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.text("results.csv", &self.results_csv()?)?;
        sink.text("times.csv", &self.times_csv()?)?;
        self.svg()?.map_or(Ok(()), |picture| sink.text("study.svg", &picture))
    }

    /// Copies the curves of the runs from the folders of the parts to `target`.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn copy_curves(&self, parts: &[PathBuf], target: &Path) -> Result<(), Error> {
        for name in self.runs.iter().filter_map(|run| run.curve.as_ref()) {
            let to = target.join(name);
            let from = parts.iter().map(|part| part.join(name)).find(|path| path.is_file());
            let Some(from) = from.filter(|from| *from != to) else { continue };
            let made = to.parent().map_or(Ok(()), std::fs::create_dir_all);
            made.and_then(|()| std::fs::copy(&from, &to)).map_err(|e| Error::disk(&to, e))?;
        }
        Ok(())
    }

    /// Runs that reached their end with larger errors than their accuracy promises.
    fn promises_missed(&self) -> usize {
        let missed = |run: &&Run| run.ok() && run.results.get("promise_kept") == Some(&false.into());
        self.runs.iter().filter(missed).count()
    }

    /// The result for a person.
    pub fn text(&self) -> String {
        let failed: Vec<&Run> = self.runs.iter().filter(|run| !run.ok()).collect();
        let seconds: f64 = self.runs.iter().map(|run| run.wall_s).sum();
        let mut text = format!(
            "runs      {} ({} failed) in {:.1} s; {:.3} s a run",
            self.runs.len(),
            failed.len(),
            self.wall_s,
            seconds / self.runs.len().max(1) as f64
        );
        for run in failed.iter().take(5) {
            let values = self.definition.overrides(&run.values).join(", ");
            let _ = write!(text, "\nfailed    {values}: {}", run.status);
        }
        let missed = self.promises_missed();
        if missed > 0 {
            let _ = write!(
                text,
                "\nmissed    {missed} (promise_kept is false: more error is stated than the accuracy promises)"
            );
        }
        if let Some(column) = self.shown() {
            let numbers = || self.runs.iter().filter(|run| run.ok()).filter_map(|run| run.number(column));
            let (low, high) =
                numbers().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
            if low <= high {
                let _ = write!(text, "\n{column} from {} to {}", significant(low), significant(high));
            }
        }
        text
    }

    /// Its plan and its outcome, as JSON.
    ///
    /// # Errors
    /// None that is known: names and numbers are JSON.
    pub fn json(&self) -> Result<String, Error> {
        let failed = self.runs.iter().filter(|run| !run.ok()).count();
        crate::results::output::json(&serde_json::json!({
            "keys": self.keys, "runs": self.runs.len(), "failed": failed,
            "promises_missed": self.promises_missed(), "wall_s": self.wall_s,
        }))
    }
}

/// Joins the folders of all parts of a study; [`Study::copy_curves`] brings their curves.
///
/// # Errors
/// Folders that hold no parts, parts of different studies, or runs that are in none of them.
pub fn merge(parts: &[PathBuf]) -> Result<Study, Error> {
    let start = Instant::now();
    let wrong = |part: &Path, file: &str, why: &dyn Display| not_a_part("study", part, file, why);
    let (definition, found) = batch::parts(parts, |part| {
        let text = std::fs::read_to_string(part.join(DEFINITION)).map_err(|e| wrong(part, DEFINITION, &e))?;
        let definition: Definition = serde_json::from_str(&text).map_err(|e| wrong(part, DEFINITION, &e))?;
        let rows = batch::read::<(Vec<String>, Outcome)>(&part.join(JOURNAL), &definition.of_run());
        Ok((definition, rows.map_err(|e| wrong(part, JOURNAL, &e))?))
    })?;
    let found: HashMap<String, Outcome> =
        found.into_iter().map(|(key, (_, outcome))| (key, outcome)).collect();
    let points = Points::new(&definition.vary, definition.sample)?;
    let all: Vec<Vec<String>> = (0..points.len()).map(|i| points.get(i)).collect();
    let keys: Vec<String> = all.iter().map(|values| key(&definition, values)).collect();
    all_found(&keys, &found)?;
    let run = |values: Vec<String>| {
        let outcome = found.get(&key(&definition, &values))?.clone();
        Some(Run::new(values, outcome))
    };
    let runs = all.into_iter().filter_map(run).collect();
    Ok(Study { wall_s: start.elapsed().as_secs_f64(), ..Study::new(definition, runs) })
}
