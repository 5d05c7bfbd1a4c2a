//! The result of an identification: numbers with their intervals, the stress-strain curve with its band, the
//! verdict, and the files.

use super::fit::Fit;
use super::pictures;
use crate::draw::chart::svg;
use crate::error::{Error, InputError};
use crate::input::toml_file::to_toml;
use crate::results::numbers::decimals;
use crate::results::output::{Sink, SinkExt, json};
use asperity_identification::experiment::Experiment;
use asperity_identification::fit_file::{FitCurve, FitShape};
use asperity_identification::identifiability::{Decided, NullDirection};
use asperity_identification::inference::{Inference, Sampling, infer};
use asperity_identification::levenberg_marquardt::Minimum;
use asperity_identification::next_experiment::NextExperiment;
use asperity_identification::noise::noise_from_scatter;
use asperity_identification::numbers::StressAt;
use asperity_identification::numbers::{Found, Residual};
use asperity_identification::objective::Objective;
use asperity_identification::parameters::Unknowns;
use asperity_identification::pyramid::Pyramid;
use asperity_identification::search::{self, search};
use asperity_simulation::scene::Material;
use indexmap::IndexMap;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::time::Instant;

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Identification {
    /// The unknowns, by their names.
    #[schemars(with = "BTreeMap<String, Found>")]
    pub parameters: IndexMap<String, Found>,
    /// Correlations of the unknowns in their order, by the curvature at the best fit.
    pub correlation: Vec<Vec<f64>>,
    /// In words: what the measurements tell and what they do not.
    pub verdict: String,
    /// The direction in which they see least.
    pub blind_direction: Option<NullDirection>,
    /// The experiment that would narrow the widest interval most; none where everything is told.
    pub next_experiment: Option<NextExperiment>,
    /// Narrowing of the intervals by each of several measurements.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub decided: Vec<Decided>,
    /// The stress-strain curve.
    pub stress_strain: Vec<StressAt>,
    /// The stress that is determined best.
    pub representative: Option<StressAt>,
    /// The residual.
    pub residual: Residual,
    /// Interpretation of each file of a curve: columns, units, rows.
    pub understood: Vec<String>,
    /// Remarks: holds cut, runs that stopped early, noise that was assumed.
    pub notes: Vec<String>,
    /// Runs of finite elements.
    pub runs: usize,
    /// Seconds.
    pub wall_s: f64,
    /// The program.
    pub version: &'static str,
    /// The metal at the best values, as the `[material]` of a scene has it: `asperity crush --metal` takes
    /// it.
    pub material: Material,
    /// Samples of the posterior, in the units of the parameters.
    #[serde(skip)]
    pub samples: Vec<Vec<f64>>,
    #[serde(skip)]
    pub(super) drawn: pictures::Drawn,
    /// The fit as it was asked for, as TOML.
    #[serde(skip)]
    pub(super) asked: String,
}

pub(super) fn identify(
    mut fit: Fit,
    observer: &mut dyn FnMut(f64, &str) -> bool,
) -> Result<Identification, Error> {
    let clock = Instant::now();
    let (accuracy, unknowns) = (fit.accuracy(), fit.unknowns.clone());
    let mut experiments = std::mem::take(&mut fit.experiments);
    let mut found = search(&mut experiments, &unknowns, accuracy, observer)?;
    for _ in 0..3 {
        if !noise_from_scatter(&mut experiments, &unknowns, &found.minimum.point) {
            break;
        }
        found.minimum = search::again(&experiments, &unknowns, &found.minimum.point)?;
    }
    let best = &found.minimum;
    let sampling = Sampling { count: fit.tables().samples, seed: fit.tables().seed };
    let nowhere = || Error::Unfinished("the best fit lies at a metal that cannot be computed".into());
    let inference = infer(&experiments, &unknowns, best, &fit.doubts, sampling).ok_or_else(nowhere)?;
    let objective = Objective::new(&experiments, &unknowns, &best.point).ok_or_else(nowhere)?.for_intervals();
    let best = &Minimum { chi2: inference.residual.chi2, ..best.clone() };
    let drawn = pictures::Drawn::new(&objective, &experiments, &unknowns, best, &inference.intervals);
    let mut notes = std::mem::take(&mut fit.notes);
    notes.extend(found.notes);
    notes.extend(assumed(&fit));
    // about a fit that another measurement contradicts, forces scatter as well
    if inference.residual.accords.iter().all(|accord| accord.holds) {
        notes.extend(experiments.iter().filter_map(note_on_large_noise));
    }
    notes.extend(notes_on_pyramids(&experiments, &unknowns, &best.point));
    let material = unknowns.material(&best.point).ok_or_else(nowhere)?;
    notes.extend(note_on_rigid_tools(&fit, &unknowns, &material));
    notes.dedup();
    let Inference { parameters, correlation, verdict, blind_direction, next_experiment, .. } = inference;
    Ok(Identification {
        parameters,
        correlation,
        verdict,
        blind_direction,
        next_experiment,
        decided: inference.decided,
        stress_strain: inference.stress_strain,
        representative: inference.representative,
        residual: inference.residual,
        understood: std::mem::take(&mut fit.understood),
        notes,
        runs: found.runs,
        wall_s: clock.elapsed().as_secs_f64(),
        version: env!("CARGO_PKG_VERSION"),
        material,
        samples: inference.samples,
        drawn,
        asked: to_toml(fit.tables()).map_err(Error::Unfinished)?,
    })
}

/// The metal of the `fit.json` at `path` as an override of a scene, `material={…}`.
///
/// # Errors
/// A file that cannot be read or holds no metal.
pub fn metal_override(path: &Path) -> Result<String, InputError> {
    let shown = path.display();
    let text = std::fs::read_to_string(path)
        .map_err(|e| InputError::new(format!("{shown}: cannot be read: {e}")))?;
    let fit: Option<serde_json::Value> = serde_json::from_str(&text).ok();
    let metal = fit.and_then(|mut fit| serde_json::from_value::<toml::Table>(fit["material"].take()).ok());
    let metal = metal.ok_or_else(|| {
        InputError::new(format!("{shown} holds no metal")).help(
            "give the fit.json that asperity identify wrote; a [material] of TOML goes into the scene itself",
        )
    })?;
    Ok(format!("material={}", toml::Value::Table(metal)))
}

/// Notes on the cones that stand for pyramids, and on the error of that for the metal at `point`.
fn notes_on_pyramids(experiments: &[Experiment], unknowns: &Unknowns, point: &[f64]) -> Vec<String> {
    let one = |kind: Pyramid| {
        let own: Vec<&Experiment> = experiments.iter().filter(|e| e.pyramid == Some(kind)).collect();
        let names = match own.len() {
            ..=3 => own.iter().map(|e| e.name.as_str()).collect::<Vec<_>>().join(", "),
            many => format!("{many} measurements"),
        };
        Some(kind.note(&names, &own.first()?.design_point(unknowns, point)?))
    };
    [Pyramid::Berkovich, Pyramid::Vickers].into_iter().filter_map(one).collect()
}

/// A note on tools that are taken as rigid where E is sought: what diamond would make of it.
fn note_on_rigid_tools(fit: &Fit, unknowns: &Unknowns, metal: &Material) -> Option<String> {
    /// Young's modulus of diamond over 1 - ν² of it, Pa.
    const DIAMOND: f64 = 1141e9 / (1.0 - 0.07 * 0.07);
    let is_rigid =
        |c: &FitCurve| c.file.is_some() && c.tool.shape != FitShape::Plane && c.tool.youngs_modulus.is_none();
    let is_sought = unknowns.parameters.iter().any(|p| p.name == "youngs_modulus");
    let plane = metal.youngs_modulus.0 / (1.0 - metal.poissons_ratio.powi(2));
    let more = 1.0 / (1.0 - plane / DIAMOND) - 1.0;
    let said = is_sought && fit.tables().curve.iter().any(is_rigid) && more > 0.005;
    said.then(|| {
        format!(
            "the tool is taken as rigid; if it was diamond, youngs_modulus is {:.0} % larger: give youngs_modulus = \"1141 GPa\" and \
             poissons_ratio = 0.07 in `tool`",
            100.0 * more
        )
    })
}

/// Standard deviation of a force above which a noise that nobody stated is doubted: instruments scatter less.
const DOUBTED_NOISE: f64 = 0.05;

/// A note on a curve whose noise, unstated, was taken from a scatter about the fit that no instrument has.
fn note_on_large_noise(experiment: &Experiment) -> Option<String> {
    let is_large = !experiment.noise_given && experiment.noise > DOUBTED_NOISE;
    is_large.then(|| {
        format!(
            "{}: the forces scatter about the fit by {:.0} %, which counts as noise since none is stated; instruments scatter less, so doubt \
             the unit, the tool or the law, or state `noise`",
            experiment.name,
            100.0 * experiment.noise
        )
    })
}

fn assumed(fit: &Fit) -> Option<String> {
    let silent = fit.tables().curve.iter().any(|c| c.features.is_some() && c.noise.is_none());
    silent.then(|| {
        "features without `noise` count as measured to 1 %: state it, for the intervals follow it".into()
    })
}

/// A number with so many digits as its interval deserves.
fn digits(value: f64, low: f64, high: f64) -> usize {
    let width = (high - low).abs().max(1e-3 * value.abs()).max(1e-12);
    decimals(width, 2).min(6)
}

fn quoted(name: &str, f: &Found) -> String {
    let d = digits(f.value, f.low, f.high);
    let unit = if f.unit.is_empty() { String::new() } else { format!(" {}", f.unit) };
    // an interval that the search cut short
    let [low, high] = f.at_bound.map(|is_bound| if is_bound { "the bound " } else { "" });
    format!("{name} {:.d$} ({low}{:.d$} to {high}{:.d$}){unit}", f.value, f.low, f.high)
}

impl Identification {
    /// `fit.json`.
    ///
    /// # Errors
    /// None that is known.
    pub fn to_json(&self) -> Result<String, Error> {
        json(self)
    }

    /// A few lines for a person, the first of which can be quoted.
    pub fn overview(&self) -> String {
        let all: Vec<String> = self.parameters.iter().map(|(name, f)| quoted(name, f)).collect();
        let mut text: String = self.understood.iter().map(|line| format!("read      {line}\n")).collect();
        text += &match self.residual.fits {
            true => format!("found     {} (95 %)\n", all.join(", ")),
            // intervals about a point that does not fit say nothing of the metal
            false => {
                let nearest = self
                    .parameters
                    .iter()
                    .map(|(name, f)| format!("{name} {:.3} {}", f.value, f.unit).trim_end().to_string());
                format!("no fit    nearest: {}\n", nearest.collect::<Vec<_>>().join(", "))
            }
        };
        let _ = writeln!(text, "verdict   {}", self.verdict);
        let _ = write!(
            text,
            "solved    {} runs of finite elements, sum of squares {:.2} with {} degrees of freedom",
            self.runs, self.residual.chi2, self.residual.degrees_of_freedom
        );
        if self.residual.fits {
            text += "\nuse it    asperity crush scene.toml --metal fit.json takes this metal; material.toml is its [material]";
        }
        text
    }

    /// `posterior.csv`.
    pub fn posterior_csv(&self) -> String {
        let unit = |(name, f): (&String, &Found)| {
            let unit = f.unit.replace('/', "_per_");
            if unit.is_empty() { name.clone() } else { format!("{name}_{unit}") }
        };
        let mut text = self.parameters.iter().map(unit).collect::<Vec<_>>().join(",") + "\n";
        for sample in &self.samples {
            text += &(sample.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(",") + "\n");
        }
        text
    }

    /// `material.toml`: the metal as the table of a scene, for `asperity crush`, with what it is worth.
    ///
    /// # Errors
    /// None that is known.
    pub fn material_toml(&self) -> Result<String, Error> {
        let tables = IndexMap::from([("material", &self.material)]);
        let text = to_toml(&tables).map_err(Error::Unfinished)?;
        let worth =
            if self.residual.fits { "best values of" } else { "nearest values, though no metal fits, of" };
        Ok(format!(
            "# {worth} asperity identify; fit.json has their intervals. Paste it into a scene in place of its [material].\n{text}"
        ))
    }

    /// `curve.svg`: measured points, the fit and its residuals.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn curve_svg(&self) -> Result<String, Error> {
        self.drawn.curves().map_err(Error::Unfinished)
    }

    /// `stress_strain.svg`: the stress-strain curve with its band.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn stress_strain_svg(&self) -> Result<String, Error> {
        svg(&pictures::stress_strain(&self.stress_strain, self.residual.fits)).map_err(Error::Unfinished)
    }

    /// `objective.svg`: the map of the sum of squares over two unknowns, the others at their best; none with
    /// one unknown.
    ///
    /// # Errors
    /// A drawing that fails.
    pub fn objective_svg(&self) -> Result<Option<String>, Error> {
        self.drawn.map().map_err(Error::Unfinished)
    }

    /// Writes all files.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.text("fit.json", &self.to_json()?)?;
        sink.text("material.toml", &self.material_toml()?)?;
        if !self.samples.is_empty() {
            sink.text("posterior.csv", &self.posterior_csv())?;
        }
        sink.text("curve.svg", &self.curve_svg()?)?;
        sink.text("stress_strain.svg", &self.stress_strain_svg()?)?;
        if let Some(imprints) = self.drawn.imprints_svg().map_err(Error::Unfinished)? {
            sink.text("imprint.svg", &imprints)?;
        }
        if let Some(map) = self.objective_svg()? {
            sink.text("objective.svg", &map)?;
        }
        Ok(())
    }
}
