//! The result of an identification: numbers with their intervals, the stress-strain curve with its band, the
//! verdict, and the files.

use super::fit::Fit;
use super::noise::noise_from_scatter;
use super::pictures;
use crate::draw::chart::svg;
use crate::error::Error;
use crate::input::toml_file::to_toml;
use crate::results::numbers::decimals;
use crate::results::output::{Sink, SinkExt, json};
use asperity_identification::experiment::{Data, Experiment};
use asperity_identification::identifiability::{
    NextExperiment, NullDirection, deviations, identified, next_experiment, null_direction,
};
use asperity_identification::levenberg_marquardt::{Minimum, Residuals};
use asperity_identification::objective::Objective;
use asperity_identification::parameters::{Parameter, Slot, Unknowns};
use asperity_identification::posterior;
use asperity_identification::profile_likelihood::{self, Interval};
use asperity_identification::search::{self, search};
use asperity_identification::stress_strain::StressAt;
use asperity_simulation::scene::Material;
use indexmap::IndexMap;
use nalgebra::DVector;
use rayon::prelude::*;
use serde::Serialize;
use std::fmt::Write;
use std::time::Instant;

/// A number that was sought, with its 95 % interval.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Found {
    /// The best value.
    pub value: f64,
    /// Lower end of the interval.
    pub low: f64,
    /// Upper end of the interval.
    pub high: f64,
    /// Unit of the three.
    pub unit: &'static str,
    /// True where the measurements tell it: an interval within ±15 % (±0.05 of n) that no bound cuts, neither
    /// its own nor that of an unknown it is tied to.
    pub identifiable: bool,
    /// True where the lower and the upper end are the bounds of the search.
    pub at_bound: [bool; 2],
}

/// Residual of the fit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Residual {
    /// Sum of squares in standard deviations.
    pub chi2: f64,
    /// True where that is no more than chance allows.
    pub fits: bool,
    /// Measured numbers less unknowns.
    pub degrees_of_freedom: i64,
    /// Of each measurement: name, root mean square of the relative differences of its forces (features),
    /// noise used.
    pub curves: Vec<CurveResidual>,
}

/// Residual of one measurement.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CurveResidual {
    /// Its name.
    pub name: String,
    /// Root mean square of the relative differences of forces, of features.
    pub rms: f64,
    /// Standard deviation that was given or taken from the scatter.
    pub noise: f64,
}

/// The result.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Identification {
    /// The unknowns, by their names.
    pub parameters: IndexMap<String, Found>,
    /// Correlations of the unknowns in their order, by the curvature at the best fit.
    pub correlation: Vec<Vec<f64>>,
    /// In words: what the measurements tell and what they do not.
    pub verdict: String,
    /// The direction in which they see least.
    pub blind_direction: Option<NullDirection>,
    /// The sharp cone that would narrow the widest interval most; none where everything is told.
    pub next_experiment: Option<NextExperiment>,
    /// The stress-strain curve.
    pub stress_strain: Vec<StressAt>,
    /// The stress that is told best.
    pub representative: Option<StressAt>,
    /// The residual.
    pub residual: Residual,
    /// What was understood of each file of a curve: columns, units, rows.
    pub understood: Vec<String>,
    /// Remarks: holds cut, runs that stopped early, noise that was assumed.
    pub notes: Vec<String>,
    /// Runs of finite elements.
    pub runs: usize,
    /// Seconds.
    pub wall_s: f64,
    /// The program.
    pub version: &'static str,
    /// The metal at the best values, as the `[material]` of a scene has it.
    #[serde(skip)]
    pub material: Material,
    /// Samples of the posterior, in the units of the parameters.
    #[serde(skip)]
    pub samples: Vec<Vec<f64>>,
    #[serde(skip)]
    pub(super) drawn: pictures::Drawn,
}

/// Plastic strains of the stress-strain curve.
const STRAINS: [f64; 13] = [0.0, 0.002, 0.005, 0.01, 0.02, 0.033, 0.05, 0.066, 0.1, 0.15, 0.2, 0.25, 0.3];

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
    let mut result = describe(&fit, &experiments, &unknowns, &found.minimum)
        .ok_or_else(|| Error::Unfinished("the best fit lies at a metal that cannot be computed".into()))?;
    result.understood = std::mem::take(&mut fit.understood);
    let mut notes = std::mem::take(&mut fit.notes);
    notes.extend(found.notes);
    notes.extend(assumed(&fit));
    notes.dedup();
    result.notes = notes;
    result.runs = found.runs;
    result.wall_s = clock.elapsed().as_secs_f64();
    Ok(result)
}

fn assumed(fit: &Fit) -> Option<String> {
    let silent = fit.tables().curve.iter().any(|c| c.features.is_some() && c.noise.is_none());
    silent.then(|| {
        "features without `noise` count as measured to 1 %: state it, for the intervals follow it".into()
    })
}

fn describe(
    fit: &Fit,
    experiments: &[Experiment],
    unknowns: &Unknowns,
    best: &Minimum,
) -> Option<Identification> {
    let objective = Objective::new(experiments, unknowns, &best.point)?;
    let function = objective.function();
    let bounds = objective.bounds();
    let (deviations, correlation) = deviations(&objective, unknowns, &best.point);
    let others = search::secondary_minima(&objective, unknowns, best.chi2 + profile_likelihood::GROWTH);
    let intervals: Vec<Interval> = (0..bounds.len())
        .into_par_iter()
        .map(|i| profile_likelihood::of_coordinate(&function, best, &others, &bounds, i, deviations[i]))
        .collect();
    let residual = residual(experiments, unknowns, best)?;
    let identified = identified(&unknowns.parameters, &intervals, &correlation);
    let parameters: IndexMap<String, Found> = unknowns
        .parameters
        .iter()
        .zip(&intervals)
        .zip(&best.point)
        .zip(&identified)
        .map(|(((p, i), x), told)| (p.name.clone(), found(p, i, *x, residual.fits && *told)))
        .collect();
    let stress_strain = band(&function, unknowns, best, &bounds, &correlation, &deviations);
    let null = null_direction(&objective, unknowns, &best.point);
    let widest = widest(unknowns, &intervals, &identified);
    let next = widest.and_then(|of| next_experiment(&objective, experiments, unknowns, &best.point, of));
    let width = |s: &StressAt| (s.high_MPa / s.low_MPa).ln();
    let representative = stress_strain.iter().copied().min_by(|a, b| width(a).total_cmp(&width(b)));
    let samples =
        posterior::samples(&function, best, &deviations, &bounds, fit.tables().samples, fit.tables().seed);
    let shown = |point: &Vec<f64>| point.iter().zip(&unknowns.parameters).map(|(x, p)| p.shown(*x)).collect();
    let drawn = pictures::Drawn::new(&objective, experiments, unknowns, best, &intervals);
    Some(Identification {
        verdict: words(&parameters, representative.as_ref(), null.as_ref(), next.as_ref(), &residual),
        parameters,
        correlation,
        blind_direction: null,
        next_experiment: next,
        stress_strain,
        representative,
        residual,
        understood: Vec::new(),
        notes: Vec::new(),
        runs: 0,
        wall_s: 0.0,
        version: env!("CARGO_PKG_VERSION"),
        material: unknowns.material(&best.point)?,
        samples: samples.iter().map(shown).collect(),
        drawn,
    })
}

fn found(parameter: &Parameter, interval: &Interval, best: f64, identifiable: bool) -> Found {
    Found {
        value: parameter.shown(best),
        low: parameter.shown(interval.ends[0].min(best)),
        high: parameter.shown(interval.ends[1].max(best)),
        unit: parameter.unit,
        identifiable,
        at_bound: interval.bounded,
    }
}

/// The unknown of the metal with the widest interval among those that are not told.
fn widest(unknowns: &Unknowns, intervals: &[Interval], identified: &[bool]) -> Option<usize> {
    let size = |i: &usize| {
        let half = 0.5 * (intervals[*i].ends[1] - intervals[*i].ends[0]);
        let scale = if unknowns.parameters[*i].slot == Slot::HardeningExponent { 3.0 } else { 1.0 };
        half * scale
    };
    (0..unknowns.of_the_metal()).filter(|&i| !identified[i]).max_by(|a, b| size(a).total_cmp(&size(b)))
}

/// The stress-strain curve with its band.
fn band(
    function: &Residuals<'_>,
    unknowns: &Unknowns,
    best: &Minimum,
    bounds: &[[f64; 2]],
    correlation: &[Vec<f64>],
    deviations: &[f64],
) -> Vec<StressAt> {
    let at = |strain: &f64| {
        let number = |point: &[f64]| Some(unknowns.metal(point)?.stress_at(*strain).ln());
        let here = number(&best.point)?;
        let gradient = DVector::from_fn(bounds.len(), |i, _| {
            let mut moved = best.point.clone();
            let step = 1e-4 * (bounds[i][1] - bounds[i][0]);
            moved[i] += if moved[i] + step > bounds[i][1] { -step } else { step };
            number(&moved).map_or(0.0, |y| (y - here) / (moved[i] - best.point[i]))
        });
        let count = bounds.len();
        let variance: f64 = (0..count * count)
            .map(|k| (k / count, k % count))
            .map(|(i, j)| gradient[i] * gradient[j] * deviations[i] * deviations[j] * correlation[i][j])
            .sum();
        let interval =
            profile_likelihood::of_number(function, best, bounds, &number, variance.max(1e-8).sqrt())?;
        let [low_mpa, high_mpa] = interval.ends.map(|x| 1e-6 * x.exp());
        Some(StressAt {
            plastic_strain: *strain,
            value_MPa: 1e-6 * here.exp(),
            low_MPa: low_mpa,
            high_MPa: high_mpa,
        })
    };
    STRAINS.par_iter().filter_map(at).collect()
}

fn residual(experiments: &[Experiment], unknowns: &Unknowns, best: &Minimum) -> Option<Residual> {
    let mut count = 0;
    let curves = experiments.iter().map(|e| {
        let differences = e.differences(unknowns, &best.point, false)?;
        count += differences.len() as i64;
        let loading = match &e.data {
            Data::Curve(measured) => measured.loading.len(),
            Data::Features { .. } => differences.len(),
        };
        let square = differences[..loading].iter().map(|d| d * d).sum::<f64>() / loading.max(1) as f64;
        Some(CurveResidual { name: e.name.clone(), rms: square.sqrt(), noise: e.noise })
    });
    let curves = curves.collect::<Option<_>>()?;
    let degrees_of_freedom = count - unknowns.parameters.len() as i64;
    Some(Residual { chi2: best.chi2, fits: fits(best.chi2, degrees_of_freedom), degrees_of_freedom, curves })
}

/// True where a sum of squares lies within three standard deviations of what is expected of so many degrees
/// of freedom; that of none has to be small.
fn fits(chi2: f64, freedom: i64) -> bool {
    let free = freedom.max(0) as f64;
    chi2 <= free + 3.0 * (2.0 * free).sqrt() + 4.0
}

/// A number with so many digits as its interval deserves.
fn digits(value: f64, low: f64, high: f64) -> usize {
    let width = (high - low).abs().max(1e-3 * value.abs()).max(1e-12);
    decimals(width, 2).min(6)
}

fn quoted(name: &str, f: &Found) -> String {
    let d = digits(f.value, f.low, f.high);
    let unit = if f.unit.is_empty() { String::new() } else { format!(" {}", f.unit) };
    format!("{name} {:.d$} ({:.d$} to {:.d$}){unit}", f.value, f.low, f.high)
}

fn words(
    parameters: &IndexMap<String, Found>,
    representative: Option<&StressAt>,
    null: Option<&NullDirection>,
    next: Option<&NextExperiment>,
    residual: &Residual,
) -> String {
    let list = |told: bool| -> Vec<&str> {
        parameters.iter().filter(|(_, f)| f.identifiable == told).map(|(name, _)| name.as_str()).collect()
    };
    if !residual.fits {
        return format!(
            "not identifiable: no metal within the bounds fits the measurements within their errors, so the model is rejected (χ² {:.1}, {} degrees of freedom); look for a wrong unit, tool, law, bound or noise",
            residual.chi2, residual.degrees_of_freedom
        );
    }
    let (told, unidentified) = (list(true), list(false));
    let mut text = match (&told[..], &unidentified[..]) {
        (_, []) => "identifiable: the measurements determine all that is sought".to_string(),
        ([], _) => format!("not identifiable: the measurements do not determine {}", unidentified.join(", ")),
        _ => format!(
            "partly identifiable: the measurements determine {}, but not {}",
            told.join(", "),
            unidentified.join(", ")
        ),
    };
    if let (false, Some(null)) = (unidentified.is_empty(), null) {
        let _ = write!(text, "; they are least sensitive to {}", null.text);
    }
    if let (false, Some(s)) = (unidentified.is_empty(), representative) {
        let _ = write!(
            text,
            "; what they determine best is the stress at a plastic strain of {}: {:.0} ({:.0} to {:.0}) MPa",
            s.plastic_strain, s.value_MPa, s.low_MPa, s.high_MPa
        );
    }
    if let Some(next) = next {
        let _ = write!(
            text,
            "; a sharp cone of {:.0} degrees half apex angle beside these would narrow the interval of {} to {:.0} % of its width",
            next.half_apex_deg,
            next.parameter,
            100.0 * next.interval_ratio
        );
    }
    text
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
            text += "\nhand on   material.toml is the [material] of a scene for asperity crush";
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

    /// `curve.svg`: measured points, the fit, and what is left.
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
        svg(&pictures::stress_strain(&self.stress_strain)).map_err(Error::Unfinished)
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
        if let Some(map) = self.objective_svg()? {
            sink.text("objective.svg", &map)?;
        }
        Ok(())
    }
}
