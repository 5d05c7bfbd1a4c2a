//! `summary.json`: its keys, as they are written and read.

use crate::error::{Error, InputError};
use crate::input::toml_file::LARGEST_FILE;
use crate::results::columns::{Described, Unit, columns, named, symmetry_of, unnamed};
use crate::results::numbers::{four_decimals, with_digits};
use crate::results::units::{MEGAPASCAL, per_length};
use asperity_formats::memory::read_file;
use asperity_simulation::record::rows::{Errors, ErrorsAlong, OliverPharr, Summary as Numbers};
use asperity_simulation::refine::work_to_keep;
use asperity_simulation::run::Outcome;
use asperity_simulation::scene::{Numerics as Given, Scene as Tables, Smoothing};
use asperity_solver::body::islands::Island;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::{Map, Value};
use std::ops::Deref;
use std::path::Path;

/// The numbers of a crush in SI, and what they are the numbers of.
///
/// It is serialised as `summary.json` has it: under the names and in the units of the file. What the scene
/// did not ask for (unloading) or the run did not reach is `None`, `null` in the file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct Summary {
    /// The reason why the run ended before its target, and the place.
    #[serde(default)]
    pub stopped: Option<String>,
    /// The numbers of the run, which the summary gives as its own.
    #[serde(flatten)]
    pub numbers: Numbers,
    /// Regions among the asperities that never yielded, at the peak.
    pub elastic_islands: Vec<Island>,
    /// Seconds the run took.
    pub wall_s: f64,
    /// Largest resident memory of the process so far, bytes; `None` where the system does not say.
    pub peak_memory: Option<f64>,
    /// Half apex angle of the cone that stands for a pyramid: that of the same projected area.
    #[serde(default)]
    pub equivalent_half_apex_deg: Option<f64>,
    /// Smoothing of each measured outline.
    #[serde(default)]
    pub outlines: Vec<Smoothing>,
    /// The scene as resolved, with the numbers that its accuracy stands for: enough to run it again.
    pub scene: Box<Tables>,
    /// Version of this program.
    pub version: String,
    /// The words of the scene that kept it from being refined, and what lifts them; not in the file.
    #[serde(skip)]
    pub(crate) single: Option<&'static str>,
}

impl Deref for Summary {
    type Target = Numbers;

    fn deref(&self) -> &Numbers {
        &self.numbers
    }
}

columns! {
    Errors {
        /// Of the force, relative.
        force: Plain,
        /// Of the contact area, relative.
        contact_area: Plain,
        /// Of the mean pressure, relative.
        mean_pressure: Plain,
        /// Of the depth at which a force was asked for, relative.
        depth: Plain,
        /// Of the residual depth, over the peak depth.
        residual_depth: Plain,
        /// Of the elastic fraction, absolute.
        elastic_fraction: Plain,
        /// Of the unloading stiffness, relative.
        unloading_stiffness: Plain,
    }
}

columns! {
    ErrorsAlong {
        /// Of the force, relative.
        force: Plain,
        /// Of the contact area, relative.
        contact_area: Plain,
        /// Of the mean pressure, relative.
        mean_pressure: Plain,
    }
}

columns! {
    Summary {
        /// The reason why the run ended before its target, and the place; absent if it did not.
        stopped: Plain,
        /// Force at the end of the first loading, its largest but for what gives way on the way.
        peak_force: Force,
        /// Depth at the peak.
        peak_depth: Length,
        /// After unloading: how much lower the highest point of the body is than its first summit; under a
        /// tool that is no plane, how far it now travels before it touches.
        residual_depth: Length,
        /// dF/dh at the peak from one elastic solve with the contact kept.
        unloading_stiffness: Stiffness,
        /// Contact area at the peak.
        contact_area: Contact,
        /// Contact radius at the peak.
        contact_radius: Length,
        /// ∫F dh to the peak, over the corrected depth.
        total_work: Energy,
        /// Work returned on unloading to F = 0.
        elastic_work: Energy,
        /// Plastic work at the end of loading.
        plastic_work: Energy,
        /// Work that friction took to the end of loading; absent without friction.
        friction_work: Energy,
        /// Reading of the unloading curve by the method of Oliver and Pharr, under a tool with an apex.
        oliver_pharr: Table(OliverPharr::COLUMNS),
        /// Work returned on unloading over the work to the peak.
        elastic_fraction: Plain,
        /// Largest |W - E_e - W_p - E_c - W_f + E_t| over the largest W up to the row, from 1 % of its peak
        /// on, W_f what friction took and E_t what remeshing changed: large with coarse steps, not a measure
        /// of the error of the force.
        energy_balance_error: Plain,
        /// `errors.force`; NaN (`null`) where it is not known.
        estimated_error: Plain,
        /// 95 % bounds of the errors against the converged limit, at the peak or of what they name.
        errors: Table(Errors::COLUMNS),
        /// The largest of such bounds along the curve, over 0.2 ≤ h/h_peak ≤ 1.
        errors_along: Table(ErrorsAlong::COLUMNS),
        /// True where the stated errors are what the accuracy promises: of the force along the curve (of
        /// several contacts at the peak), of the area at the peak; `null` of a run that did not reach its
        /// goal.
        promise_kept: Plain,
        /// Rounds that were made, each finer than the one before: rows, fields and errors are those of the
        /// best.
        rounds: Plain,
        /// Number of elements.
        elements: Plain,
        /// Number of unknowns.
        dofs: Plain,
        /// Converged increments.
        increments: Plain,
        /// Newton iterations of all rounds, failed ones included.
        newton_iterations: Plain,
        /// Times an increment was halved.
        cutbacks: Plain,
        /// Number of remeshings: the mesh was too distorted.
        meshed_anew: Plain,
        /// Regions among the asperities that never yielded, at the peak.
        elastic_islands: Table(Island::COLUMNS),
        /// Seconds the run took.
        wall_s: Plain,
        /// Largest resident memory of the process so far, MB of 10⁶ bytes; `None` where the system does not
        /// say.
        peak_memory: Memory,
        /// Half apex angle of the cone that stands for a pyramid: that of the same projected area; absent of
        /// other tools.
        equivalent_half_apex_deg: Plain,
        /// Smoothing of each measured outline; absent where there is none.
        outlines: Table(Smoothing::COLUMNS),
        /// The scene as resolved, with the numbers that its accuracy stands for: enough to run it again.
        scene: Plain,
        /// Version of this program.
        version: Plain,
    }
}

columns! {
    Island {
        /// Area of its section before the crush.
        area: Area,
        /// Mean hydrostatic pressure, positive in compression.
        mean_pressure: Pressure,
        /// Mean von Mises stress.
        mean_von_mises: Pressure,
        /// Centroid (r, z) of its section before the crush.
        place: Length,
        /// True where it hangs together with the elastic bulk of the substrate.
        reaches_substrate: Plain,
        /// True where it reaches the free surface; the paper takes such a region for a possible leak path.
        reaches_surface: Plain,
    }
}

columns! {
    Smoothing {
        /// Table of the scene that names it: `asperity[0]`, `tool`.
        table: Plain,
        /// Number of points.
        points: Plain,
        /// Number of parabolic arcs of the curve.
        arcs: Plain,
        /// Standard deviation of the points about the curve that was allowed for.
        tolerance: Length,
        /// Greatest distance of a point from the curve.
        farthest: Length,
        /// Places of the corners that were kept.
        corners: Length,
    }
}

columns! {
    OliverPharr {
        /// Contact area read from the contact depth: `tool.area_function` there, or the section of the tool.
        contact_area: Area,
        /// h - ε F/S.
        contact_depth: Length,
        /// The geometry factor ε.
        epsilon: Plain,
        /// Peak force over the area that was read.
        hardness: Pressure,
        /// Reduced modulus from stiffness and area read.
        reduced_modulus: Modulus,
        /// Contact area at the peak.
        true_contact_area: Area,
        /// Mean pressure at the peak.
        true_hardness: Pressure,
        /// E/(1 - ν²), with an elastic tool in series.
        true_reduced_modulus: Modulus,
    }
}

/// Share of the kinematic hardening up to which a bar does not yield in reverse before its load is gone.
const FREE_SHARE: f64 = 0.5;
/// Yield stress over Young's modulus of the softest metals (lead, indium) is twice that.
const LEAST_YIELD_STRAIN: f64 = 5e-5;

impl Summary {
    /// The summary of a run of `scene`, which took `wall_s` seconds.
    pub(crate) fn new(outcome: &Outcome, given: &Tables, stopped: Option<String>, wall_s: f64) -> Summary {
        let single = match &given.numerics {
            Given { elements_in_contact: Some(_), .. } => {
                Some("the numbers of [numerics] stay as they are given; without numerics.elements_in_contact")
            }
            Given { refine: Some(false), .. } => {
                Some("it was to run once; without --no-refine, or numerics.refine = false,")
            }
            _ => None,
        };
        let scene = Tables { numerics: outcome.numbers.numerics(), ..given.clone() };
        Summary {
            stopped,
            single,
            numbers: outcome.summary.clone(),
            elastic_islands: outcome.elastic_islands.clone(),
            wall_s,
            peak_memory: peak_memory(),
            equivalent_half_apex_deg: scene.tool.shape.equivalent_half_apex_deg(),
            outlines: scene.smoothings(),
            scene: Box::new(scene),
            version: env!("CARGO_PKG_VERSION").into(),
        }
    }

    /// A value of this run in the `unit` of its files.
    pub fn written(&self, value: f64, unit: Unit) -> f64 {
        value / unit.value(self.scene.symmetry)
    }

    /// The text of summary.json.
    ///
    /// # Errors
    /// A scene that JSON cannot hold.
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(crate::results::output::json(self)? + "\n")
    }

    /// Reads a summary.json.
    ///
    /// # Errors
    /// A file that cannot be read, or holds something else.
    pub fn read(path: &Path) -> Result<Summary, Error> {
        let error =
            |e: &dyn std::fmt::Display| InputError::new(format!("cannot read {}: {e}", path.display()));
        let bytes = read_file(path, LARGEST_FILE, "the limit of a summary").map_err(|e| error(&e))?;
        serde_json::from_slice(&bytes).map_err(|e| error(&e).into())
    }

    /// Promises of the accuracy that this run does not keep, as far as it can tell.
    pub fn warnings(&self) -> Vec<String> {
        let promise = self.scene.accuracy.promise();
        let stated = self.scene.stated_and_promised(&self.numbers);
        let way_out = self.way_out(stated.map(|[stated, promised]| stated / promised));
        let mut warnings = Vec::new();
        let force = if self.scene.asperity_count() > 1 { "force" } else { "force along the curve" };
        for (what, [error, promise]) in [force, "contact area"].into_iter().zip(stated) {
            if error.is_nan() && self.stopped.is_some() {
                warnings.push(format!(
                    "the run ended before its goal: its {what} is not extrapolated and has no stated error"
                ));
            } else if error.is_nan() {
                warnings.push(format!(
                    "the error of the {what} is not known: the coarser run beside this one did not get as far; give more \
                     numerics.elements_in_contact and numerics.steps if they are given"
                ));
            } else if error > promise {
                let [error, promise] = [error, promise].map(|share| 100.0 * share);
                warnings.push(format!(
                    "the stated error of the {what} is {error:.2} %, above the {promise} % of the accuracy: {way_out}"
                ));
            }
        }
        let table = self.scene.material.hardening_table.as_ref().and_then(|rows| Some(rows.first()?.1));
        let yields_at =
            self.scene.material.yield_stress.or(table).map(|s| s.0 / self.scene.material.youngs_modulus.0);
        if let Some(strain) = yields_at.filter(|strain| *strain < LEAST_YIELD_STRAIN) {
            warnings.push(format!(
                "the metal yields at {strain:.0e} of its Young's modulus, metals at 1e-4 and above: look at the units of both"
            ));
        }
        let share = self.scene.material.moving_share();
        if share > FREE_SHARE && self.residual_depth.is_some() {
            warnings.push(format!(
                "the kinematic share of the hardening is {share}: during unloading the metal yields again, by too much at large strains, so that \
                 residual depth and elastic fraction may be off by far more than their stated errors; give material.kinematic_share of {FREE_SHARE} or less"
            ));
        }
        if self.elastic_fraction.is_some_and(|fraction| fraction > 1.0) {
            warnings.push(
                "more work was recovered than was done: force and energies of this run are not to be used; press less deep, or by a blunter tool"
                    .into(),
            );
        }
        // the steps of a level, chosen for its force, leave up to 2e-3
        let balance = if promise > 0.01 { 1e-2 } else { 3e-3 };
        if self.energy_balance_error > balance {
            warnings.push(format!(
                "work and energies differ by {:.1e} of the work, more than {balance:.0e}: give more numerics.steps if energies matter",
                self.energy_balance_error
            ));
        }
        warnings
    }

    /// The way out where the stated errors are these times what is promised.
    fn way_out(&self, over: [f64; 2]) -> String {
        let work = work_to_keep(over);
        // beyond that the order of the errors foretells nothing
        let work = if work > 1000.0 { "more than 1000".into() } else { format!("about {work:.0}") };
        match (self.rounds, self.single) {
            _ if self.scene.mesh.is_some() => "the mesh is given, and stays; give a finer one".into(),
            _ if self.stopped.is_some() => "the run ended before its goal, and was not refined".into(),
            (1, Some(single)) => {
                format!("{single} the run is refined by itself, at {work} times the work")
            }
            (1, None) => format!(
                "no finer run came to its end; give a larger numerics.elements_in_contact, at {work} times the work"
            ),
            (rounds, _) => format!(
                "{rounds} rounds of finer numbers did not bring it below; that would take {work} times the work of the last one, \
                 with a larger numerics.elements_in_contact"
            ),
        }
    }

    /// A few lines for a person.
    pub fn overview(&self) -> String {
        let per = per_length(self.scene.symmetry);
        let shown = |value: f64, unit: Unit| four_decimals(self.written(value, unit));
        let error = match self.errors {
            Errors { force, contact_area, .. } if force.is_finite() => {
                format!(
                    ", force within {:.2} %, contact area within {:.2} %",
                    100.0 * force,
                    100.0 * contact_area
                )
            }
            _ => String::new(),
        };
        let mut text = format!(
            "peak      {} N{per} at {} um{error}\n",
            shown(self.peak_force, Unit::Force),
            shown(self.peak_depth, Unit::Length)
        );
        if let (Some(residual), Some(elastic), Some(fraction)) =
            (self.residual_depth, self.elastic_work, self.elastic_fraction)
        {
            text += &format!(
                "unloaded  residual depth {} um; work returned {} of {} uJ{per} ({:.1} %)\n",
                shown(residual, Unit::Length),
                shown(elastic, Unit::Energy),
                shown(self.total_work, Unit::Energy),
                100.0 * fraction
            );
        }
        if let Some(read) = &self.oliver_pharr {
            let [over_area, by_stiffness] =
                [read.true_hardness, read.hardness].map(|p| with_digits(p / MEGAPASCAL, 4));
            text += &format!(
                "hardness  {over_area} MPa, force over contact area; by Oliver and Pharr {by_stiffness} MPa\n"
            );
        }
        text += &format!(
            "solved    {} elements, {} unknowns, {} increments, {} Newton iterations, energy balance {:.1e}",
            self.elements, self.dofs, self.increments, self.newton_iterations, self.energy_balance_error
        );
        text
    }
}

/// Keys that a file does not have where they have no value.
const ABSENT: [&str; 3] = ["stopped", "equivalent_half_apex_deg", "outlines"];

impl Serialize for Summary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let si = Summary::serialize(self, serde_json::value::Serializer).map_err(S::Error::custom)?;
        let Value::Object(si) = si else { return Err(S::Error::custom("a summary is a table")) };
        let nothing = |value: &Value| value.is_null() || value.as_array().is_some_and(Vec::is_empty);
        let entries = named(si, Summary::COLUMNS, self.scene.symmetry);
        serializer.collect_map(entries.filter(|(name, v)| !(ABSENT.contains(&name.as_str()) && nothing(v))))
    }
}

impl<'de> Deserialize<'de> for Summary {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let mut entries = Map::<String, Value>::deserialize(deserializer)?;
        let symmetry = symmetry_of(Summary::COLUMNS, |name| entries.contains_key(name));
        let si = unnamed(Summary::COLUMNS, symmetry, |name| entries.remove(name));
        Summary::deserialize(Value::Object(si)).map_err(D::Error::custom)
    }
}

/// Largest resident memory of this process so far, bytes; `None` where the system does not say.
pub fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1024.0)
}
