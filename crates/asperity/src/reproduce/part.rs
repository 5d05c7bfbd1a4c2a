//! One part from its definition to a folder of files, and the stamp that says it is done.
//!
//! A stamp is written when the files are in their place and taken away before they change, so that a part that was
//! killed is begun anew; the sweep goes on from its journal.

use super::plan::{Part, Work};
use crate::calibrate::{Options, Progress as Done, calibrate};
use crate::cli::folder::Folder;
use crate::cli::folder::journal_beside;
use crate::cli::progress::Progress;
use crate::crush::{Crushed, Sketch, crush_into, resolved};
use crate::error::Error;
use crate::input::toml_file::TomlFile;
use crate::output::{SinkExt, write_whole};
use crate::press::{self, RoughScene, table1};
use asperity_calibration::sweep::Sweep;
use asperity_roughness::scene::Scene as RoughTables;
use asperity_roughness::{Islands, KindName};
use asperity_solver::run::problem::prepare;
use asperity_solver::scene::{Accuracy, Level, Scene};
use serde::{Deserialize, Serialize};
use std::fmt::Debug;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Dots along a side of a map of a rough surface in the report, its key included.
const MAP: usize = 728;

/// That a part is done.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Stamp {
    /// Of the resolved scene and the program.
    pub key: String,
    /// Seconds it took.
    pub wall_s: f64,
    /// Why it ended before its target, if it did.
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
        fn text(value: &impl Debug) -> String {
            format!("{value:?}")
        }
        match self {
            Resolved::Crush(scene, sketches) => text(&(resolved(scene), sketches)),
            Resolved::Calibrate(sweep) => text(sweep),
            Resolved::Rough(scene, kind) => text(&(scene, kind)),
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
                let changes: Vec<String> = changes.iter().map(|c| (*c).to_string()).collect();
                let mut read: TomlFile<Scene> = TomlFile::parse(file, scene.into(), &changes)?;
                read.value.accuracy = accuracy;
                embedded(part.name, read.value.validate())?;
                Resolved::Crush(Box::new(read.value), sketches)
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

    /// How long it takes, in crushes of the single asperity at `draft`.
    pub fn effort(&self, single: f64) -> f64 {
        match &self.scene {
            Resolved::Crush(scene, _) => load_of(scene) / single,
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

    /// Computes the part and stamps it.
    ///
    /// # Errors
    /// What kept it from being done. A crush that ends before its target is done: its stamp says so.
    pub fn run(&self, progress: Progress) -> Result<Stamp, Error> {
        let start = Instant::now();
        let _ = std::fs::remove_file(self.stamp_path());
        let stopped = match &self.scene {
            Resolved::Crush(scene, sketches) => self.crush(scene, sketches, progress)?,
            Resolved::Calibrate(sweep) => {
                self.keep_own_journal()?;
                self.calibrate(sweep, progress)?;
                None
            }
            Resolved::Rough(scene, kind) => {
                self.press(scene, *kind, &progress)?;
                progress.finish();
                None
            }
        };
        let stamp = Stamp { key: self.key.clone(), wall_s: start.elapsed().as_secs_f64(), stopped };
        let text = serde_json::to_string(&stamp).map_err(|e| Error::Unfinished(e.to_string()))?;
        write_whole(&self.stamp_path(), text.as_bytes())?;
        Ok(stamp)
    }

    fn calibrate(&self, sweep: &Sweep, progress: Progress) -> Result<(), Error> {
        let mut folder = Folder::create(&self.folder, "calibrate", true)?;
        let journal = Some(journal_beside(&self.folder));
        let options = Options { threads: rayon::current_num_threads(), journal, ..Options::default() };
        let mut show = |done: &Done| {
            let share = done.done as f64 / done.cases.max(1) as f64;
            progress.show(share, || format!("case {} of {}", done.done, done.cases));
            true
        };
        let calibration = match calibrate(sweep, &options, &mut show) {
            Ok(calibration) => calibration,
            Err(failure) => {
                folder.abandon();
                return Err(failure);
            }
        };
        progress.finish();
        calibration.write(&mut folder)?;
        folder.publish()?;
        calibration.remove_journal();
        Ok(())
    }

    /// Throws away a journal that another program, or the same for another sweep, has left.
    fn keep_own_journal(&self) -> Result<(), Error> {
        let begun = self.folder.with_extension("begun");
        if std::fs::read_to_string(&begun).is_ok_and(|key| key == self.key) {
            return Ok(());
        }
        let _ = std::fs::remove_file(journal_beside(&self.folder));
        write_whole(&begun, self.key.as_bytes())
    }

    fn crush(&self, scene: &Scene, sketches: &[Sketch], progress: Progress) -> Result<Option<String>, Error> {
        let mut folder = Folder::create(&self.folder, "crush", true)?;
        let crushed = crush_into(scene, None, &mut folder, sketches, progress);
        let Crushed { stopped, failure, summary, .. } = embedded(self.part.name, crushed)?;
        summary?;
        folder.publish()?;
        failure.map_or(Ok(stopped), Err)
    }

    fn press(&self, scene: &RoughTables, kind: KindName, progress: &Progress) -> Result<(), Error> {
        let name = kind.name();
        progress.show(0.0, || format!("the {name} surface"));
        let scene = RoughScene::new(scene.clone(), Path::new(""));
        let rough = embedded(self.part.name, press::press(&scene, &mut |_| true))?;
        let mut folder = Folder::create(&self.folder, "rough", true)?;
        rough.write_tables(&mut folder)?;
        rough.write_topography(&mut folder, MAP)?;
        for one in &rough.contacts {
            rough.write_pictures(&mut folder, one, MAP)?;
        }
        if let Some(one) = rough.contacts.first() {
            let cones = profile(&rough.surface.map, &one.contact.islands);
            folder.write("profile.csv", |out| out.write_all(cones.as_bytes()))?;
        }
        if let Some((kind, row)) = table1::TABLE.iter().find(|(row, _)| *row == kind) {
            progress.show(0.2, || format!("five {name} surfaces, every closure"));
            let table = serde_json::to_string_pretty(&table1::measure(*kind, row)?)
                .map_err(|e| Error::Unfinished(e.to_string()))?;
            folder.write("table1.json", |out| out.write_all(table.as_bytes()))?;
        }
        folder.publish().map(|_| ())
    }
}

/// Unknowns to a power times steps: what the time of a crush goes with.
fn load_of(scene: &Scene) -> f64 {
    let Ok(problem) = prepare(scene, None) else { return 0.0 };
    let numbers = problem.numbers;
    (problem.mesh.nodes.len() as f64).powf(1.15) * (numbers.steps + numbers.unload_steps) as f64
}

/// Seconds that a crush of the paper's asperity at `draft` takes on this machine, and its load.
///
/// # Errors
/// A scene of the program that is none.
pub fn yardstick() -> Result<(f64, f64), Error> {
    let text = include_str!("../../scenes/single-asperity.toml");
    let changes = ["output.every=0", "accuracy=draft"].map(String::from);
    let file: TomlFile<Scene> = TomlFile::parse(Path::new("single-asperity"), text.into(), &changes)?;
    // the fastest of three: other work on the machine only ever adds
    let mut fastest = f64::INFINITY;
    for _ in 0..3 {
        let start = Instant::now();
        let outcome =
            asperity_solver::run::crush::run(&file.value, None, &mut |_| std::ops::ControlFlow::Continue(()));
        embedded("single-asperity", outcome)?;
        fastest = fastest.min(start.elapsed().as_secs_f64());
    }
    Ok((fastest, load_of(&file.value)))
}

/// The row of the map with the largest summit: its heights, the plane, and the cones that stand for the islands on it.
fn profile(map: &asperity_roughness::HeightMap, islands: &Islands) -> String {
    const MICROMETRE: f64 = 1e-6;
    let [width, height] = map.pixel();
    let top = (0..map.rows())
        .max_by(|a, b| {
            let most = |row: usize| map.row(row).iter().copied().fold(f64::NEG_INFINITY, f64::max);
            most(*a).total_cmp(&most(*b))
        })
        .unwrap_or(0);
    let y = top as f64 * height;
    let mut lines = vec!["what,x_um,z_um".to_string()];
    let mut point = |what: &str, x: f64, z: f64| {
        lines.push(format!("{what},{:?},{:?}", x / MICROMETRE, z / MICROMETRE));
    };
    for (column, z) in map.row(top).iter().enumerate().filter(|(_, z)| z.is_finite()) {
        point("surface", column as f64 * width, *z);
    }
    let end = map.columns().saturating_sub(1) as f64 * width;
    let d = islands.plane;
    point("cones", 0.0, d);
    let mut cones: Vec<[f64; 3]> = islands
        .islands
        .iter()
        .filter_map(|island| {
            let radius = (island.area / std::f64::consts::PI).sqrt();
            let centre = island.ellipse?.centre;
            // the chord of the cone's base on this row
            let aside = (centre[1] - y).abs();
            (aside < 0.5 * radius && radius > 2.0 * width).then_some([
                centre[0],
                radius,
                island.slope * (radius - aside),
            ])
        })
        .collect();
    cones.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut reached = 0.0;
    for [x, radius, rise] in cones {
        if x - radius > reached {
            point("cones", x - radius, d);
            point("cones", x, d + rise);
            point("cones", x + radius, d);
            reached = x + radius;
        }
    }
    point("cones", end.max(reached), d);
    lines.join("\n") + "\n"
}
