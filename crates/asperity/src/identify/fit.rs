//! A fit that makes sense: the unknowns, and the measurements read from their files.

use crate::error::{Error, InputError};
use crate::input::RELATIVE;
use crate::input::toml_file::TomlFile;
use asperity_formats::indentation_table;
use asperity_identification::emulator::Emulator;
use asperity_identification::experiment::{Data, Experiment};
use asperity_identification::fit_file::{
    Features, FitAccuracy, FitCurve, FitFile, FitMaterial, FitShape, FitTool, Nuisance,
};
use asperity_identification::known_or_unknown::Sought;
use asperity_identification::measured_curve::Measured;
use asperity_identification::parameters::Unknowns;
use asperity_identification::response::{AFTER, Geometry};
use asperity_material::units::Stress;
use asperity_material::{Elastic, StressMeasure, range};
use asperity_simulation::scene::{Accuracy, HardeningChoice};
use std::path::Path;

/// A fit ready to be searched.
#[derive(Debug)]
pub struct Fit {
    file: TomlFile<FitFile>,
    pub(super) unknowns: Unknowns,
    pub(super) experiments: Vec<Experiment>,
    /// Remarks on the input.
    pub notes: Vec<String>,
}

/// Standard deviation of a feature that states none, and the first guess of that of a curve.
const NOISE: f64 = 0.01;
/// Standard deviation of the force of a pyramid taken as a cone of the same section.
const PYRAMID: f64 = 0.04;
/// Half apex angle of the cone whose section is that of Berkovich's and of Vickers' pyramid at every depth, degrees.
pub const PYRAMIDS_CONE: f64 = 70.3;
/// Most unknowns of a fit.
const MOST_UNKNOWNS: usize = 12;
/// Most measurements of a fit.
const MOST_CURVES: usize = 50;

impl Fit {
    /// The fit of the file at `path`, with overrides `key.path=value`; files that it names are relative to its folder.
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
        let (mut experiments, mut owners, mut notes) = (Vec::new(), Vec::new(), Vec::new());
        for (i, curve) in tables.curve.iter().enumerate() {
            let at = |key: &str, message: &str| {
                let path = if key.is_empty() { format!("curve[{i}]") } else { format!("curve[{i}].{key}") };
                file.error_at(&path, message)
            };
            let geometry = geometry(curve).map_err(|(key, m)| at(&key, &m))?;
            let read = measurements(&file, i, curve, &mut notes)?;
            for (name, data, depth) in read {
                let experiment = experiment(
                    curve,
                    (experiments.len(), name),
                    geometry.clone(),
                    data,
                    depth,
                    tables.material.stress_measure,
                )
                .map_err(|(key, m)| at(&key, &m))?;
                experiments.push(experiment);
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
        let count = experiments.len();
        for (experiment, i) in experiments.iter().zip(owners) {
            add_nuisances(&mut unknowns, experiment, &tables.curve[i], count)
                .map_err(|(key, m)| file.error_at(&format!("curve[{i}].{key}"), &m))?;
        }
        if unknowns.parameters.len() > MOST_UNKNOWNS {
            let message = format!(
                "{} unknowns are more than {MOST_UNKNOWNS}, the measurements' own among them: give some of them, or fewer measurements",
                unknowns.parameters.len()
            );
            return Err(file.error_at("", &message).into());
        }
        let like = tables.material.hardening_law != HardeningChoice::Table
            && tables.material.stress_measure == StressMeasure::Cauchy;
        for experiment in &mut experiments {
            experiment.emulator = Emulator::of_a_cone(1 + AFTER, like);
        }
        notes.extend(experiments.iter().filter_map(begins_elsewhere));
        Ok(Fit { file, unknowns, experiments, notes })
    }
}

type Fault = (String, String);

fn fault(key: &str, message: impl Into<String>) -> Fault {
    (key.into(), message.into())
}

/// A range or a number within what is allowed.
fn check_number(key: &str, sought: Sought<f64>, [low, high]: [f64; 2], unit: &str) -> Result<(), Fault> {
    let inside = |v: f64| v >= low && v <= high;
    match sought {
        Sought::Known(value) if !inside(value) => {
            Err(fault(key, format!("must be from {low} to {high}{unit}, not {value}")))
        }
        Sought::Range([a, b]) if !(inside(a) && inside(b) && a < b) => Err(fault(
            key,
            format!(
                "a range must rise and lie from {low} to {high}{unit}, not [{a}, {b}]: give [lowest, highest]"
            ),
        )),
        _ => Ok(()),
    }
}

fn check_material(material: &FitMaterial) -> Result<(), Fault> {
    let modulus = material.youngs_modulus.map(|e| e.in_unit("GPa"));
    check_number("youngs_modulus", modulus, range::FITTED_MODULI_GPA, " GPa")?;
    check_number("poissons_ratio", material.poissons_ratio, range::FITTED_POISSONS_RATIOS, "")?;
    if material.hardening_law == HardeningChoice::Table {
        return check_table(material);
    }
    if material.hardening_table.is_some() {
        return Err(fault(
            "hardening_table",
            "needs hardening_law = \"table\" beside it: add that, or remove it",
        ));
    }
    let missing =
        |key: &str| fault("", format!("`{key}` is missing: give a number, or a range [lowest, highest]"));
    let stress = material.yield_stress.ok_or_else(|| missing("yield_stress"))?;
    check_stress("yield_stress", stress)?;
    let exponent = material.hardening_exponent.ok_or_else(|| missing("hardening_exponent"))?;
    check_number("hardening_exponent", exponent, range::VARIED_EXPONENTS, "")
}

fn check_stress(key: &str, sought: Sought<Stress>) -> Result<(), Fault> {
    check_number(key, sought.map(|s| s.in_unit("MPa")), range::FITTED_YIELD_STRESSES_MPA, " MPa")
}

fn check_table(material: &FitMaterial) -> Result<(), Fault> {
    for (key, given) in [
        ("yield_stress", material.yield_stress.is_some()),
        ("hardening_exponent", material.hardening_exponent.is_some()),
    ] {
        if given {
            return Err(fault(key, "does not go with hardening_law = \"table\": remove it"));
        }
    }
    let table = material.hardening_table.as_deref().unwrap_or_default();
    if !(1..=8).contains(&table.len()) || table[0].0 != 0.0 {
        return Err(fault(
            "hardening_law",
            "\"table\" needs hardening_table with 1 to 8 points from plastic strain 0 on, like [[0, [\"50 MPa\", \"1 GPa\"]], [0.1, [\"50 MPa\", \"2 GPa\"]]]",
        ));
    }
    if table.windows(2).any(|w| w[0].0.is_nan() || w[1].0.is_nan() || w[0].0 >= w[1].0) {
        return Err(fault("hardening_table", "plastic strains must rise from point to point"));
    }
    for (i, (_, sought)) in table.iter().enumerate() {
        check_stress(&format!("hardening_table[{i}]"), *sought)?;
    }
    Ok(())
}

/// The data of measurement `i`, one or several tests, each with its name and deepest depth.
fn measurements(
    file: &TomlFile<FitFile>,
    i: usize,
    curve: &FitCurve,
    notes: &mut Vec<String>,
) -> Result<Vec<(String, Data, f64)>, InputError> {
    let at = |key: &str, message: &str| file.error_at(&format!("curve[{i}]{key}"), message);
    let name = format!("curve {}", i + 1);
    match (&curve.file, &curve.features) {
        (Some(_), Some(_)) => Err(at(".features", "does not go with `file`: remove one of the two")),
        (None, None) => Err(at(
            "",
            "holds nothing measured: give file = \"curve.csv\" or features = { loading_curvature = \"27 GPa\" }",
        )),
        (None, Some(f)) => {
            let positive = [
                ("loading_curvature", f.loading_curvature.map(|v| v.0)),
                ("unloading_slope", f.unloading_slope.map(|v| v.0)),
                ("plastic_work_ratio", f.plastic_work_ratio),
                ("max_depth", f.max_depth.map(|v| v.0)),
            ];
            for (key, value) in positive {
                let most = if key == "plastic_work_ratio" { 1.0 } else { f64::INFINITY };
                if let Some(v) = value.filter(|v| !(*v > 0.0 && *v < most)) {
                    let message = format!("must be above 0 (a work ratio also below 1), not {v} in SI units");
                    return Err(at(&format!(".features.{key}"), &message));
                }
            }
            if positive[..3].iter().all(|(_, value)| value.is_none()) {
                return Err(at(
                    ".features",
                    "holds no number of a curve: give loading_curvature, unloading_slope or plastic_work_ratio",
                ));
            }
            let data = Data::Features {
                loading_curvature: positive[0].1,
                unloading_slope: positive[1].1,
                plastic_work_ratio: positive[2].1,
            };
            Ok(vec![(name, data, f.max_depth.map_or(1.0, |d| d.0))])
        }
        (Some(path), None) => {
            let path = file.resolve(path);
            let shown = path.display().to_string();
            let text = std::fs::read_to_string(&path)
                .map_err(|e| at(".file", &format!("{shown}: cannot be read as text: {e}; {RELATIVE}")))?;
            let tests = indentation_table::read(&text).map_err(|fault| {
                let error = match fault.line {
                    Some(line) => {
                        let start = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
                        InputError::new(fault.message).at(&shown, &text, start..text.len())
                    }
                    None => at(".file", &format!("{shown} {}", fault.message)),
                };
                if Features::are_named_in(&text) { error.help(Features::PLACE) } else { error }
            })?;
            chosen(tests.tests, curve.test)
                .map_err(|m| at(".test", &m))?
                .into_iter()
                .map(|(label, readings, many)| {
                    let name = if many { format!("{name}: test {label}") } else { name.clone() };
                    let measured = Measured::new(&readings)
                        .map_err(|m| at(".file", &format!("{shown}, test {label} {m}")))?;
                    notes.extend(measured.notes.iter().map(|note| format!("{name}: {note}")));
                    let depth = measured.peak[0];
                    Ok((name, Data::Curve(measured), depth))
                })
                .collect()
        }
    }
}

type Chosen = Vec<(String, asperity_formats::indentation_table::Readings, bool)>;

fn chosen(
    tests: Vec<(String, asperity_formats::indentation_table::Readings)>,
    wanted: Option<usize>,
) -> Result<Chosen, String> {
    let count = tests.len();
    match wanted {
        None => Ok(tests.into_iter().map(|(label, readings)| (label, readings, count > 1)).collect()),
        Some(k) if (1..=count).contains(&k) => Ok(tests
            .into_iter()
            .skip(k - 1)
            .take(1)
            .map(|(label, readings)| (label, readings, false))
            .collect()),
        Some(k) => Err(format!(
            "there is no test {k} in the file, which has {count}: give a number from 1 to {count}"
        )),
    }
}

fn slope_deg(tool: &FitTool) -> Result<f64, Fault> {
    match (tool.slope_deg, tool.half_apex_deg) {
        (Some(_), Some(_)) => {
            Err(fault("tool.half_apex_deg", "does not go with slope_deg: remove one of the two"))
        }
        (None, None) => Err(fault(
            "tool",
            "`half_apex_deg` of the cone is missing: give half_apex_deg = 70.3, or slope_deg = 19.7",
        )),
        (Some(slope), None) | (None, Some(slope)) if !(slope > 0.0 && slope < 90.0) => {
            Err(fault("tool", format!("the angle must be above 0 and below 90 degrees, not {slope}")))
        }
        (Some(slope), None) => Ok(slope),
        (None, Some(half)) => Ok(90.0 - half),
    }
}

/// Slopes of cones that finite elements go through with, degrees.
const SLOPES: [f64; 2] = [1.0, 50.0];

fn geometry(curve: &FitCurve) -> Result<Geometry, Fault> {
    let tool = &curve.tool;
    let pyramid = matches!(tool.shape, FitShape::Berkovich | FitShape::Vickers);
    let cone = matches!(tool.shape, FitShape::Cone | FitShape::Conospherical);
    for (key, given, allowed) in [
        ("slope_deg", tool.slope_deg.is_some(), cone),
        ("half_apex_deg", tool.half_apex_deg.is_some(), cone),
        ("tip_radius", tool.tip_radius.is_some(), cone || pyramid),
        ("radius", tool.radius.is_some(), tool.shape == FitShape::Sphere),
    ] {
        if given && !allowed {
            return Err(fault(&format!("tool.{key}"), "does not belong to a tool of this shape: remove it"));
        }
    }
    if tool.shape != FitShape::Plane && curve.asperity.is_some() {
        return Err(fault(
            "asperity",
            "is crushed by a plane: give tool = { shape = \"plane\" }, or remove it",
        ));
    }
    let blunt = match tool.tip_radius {
        Some(Sought::Known(tip)) => tip.0 > 0.0,
        Some(Sought::Range(_)) => true,
        None => curve.unknown.contains(&Nuisance::TipRadius),
    };
    let cone_of = |slope_deg: f64| {
        if !(SLOPES[0]..=SLOPES[1]).contains(&slope_deg) {
            return Err(fault(
                "tool",
                format!(
                    "a cone must have a half apex angle from {} to {} degrees, not {}",
                    90.0 - SLOPES[1],
                    90.0 - SLOPES[0],
                    90.0 - slope_deg
                ),
            ));
        }
        Ok(if blunt { Geometry::Rounded { slope_deg } } else { Geometry::Sharp { slope_deg } })
    };
    match tool.shape {
        FitShape::Plane => {
            let asperity = curve
                .asperity
                .clone()
                .ok_or_else(|| fault("", "`asperity` is missing: a plane crushes one"))?;
            asperity.form().map_err(|e| fault(&format!("asperity.{}", e.path), e.message))?;
            Ok(Geometry::Crush { asperity })
        }
        FitShape::Sphere => {
            let radius = tool
                .radius
                .ok_or_else(|| fault("tool", "`radius` of the sphere is missing: give radius = \"1 mm\""))?;
            if !(radius.0 > 0.0 && radius.0.is_finite()) {
                return Err(fault("tool.radius", "must be finite and above 0"));
            }
            Ok(Geometry::Ball { radius: radius.0 })
        }
        FitShape::Berkovich | FitShape::Vickers => cone_of(90.0 - PYRAMIDS_CONE),
        FitShape::Cone | FitShape::Conospherical => cone_of(slope_deg(tool)?),
    }
}

fn experiment(
    curve: &FitCurve,
    (number, name): (usize, String),
    geometry: Geometry,
    data: Data,
    depth: f64,
    stress_measure: StressMeasure,
) -> Result<Experiment, Fault> {
    for (key, share) in [("noise", curve.noise), ("model_error", curve.model_error)] {
        if let Some(share) = share.filter(|s| !(0.0..=0.5).contains(&s.0)) {
            return Err(fault(key, format!("must be from 0 % to 50 %, not {} %", 100.0 * share.0)));
        }
    }
    let pyramid = matches!(curve.tool.shape, FitShape::Berkovich | FitShape::Vickers);
    let tool = match (curve.tool.youngs_modulus, curve.tool.poissons_ratio) {
        (None, None) => None,
        (Some(modulus), ratio) if modulus.0 > 0.0 => {
            Some(Elastic { youngs_modulus: modulus.0, poissons_ratio: ratio.unwrap_or(0.3) })
        }
        _ => {
            return Err(fault(
                "tool",
                "an elastic tool needs youngs_modulus above 0: give it, or leave out poissons_ratio",
            ));
        }
    };
    let needs_depth = !matches!(geometry, Geometry::Sharp { .. });
    if needs_depth && matches!(data, Data::Features { .. }) && depth == 1.0 {
        return Err(fault("features", "`max_depth` is missing: only features of a sharp cone do without"));
    }
    let known = |sought: Option<Sought<f64>>| match sought {
        Some(Sought::Known(value)) => value,
        _ => 0.0,
    };
    Ok(Experiment {
        label: curve.label(&name),
        name,
        curve: number,
        geometry,
        tool,
        tip_radius: known(curve.tool.tip_radius.map(|t| t.map(|l| l.0))),
        compliance: known(curve.tool.machine_compliance.map(|c| c.map(|v| v.0))),
        depth,
        stress_measure,
        noise: curve.noise.map_or(NOISE, |n| n.0).max(1e-4),
        noise_given: curve.noise.is_some() || matches!(data, Data::Features { .. }),
        data,
        model_error: curve.model_error.map_or(if pyramid { PYRAMID } else { 0.0 }, |m| m.0),
        errors: [0.01, 0.02, 0.02],
        emulator: Emulator::of_a_cone(1 + AFTER, true),
    })
}

/// Adds the unknowns of a measurement with their bounds.
fn add_nuisances(
    unknowns: &mut Unknowns,
    experiment: &Experiment,
    curve: &FitCurve,
    count: usize,
) -> Result<(), Fault> {
    let of = experiment.curve;
    let asked = |nuisance| curve.unknown.contains(&nuisance);
    if asked(Nuisance::ContactDepth) {
        let Data::Curve(measured) = &experiment.data else {
            return Err(fault("unknown", "contact_depth needs a curve in a file: features have none"));
        };
        let room = 0.08 * experiment.depth;
        let middle = measured.touches.clamp(-2.0 * room, 2.0 * room);
        unknowns.add("contact_depth", of, count, [middle - room, middle + room]);
    }
    match curve.tool.machine_compliance {
        Some(Sought::Range(ends)) => unknowns.add("machine_compliance", of, count, ends.map(|c| c.0)),
        _ if asked(Nuisance::MachineCompliance) => {
            let peak =
                experiment.peak().ok_or_else(|| fault("unknown", "machine_compliance needs a loading"))?;
            unknowns.add("machine_compliance", of, count, [0.0, 0.1 * peak[0] / peak[1]]);
        }
        _ => {}
    }
    match curve.tool.tip_radius {
        Some(Sought::Range(ends)) => unknowns.add("tip_radius", of, count, ends.map(|l| l.0)),
        Some(Sought::Known(tip)) if asked(Nuisance::TipRadius) => {
            unknowns.add("tip_radius", of, count, [0.3 * tip.0, 3.0 * tip.0]);
        }
        None if asked(Nuisance::TipRadius) => {
            unknowns.add("tip_radius", of, count, [0.005 * experiment.depth, 0.5 * experiment.depth]);
        }
        _ => {}
    }
    Ok(())
}

/// A remark on a curve of a sharp tool that does not begin where the file says.
fn begins_elsewhere(experiment: &Experiment) -> Option<String> {
    let Data::Curve(measured) = &experiment.data else { return None };
    let sharp = matches!(experiment.geometry, Geometry::Sharp { .. });
    (sharp && measured.touches.abs() > 0.03 * experiment.depth).then(|| {
        format!(
            "{}: √F points to first touch at {:.4} um, not at 0: a rounded tip or an offset; add unknown = [\"contact_depth\"] or a tip_radius",
            experiment.name,
            1e6 * measured.touches
        )
    })
}
