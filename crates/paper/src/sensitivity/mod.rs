//! c for both laws, both tools and parts of the range of materials.

#![expect(non_snake_case, reason = "a name holds its symbols, as in the files")]

mod sensitivity_report;

use crate::sensitivity_parts::{Line, lines, sweeps};
use asperity::Observer;
use asperity::calibrate::run_sweep::{Options, solve};
use asperity::calibration::case::Tool;
use asperity::calibration::fit::DEVELOPED_PLASTICITY;
use asperity::calibration::row::CaseRow;
use asperity::calibration::sweep::Sweep;
use asperity::error::Error;
use asperity::material::HardeningLaw;
use asperity::output::{Sink, SinkExt, row};
use asperity::roughness::PUBLISHED_COEFFICIENT;
use asperity::simulation::scene::Accuracy;
use serde::{Deserialize, Serialize};
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

row! {
    /// c of a part of the grid: a row of `dependence.csv`. The first three c are those of all cases, the
    /// others those of the cases in which plasticity is developed; each with its 95 % interval, none where
    /// it is not determined.
    SensitivityLine(sweep: &Sweep, line: &Line) {
        /// `crush` or `indentation`.
        tool: String = tool_name(sweep.tool).into(),
        /// Hardening law.
        hardening_law: HardeningLaw = sweep.hardening_law,
        /// Smallest n.
        n_least: f64 = line.exponents[0],
        /// Largest n.
        n_largest: f64 = line.exponents[1],
        /// Smallest E/σ_y.
        E_over_sy_least: f64 = line.ratios[0],
        /// Largest E/σ_y.
        E_over_sy_largest: f64 = line.ratios[1],
        /// c.
        c: Option<f64> = line.all.map(|s| rounded(s.c)),
        /// Lower end.
        low: Option<f64> = line.all.map(|s| rounded(s.ci95[0])),
        /// Upper end.
        high: Option<f64> = line.all.map(|s| rounded(s.ci95[1])),
        /// c.
        c_developed: Option<f64> = line.developed.map(|s| rounded(s.c)),
        /// Lower end.
        low_developed: Option<f64> = line.developed.map(|s| rounded(s.ci95[0])),
        /// Upper end.
        high_developed: Option<f64> = line.developed.map(|s| rounded(s.ci95[1])),
    }
}

impl SensitivityLine {
    /// c with the ends of its interval, of all cases and of those in which plasticity is developed; `None`:
    /// not determined.
    fn coefficients(&self) -> [Option<[f64; 3]>; 2] {
        let whole = |c: Option<f64>, low: Option<f64>, high: Option<f64>| Some([c?, low?, high?]);
        [whole(self.c, self.low, self.high), whole(self.c_developed, self.low_developed, self.high_developed)]
    }
}

/// Published values.
fn published() -> String {
    format!(
        "published: Tabor and Johnson 0.2, Bucaille 0.105 (indentation), Jourani {PUBLISHED_COEFFICIENT} (crush)"
    )
}

/// To five decimals.
fn rounded(value: f64) -> f64 {
    (1e5 * value).round() / 1e5
}

fn tool_name(tool: Tool) -> &'static str {
    match tool {
        Tool::Plane => "crush",
        Tool::Cone => "indentation",
    }
}

/// Runs four sweeps, crush and indentation, each with both laws, and fits their parts.
///
/// A journal of the options stands for four, one a sweep, beside it. The observer is told as by
/// [`calibrate`](asperity::calibrate::calibrate); `false` ends the run after the sweep at hand.
///
/// # Errors
/// A journal that cannot be written; finished cases stay in the journals.
pub fn sensitivity(
    accuracy: Accuracy,
    options: &Options,
    observer: &mut Observer<'_, CaseRow>,
) -> Result<Sensitivity, Error> {
    let mut found = Sensitivity {
        lines: Vec::new(),
        published: PUBLISHED_COEFFICIENT,
        sweeps: Vec::new(),
        journals: Vec::new(),
    };
    for sweep in sweeps(accuracy) {
        let name = format!("{}-{}", tool_name(sweep.tool), sweep.hardening_law.name());
        let journal = options.journal.as_ref().map(|path| path.with_extension(format!("{name}.journal")));
        found.journals.extend(journal.clone());
        let solved = solve(&sweep, &Options { journal, ..options.clone() }, observer)?;
        found.sweeps.push((name, solved.rows.iter().map(CaseRow::from).collect()));
        found.lines.extend(lines(&solved.rows).iter().map(|line| SensitivityLine::new(&sweep, line)));
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
            sink.csv(&format!("cases-{name}.csv"), rows)?;
        }
        sink.csv("dependence.csv", &self.lines)
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
        asperity::output::sorted_json(self)
    }

    /// The lines as a table of Markdown.
    pub fn text(&self) -> String {
        let mut text = format!(
            "| tool, law | n | E/σ_y | c (95 %) | c where E* tan β/σ_r ≥ {DEVELOPED_PLASTICITY} |\n|-|-|-|-|-|\n"
        );
        for l in &self.lines {
            let [all, developed] = l.coefficients().map(|c| match c {
                Some([c, low, high]) => format!("{c:.3} ({low:.3}-{high:.3})"),
                None => "not determined".into(),
            });
            let _ = writeln!(
                text,
                "| {}, {} | {}-{} | {}-{} | {} | {} |",
                l.tool,
                l.hardening_law.name(),
                l.n_least,
                l.n_largest,
                l.E_over_sy_least,
                l.E_over_sy_largest,
                all,
                developed
            );
        }
        let _ = writeln!(text, "{}", published());
        text
    }
}
