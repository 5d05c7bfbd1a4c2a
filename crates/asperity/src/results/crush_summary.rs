//! `summary.json`, as it is written and read.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the file")]

use crate::error::{Error, InputError};
use crate::page::format::significant;
use crate::results::output::{nan_for_null, row};
use crate::results::units::{GIGAPASCAL, MEGAPASCAL, MICROMETRE, Units, axisymmetric_name, file_name};
use asperity_simulation::record::rows::{self, OliverPharr};
use asperity_simulation::scene::{Accuracy, Scene as Tables, Smoothing, Symmetry};
use asperity_solver::body::islands;
use indexmap::IndexMap;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;
use std::path::Path;

row! {
    /// 95 % bounds of the errors against the program's own converged limit, for 0.2 ≤ h/h_peak ≤ 1. NaN or `None`, `null` in
    /// the file, where an error is not known or the run did not unload.
    Errors(errors: &rows::Errors) {
        /// Of the force, relative.
        #[serde(deserialize_with = "nan_for_null")]
        force: f64 = errors.force,
        /// Of the contact area, relative.
        #[serde(deserialize_with = "nan_for_null")]
        contact_area: f64 = errors.contact_area,
        /// Of the mean pressure, relative.
        #[serde(deserialize_with = "nan_for_null")]
        mean_pressure: f64 = errors.mean_pressure,
        /// Of the residual depth, over the peak depth.
        residual_depth: Option<f64> = errors.residual_depth,
        /// Of the elastic fraction, absolute.
        elastic_fraction: Option<f64> = errors.elastic_fraction,
        /// Of the unloading stiffness, relative.
        unloading_stiffness: Option<f64> = errors.unloading_stiffness,
    }
}

row! {
    /// The numbers of a crush. `None`, `null` in the file, is what the scene did not ask for (unloading) or the run did not
    /// reach. Fields are named as the keys of an axisymmetric crush; the file of a crush in plane strain has the names of
    /// [`crate::results::units::plane_strain_name`], and so has what is serialised.
    #[serde(remote = "Self")]
    Summary(
        summary: &rows::Summary, islands: &[islands::Island], units: Units, scene: Tables,
        stopped: Option<String>, wall_s: f64
    ) {
        /// Why and where the run ended before its target; absent if it did not.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        stopped: Option<String> = stopped,
        /// Force at the end of the first loading, its largest but for what gives way on the way.
        peak_force_N: f64 = summary.peak_force / units.force,
        /// Depth at the peak.
        peak_depth_um: f64 = summary.peak_depth / MICROMETRE,
        /// After unloading: how much lower the highest point of the body is than its first summit; under a cone or a sphere, how far
        /// that tool now travels before it touches.
        residual_depth_um: Option<f64> = summary.residual_depth.map(|h| h / MICROMETRE),
        /// dF/dh at the peak from one elastic solve with the contact kept.
        unloading_stiffness_N_per_um: Option<f64> = summary.unloading_stiffness.map(|s| s / units.stiffness),
        /// Contact area at the peak.
        contact_area_um2: f64 = summary.contact_area / units.area,
        /// Contact radius at the peak.
        contact_radius_um: f64 = summary.contact_radius / MICROMETRE,
        /// ∫F dh to the peak, over the corrected depth.
        total_work_uJ: f64 = summary.total_work / units.energy,
        /// Work returned on unloading to F = 0.
        elastic_work_uJ: Option<f64> = summary.elastic_work.map(|w| w / units.energy),
        /// Plastic work at the end of loading.
        plastic_work_uJ: f64 = summary.plastic_work / units.energy,
        /// Reading of the unloading curve by the method of Oliver and Pharr, under a tool with an apex.
        oliver_pharr: Option<Instrument> = summary.oliver_pharr.as_ref().map(|read| Instrument::new(read, summary)),
        /// Work returned on unloading over the work to the peak.
        elastic_fraction: Option<f64> = summary.elastic_fraction,
        /// Largest |W - E_e - W_p - E_c + E_t|/W over increments with W above 1 % of its peak, E_t what remeshing changed: large with
        /// coarse steps, not a measure of the error of the force.
        #[serde(deserialize_with = "nan_for_null")]
        energy_balance_error: f64 = summary.energy_balance_error,
        /// `errors.force`; NaN (`null`) where it is not known.
        #[serde(deserialize_with = "nan_for_null")]
        estimated_error: f64 = summary.estimated_error,
        /// 95 % bounds of the errors against the converged limit.
        errors: Errors = Errors::new(&summary.errors),
        /// Number of elements.
        elements: usize = summary.elements,
        /// Number of unknowns.
        dofs: usize = summary.dofs,
        /// Converged increments.
        increments: usize = summary.increments,
        /// Newton iterations of the whole run, failed ones included.
        newton_iterations: usize = summary.newton_iterations,
        /// Times an increment was halved.
        cutbacks: usize = summary.cutbacks,
        /// Number of remeshings: the mesh was too distorted.
        meshed_anew: usize = summary.transfers,
        /// Regions among the asperities that never yielded, at the peak.
        elastic_islands: Vec<Island> = islands.iter().map(Island::new).collect(),
        /// Seconds the run took.
        wall_s: f64 = wall_s,
        /// Largest resident memory of the process so far, MB of 10⁶ bytes; `None` where the system does not say.
        peak_memory_MB: Option<f64> = peak_memory_mb(),
        /// Half apex angle of the cone that stands for a pyramid: that of the same projected area; absent of other tools.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        equivalent_half_apex_deg: Option<f64> = scene.tool.shape.equivalent_half_apex_deg(),
        /// Smoothing of each measured outline; absent where there is none.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        outlines: Vec<MeasuredOutline> = scene.smoothings().iter().map(MeasuredOutline::new).collect(),
        /// The scene as resolved, with the numbers that its accuracy stands for: enough to run it again.
        #[serde(serialize_with = "by_key")]
        scene: Box<Tables> = Box::new(scene),
        /// Version of this program.
        version: String = env!("CARGO_PKG_VERSION").into(),
    }
}

row! {
    /// A connected region that never yielded, enclosed by material that did or standing above the substrate.
    Island(row: &islands::Island) {
        /// Area of its section before the crush.
        area_um2: f64 = row.area / (MICROMETRE * MICROMETRE),
        /// Mean hydrostatic pressure, positive in compression.
        mean_pressure_MPa: f64 = row.mean_pressure / MEGAPASCAL,
        /// Mean von Mises stress.
        mean_von_mises_MPa: f64 = row.mean_von_mises / MEGAPASCAL,
        /// Centroid (r, z) of its section before the crush.
        place_um: [f64; 2] = row.place.map(|x| x / MICROMETRE),
        /// Whether it hangs together with the elastic bulk of the substrate.
        reaches_substrate: bool = row.reaches_substrate,
        /// Whether it reaches the free surface; the paper takes such a region for a possible leak path.
        reaches_surface: bool = row.reaches_surface,
    }
}

row! {
    /// A measured outline and the curve that stands for it.
    MeasuredOutline(read: &Smoothing) {
        /// Table of the scene that names it: `asperity[0]`, `tool`.
        table: String = read.table.clone(),
        /// Number of points.
        points: usize = read.points,
        /// Number of parabolic arcs of the curve.
        arcs: usize = read.arcs,
        /// Standard deviation of the points about the curve that was allowed for.
        tolerance_um: f64 = read.tolerance / MICROMETRE,
        /// Greatest distance of a point from the curve.
        farthest_um: f64 = read.farthest / MICROMETRE,
        /// Places of the corners that were kept.
        corners_um: Vec<f64> = read.corners.iter().map(|x| x / MICROMETRE).collect(),
    }
}

row! {
    /// An instrument's reading of the unloading curve (Oliver and Pharr 1992), and beside it what is true.
    Instrument(read: &OliverPharr, summary: &rows::Summary) {
        /// Contact area read from the contact depth: `tool.area_function` there, or the section of the tool.
        contact_area_um2: f64 = read.contact_area / (MICROMETRE * MICROMETRE),
        /// h - ε F/S.
        contact_depth_um: f64 = read.contact_depth / MICROMETRE,
        /// The geometry factor ε.
        epsilon: f64 = read.geometry_factor,
        /// Peak force over the area that was read.
        hardness_MPa: f64 = read.hardness / MEGAPASCAL,
        /// Reduced modulus from stiffness and area read.
        reduced_modulus_GPa: f64 = read.reduced_modulus / GIGAPASCAL,
        /// Contact area at the peak.
        true_contact_area_um2: f64 = summary.contact_area / (MICROMETRE * MICROMETRE),
        /// Mean pressure at the peak.
        true_hardness_MPa: f64 = summary.peak_force / summary.contact_area / MEGAPASCAL,
        /// E/(1 - ν²), with an elastic tool in series.
        true_reduced_modulus_GPa: f64 = summary.reduced_modulus / GIGAPASCAL,
    }
}

/// Share of the kinematic hardening up to which a bar does not yield in reverse before its load is gone.
const FREE_SHARE: f64 = 0.5;

impl Summary {
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
        let text = std::fs::read_to_string(path).map_err(|e| error(&e))?;
        serde_json::from_str(&text).map_err(|e| error(&e).into())
    }

    /// Promises of the accuracy that this run does not keep, as far as it can tell.
    pub fn warnings(&self) -> Vec<String> {
        let promise = self.scene.accuracy.promise();
        let mut warnings = Vec::new();
        for (what, error) in [("force", self.errors.force), ("contact area", self.errors.contact_area)] {
            if error.is_nan() && self.stopped.is_some() {
                warnings.push(format!(
                    "the run ended before its goal: its {what} is not extrapolated and has no stated error"
                ));
            } else if error.is_nan() {
                warnings.push(format!(
                    "the error of the {what} is not known: the coarser run beside this one did not get as far"
                ));
            } else if error > promise {
                let way_out = if promise > Accuracy::Reference.promise() {
                    "ask for a finer one if that matters"
                } else {
                    "none is finer by name; if that matters, set the numbers of [numerics] finer, such as numerics.elements_in_contact"
                };
                let [error, promise] = [error, promise].map(|share| 100.0 * share);
                warnings.push(format!(
                    "the stated error of the {what} is {error:.2} %, above the {promise} % of the accuracy: {way_out}"
                ));
            }
        }
        let share = self.scene.material.moving_share();
        if share > FREE_SHARE && self.residual_depth_um.is_some() {
            warnings.push(format!(
                "with {share} of the hardening kinematic the metal yields in reverse as the tool retreats, by too much where strains are large: \
                 residual depth and elastic fraction may be far off; give material.kinematic_share of {FREE_SHARE} or less"
            ));
        }
        if self.elastic_fraction.is_some_and(|fraction| fraction > 1.0) {
            warnings.push(
                "more work came back than was done: force and energies of this run are not to be used; press less deep, or by a blunter tool"
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

    /// A few lines for a person.
    pub fn overview(&self) -> String {
        let per = per_length(self.scene.symmetry);
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
            four_digits(self.peak_force_N),
            four_digits(self.peak_depth_um)
        );
        if let (Some(residual), Some(elastic), Some(fraction)) =
            (self.residual_depth_um, self.elastic_work_uJ, self.elastic_fraction)
        {
            text += &format!(
                "unloaded  residual depth {} um; work returned {} of {} uJ{per} ({:.1} %)\n",
                four_digits(residual),
                four_digits(elastic),
                four_digits(self.total_work_uJ),
                100.0 * fraction
            );
        }
        text += &format!(
            "solved    {} elements, {} unknowns, {} increments, {} Newton iterations, energy balance {:.1e}",
            self.elements, self.dofs, self.increments, self.newton_iterations, self.energy_balance_error
        );
        text
    }
}

/// Four decimals, and four significant digits of what is smaller than 1.
fn four_digits(value: f64) -> String {
    if value.abs() < 1.0 && value != 0.0 { significant(value) } else { format!("{value:.4}") }
}

/// The end of a unit of force or energy.
pub(crate) fn per_length(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::Axisymmetric => "",
        Symmetry::PlaneStrain => "/mm",
    }
}

impl Serialize for Summary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut text = Vec::new();
        Summary::serialize(self, &mut serde_json::Serializer::new(&mut text)).map_err(S::Error::custom)?;
        let entries: IndexMap<String, Value> = serde_json::from_slice(&text).map_err(S::Error::custom)?;
        serializer.collect_map(entries.iter().map(|(key, v)| (file_name(key, self.scene.symmetry), v)))
    }
}

impl<'de> Deserialize<'de> for Summary {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let entries = IndexMap::<String, Value>::deserialize(deserializer)?;
        let entries = entries.into_iter().map(|(key, value)| (axisymmetric_name(&key).to_string(), value));
        Summary::deserialize(Value::Object(entries.collect())).map_err(D::Error::custom)
    }
}

/// The scene with its keys in the order of the alphabet.
fn by_key<S: Serializer>(scene: &Tables, serializer: S) -> Result<S::Ok, S::Error> {
    serde_json::to_value(scene).map_err(S::Error::custom)?.serialize(serializer)
}

/// Largest resident memory of this process so far, in MB of 10⁶ bytes; `None` where the system does not say.
pub fn peak_memory_mb() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|l| l.strip_prefix("VmHWM:"))?;
    let kib: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kib * 1.024e-3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_numbers_keep_four_digits() {
        let shown = [5.45981, 0.71874, 0.00166, 4.2e-5, 0.0].map(four_digits);
        assert_eq!(shown, ["5.4598", "0.7187", "0.001660", "0.00004200", "0.0000"]);
    }
}
