//! A fit that makes sense: the unknowns, and the measurements read from their files.

use super::material_checks::{KeyError, check_material, key_error};
use super::measurements::{Said, imprint, measurements};
use super::tool_geometry::{friction, geometry};
use crate::error::Error;
use crate::input::toml_file::TomlFile;
use asperity_identification::emulator::Emulator;
use asperity_identification::experiment::{Data, Experiment};
use asperity_identification::fit_file::{FitAccuracy, FitCurve, FitFile, FitLaw, FitShape, Nuisance};
use asperity_identification::known_or_unknown::KnownOrUnknown;
use asperity_identification::parameters::Unknowns;
use asperity_identification::pyramid::Pyramid;
use asperity_identification::response::{Geometry, NUMBERS_AFTER_LOADING};
use asperity_material::{Elastic, StressMeasure};
use asperity_simulation::scene::Accuracy;
use std::path::Path;

/// A fit ready to be searched.
#[derive(Debug)]
pub struct Fit {
    file: TomlFile<FitFile>,
    pub(super) unknowns: Unknowns,
    pub(super) experiments: Vec<Experiment>,
    /// Interpretation of each file, in a sentence.
    pub understood: Vec<String>,
    /// Remarks on the input.
    pub notes: Vec<String>,
    /// Those among them that doubt the model.
    pub(super) doubts: Vec<String>,
}

/// Standard deviation of a feature that states none, and the first guess of that of a curve.
const DEFAULT_NOISE: f64 = 0.01;
/// Most unknowns of a fit.
const MOST_UNKNOWNS: usize = 12;
/// Most measurements of a fit.
const MOST_CURVES: usize = 50;

impl Fit {
    /// The fit of the file at `path`, with overrides `key.path=value`; files that it names are relative to
    /// its folder.
    ///
    /// # Errors
    /// A file that cannot be read or makes no sense, pointing at its line.
    pub fn read(path: &Path, overrides: &[String]) -> Result<Fit, Error> {
        Fit::checked(TomlFile::read(path, overrides)?)
    }

    /// The fit that `text` says in TOML; files that it names are relative to the folder `base`.
    ///
    /// # Errors
    /// As for [`Fit::read`].
    pub fn from_toml(text: &str, base: &Path) -> Result<Fit, Error> {
        Fit::checked(TomlFile::parse(&base.join("fit"), text.into(), &[])?)
    }

    /// Name of the file without its extension.
    pub fn name(&self) -> String {
        self.file.stem()
    }

    /// The content of the file.
    pub fn tables(&self) -> &FitFile {
        &self.file.value
    }

    pub(super) fn accuracy(&self) -> Accuracy {
        match self.file.value.accuracy {
            FitAccuracy::Draft => Accuracy::Draft,
            FitAccuracy::Standard => Accuracy::Standard,
        }
    }

    fn checked(file: TomlFile<FitFile>) -> Result<Fit, Error> {
        let tables = &file.value;
        check_material(&tables.material).map_err(|(key, m)| file.error_at(&format!("material.{key}"), &m))?;
        if tables.curve.is_empty() || tables.curve.len() > MOST_CURVES {
            let message = format!(
                "needs from 1 to {MOST_CURVES} measurements, not {}: give a [[curve]] with a file or with features",
                tables.curve.len()
            );
            return Err(file.error_at("curve", &message).into());
        }
        let mut unknowns = Unknowns::new(&tables.material);
        if unknowns.parameters.is_empty() {
            let message =
                "nothing is sought: give a range, for example yield_stress = [\"50 MPa\", \"2 GPa\"]";
            return Err(file.error_at("material", message).into());
        }
        let (mut experiments, mut owners) = (Vec::new(), Vec::new());
        let mut said = Said::default();
        for (i, curve) in tables.curve.iter().enumerate() {
            let at = |key: &str, message: &str| {
                let path = if key.is_empty() { format!("curve[{i}]") } else { format!("curve[{i}].{key}") };
                file.error_at(&path, message)
            };
            let geometry = geometry(curve).map_err(|(key, m)| at(&key, &m))?;
            let read = measurements(&file, i, curve, &mut said)?;
            if curve.imprint.is_some() && read.len() > 1 {
                let message = "belongs to one test, and the file has several: choose it by `test`";
                return Err(at("imprint", message).into());
            }
            for (name, data, depth) in read {
                let made = experiments_of(curve, (owners.len(), name), &geometry, data, depth, |name| {
                    imprint(&file, curve, &geometry, depth, &mut said, name)
                });
                let measure = tables.material.stress_measure;
                let made = made.map_err(|(key, m)| at(&key, &m))?;
                experiments.extend(made.into_iter().map(|e| Experiment { stress_measure: measure, ..e }));
                owners.push(i);
            }
            let slope = curve.features.is_some_and(|f| f.unloading_slope.is_some() && f.max_depth.is_none());
            if slope {
                return Err(at(
                    "features",
                    "`max_depth` is missing beside unloading_slope: a slope belongs to a depth",
                )
                .into());
            }
        }
        for experiment in experiments.iter().filter(|e| !e.is_imprint()) {
            let i = owners[experiment.curve];
            add_nuisances(&mut unknowns, experiment, &tables.curve[i], owners.len())
                .map_err(|(key, m)| file.error_at(&format!("curve[{i}].{key}"), &m))?;
        }
        if unknowns.parameters.len() > MOST_UNKNOWNS {
            let message = format!(
                "{} unknowns are more than {MOST_UNKNOWNS}, the measurements' own among them: give some of them, or fewer measurements",
                unknowns.parameters.len()
            );
            return Err(file.error_at("", &message).into());
        }
        let like = tables.material.hardening_law != FitLaw::Table
            && tables.material.stress_measure == StressMeasure::Cauchy;
        for experiment in &mut experiments {
            experiment.emulator = Emulator::of_a_cone(1 + NUMBERS_AFTER_LOADING, like);
        }
        let sought = |e: &Experiment| tables.curve[owners[e.curve]].unknown.contains(&Nuisance::ContactDepth);
        let doubts: Vec<String> = experiments.iter().filter_map(|e| e.doubt(sought(e))).collect();
        let Said { understood, mut notes } = said;
        notes.extend(doubts.iter().cloned());
        Ok(Fit { file, unknowns, experiments, understood, notes, doubts })
    }
}

/// The experiments of a measurement: its curve or features, and its imprint.
fn experiments_of(
    curve: &FitCurve,
    (number, name): (usize, String),
    geometry: &Geometry,
    data: Data,
    depth: f64,
    imprint: impl FnOnce(&str) -> Result<Option<Data>, KeyError>,
) -> Result<Vec<Experiment>, KeyError> {
    let left = imprint(&name)?;
    let imprint_force = match &data {
        Data::Curve(measured) => Some(measured.peak[1]),
        _ => None,
    };
    let of_the_imprint = left.map(|data| {
        let made = experiment(curve, (number, format!("{name}, imprint")), geometry.clone(), data, depth)?;
        let file = curve.imprint.as_ref().map(|imprint| imprint.table().file);
        let label = file.as_ref().and_then(|file| file.file_name());
        let label = label.map_or_else(|| made.label.clone(), |name| name.to_string_lossy().into_owned());
        Ok(Experiment { imprint_force, label, model_error: 0.0, ..made })
    });
    let no_curve = matches!(
        data,
        Data::Features { loading_curvature: None, unloading_slope: None, plastic_work_ratio: None }
    );
    let of_the_curve =
        (!no_curve).then(|| experiment(curve, (number, name.clone()), geometry.clone(), data, depth));
    of_the_curve.into_iter().chain(of_the_imprint).collect()
}

fn experiment(
    curve: &FitCurve,
    (number, name): (usize, String),
    geometry: Geometry,
    data: Data,
    depth: f64,
) -> Result<Experiment, KeyError> {
    for (key, share) in [("noise", curve.noise), ("model_error", curve.model_error)] {
        if let Some(share) = share.filter(|s| !(0.0..=0.5).contains(&s.0)) {
            return Err(key_error(key, format!("must be from 0 % to 50 %, not {} %", 100.0 * share.0)));
        }
    }
    let pyramid = match curve.tool.shape {
        FitShape::Berkovich => Some(Pyramid::Berkovich),
        FitShape::Vickers => Some(Pyramid::Vickers),
        _ => None,
    };
    let tool = match (curve.tool.youngs_modulus, curve.tool.poissons_ratio) {
        (None, None) => None,
        (Some(modulus), ratio) if modulus.0 > 0.0 => {
            Some(Elastic { youngs_modulus: modulus.0, poissons_ratio: ratio.unwrap_or(0.3) })
        }
        _ => {
            return Err(key_error(
                "tool",
                "an elastic tool needs youngs_modulus above 0: give it, or leave out poissons_ratio",
            ));
        }
    };
    let needs_depth = !matches!(geometry, Geometry::Sharp { .. });
    if needs_depth && matches!(data, Data::Features { .. }) && depth == 1.0 {
        return Err(key_error(
            "features",
            "`max_depth` is missing: only features of a sharp cone do without",
        ));
    }
    let (friction, sought) = friction(curve)?;
    let known = |sought: Option<KnownOrUnknown<f64>>| match sought {
        Some(KnownOrUnknown::Known(value)) => value,
        _ => 0.0,
    };
    Ok(Experiment {
        label: curve.label(&name),
        name,
        curve: number,
        geometry,
        pyramid,
        tool,
        tip_radius: known(curve.tool.tip_radius.map(|t| t.map(|l| l.0))),
        compliance: known(curve.tool.machine_compliance.map(|c| c.map(|v| v.0))),
        friction,
        friction_sought: sought.is_some(),
        depth,
        imprint_force: None,
        stress_measure: StressMeasure::default(),
        noise: curve.noise.map_or(DEFAULT_NOISE, |n| n.0).max(1e-4),
        noise_given: curve.noise.is_some() || !matches!(data, Data::Curve(_)),
        noise_correlation: 0.0,
        data,
        model_error: curve.model_error.map_or(0.0, |m| m.0),
        errors: [0.01, 0.02, 0.02],
        emulator: Emulator::of_a_cone(1 + NUMBERS_AFTER_LOADING, true),
    })
}

/// Adds the unknowns of a measurement with their bounds.
fn add_nuisances(
    unknowns: &mut Unknowns,
    experiment: &Experiment,
    curve: &FitCurve,
    count: usize,
) -> Result<(), KeyError> {
    let of = experiment.curve;
    let asked = |nuisance| curve.unknown.contains(&nuisance);
    if asked(Nuisance::ContactDepth) {
        let range = experiment.touch_range().ok_or_else(|| {
            key_error("unknown", "contact_depth needs a curve in a file: features have none")
        })?;
        unknowns.add("contact_depth", of, count, range);
    }
    match curve.tool.machine_compliance {
        Some(KnownOrUnknown::Range(ends)) => unknowns.add("machine_compliance", of, count, ends.map(|c| c.0)),
        _ if asked(Nuisance::MachineCompliance) => {
            let peak = experiment
                .peak()
                .ok_or_else(|| key_error("unknown", "machine_compliance needs a loading"))?;
            unknowns.add("machine_compliance", of, count, [0.0, 0.1 * peak[0] / peak[1]]);
        }
        _ => {}
    }
    match curve.tool.tip_radius {
        Some(KnownOrUnknown::Range(ends)) => unknowns.add("tip_radius", of, count, ends.map(|l| l.0)),
        Some(KnownOrUnknown::Known(tip)) if asked(Nuisance::TipRadius) => {
            unknowns.add("tip_radius", of, count, [0.3 * tip.0, 3.0 * tip.0]);
        }
        None if asked(Nuisance::TipRadius) => {
            unknowns.add("tip_radius", of, count, [0.005 * experiment.depth, 0.5 * experiment.depth]);
        }
        _ => {}
    }
    if let (_, Some(range)) = friction(curve)? {
        unknowns.add("friction", of, count, range);
    }
    Ok(())
}
