//! `summary.json`, as it is written and read.

#![expect(non_snake_case, reason = "a name ends in its unit, as in the file")]

use crate::error::{Error, InputError};
use crate::units::{GIGAPASCAL, MEGAPASCAL, MICROMETRE, Units, axisymmetric_name, file_name};
use asperity_solver::run::oliver_pharr::OliverPharr;
use asperity_solver::run::record;
use asperity_solver::scene::{Scene as Tables, Symmetry};
use indexmap::IndexMap;
use serde::de::Error as _;
use serde::ser::Error as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use serde_json::Value;
use std::path::Path;

/// The numbers of a crush. `None`, `null` in the file, is what the scene did not ask for (unloading) or the run did not
/// reach. Fields are named as the keys of an axisymmetric crush; the file of a crush in plane strain has the names of
/// [`crate::units::plane_strain_name`], and so has what is serialised.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(remote = "Self")]
pub struct Summary {
    /// Why and where the run ended before its target; absent if it did not.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stopped: Option<String>,
    /// Largest force.
    pub peak_force_N: f64,
    /// Depth at the peak.
    pub peak_depth_um: f64,
    /// Initial summit minus the highest point of the body in equilibrium without the tool.
    pub residual_depth_um: Option<f64>,
    /// dF/dh at the peak from one elastic solve with the contact kept.
    pub unloading_stiffness_N_per_um: Option<f64>,
    /// Contact area at the peak.
    pub contact_area_um2: f64,
    /// Contact radius at the peak.
    pub contact_radius_um: f64,
    /// ∫F dh to the peak, over the corrected depth.
    pub total_work_uJ: f64,
    /// Work returned on unloading to F = 0.
    pub elastic_work_uJ: Option<f64>,
    /// Plastic work at the end of loading.
    pub plastic_work_uJ: f64,
    /// Reading of the unloading curve by the method of Oliver and Pharr, under a cone or sphere.
    pub oliver_pharr: Option<Instrument>,
    /// elastic_work / total_work.
    pub elastic_fraction: Option<f64>,
    /// Largest |W - E_e - W_p - E_c|/W over increments with W above 1 % of its peak.
    #[serde(deserialize_with = "crate::output::nan_for_null")]
    pub energy_balance_error: f64,
    /// 95 % bound of the relative error of the force for 0.2 ≤ h/h_peak ≤ 1; NaN (`null`) where it is not known.
    #[serde(deserialize_with = "crate::output::nan_for_null")]
    pub estimated_error: f64,
    /// Number of elements.
    pub elements: usize,
    /// Number of unknowns.
    pub dofs: usize,
    /// Converged increments.
    pub increments: usize,
    /// Newton iterations of the whole run, failed ones included.
    pub newton_iterations: usize,
    /// Times an increment was halved.
    pub cutbacks: usize,
    /// Regions among the asperities that never yielded, at the peak.
    pub elastic_islands: Vec<Island>,
    /// Seconds the run took.
    pub wall_s: f64,
    /// Largest resident memory of the process so far, MB of 10⁶ bytes; `None` where the system does not say.
    pub peak_memory_MB: Option<f64>,
    /// The scene with the numbers that its accuracy stands for.
    #[serde(serialize_with = "by_key")]
    pub scene: Box<Tables>,
    /// Version of this program.
    pub version: String,
}

/// A connected region that never yielded, enclosed by material that did or standing above the substrate.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Island {
    /// Area of its section before the crush.
    pub area_um2: f64,
    /// Mean hydrostatic pressure, positive in compression.
    pub mean_pressure_MPa: f64,
    /// Mean von Mises stress.
    pub mean_von_mises_MPa: f64,
    /// Centroid (r, z) of its section before the crush.
    pub place_um: [f64; 2],
    /// Whether it hangs together with the elastic bulk of the substrate.
    pub reaches_substrate: bool,
    /// Whether it holds a part of the free surface: a leak path.
    pub reaches_surface: bool,
}

impl From<&record::IslandRow> for Island {
    fn from(row: &record::IslandRow) -> Island {
        Island {
            area_um2: row.area / (MICROMETRE * MICROMETRE),
            mean_pressure_MPa: row.mean_pressure / MEGAPASCAL,
            mean_von_mises_MPa: row.mean_von_mises / MEGAPASCAL,
            place_um: row.place.map(|x| x / MICROMETRE),
            reaches_substrate: row.reaches_substrate,
            reaches_surface: row.reaches_surface,
        }
    }
}

/// An instrument's reading of the unloading curve (Oliver and Pharr 1992), and beside it what is true.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Instrument {
    /// Contact area read from the contact depth.
    pub contact_area_um2: f64,
    /// h - ε F/S.
    pub contact_depth_um: f64,
    /// The geometry factor ε.
    pub epsilon: f64,
    /// Peak force over the area that was read.
    pub hardness_MPa: f64,
    /// Reduced modulus from stiffness and area read.
    pub reduced_modulus_GPa: f64,
    /// Contact area at the peak.
    pub true_contact_area_um2: f64,
    /// Mean pressure at the peak.
    pub true_hardness_MPa: f64,
    /// E/(1 - ν²).
    pub true_reduced_modulus_GPa: f64,
}

impl Instrument {
    fn new(read: &OliverPharr, summary: &record::Summary) -> Instrument {
        let area = MICROMETRE * MICROMETRE;
        Instrument {
            contact_area_um2: read.contact_area / area,
            contact_depth_um: read.contact_depth / MICROMETRE,
            epsilon: read.geometry_factor,
            hardness_MPa: read.hardness / MEGAPASCAL,
            reduced_modulus_GPa: read.reduced_modulus / GIGAPASCAL,
            true_contact_area_um2: summary.contact_area / area,
            true_hardness_MPa: summary.peak_force / summary.contact_area / MEGAPASCAL,
            true_reduced_modulus_GPa: summary.reduced_modulus / GIGAPASCAL,
        }
    }
}

impl Summary {
    /// The summary of a run of `scene`, resolved, that took `wall_s` seconds.
    pub(super) fn new(
        summary: &record::Summary,
        islands: &[record::IslandRow],
        scene: Tables,
        stopped: Option<String>,
        wall_s: f64,
    ) -> Summary {
        let units = Units::of(scene.symmetry);
        Summary {
            stopped,
            peak_force_N: summary.peak_force / units.force,
            peak_depth_um: summary.peak_depth / MICROMETRE,
            residual_depth_um: summary.residual_depth.map(|h| h / MICROMETRE),
            unloading_stiffness_N_per_um: summary.unloading_stiffness.map(|s| s / units.stiffness),
            contact_area_um2: summary.contact_area / units.area,
            contact_radius_um: summary.contact_radius / MICROMETRE,
            total_work_uJ: summary.total_work / units.energy,
            elastic_work_uJ: summary.elastic_work.map(|w| w / units.energy),
            plastic_work_uJ: summary.plastic_work / units.energy,
            oliver_pharr: summary.oliver_pharr.as_ref().map(|read| Instrument::new(read, summary)),
            elastic_fraction: summary.elastic_fraction,
            energy_balance_error: summary.energy_balance_error,
            estimated_error: summary.estimated_error,
            elements: summary.elements,
            dofs: summary.dofs,
            increments: summary.increments,
            newton_iterations: summary.newton_iterations,
            cutbacks: summary.cutbacks,
            elastic_islands: islands.iter().map(Island::from).collect(),
            wall_s,
            peak_memory_MB: peak_memory_mb(),
            scene: Box::new(scene),
            version: env!("CARGO_PKG_VERSION").into(),
        }
    }

    /// The text of summary.json.
    ///
    /// # Errors
    /// A scene that JSON cannot hold.
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(crate::output::json(self)? + "\n")
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

    /// A few lines for a person.
    pub fn overview(&self) -> String {
        let per = per_length(self.scene.symmetry);
        let error = self.estimated_error;
        let error =
            if error.is_finite() { format!(", error within {:.2} %", 100.0 * error) } else { String::new() };
        let mut text =
            format!("peak      {:.4} N{per} at {:.4} um{error}\n", self.peak_force_N, self.peak_depth_um);
        if let (Some(residual), Some(elastic), Some(fraction)) =
            (self.residual_depth_um, self.elastic_work_uJ, self.elastic_fraction)
        {
            text += &format!(
                "unloaded  residual depth {residual:.4} um; work returned {elastic:.4} of {:.4} uJ{per} ({:.1} %)\n",
                self.total_work_uJ,
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

/// The end of a unit of force or energy.
pub(super) fn per_length(symmetry: Symmetry) -> &'static str {
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
