//! One part from its definition to a folder of files, and the stamp that says it is done.
//!
//! A stamp is written when the files are in their place and taken away before they change, so that a part
//! that was killed is begun anew; the sweep resumes from its journal.

use super::plan::{Part, Work};
use super::rough_part;
use super::zones::Zones;
use crate::table1;
use asperity::Progress;
use asperity::batch::side_by_side;
use asperity::calibrate::{Options, calibrate};
use asperity::calibration::row::CaseRow;
use asperity::calibration::sweep::Sweep;
use asperity::crush::{Increment, Sketch, crush_into};
use asperity::error::Error;
use asperity::input::scene::Scene;
use asperity::input::toml_file::TomlFile;
use asperity::output::{Directory, Sink, SinkExt, write_whole};
use asperity::roughness::KindName;
use asperity::roughness::scene::Scene as RoughTables;
use asperity::simulation::run::Run;
use asperity::simulation::scene::{Accuracy, Level, Scene as Tables, Target};
use asperity::units::MICROMETRE;
use serde::{Deserialize, Serialize};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Time of a case of the sweep at `draft`, `standard` and `reference`, in crushes of the single asperity at
/// `draft`.
const CASE: [f64; 3] = [1.6, 2.5, 22.0];

/// The same of a surface under all closures of islands.
const ROUGH_SURFACE: f64 = 50.0;

/// The same of a quarter of a surface at all its scales.
const SCALES_OF_SURFACE: f64 = 150.0;

/// Power of the nodes that the time of an iteration goes with.
const NODES_POWER: f64 = 1.25;

/// Time of an increment where asperities are crushed to the ground over that on their slopes: each takes more
/// iterations.
const TO_THE_GROUND: f64 = 1.4;

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
    Scales(Box<RoughTables>),
}

impl Resolved {
    /// All that the result depends on but the program.
    fn definition(&self) -> String {
        match self {
            Resolved::Crush(scene, sketches) => format!("{:?}", (scene.resolved(), sketches)),
            Resolved::Calibrate(sweep) => format!("{sweep:?}"),
            Resolved::Rough(scene, kind) => format!("{:?}", (scene, kind)),
            Resolved::Scales(scene) => format!("{scene:?}"),
        }
    }
}

/// A scene that comes with the program must be one: said like every other failure.
fn embedded<T>(name: &str, result: Result<T, impl std::fmt::Display>) -> Result<T, Error> {
    result.map_err(|e| Error::Unfinished(format!("the scene of {name}: {e}")))
}

/// A scene of a rough surface that comes with the program, with these changes.
fn rough_tables(name: &str, scene: &str, changes: &[&str]) -> Result<RoughTables, Error> {
    let changes: Vec<String> = changes.iter().map(|c| (*c).to_string()).collect();
    let read: TomlFile<RoughTables> = TomlFile::parse(Path::new(name), scene.into(), &changes)?;
    embedded(name, read.value.validate())?;
    Ok(read.value)
}

impl Job {
    /// `part` at an accuracy, in a folder of `parts`; `program` stands for the program.
    ///
    /// # Errors
    /// A scene of the program that is none.
    pub fn new(part: Part, accuracy: Accuracy, parts: &Path, program: u64) -> Result<Job, Error> {
        let scene = match part.work {
            Work::Crush { scene, changes, sketches } => {
                let accuracy = format!("accuracy={accuracy}");
                let changes: Vec<String> =
                    changes.iter().map(|c| (*c).to_string()).chain([accuracy]).collect();
                let scene = Scene::from_toml(scene, Path::new("")).and_then(|s| s.with(&changes));
                Resolved::Crush(Box::new(embedded(part.name, scene)?), sketches)
            }
            Work::Calibrate => Resolved::Calibrate(Sweep { accuracy, ..Sweep::default() }),
            Work::Rough { scene, changes, kind } => {
                Resolved::Rough(Box::new(rough_tables(part.name, scene, changes)?), kind)
            }
            Work::Scales { scene, changes } => {
                Resolved::Scales(Box::new(rough_tables(part.name, scene, changes)?))
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

    /// Its duration on one core, in crushes of the single asperity at `draft`.
    pub fn effort(&self, single: f64) -> f64 {
        match &self.scene {
            Resolved::Crush(scene, _) => load_of(scene.tables()) / single,
            Resolved::Calibrate(sweep) => {
                let each = match sweep.accuracy.level() {
                    Level::Draft => CASE[0],
                    Level::Standard => CASE[1],
                    Level::Reference => CASE[2],
                };
                each * sweep.cases().len() as f64
            }
            Resolved::Rough(scene, _) => {
                ROUGH_SURFACE * rough_part::surfaces(scene.closure).iter().sum::<f64>()
            }
            Resolved::Scales(_) => SCALES_OF_SURFACE,
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
                self.fill(|sink| rough_part::press(scene, *kind, sink, observer))?;
                None
            }
            Resolved::Scales(scene) => {
                self.fill(|sink| rough_part::press_scales(scene, sink, observer))?;
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
}

/// Nodes to a power times steps: what the time of a crush goes with.
fn load_of(scene: &Tables) -> f64 {
    let Ok(problem) = Run::new(scene).problem() else {
        return 0.0;
    };
    let ground = matches!(scene.loading.target(), Ok(Target::Depth(depth)) if depth >= scene.highest());
    let each = if ground { TO_THE_GROUND } else { 1.0 };
    let numbers = problem.numbers;
    let steps = (numbers.steps + numbers.unload_steps) as f64;
    each * steps * (problem.mesh.nodes.len() as f64).powf(NODES_POWER)
}

/// Crushes of the paper's asperity that each core does for the yardstick.
const YARDSTICKS: usize = 3;

/// Seconds that a crush of the paper's asperity at `draft` takes on this machine with all cores at work, and
/// its load.
///
/// # Errors
/// A scene of the program that is none.
pub fn yardstick() -> Result<(f64, f64), Error> {
    let text = asperity::scenes::SINGLE_ASPERITY;
    let changes = ["output.every=0", "accuracy=draft"].map(String::from);
    let scene = Scene::from_toml(text, Path::new(""))?.with(&changes)?;
    let timed = |_| -> Result<f64, Error> {
        let start = Instant::now();
        let outcome = Run::new(scene.tables()).run(&mut |_| std::ops::ControlFlow::Continue(()));
        embedded("single-asperity", outcome)?;
        Ok(start.elapsed().as_secs_f64())
    };
    // as many at once as parts will be: they share the caches and the clock of the machine
    let cores = rayon::current_num_threads();
    let turns: Vec<usize> = (0..YARDSTICKS * cores).collect();
    let mut seconds = side_by_side(cores, &turns, &timed).into_iter().collect::<Result<Vec<f64>, Error>>()?;
    let middle = seconds.len() / 2;
    Ok((*seconds.select_nth_unstable_by(middle, f64::total_cmp).1, load_of(scene.tables())))
}

#[cfg(test)]
mod tests {
    //! Claim: a rough part computes what a figure or a table of the report shows, and nothing else: no flow,
    //! no comparison of closures, and half-spaces for the load curves of Figure 3 alone.
    #![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

    use super::*;
    use crate::plan::PARTS;
    use asperity::rough::{self, RoughScene};

    /// The rough parts, each with its scene.
    fn rough_parts() -> Vec<(Part, RoughTables)> {
        let job = |part| Job::new(part, Accuracy::default(), Path::new(""), 0).unwrap();
        let rough = |part: &Part| match job(*part).scene {
            Resolved::Rough(scene, _) => Some((*part, *scene)),
            _ => None,
        };
        PARTS.iter().filter_map(rough).collect()
    }

    #[test]
    fn a_rough_part_asks_for_no_leak_no_comparison_and_no_half_space_that_is_not_shown() {
        let parts = rough_parts();
        assert_eq!(parts.len(), 3);
        for (part, scene) in parts {
            assert_eq!(scene.half_space.leak, Some(false), "{}", part.name);
            assert_eq!((scene.judge, scene.output.spectrum), (Some(false), Some(false)), "{}", part.name);
            let solved = scene.closure.closures().iter().any(|closure| closure.is_half_space());
            assert_eq!(solved, part.serves.contains(&"fig3"), "{}", part.name);
        }
    }

    /// The scene of Figure 3 on a small map, with a fluid that would flow.
    #[test]
    fn no_leak_is_in_the_tables_of_a_rough_part_though_its_scene_has_a_fluid() {
        let (_, ground) = rough_parts().into_iter().find(|(part, _)| part.name == "rough-ground").unwrap();
        let (_, milled) = rough_parts().into_iter().find(|(part, _)| part.name == "rough-milled").unwrap();
        assert!(ground.fluid.is_some());
        let scene = RoughScene::new(RoughTables { fluid: ground.fluid, ..milled }, Path::new(""));
        let small = ["surface.generate.size=[\"500 um\", \"500 um\"]", "surface.generate.pixels=[64, 64]"];
        let scene = scene.with(&small.map(String::from)).unwrap();
        let rough = rough::press(&scene, &mut |_| true).unwrap();
        assert_eq!(rough.table.len(), 7);
        for row in &rough.table {
            assert!(row.leak_x_m3.is_none() && row.leak_y_m3.is_none(), "{}", row.closure.name());
            assert!(row.area_over_half_space.is_none(), "{}", row.closure.name());
        }
        let curve = |closure: &str| rough.load_curve.iter().filter(|p| p.closure.name() == closure).count();
        assert!(curve("half-space") > 3 && curve("half-space-plastic") > 3);
    }
}
