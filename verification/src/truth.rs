//! The truths of the battery of [`coverage_scenes`](crate::coverage_scenes): answers of finer runs, found
//! once and kept.
//!
//! A truth must be better than the run that it judges, not more: its own error is to be small beside the
//! promise of that level. [`RECIPES`] says how fine it is. Truths are kept as files in a folder while they
//! are found, so that what was stopped goes on there, and packed into one file that is committed, so that
//! each session adds to it.

// a scene and a truth are plain data; searches that take minutes say how far they are
#![allow(clippy::expect_used, clippy::print_stderr)]

use crate::coverage_scenes::Case;
use crate::report::{replace, timed};
use asperity_material::units::rounded;
use asperity_mesh::Mesh;
use asperity_simulation::record::curve::Curve;
use asperity_simulation::record::rows::{Errors, ErrorsAlong, Phase};
use asperity_simulation::run::{Outcome, Run};
use asperity_simulation::scene::{Accuracy, ElementChoice, Numerics, Scene};
use asperity_simulation::setup::discretisation::Discretisation;
use asperity_simulation::setup::discretisation::LEAST_COUNTED_DEPTH;
use flate2::Compression;
use flate2::read::GzDecoder;
use flate2::write::GzEncoder;
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::BTreeMap;
use std::io::{self, Read, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// The fineness of a truth: its elements across the contact, its load steps and the size of its substrate
/// over those of `reference`; its penetration over that of `reference` is this to the power of
/// [`SOFTER_PENALTY`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Recipe(pub f64);

/// Those of the truths of draft, standard and reference runs.
pub const RECIPES: [Recipe; 3] = [Recipe(1.2), Recipe(1.6), Recipe(1.8)];

/// Penetration and mesh pull the area in opposite directions, and more of the first is left at `reference`.
pub const SOFTER_PENALTY: f64 = -1.5;

/// Share of the elements where linear ones take the place of quadratic ones, whose errors are independent of
/// theirs: they cost more.
const LINEAR_SHARE: f64 = 0.75;

/// Depths at which curves are compared.
const DEPTHS: usize = 81;

/// Largest share of the depth by which the end of a complete run may miss it.
const SHORT_DEPTH: f64 = 1e-3;

/// The quantities whose errors are stated, in the order of [`Each`]: force, area and pressure at the peak and
/// the largest along the curve.
pub const QUANTITIES: [&str; 9] = [
    "force",
    "contact area",
    "mean pressure",
    "residual depth",
    "elastic fraction",
    "unloading stiffness",
    "force along the curve",
    "contact area along the curve",
    "mean pressure along the curve",
];

/// A value or a bound of each of [`QUANTITIES`], `None` where it is not known.
pub type Each = [Option<f64>; 9];

/// The results of a run of a scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Answer {
    /// Force (N, N/m) and contact area (m², m) at [`DEPTHS`] equal steps from a fifth of the peak depth on.
    curve: Vec<[f64; 2]>,
    /// Over the peak depth.
    residual_depth: Option<f64>,
    elastic_fraction: Option<f64>,
    /// N/m (N/m²).
    unloading_stiffness: Option<f64>,
    /// The errors that it states, of [`QUANTITIES`].
    #[serde(deserialize_with = "read_stated")]
    pub stated: Each,
    /// That of the summary.
    pub energy_balance: f64,
}

/// The truth of a scene, and how it was found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// The number of the scene.
    pub scene: usize,
    /// With another element than that of the scene.
    pub other_element: bool,
    /// Of the run that found it.
    pub numerics: Numerics,
    /// That it took.
    pub seconds: f64,
    /// Its results.
    pub answer: Answer,
}

/// A truth, or why it was not reached.
pub type Found = Result<Truth, String>;

/// Stated errors, of which older truths hold six: there the first three are those along the curve.
fn read_stated<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Each, D::Error> {
    let held = Vec::<Option<f64>>::deserialize(deserializer)?;
    let older = held.len() == 6;
    Ok(std::array::from_fn(|i| held.get(if older { i % 6 } else { i }).copied().flatten()))
}

fn stated(errors: &Errors, along: &ErrorsAlong) -> Each {
    let known = |x: f64| Some(x).filter(|x| x.is_finite());
    [
        known(errors.force),
        known(errors.contact_area),
        known(errors.mean_pressure),
        errors.residual_depth.and_then(known),
        errors.elastic_fraction.and_then(known),
        errors.unloading_stiffness.and_then(known),
        known(along.force),
        known(along.contact_area),
        known(along.mean_pressure),
    ]
}

/// `x` to the seven digits that a truth is kept with.
fn single(x: f64) -> f64 {
    rounded(x, 7)
}

impl Answer {
    /// Of a run that reached its depth, or why there is none.
    fn from_outcome(outcome: &Outcome, depth: f64) -> Result<Answer, String> {
        let summary = &outcome.summary;
        if let Some(stopped) = &outcome.stopped {
            let way = if stopped.phase == Phase::Load { "" } else { ", unloading" };
            return Err(format!("{} at {:.2} of the depth{way}", stopped.reason, stopped.depth / depth));
        }
        let loading = outcome.rows.iter().filter(|row| row.phase == Phase::Load);
        let force = Curve::force(&outcome.rows);
        let area = Curve::new(loading.map(|row| [row.depth, row.contact_area]));
        if (force.end() / depth - 1.0).abs() > SHORT_DEPTH {
            return Err(format!("ends at {:.4} of the depth", force.end() / depth));
        }
        let at = |i: usize| {
            let share = LEAST_COUNTED_DEPTH + (1.0 - LEAST_COUNTED_DEPTH) * i as f64 / (DEPTHS - 1) as f64;
            let depth = (share * depth).min(force.end());
            [force.value(depth), area.value(depth)]
        };
        let curve: Vec<[f64; 2]> = (0..DEPTHS).map(at).collect();
        if curve.iter().flatten().any(|x| !x.is_finite()) {
            return Err("the curve is not known at every depth".into());
        }
        Ok(Answer {
            curve,
            residual_depth: summary.residual_depth.map(|h| h / summary.peak_depth),
            elastic_fraction: summary.elastic_fraction,
            unloading_stiffness: summary.unloading_stiffness,
            stated: stated(&summary.errors, &summary.errors_along),
            energy_balance: summary.energy_balance_error,
        })
    }

    /// Of `scene`, on `mesh` if one is given.
    ///
    /// # Errors
    /// The reason why the run does not begin or does not reach its depth.
    pub fn compute(scene: &Scene, mesh: Option<Mesh>) -> Result<Answer, String> {
        let depth = scene.loading.depth.ok_or("the scene is not driven by depth")?.0;
        let outcome = Run { mesh, ..Run::new(scene) }
            .run(&mut |_| ControlFlow::Continue(()))
            .map_err(|e| e.to_string())?;
        Answer::from_outcome(&outcome, depth)
    }

    /// Its errors against `truth`: of force, contact area and mean pressure at the peak and the largest over
    /// the depths, relative; the residual depth over the peak depth, the elastic fraction absolute, the
    /// stiffness relative.
    pub fn error(&self, truth: &Answer) -> Each {
        let errors = |of: fn(&[f64; 2]) -> f64| -> Vec<f64> {
            let pairs = self.curve.iter().zip(&truth.curve);
            pairs.map(|(own, other)| (of(own) / of(other) - 1.0).abs()).collect()
        };
        let [force, area, pressure] = [errors(|p| p[0]), errors(|p| p[1]), errors(|p| p[0] / p[1])];
        let worst = |errors: &[f64]| Some(errors.iter().copied().fold(0.0, f64::max));
        let difference = |own: Option<f64>, other: Option<f64>| Some((own? - other?).abs());
        let stiffness = difference(self.unloading_stiffness, truth.unloading_stiffness);
        [
            force.last().copied(),
            area.last().copied(),
            pressure.last().copied(),
            difference(self.residual_depth, truth.residual_depth),
            difference(self.elastic_fraction, truth.elastic_fraction),
            stiffness.zip(truth.unloading_stiffness).map(|(d, s)| d / s),
            worst(&force),
            worst(&area),
            worst(&pressure),
        ]
    }

    /// To the digits that it is kept with.
    fn single(self) -> Answer {
        Answer {
            curve: self.curve.into_iter().map(|p| p.map(single)).collect(),
            residual_depth: self.residual_depth.map(single),
            elastic_fraction: self.elastic_fraction.map(single),
            unloading_stiffness: self.unloading_stiffness.map(single),
            stated: self.stated.map(|x| x.map(single)),
            energy_balance: single(self.energy_balance),
        }
    }
}

impl Truth {
    /// With the elastic fraction of a body that never yields, 1, in the place of that which the run found.
    #[must_use]
    pub fn exact_where_known(mut self, scene: &Scene) -> Truth {
        if !scene.material.yields() {
            self.answer.elastic_fraction = Some(1.0);
            self.answer.stated[4] = Some(0.0);
        }
        self
    }
}

impl Recipe {
    /// That of the truth of a run at `accuracy`.
    pub fn for_accuracy(accuracy: Accuracy) -> Recipe {
        RECIPES[accuracy.level() as usize]
    }

    /// `scene` as the truth computes it, with this element.
    pub fn scene(&self, scene: &Scene, element: ElementChoice) -> Scene {
        let mut finer = Scene { accuracy: Accuracy::Reference, ..scene.clone() };
        finer.numerics = Numerics { element: Some(element), ..Numerics::default() };
        let reference = Discretisation::new(&finer);
        let other = element == ElementChoice::Q4 && Discretisation::new(scene).element != element;
        let more = |count: usize, factor: f64| Some((count as f64 * factor).ceil() as usize);
        let Recipe(finer_by) = *self;
        let elements = if other { LINEAR_SHARE * finer_by } else { finer_by };
        finer.numerics.elements_in_contact = more(reference.elements_in_contact, elements);
        finer.numerics.steps = more(reference.steps, finer_by);
        finer.numerics.penetration = Some(single(reference.penetration * finer_by.powf(SOFTER_PENALTY)));
        finer.numerics.domain = Some((reference.domain * finer_by).min(Numerics::DOMAIN[1]));
        finer
    }

    /// Finds the truth with the element that the scene is to be judged by, or where that does not reach the
    /// depth with its own.
    ///
    /// # Errors
    /// The reason why it was not reached.
    pub fn find(&self, case: &Case) -> Found {
        let own = Discretisation::new(&case.scene).element;
        let with = |element: ElementChoice| {
            let finer = self.scene(&case.scene, element);
            let (answer, seconds) = timed(|| Answer::compute(&finer, None));
            let (scene, numerics, seconds) = (case.number, finer.numerics, (10.0 * seconds).round() / 10.0);
            let other_element = element != own;
            answer.map(|answer| Truth { scene, other_element, numerics, seconds, answer: answer.single() })
        };
        match case.element_of_truth() {
            element if element == own => with(own),
            other => with(other).or_else(|_| with(own)),
        }
    }

    /// The key of a truth: the number of the scene with a hash of it and of the recipe. It depends not on the
    /// level, nor on the numbers of `reference`.
    fn key(&self, case: &Case) -> String {
        let same = Scene { accuracy: Accuracy::Reference, ..case.scene.clone() };
        let recipe = format!("{:?} {} {SOFTER_PENALTY} {LINEAR_SHARE}", case.element_of_truth(), self.0);
        let text = toml::to_string(&same).expect("a scene is a table") + &recipe;
        format!("{:04}-{:016x}", case.number, hash(&text))
    }
}

/// FNV-1a.
fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}

/// A line of the file of packed truths.
#[derive(Serialize, Deserialize)]
struct Line {
    key: String,
    found: Found,
}

/// The truths that are there.
#[derive(Debug)]
pub struct Truths {
    packed: BTreeMap<String, Found>,
    folder: PathBuf,
}

impl Truths {
    /// Those of the file `packed`, if there is one, and of the `folder` in which new ones are kept.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn open(packed: &Path, folder: &Path) -> io::Result<Truths> {
        let folder = folder.to_path_buf();
        if !packed.exists() {
            return Ok(Truths { packed: BTreeMap::new(), folder });
        }
        let mut text = String::new();
        GzDecoder::new(std::fs::File::open(packed)?).read_to_string(&mut text)?;
        let read = |line| serde_json::from_str(line).map(|Line { key, found }| (key, found));
        let packed = text.lines().map(read).collect::<Result<_, _>>()?;
        Ok(Truths { packed, folder })
    }

    fn file(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.json"))
    }

    fn kept(&self, key: &str) -> Option<Found> {
        let file = std::fs::read_to_string(self.file(key)).ok();
        file.and_then(|text| serde_json::from_str(&text).ok()).or_else(|| self.packed.get(key).cloned())
    }

    /// The truth of `case`, found and kept if it is not there and `search`. That of a finer recipe than its
    /// own is as good.
    pub fn find_or_compute(&self, case: &Case, search: bool) -> Option<Found> {
        let level = case.scene.accuracy.level() as usize;
        let kept: Vec<Found> = RECIPES[level..].iter().filter_map(|r| self.kept(&r.key(case))).collect();
        if let Some(found) = kept.iter().find(|found| found.is_ok()).or(kept.first()) {
            return Some(found.clone());
        }
        search.then(|| {
            let recipe = RECIPES[level];
            let (found, seconds) = timed(|| recipe.find(case));
            let text = serde_json::to_string(&found).expect("a truth is plain data");
            let file = self.file(&recipe.key(case));
            if let Err(error) = replace(&file, &text) {
                eprintln!("{} is not kept: {error}", file.display());
            }
            let end = found.as_ref().err().map_or(String::new(), |reason| format!(": {reason}"));
            eprintln!("truth of scene {} ({}): {seconds:.0} s{end}", case.number, case.kind.name());
            found
        })
    }

    /// Writes all truths of `cases` into one `file`, whole or not at all; their number.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn pack(&self, cases: &[Case], file: &Path) -> io::Result<usize> {
        let mut all = BTreeMap::new();
        for case in cases {
            let keys = RECIPES.iter().map(|recipe| recipe.key(case));
            all.extend(keys.filter_map(|key| self.kept(&key).map(|found| (key, found))));
        }
        let mut packed = GzEncoder::new(Vec::new(), Compression::best());
        for (key, found) in &all {
            let line = Line { key: key.clone(), found: found.clone() };
            writeln!(packed, "{}", serde_json::to_string(&line)?)?;
        }
        replace(file, packed.finish()?)?;
        Ok(all.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A truth of scene `number` with the digits of a run.
    fn truth(number: usize) -> Truth {
        let third = (number as f64 + 1.0) / 3.0;
        let answer = Answer {
            curve: (0..DEPTHS).map(|i| [third * i as f64, 1e-11 * third / (i + 1) as f64]).collect(),
            residual_depth: Some(third),
            elastic_fraction: None,
            unloading_stiffness: Some(1e7 * third),
            stated: [Some(third), None, Some(1e-3 * third), None, Some(0.0), None, Some(third), None, None],
            energy_balance: 1e-5 * third,
        };
        let numerics = Numerics { steps: Some(7), ..Numerics::default() };
        Truth { scene: number, other_element: number == 1, numerics, seconds: 1.5, answer: answer.single() }
    }

    #[test]
    fn a_packed_truth_is_read_back_equal() {
        let folder = tempfile::tempdir().unwrap();
        let [file, cache] = ["truths.json.gz", "cache"].map(|name| folder.path().join(name));
        let cases: Vec<Case> = (0..4).map(|number| Case::new(number).unwrap()).collect();
        let recipe = |case: &Case| Recipe::for_accuracy(case.scene.accuracy);
        let found = [Ok(truth(0)), Ok(truth(1)), Err("no equilibrium".to_string())];
        let truths = Truths::open(&file, &cache).unwrap();
        for (case, found) in cases.iter().zip(&found) {
            replace(&truths.file(&recipe(case).key(case)), serde_json::to_string(found).unwrap()).unwrap();
        }
        assert_eq!(truths.pack(&cases, &file).unwrap(), 3);
        std::fs::remove_dir_all(&cache).unwrap();
        let read = Truths::open(&file, &cache).unwrap();
        for (case, found) in cases.iter().zip(&found) {
            assert_eq!(read.find_or_compute(case, false).as_ref(), Some(found));
        }
        assert!(read.find_or_compute(&cases[3], false).is_none());
        // what another session adds keeps the rest
        let more = Ok(truth(3));
        replace(&read.file(&recipe(&cases[3]).key(&cases[3])), serde_json::to_string(&more).unwrap())
            .unwrap();
        assert_eq!(read.pack(&cases, &file).unwrap(), 4);
        let read = Truths::open(&file, &cache).unwrap();
        assert_eq!(read.find_or_compute(&cases[0], false).as_ref(), Some(&found[0]));
        assert_eq!(read.find_or_compute(&cases[3], false), Some(more));
    }

    #[test]
    fn a_finer_truth_judges_a_coarser_run() {
        let folder = tempfile::tempdir().unwrap();
        let truths = Truths::open(&folder.path().join("none"), folder.path()).unwrap();
        let mut case = Case::new(0).unwrap();
        let found: Found = Ok(truth(0));
        replace(&truths.file(&RECIPES[1].key(&case)), serde_json::to_string(&found).unwrap()).unwrap();
        for (accuracy, known) in
            [(Accuracy::Draft, true), (Accuracy::Standard, true), (Accuracy::Reference, false)]
        {
            case.scene.accuracy = accuracy;
            assert_eq!(truths.find_or_compute(&case, false).is_some(), known, "{accuracy}");
        }
    }
}
