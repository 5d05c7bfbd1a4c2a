//! One row of `cases.csv`: a case and what came of it.

#![expect(non_snake_case, reason = "a name holds its symbols, as in the files")]

use crate::case::Case;
use crate::loading_curvature::LoadingCurvature;
use asperity_material::StressMeasure;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};
use std::collections::HashMap;
use std::io;

/// A solved case, or one that failed with its reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The case.
    pub case: Case,
    /// K and its error, or why there is none.
    pub outcome: Result<LoadingCurvature, String>,
    /// Seconds it took.
    pub wall_s: f64,
}

/// The same as `cases.csv` has it: the names of the fields there are the columns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseRow {
    /// Slope β, degrees.
    #[serde(serialize_with = "plain")]
    pub beta_deg: f64,
    /// Hardening law, or `elastic`.
    pub hardening_law: String,
    /// Hardening exponent.
    #[serde(serialize_with = "plain")]
    pub n: f64,
    /// Young's modulus over yield stress.
    #[serde(serialize_with = "plain")]
    pub E_over_sy: f64,
    /// The stress that yields, `cauchy` or `kirchhoff`. Files of versions without this column are refused: they do not say.
    pub stress_measure: StressMeasure,
    /// F/(E h²); none of a case that failed, like the next four.
    #[serde(serialize_with = "plain")]
    pub K_over_E: Option<f64>,
    /// Relative 95 % bound of what mesh, load steps, penalty and substrate leave in K.
    #[serde(serialize_with = "plain")]
    pub K_error: Option<f64>,
    /// a tan β/h.
    #[serde(serialize_with = "plain")]
    pub contact_ratio: Option<f64>,
    /// Converged increments, those of the companion included, as the next.
    pub increments: Option<usize>,
    /// Newton iterations.
    pub newton_iterations: Option<usize>,
    /// Seconds it took.
    #[serde(serialize_with = "plain")]
    pub wall_s: f64,
    /// `ok`, or the reason.
    pub status: String,
}

/// Shortest digits that read back, without exponent and without a zero behind the point.
fn plain<S: Serializer, T: Copy + Into<Option<f64>>>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
    match (*value).into() {
        Some(value) => serializer.collect_str(&value),
        None => serializer.serialize_none(),
    }
}

impl From<&Row> for CaseRow {
    fn from(row: &Row) -> CaseRow {
        let yielding = row.case.yielding;
        let found = row.outcome.as_ref().ok();
        CaseRow {
            beta_deg: row.case.beta_deg,
            hardening_law: yielding.map_or("elastic", |y| y.law.name()).into(),
            n: yielding.map_or(0.0, |y| y.exponent),
            E_over_sy: yielding.map_or(f64::INFINITY, |y| y.e_over_sy),
            stress_measure: row.case.stress_measure,
            K_over_E: found.map(|k| k.k_over_e),
            K_error: found.map(|k| k.error),
            contact_ratio: found.map(|k| k.contact_ratio),
            increments: found.map(|k| k.increments),
            newton_iterations: found.map(|k| k.iterations),
            wall_s: row.wall_s,
            // a row is one line in the journal, and stays one for readers that know no quotes
            status: row.outcome.as_ref().map_or_else(|r| r.replace([',', '\n', '"'], ";"), |_| "ok".into()),
        }
    }
}

impl CaseRow {
    /// Names the case; the grid supplies Poisson's ratio and the tool.
    pub fn key(&self) -> String {
        let CaseRow { beta_deg, hardening_law, n, E_over_sy, stress_measure, .. } = self;
        let stress_measure = match stress_measure {
            StressMeasure::Cauchy => "cauchy",
            StressMeasure::Kirchhoff => "kirchhoff",
        };
        format!("{beta_deg},{hardening_law},{n},{E_over_sy},{stress_measure}")
    }

    /// The row as a line of the file, without its end.
    pub fn line(&self) -> String {
        let mut table = csv::WriterBuilder::new().has_headers(false).from_writer(Vec::new());
        let bytes = table.serialize(self).ok().and_then(|()| table.into_inner().ok()).unwrap_or_default();
        String::from_utf8_lossy(&bytes).trim_end().into()
    }

    /// Reads a line of [`CaseRow::line`]; `None` if it is not one.
    pub fn of_line(line: &str) -> Option<CaseRow> {
        let table = csv::ReaderBuilder::new().has_headers(false).from_reader(line.as_bytes());
        table.into_deserialize().next()?.ok()
    }

    /// Reads `cases.csv`.
    ///
    /// # Errors
    /// A file that cannot be read or is another table.
    pub fn read(file: impl io::Read) -> Result<Vec<CaseRow>, csv::Error> {
        csv::Reader::from_reader(file).into_deserialize().collect()
    }

    fn outcome(&self) -> Option<Result<LoadingCurvature, String>> {
        if self.status != "ok" {
            return Some(Err(self.status.clone()));
        }
        Some(Ok(LoadingCurvature {
            k_over_e: self.K_over_E?,
            error: self.K_error?,
            contact_ratio: self.contact_ratio?,
            increments: self.increments?,
            iterations: self.newton_iterations?,
        }))
    }
}

impl Row {
    /// Names the case among those of one grid.
    pub fn key(case: &Case) -> String {
        CaseRow::from(&Row { case: *case, outcome: Err(String::new()), wall_s: 0.0 }).key()
    }

    /// The rows of `cases` that `found` holds; others are passed over.
    pub fn of_cases(cases: &[Case], found: impl IntoIterator<Item = CaseRow>) -> Vec<Row> {
        let by_key: HashMap<String, &Case> = cases.iter().map(|c| (Row::key(c), c)).collect();
        let row = |r: CaseRow| {
            let case = **by_key.get(&r.key())?;
            Some(Row { case, outcome: r.outcome()?, wall_s: r.wall_s })
        };
        found.into_iter().filter_map(row).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::Sweep;

    const HEADER: &str = "beta_deg,hardening_law,n,E_over_sy,stress_measure,K_over_E,K_error,contact_ratio,increments,newton_iterations,wall_s,status";

    #[test]
    fn rows_read_back_from_lines_and_from_the_file() {
        let case = Sweep::default().cases()[7];
        let found = LoadingCurvature {
            k_over_e: 0.1 + 0.2,
            error: 5e-3,
            contact_ratio: 0.7,
            increments: 28,
            iterations: 110,
        };
        for outcome in [Ok(found), Err("stopped; at 0.3".to_string())] {
            let row = Row { case, outcome, wall_s: 0.125 };
            let record = CaseRow::from(&row);
            let line = record.line();
            assert_eq!(CaseRow::of_line(&line), Some(record.clone()));
            assert_eq!(
                CaseRow::read(format!("{HEADER}\n{line}\n").as_bytes()).unwrap(),
                std::slice::from_ref(&record)
            );
            assert_eq!(Row::of_cases(&[case], [record]), [row]);
        }
        assert_eq!(CaseRow::of_line("1,hollomon,0.5,233.333333333,cauchy,1.0,0.01"), None);
        let old = "beta_deg,hardening_law,n,E_over_sy,K_over_E,K_error,contact_ratio,increments,newton_iterations,wall_s,status\n\
                   1,hollomon,0.1,350,2,0.01,0.7,28,110,0.1,ok\n";
        let refused = CaseRow::read(old.as_bytes()).unwrap_err().to_string();
        assert!(refused.contains("stress_measure"), "{refused}");
    }

    #[test]
    fn a_line_has_the_shortest_digits_and_no_quotes() {
        let case = Sweep::default().cases()[0];
        let row = Row { case, outcome: Err("no, \"never\"".into()), wall_s: 2.0 };
        assert_eq!(CaseRow::from(&row).line(), "1,hollomon,0.1,350,cauchy,,,,,,2,no; ;never;");
    }
}
