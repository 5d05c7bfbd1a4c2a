//! One part from its definition to a folder of files, and the stamp that says it is done.
//!
//! A stamp is written when the files are in their place and taken away before they change, so that a part
//! that was killed is begun anew; the sweep resumes from its journal.

use super::plan::{Part, Work};
use super::profile::profile;
use super::zones::Zones;
use crate::table1;
use asperity::Progress;
use asperity::calibrate::{Options, calibrate};
use asperity::calibration::row::CaseRow;
use asperity::calibration::sweep::Sweep;
use asperity::crush::{Increment, Sketch, crush_into};
use asperity::error::Error;
use asperity::input::scene::Scene;
use asperity::input::toml_file::TomlFile;
use asperity::output::{Directory, Sink, SinkExt, write_csv, write_whole};
use asperity::rough::{self, RoughScene};
use asperity::roughness::scene::Scene as RoughTables;
use asperity::roughness::{Closure, KindName};
use asperity::simulation::run::Run;
use asperity::simulation::scene::{Accuracy, Level, Scene as Tables};
use asperity::units::MICROMETRE;
use serde::{Deserialize, Serialize};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Dots along a side of a map of a rough surface in the report, its key included.
const MAP: usize = 900;

/// Share of the work of a rough surface that its own scene takes, and that the five surfaces of Table 1 take;
/// the rest is that of the surfaces of other kinds.
const OWN_SHARE: f64 = 0.2;
const OF_TABLE: f64 = 0.7;

/// That a part is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stamp {
    /// Of the resolved scene and the program.
    pub key: String,
    /// Seconds it took.
    pub wall_s: f64,
    /// The reason why it ended before its target, if it did.
    pub stopped: Option<String>,
}

/// A part with its scene as it will be run.
pub struct Job {
    /// The part.
    pub part: Part,
    scene: Resolved,
    folder: PathBuf,
    key: String,
}

/// A scene, its numbers resolved.
enum Resolved {
    Crush(Box<Scene>, &'static [Sketch]),
    Calibrate(Sweep),
    Rough(Box<RoughTables>, KindName),
}

impl Resolved {
    /// All that the result depends on but the program.
    fn definition(&self) -> String {
        match self {
            Resolved::Crush(scene, sketches) => format!("{:?}", (scene.resolved(), sketches)),
            Resolved::Calibrate(sweep) => format!("{sweep:?}"),
            Resolved::Rough(scene, kind) => format!("{:?}", (scene, kind)),
        }
    }
}

/// A scene that comes with the program must be one: said like every other failure.
fn embedded<T>(name: &str, result: Result<T, impl std::fmt::Display>) -> Result<T, Error> {
    result.map_err(|e| Error::Unfinished(format!("the scene of {name}: {e}")))
}

impl Job {
    /// `part` at an accuracy, in a folder of `parts`; `program` stands for the program.
    ///
    /// # Errors
    /// A scene of the program that is none.
    pub fn new(part: Part, accuracy: Accuracy, parts: &Path, program: u64) -> Result<Job, Error> {
        let file = Path::new(part.name);
        let scene = match part.work {
            Work::Crush { scene, changes, sketches } => {
                let accuracy = format!("accuracy={accuracy}");
                let changes: Vec<String> =
                    changes.iter().map(|c| (*c).to_string()).chain([accuracy]).collect();
                let scene = Scene::from_toml(scene, Path::new("")).and_then(|s| s.with(&changes));
                Resolved::Crush(Box::new(embedded(part.name, scene)?), sketches)
            }
            Work::Calibrate => Resolved::Calibrate(Sweep { accuracy, ..Sweep::default() }),
            Work::Rough { scene, kind } => {
                let read: TomlFile<RoughTables> = TomlFile::parse(file, scene.into(), &[])?;
                embedded(part.name, read.value.validate())?;
                Resolved::Rough(Box::new(read.value), kind)
            }
        };
        let mut hasher = DefaultHasher::new();
        (program, scene.definition()).hash(&mut hasher);
        let key = format!("{:016x}", hasher.finish());
        Ok(Job { part, scene, folder: parts.join(part.name), key })
    }

    fn stamp_path(&self) -> PathBuf {
        self.folder.with_extension("done")
    }

    /// The stamp of an earlier run of the same scene by the same program.
    pub fn done(&self) -> Option<Stamp> {
        let text = std::fs::read_to_string(self.stamp_path()).ok()?;
        let stamp: Stamp = serde_json::from_str(&text).ok()?;
        (stamp.key == self.key && self.folder.is_dir()).then_some(stamp)
    }

    /// Its duration, in crushes of the single asperity at `draft`.
    pub fn effort(&self, single: f64) -> f64 {
        match &self.scene {
            Resolved::Crush(scene, _) => load_of(scene.tables()) / single,
            Resolved::Calibrate(sweep) => {
                let each = match sweep.accuracy.level() {
                    Level::Draft => 0.25,
                    Level::Standard => 0.9,
                    Level::Reference => 8.0,
                };
                each * sweep.cases().len() as f64
            }
            Resolved::Rough(..) => 100.0,
        }
    }

    /// Computes the part and stamps it; `observer` hears of the share that is done (0 to 1) and ends the work
    /// by `false`.
    ///
    /// # Errors
    /// The failure that kept it from being done, or an observer that ended it: then the part is as it was
    /// before. A crush that ends by itself before its target is done: its stamp says so.
    pub fn run(&self, observer: &mut (dyn FnMut(f64, &str) -> bool + Send)) -> Result<Stamp, Error> {
        let start = Instant::now();
        let _ = std::fs::remove_file(self.stamp_path());
        let stopped = match &self.scene {
            Resolved::Crush(scene, sketches) => self.fill(|sink| {
                let mut goes_on = true;
                let told = &mut |reached: &Progress<'_, Increment<'_>>| {
                    let depth = reached.news.map_or(0.0, |news| news.row.depth / MICROMETRE);
                    let message = format!("{depth:.3} um  increment {}", reached.done);
                    goes_on = goes_on && observer(reached.share, &message);
                    goes_on
                };
                let crushed = crush_into(scene, sink, sketches, told)?;
                let tables = scene.tables();
                if tables.asperity_count() > 1
                    && let Some(zones) = crushed.peak().and_then(|peak| Zones::new(peak, tables))
                {
                    sink.text("zones.json", &asperity::output::json(&zones)?)?;
                }
                if goes_on { Ok(crushed.summary.stopped) } else { Err(table1::ended()) }
            })?,
            Resolved::Calibrate(sweep) => {
                self.keep_own_journal()?;
                self.calibrate(sweep, observer)?;
                None
            }
            Resolved::Rough(scene, kind) => {
                self.fill(|sink| self.press(scene, *kind, sink, observer))?;
                None
            }
        };
        let stamp = Stamp { key: self.key.clone(), wall_s: start.elapsed().as_secs_f64(), stopped };
        let text = serde_json::to_string(&stamp).map_err(|e| Error::Unfinished(e.to_string()))?;
        write_whole(&self.stamp_path(), text.as_bytes())?;
        Ok(stamp)
    }

    /// Fills a folder beside the part's own and puts it in its place when it is whole.
    fn fill<T>(&self, compute: impl FnOnce(&mut dyn Sink) -> Result<T, Error>) -> Result<T, Error> {
        let partial = self.folder.with_extension("partial");
        let _ = std::fs::remove_dir_all(&partial);
        let result = compute(&mut Directory::create(&partial)?)?;
        let _ = std::fs::remove_dir_all(&self.folder);
        std::fs::rename(&partial, &self.folder).map_err(|e| Error::disk(&self.folder, e))?;
        Ok(result)
    }

    fn calibrate(
        &self,
        sweep: &Sweep,
        observer: &mut (dyn FnMut(f64, &str) -> bool + Send),
    ) -> Result<(), Error> {
        let journal = Some(self.folder.with_extension("journal"));
        let options = Options { threads: rayon::current_num_threads(), journal, ..Options::default() };
        let calibration = calibrate(sweep, &options, &mut |solved: &Progress<'_, CaseRow>| {
            observer(solved.share, &format!("case {} of {}", solved.done, solved.all))
        })?;
        if calibration.stopped {
            let done = calibration.cases.len();
            return Err(Error::Unfinished(format!("stopped after {done} cases, which are kept")));
        }
        self.fill(|sink| calibration.write(sink))?;
        calibration.remove_journal();
        Ok(())
    }

    /// Throws away a journal that another program, or the same for another sweep, has left.
    fn keep_own_journal(&self) -> Result<(), Error> {
        let begun = self.folder.with_extension("begun");
        if std::fs::read_to_string(&begun).is_ok_and(|key| key == self.key) {
            return Ok(());
        }
        let _ = std::fs::remove_file(self.folder.with_extension("journal"));
        write_whole(&begun, self.key.as_bytes())
    }

    fn press(
        &self,
        scene: &RoughTables,
        kind: KindName,
        sink: &mut dyn Sink,
        observer: &mut (dyn FnMut(f64, &str) -> bool + Send),
    ) -> Result<(), Error> {
        let name = kind.name();
        let scene = RoughScene::new(scene.clone(), Path::new(""));
        let told = &mut |reached: &Progress<'_, Closure>| {
            let closure = reached.news.map_or("half-space", |closure| closure.name());
            observer(OWN_SHARE * reached.share, &format!("the {name} surface, {closure}"))
        };
        let rough = embedded(self.part.name, rough::press(&scene, told))?;
        if rough.stopped {
            return Err(table1::ended());
        }
        rough.write_tables(sink)?;
        rough.write_topography(sink, MAP)?;
        for one in &rough.contacts {
            rough.write_pictures(sink, one, MAP)?;
        }
        if let Some(one) = rough.contacts.iter().find_map(rough::ClosureContact::islands) {
            let points = profile(&rough.surface.map, &one.contact.islands);
            sink.write("profile.csv", |out| write_csv(out, &points))?;
        }
        if let Some((kind, row)) = table1::TABLE.iter().find(|(row, _)| *row == kind) {
            let table = table1::measure(*kind, row, &mut |share, message| {
                observer(OWN_SHARE + OF_TABLE * share, message)
            })?;
            sink.text("table1.json", &asperity::output::json(&table)?)?;
            let others =
                table1::other_kinds(*kind, row, &mut |message| observer(OWN_SHARE + OF_TABLE, message))?;
            sink.text("other_kinds.json", &asperity::output::json(&others)?)?;
        }
        Ok(())
    }
}

/// Unknowns to a power times steps: what the time of a crush goes with.
fn load_of(scene: &Tables) -> f64 {
    let Ok(problem) = Run::new(scene).problem() else {
        return 0.0;
    };
    let numbers = problem.numbers;
    (problem.mesh.nodes.len() as f64).powf(1.15) * (numbers.steps + numbers.unload_steps) as f64
}

/// Seconds that a crush of the paper's asperity at `draft` takes on this machine, and its load.
///
/// # Errors
/// A scene of the program that is none.
pub fn yardstick() -> Result<(f64, f64), Error> {
    let text = asperity::scenes::SINGLE_ASPERITY;
    let changes = ["output.every=0", "accuracy=draft"].map(String::from);
    let scene = Scene::from_toml(text, Path::new(""))?.with(&changes)?;
    // the fastest of three: other work on the machine only ever adds
    let mut fastest = f64::INFINITY;
    for _ in 0..3 {
        let start = Instant::now();
        let outcome = Run::new(scene.tables()).run(&mut |_| std::ops::ControlFlow::Continue(()));
        embedded("single-asperity", outcome)?;
        fastest = fastest.min(start.elapsed().as_secs_f64());
    }
    Ok((fastest, load_of(scene.tables())))
}
