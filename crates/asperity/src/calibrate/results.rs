//! The files and the text of a calibration.

use super::pictures;
use crate::error::Error;
use crate::output::{Sink, SinkExt};
use asperity_calibration::dimensionless::Dimensionless;
use asperity_calibration::fit::{Angle, DEVELOPED, Data, Slope, angles, developed, obstacle, slope};
use asperity_calibration::row::{HEADER, Row};
use asperity_calibration::sweep::Sweep;
use asperity_calibration::unloading::{self, Unloaded};
use asperity_roughness::{self as roughness, Coefficient, PUBLISHED};
use serde_json::{Value, json};
use std::fmt::Write;

/// Points of the table of `coefficient.toml` for each slope.
const TABLE: usize = 12;

/// A sweep with all that was fitted to it.
pub struct Calibration {
    sweep: Sweep,
    rows: Vec<Row>,
    wall_s: f64,
    /// Slope that collapse.svg shows, degrees.
    shown: Option<f64>,
    /// Usable rows by slope.
    pub data: Data,
    /// Why there is no fit.
    obstacle: Option<String>,
    /// Every slope.
    pub angles: Vec<Angle>,
    /// c of all cases.
    pub slope: Option<Slope>,
    developed: Option<Slope>,
    function: Option<Dimensionless>,
    /// Cones taken back, for the exponent of the unloading curve.
    unloaded: Vec<Unloaded>,
}

impl Calibration {
    /// Fits `rows`.
    pub fn new(sweep: &Sweep, rows: Vec<Row>, wall_s: f64, shown: Option<f64>) -> Calibration {
        let data = Data::new(&rows);
        let obstacle = obstacle(&data);
        let angles = if obstacle.is_none() { angles(&data) } else { Vec::new() };
        let slope = slope(&angles);
        let developed = slope.and_then(|s| self::slope_of(&developed(&data, s.c, DEVELOPED)));
        let function = slope.and_then(|s| Dimensionless::fit(&data, s.c));
        let unloaded = match (&function, slope) {
            (Some(_), Some(s)) => unloading::unload(sweep, s.c),
            _ => Vec::new(),
        };
        Calibration {
            unloaded,
            sweep: sweep.clone(),
            rows,
            wall_s,
            shown,
            data,
            obstacle,
            angles,
            slope,
            developed,
            function,
        }
    }

    fn failed(&self) -> usize {
        self.rows.iter().filter(|r| r.outcome.is_err()).count()
    }

    fn reason(&self) -> Option<String> {
        let flat = "not determined: the scatter is flat in the representative strain at every slope";
        self.obstacle.clone().or_else(|| self.slope.is_none().then(|| flat.into()))
    }

    /// Writes everything; of a part only its rows and the sweep.
    pub fn write(&self, folder: &mut dyn Sink, whole: bool) -> Result<(), Error> {
        let mut table = format!("{HEADER}\n");
        for row in &self.rows {
            let _ = writeln!(table, "{}", row.to_csv());
        }
        folder.write("cases.csv", |out| out.write_all(table.as_bytes()))?;
        let sweep =
            serde_json::to_string_pretty(&self.sweep).map_err(|e| Error::Unfinished(e.to_string()))?;
        folder.write("sweep.json", |out| out.write_all(sweep.as_bytes()))?;
        if !whole {
            return Ok(());
        }
        let fit = self.json()?;
        folder.write("fit.json", |out| out.write_all(fit.as_bytes()))?;
        if let Some(coefficient) = self.coefficient() {
            let text = coefficient.to_toml().map_err(|e| Error::Unfinished(e.to_string()))?;
            folder.write("coefficient.toml", |out| out.write_all(text.as_bytes()))?;
        }
        for (name, picture) in pictures::all(self, self.shown) {
            let text = picture.map_err(Error::Unfinished)?;
            folder.write(name, |out| out.write_all(text.as_bytes()))?;
        }
        Ok(())
    }

    /// The fit as JSON.
    pub fn json(&self) -> Result<String, Error> {
        let angle = |a: &Angle| {
            json!({
                "beta_deg": a.beta_deg,
                "representative_strain": a.strain,
                "low": a.interval[0],
                "high": a.interval[1],
                "scatter": a.scatter,
                "cases": a.cases,
                "determined": a.strain.is_some(),
                "correlation_strain": a.correlation_strain,
                "weight": a.weight,
                "scatter_curve": a.curve.iter()
                    .map(|m| json!([m.share * a.beta_deg.to_radians().tan(), m.scatter, m.correlation]))
                    .collect::<Vec<Value>>(),
            })
        };
        let formula = |f: &asperity_calibration::dimensionless::Formula| json!({ "coefficients": f.coefficients, "rms_error": f.rms, "largest_error": f.largest });
        let value = json!({
            "law": self.sweep.hardening_law,
            "tool": self.sweep.tool,
            "poissons_ratio": self.sweep.poissons_ratio,
            "coefficient": self.slope.map(|s| s.c),
            "ci95": self.slope.map(|s| s.ci95),
            "reason": self.reason(),
            "per_angle": self.angles.iter().map(angle).collect::<Vec<Value>>(),
            "published": PUBLISHED,
            "developed": self.developed.map(|s| json!({
                "least_modulus_tan_beta_over_stress": DEVELOPED,
                "coefficient": s.c,
                "ci95": s.ci95,
                "slopes": s.angles,
            })),
            "dimensionless_function": self.function.as_ref().map(|f| json!({
                "form": "ln(K tan^2(beta)/sigma_r) = a0 + a1 L + a2 L^2 + a3 L^3 + a4 L^4 + tan(beta) (b0 + b1 L + b2 L^2), L = ln(E* tan(beta)/sigma_r)",
                "force": formula(&f.force),
                "contact_ratio": formula(&f.contact_ratio),
            })),
            "unloading_exponent": unloading::mean(&self.unloaded),
            "unloaded": self.unloaded.iter().map(|u| json!({
                "beta_deg": u.case.beta_deg,
                "n": u.case.yielding.map(|y| y.exponent),
                "E_over_sy": u.case.yielding.map(|y| y.e_over_sy),
                "exponent": u.exponent,
            })).collect::<Vec<Value>>(),
            "cases": self.rows.len(),
            "failed": self.failed(),
        });
        let text = serde_json::to_string_pretty(&value).map_err(|e| Error::Unfinished(e.to_string()))?;
        Ok(text + "\n")
    }

    /// What `rough` reads.
    fn coefficient(&self) -> Option<Coefficient> {
        let (slope, function) = (self.slope?, self.function.as_ref()?);
        let mut stiffness = [f64::INFINITY, 0.0_f64];
        let rows = function.ranges.iter().map(|&(beta_deg, [low, high])| {
            let tan = beta_deg.to_radians().tan();
            let at = |i: usize| low * (high / low).powf(i as f64 / (TABLE - 1) as f64);
            let column = |f: &dyn Fn(f64) -> f64| (0..TABLE).map(|i| f(at(i))).collect::<Vec<f64>>();
            stiffness = [stiffness[0].min(low / tan), stiffness[1].max(high / tan)];
            roughness::SlopeTable {
                beta_deg,
                modulus_over_stress: column(&|x| x / tan),
                k_over_stress: column(&|x| function.force.at(x, tan) / (tan * tan)),
                contact_ratio: column(&|x| function.contact_ratio.at(x, tan)),
            }
        });
        let angles: Vec<roughness::SlopeTable> =
            rows.filter(|a| a.modulus_over_stress[0] < a.modulus_over_stress[TABLE - 1]).collect();
        let beta_deg = [angles.first()?.beta_deg, angles.last()?.beta_deg];
        Some(Coefficient {
            law: self.sweep.hardening_law,
            poissons_ratio: self.sweep.poissons_ratio,
            c: slope.c,
            ci95: slope.ci95,
            unloading_exponent: unloading::mean(&self.unloaded)
                .unwrap_or(roughness::SINGLE_ASPERITY_EXPONENT),
            beta_deg,
            modulus_over_stress: stiffness,
            angles,
        })
    }

    /// What a person reads at the end.
    pub fn text(&self, whole: bool) -> String {
        let mut text = String::new();
        let count = self.rows.len().max(1) as f64;
        let solved = || self.rows.iter().filter_map(|r| r.outcome.as_ref().ok());
        let seconds: f64 = self.rows.iter().map(|r| r.wall_s).sum();
        let iterations: usize = solved().map(|k| k.iterations).sum();
        let _ = writeln!(
            text,
            "cases     {} ({} failed) in {:.1} s; {:.3} s and {:.0} iterations a case, {:.2} ms an iteration",
            self.rows.len(),
            self.failed(),
            self.wall_s,
            seconds / count,
            iterations as f64 / count,
            1e3 * seconds / iterations.max(1) as f64
        );
        let worst = solved().map(|k| k.error).fold(0.0, f64::max);
        let _ = writeln!(text, "K         error at most {:.2} %", 100.0 * worst);
        for row in self.rows.iter().filter(|r| r.outcome.is_err()).take(5) {
            let _ = writeln!(text, "failed    {}", row.to_csv());
        }
        if !whole {
            return text.trim_end().into();
        }
        if !self.angles.is_empty() {
            let _ = writeln!(
                text,
                "slope     eps_r     95 % interval       eps_r/tan   by correlation  scatter  cases"
            );
        }
        for a in &self.angles {
            let tan = a.beta_deg.to_radians().tan();
            let number = |v: Option<f64>| v.map_or("  none ".into(), |v| format!("{v:.5}"));
            let _ = writeln!(
                text,
                "{:>5}     {}   {:.5} … {:.5}   {}     {}         {:.2} %   {}{}",
                a.beta_deg,
                number(a.strain),
                a.interval[0],
                a.interval[1],
                number(a.strain.map(|s| s / tan)),
                number(a.correlation_strain.map(|s| s / tan)),
                100.0 * a.scatter,
                a.cases,
                if a.strain.is_some() { "" } else { "  not determined" }
            );
        }
        let law = self.sweep.hardening_law.name();
        let say =
            |s: &Slope| format!("{:.4} [{:.4}, {:.4}] from {} slopes", s.c, s.ci95[0], s.ci95[1], s.angles);
        match (&self.slope, self.reason()) {
            (Some(s), _) => {
                let _ = writeln!(text, "c         {} ({law}; published {PUBLISHED})", say(s));
            }
            (None, reason) => {
                let _ = writeln!(text, "c         {}", reason.unwrap_or_default());
            }
        }
        if let Some(s) = &self.developed {
            let _ = writeln!(text, "          {} where E* tan(beta)/sigma_r >= {DEVELOPED}", say(s));
        }
        if let Some(f) = &self.function {
            let _ = writeln!(
                text,
                "function  K/sigma_r to {:.1} % (largest {:.1} %), contact ratio to {:.1} % ({:.1} %)",
                100.0 * f.force.rms,
                100.0 * f.force.largest,
                100.0 * f.contact_ratio.rms,
                100.0 * f.contact_ratio.largest
            );
        }
        if let Some(m) = unloading::mean(&self.unloaded) {
            let (low, high) = self
                .unloaded
                .iter()
                .fold((f64::MAX, f64::MIN), |(a, b), u| (a.min(u.exponent), b.max(u.exponent)));
            let count = self.unloaded.len();
            let _ = writeln!(text, "unloading exponent {m:.3} ({low:.3} to {high:.3}, {count} cones)");
        }
        text.trim_end().into()
    }
}

fn slope_of(data: &Data) -> Option<Slope> {
    slope(&angles(data))
}
