//! A sweep with its fit: the files that it leaves, and the text for a person.

use super::fit::{AngleFit, Fit};
use super::pictures;
use crate::calibrate::run_sweep::{Options, solve};
use crate::draw::chart::{Chart, svg};
use crate::error::{Error, InputError};
use crate::progress::Observer;
use crate::results::output::{Sink, SinkExt};
use asperity_calibration::dimensionless::Dimensionless;
use asperity_calibration::fit::{
    DEVELOPED_PLASTICITY, Data, StrainCoefficient, angles, developed, model_choices, obstacle,
    strain_coefficient,
};
use asperity_calibration::row::{CaseRow, Row};
use asperity_calibration::sweep::Sweep;
use asperity_calibration::unloading;
use asperity_roughness::{self as roughness, Coefficient};
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Instant;

/// Points of the table of `coefficient.toml` for each slope.
const TABLE: usize = 12;

/// A sweep, its rows and the fit to them.
#[derive(Debug)]
pub struct Calibration {
    /// One row a case, in the order of the grid: `cases.csv`.
    pub cases: Vec<CaseRow>,
    /// The content of `fit.json`.
    pub fit: Fit,
    /// The content of `coefficient.toml`; none where nothing was fitted.
    pub coefficient: Option<Coefficient>,
    /// The content of `sweep.json`.
    pub sweep: Sweep,
    /// True where all cases of the sweep are there: of a part, or of a run that was stopped, only rows and
    /// sweep are written.
    pub whole: bool,
    /// True where the observer ended the run.
    pub stopped: bool,
    /// Seconds it took.
    pub wall_s: f64,
    /// Usable rows by slope.
    data: Data,
    /// Slope that collapse.svg shows, degrees.
    shown: Option<f64>,
    journal: Option<PathBuf>,
}

/// Crushes the cones of `sweep` and fits them.
///
/// `observer` is told of every case, from the thread that solved it; `false` ends the run, which keeps the
/// rows it has.
///
/// # Errors
/// Values of the sweep that make no sense; a journal that cannot be written (it keeps every finished case).
pub fn calibrate(
    sweep: &Sweep,
    options: &Options,
    observer: &mut Observer<'_, CaseRow>,
) -> Result<Calibration, Error> {
    let start = Instant::now();
    sweep.validate().map_err(|e| InputError::new(e.to_string()))?;
    let solved = solve(sweep, options, observer)?;
    let wall_s = start.elapsed().as_secs_f64();
    let calibration = Calibration::fit(sweep, solved.rows, wall_s, options.shown_slope_deg);
    Ok(Calibration {
        whole: options.part.is_none() && !solved.stopped,
        stopped: solved.stopped,
        journal: options.journal.clone(),
        ..calibration
    })
}

impl Calibration {
    /// Fits `rows`.
    pub(super) fn fit(sweep: &Sweep, rows: Vec<Row>, wall_s: f64, shown: Option<f64>) -> Calibration {
        let data = Data::new(&rows);
        let obstacle = obstacle(&data);
        let angles = if obstacle.is_none() { angles(&data) } else { Vec::new() };
        let all = strain_coefficient(&angles);
        let choices = if all.is_some() { model_choices(&data) } else { Vec::new() };
        let developed = all.and_then(|a| {
            strain_coefficient(&self::angles(&self::developed(&data, a.c, DEVELOPED_PLASTICITY)))
        });
        let function = all.and_then(|a| Dimensionless::fit(&data, a.c));
        let unloaded = match (&function, all) {
            (Some(_), Some(a)) => unloading::unload(sweep, a.c),
            _ => Vec::new(),
        };
        let flat = "not determined: the scatter is flat in the representative strain at every slope; give more moduli, yield stresses and exponents";
        let reason = obstacle.or_else(|| all.is_none().then(|| flat.into()));
        let function = function.as_ref();
        let fit = Fit::new(sweep, &rows, &angles, all, &choices, developed, function, &unloaded, reason);
        let coefficient = all.zip(function).and_then(|(a, f)| coefficient(sweep, &fit, a, f));
        let cases = rows.iter().map(CaseRow::from).collect();
        let sweep = sweep.clone();
        let (whole, stopped, journal) = (true, false, None);
        Calibration { cases, fit, coefficient, sweep, whole, stopped, wall_s, data, shown, journal }
    }

    /// Removes the journal, which is of no use once the results are in their place.
    pub fn remove_journal(&self) {
        if let Some(path) = &self.journal {
            let _ = std::fs::remove_file(path);
        }
    }

    /// Writes everything; of a part only its rows and the sweep.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.csv("cases.csv", &self.cases)?;
        sink.text("sweep.json", &crate::results::output::json(&self.sweep)?)?;
        if !self.whole {
            return Ok(());
        }
        sink.text("fit.json", &self.json()?)?;
        if let Some(coefficient) = &self.coefficient {
            let text = coefficient.to_toml().map_err(|e| Error::Unfinished(e.to_string()))?;
            sink.text("coefficient.toml", &text)?;
        }
        for (name, chart, _) in self.charts() {
            sink.text(name, &svg(&chart).map_err(Error::Unfinished)?)?;
        }
        Ok(())
    }

    /// File names, charts and what they show; none where nothing was fitted.
    pub(super) fn charts(&self) -> Vec<(&'static str, Chart, &'static str)> {
        pictures::all(&self.data, &self.fit, self.shown)
    }

    /// The text of fit.json.
    ///
    /// # Errors
    /// None that is known: every fit is JSON.
    pub fn json(&self) -> Result<String, Error> {
        Ok(crate::results::output::sorted_json(&self.fit)? + "\n")
    }

    /// The result for a person.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let (fit, count) = (&self.fit, self.cases.len().max(1) as f64);
        let seconds: f64 = self.cases.iter().map(|r| r.wall_s).sum();
        let iterations: usize = self.cases.iter().filter_map(|r| r.newton_iterations).sum();
        let _ = writeln!(
            text,
            "cases     {} ({} failed) in {:.1} s; {:.3} s and {:.0} iterations a case, {:.2} ms an iteration",
            fit.cases,
            fit.failed,
            self.wall_s,
            seconds / count,
            iterations as f64 / count,
            1e3 * seconds / iterations.max(1) as f64
        );
        let _ = writeln!(text, "K         error at most {:.2} %", 100.0 * self.worst());
        for row in self.cases.iter().filter(|r| r.K_over_E.is_none()).take(5) {
            let _ = writeln!(text, "failed    {}", row.line());
        }
        if self.whole {
            text += &fit_text(fit);
        }
        text.trim_end().into()
    }
}

fn fit_text(fit: &Fit) -> String {
    let mut text = String::new();
    if !fit.per_angle.is_empty() {
        text += "slope     eps_r     95 % interval       eps_r/tan   by correlation  scatter  cases\n";
    }
    for a in &fit.per_angle {
        let AngleFit { beta_deg, representative_strain, low, high, cases, .. } = a;
        let tan = beta_deg.to_radians().tan();
        let number = |v: Option<f64>| v.map_or("  none ".into(), |v| format!("{v:.5}"));
        let _ = writeln!(
            text,
            "{beta_deg:>5}     {}   {low:.5} … {high:.5}   {}     {}         {:.2} %   {cases}{}",
            number(*representative_strain),
            number(representative_strain.map(|s| s / tan)),
            number(a.correlation_strain.map(|s| s / tan)),
            100.0 * a.scatter,
            if a.determined { "" } else { "  not determined" }
        );
    }
    let within = |[low, high]: [f64; 2]| format!("[{low:.4}, {high:.4}]");
    let _ = match (fit.coefficient_least_squares, fit.coefficient_mean_ratio, fit.ci95, fit.model_interval) {
        (Some(c), Some(mean), Some(ci95), Some(model)) => {
            let slopes = fit.per_angle.iter().filter(|a| a.determined).count();
            let (law, published) = (fit.law.name(), fit.published);
            let [arithmetic, model] = [ci95, model].map(within);
            let _ = writeln!(
                text,
                "c         {c:.4} by least squares through the origin, {mean:.4} as mean of eps_r/tan ({law}, {slopes} slopes; published {published})"
            );
            let _ = writeln!(
                text,
                "          {arithmetic} arithmetic: 95 %, other cases drawn, K shifted by its error"
            );
            writeln!(
                text,
                "          {model} model: over parts of these metals and slopes; the law is {law} in all of them"
            )
        }
        _ => writeln!(text, "c         {}", fit.reason.as_deref().unwrap_or_default()),
    };
    if let Some(d) = &fit.developed {
        let said = format!("{:.4} {} from {} slopes", d.coefficient, within(d.ci95), d.slopes);
        let _ = writeln!(text, "          {said} where E* tan(beta)/sigma_r >= {DEVELOPED_PLASTICITY}");
    }
    if let Some(f) = &fit.dimensionless_function {
        let [force, largest] = [f.force.rms, f.force.largest].map(|e| 100.0 * e);
        let [ratio, worst] = [f.contact_ratio.rms, f.contact_ratio.largest].map(|e| 100.0 * e);
        let _ = writeln!(
            text,
            "function  K/sigma_r to {force:.1} % (largest {largest:.1} %), contact ratio to {ratio:.1} % ({worst:.1} %)"
        );
    }
    if let Some(m) = fit.unloading_exponent {
        let exponents = || fit.unloaded.iter().map(|u| u.exponent);
        let (low, high) = (exponents().fold(f64::MAX, f64::min), exponents().fold(f64::MIN, f64::max));
        let count = fit.unloaded.len();
        let _ = writeln!(text, "unloading exponent {m:.3} ({low:.3} to {high:.3}, {count} cones)");
    }
    text
}

/// The table that `rough` reads.
fn coefficient(
    sweep: &Sweep,
    fit: &Fit,
    all: StrainCoefficient,
    function: &Dimensionless,
) -> Option<Coefficient> {
    let mut stiffness = [f64::INFINITY, 0.0_f64];
    let rows = function.ranges.iter().map(|&(beta_deg, [low, high])| {
        let tan = beta_deg.to_radians().tan();
        let at = |i: usize| low * (high / low).powf(i as f64 / (TABLE - 1) as f64);
        let column = |f: &dyn Fn(f64) -> f64| (0..TABLE).map(|i| f(at(i))).collect::<Vec<f64>>();
        stiffness = [stiffness[0].min(low / tan), stiffness[1].max(high / tan)];
        roughness::SlopeTable {
            beta_deg,
            modulus_over_stress: column(&|x| x / tan),
            k_over_stress: column(&|x| function.force.value(x, tan) / (tan * tan)),
            contact_ratio: column(&|x| function.contact_ratio.value(x, tan)),
        }
    });
    let angles: Vec<roughness::SlopeTable> =
        rows.filter(|a| a.modulus_over_stress[0] < a.modulus_over_stress[TABLE - 1]).collect();
    let beta_deg = [angles.first()?.beta_deg, angles.last()?.beta_deg];
    Some(Coefficient {
        law: sweep.hardening_law,
        poissons_ratio: sweep.poissons_ratio,
        c: all.c,
        ci95: all.ci95,
        unloading_exponent: fit.unloading_exponent.unwrap_or(roughness::SINGLE_ASPERITY_EXPONENT),
        beta_deg,
        modulus_over_stress: stiffness,
        angles,
    })
}
