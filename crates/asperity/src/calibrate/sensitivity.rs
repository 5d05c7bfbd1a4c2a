//! c for both laws, both tools and parts of the range of materials.

use super::run::{Options, Progress, solve};
use crate::csv_file;
use crate::error::Error;
use crate::output::Sink;
use asperity_calibration::case::Tool;
use asperity_calibration::fit::{DEVELOPED, Slope};
use asperity_calibration::row::CaseRow;
use asperity_calibration::sensitivity::{lines, sweeps};
use asperity_law::HardeningLaw;
use asperity_roughness::PUBLISHED;
use asperity_solver::scene::Accuracy;
use serde::{Deserialize, Serialize, Serializer};
use std::fmt::Write;
use std::path::PathBuf;

/// c over laws, tools, exponents and ranges of E over yield stress.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sensitivity {
    /// A line for every part of the grid.
    pub lines: Vec<SensitivityLine>,
    /// The published c.
    pub published: f64,
    /// Name and rows of every sweep.
    #[serde(skip)]
    pub sweeps: Vec<(String, Vec<CaseRow>)>,
    #[serde(skip)]
    journals: Vec<PathBuf>,
}

/// c of a part of the grid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensitivityLine {
    /// Crush or indentation.
    pub tool: Tool,
    /// Hardening law.
    pub law: HardeningLaw,
    /// Smallest and largest n.
    pub hardening_exponent: [f64; 2],
    /// Smallest and largest E/σ_y.
    pub modulus_over_yield_stress: [f64; 2],
    /// c of all cases; none where it is not determined.
    pub all: Option<Estimate>,
    /// c of those in which plasticity is developed.
    pub developed: Option<Estimate>,
}

/// A c with its 95 % interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Estimate {
    /// c.
    pub coefficient: f64,
    /// Its interval.
    pub ci95: [f64; 2],
}

impl From<Slope> for Estimate {
    fn from(s: Slope) -> Estimate {
        Estimate { coefficient: s.c, ci95: s.ci95 }
    }
}

/// A row of `dependence.csv`.
#[derive(Serialize)]
struct Record {
    tool: &'static str,
    hardening_law: HardeningLaw,
    n_least: String,
    n_largest: String,
    #[serde(rename = "E_over_sy_least")]
    ratio_least: String,
    #[serde(rename = "E_over_sy_largest")]
    ratio_largest: String,
    #[serde(serialize_with = "rounded")]
    c: Option<f64>,
    #[serde(serialize_with = "rounded")]
    low: Option<f64>,
    #[serde(serialize_with = "rounded")]
    high: Option<f64>,
    #[serde(serialize_with = "rounded")]
    c_developed: Option<f64>,
    #[serde(serialize_with = "rounded")]
    low_developed: Option<f64>,
    #[serde(serialize_with = "rounded")]
    high_developed: Option<f64>,
}

fn rounded<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => serializer.collect_str(&format_args!("{value:.5}")),
        None => serializer.serialize_none(),
    }
}

fn tool_name(tool: Tool) -> &'static str {
    match tool {
        Tool::Plane => "crush",
        Tool::Cone => "indentation",
    }
}

impl From<&SensitivityLine> for Record {
    fn from(line: &SensitivityLine) -> Record {
        let [n_least, n_largest] = line.hardening_exponent.map(|n| n.to_string());
        let [ratio_least, ratio_largest] = line.modulus_over_yield_stress.map(|r| r.to_string());
        Record {
            tool: tool_name(line.tool),
            hardening_law: line.law,
            n_least,
            n_largest,
            ratio_least,
            ratio_largest,
            c: line.all.map(|s| s.coefficient),
            low: line.all.map(|s| s.ci95[0]),
            high: line.all.map(|s| s.ci95[1]),
            c_developed: line.developed.map(|s| s.coefficient),
            low_developed: line.developed.map(|s| s.ci95[0]),
            high_developed: line.developed.map(|s| s.ci95[1]),
        }
    }
}

/// Runs four sweeps, crush and indentation, each with both laws, and fits their parts.
///
/// A journal of the options stands for four, one a sweep, beside it. The observer is told as by
/// [`calibrate`](super::calibrate); `false` ends the run after the sweep at hand.
///
/// # Errors
/// A journal that cannot be written; finished cases stay in the journals.
pub fn sensitivity(
    accuracy: Accuracy,
    options: &Options,
    observer: &mut (dyn FnMut(&Progress) -> bool + Send),
) -> Result<Sensitivity, Error> {
    let mut found =
        Sensitivity { lines: Vec::new(), published: PUBLISHED, sweeps: Vec::new(), journals: Vec::new() };
    for sweep in sweeps(accuracy) {
        let name = format!("{}-{}", tool_name(sweep.tool), sweep.hardening_law.name());
        let journal = options.journal.as_ref().map(|path| path.with_extension(format!("{name}.journal")));
        found.journals.extend(journal.clone());
        let solved = solve(&sweep, &Options { journal, ..options.clone() }, observer)?;
        found.sweeps.push((name, solved.rows.iter().map(CaseRow::from).collect()));
        found.lines.extend(lines(&solved.rows).iter().map(|line| SensitivityLine {
            tool: sweep.tool,
            law: sweep.hardening_law,
            hardening_exponent: line.exponents,
            modulus_over_yield_stress: line.ratios,
            all: line.all.map(Estimate::from),
            developed: line.developed.map(Estimate::from),
        }));
        if solved.stopped {
            break;
        }
    }
    Ok(found)
}

impl Sensitivity {
    /// Writes `dependence.csv` and the rows of every sweep.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        for (name, rows) in &self.sweeps {
            csv_file::write(sink, &format!("cases-{name}.csv"), rows)?;
        }
        csv_file::write(sink, "dependence.csv", self.lines.iter().map(Record::from))
    }

    /// Removes the journals, which are of no use once the results are in their place.
    pub fn remove_journals(&self) {
        for path in &self.journals {
            let _ = std::fs::remove_file(path);
        }
    }

    /// The lines as JSON.
    ///
    /// # Errors
    /// None that is known: every line is JSON.
    pub fn json(&self) -> Result<String, Error> {
        crate::json_file::text(self)
    }

    /// The lines as a table of Markdown.
    pub fn text(&self) -> String {
        let mut text = format!(
            "| tool, law | n | E/σ_y | c (95 %) | c where E* tan β/σ_r ≥ {DEVELOPED} |\n|-|-|-|-|-|\n"
        );
        let shown = |s: Option<Estimate>| {
            let text =
                |Estimate { coefficient: c, ci95: [low, high] }| format!("{c:.3} ({low:.3}-{high:.3})");
            s.map_or("not determined".into(), text)
        };
        for line in &self.lines {
            let (tool, law) = (tool_name(line.tool), line.law.name());
            let ([n, most], [ratio, largest]) = (line.hardening_exponent, line.modulus_over_yield_stress);
            let (all, developed) = (shown(line.all), shown(line.developed));
            let _ =
                writeln!(text, "| {tool}, {law} | {n}-{most} | {ratio}-{largest} | {all} | {developed} |");
        }
        let indentation = "published: Tabor and Johnson 0.2, Bucaille 0.105 (indentation)";
        let _ = writeln!(text, "{indentation}, Jourani {PUBLISHED} (crush)");
        text
    }
}
