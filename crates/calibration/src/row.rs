//! One row of `cases.csv`: a case and what came of it.

use crate::case::Case;
use crate::loading_curvature::LoadingCurvature;
use std::collections::HashMap;

/// The columns of `cases.csv`.
pub const HEADER: &str = "beta_deg,hardening_law,n,E_over_sy,K_over_E,K_error,contact_ratio,increments,newton_iterations,wall_s,status";

/// A solved case, or one that failed with its reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The case.
    pub case: Case,
    /// What it gave, or why nothing.
    pub outcome: Result<LoadingCurvature, String>,
    /// Seconds it took.
    pub wall_s: f64,
}

impl Row {
    /// The columns that say which case this is; the grid supplies Poisson's ratio and the tool.
    pub fn key(case: &Case) -> String {
        let (law, n, ratio) = case
            .yielding
            .map_or(("elastic", 0.0, f64::INFINITY), |y| (y.law.name(), y.exponent, y.e_over_sy));
        format!("{},{law},{n},{ratio}", case.beta_deg)
    }

    /// The row as text, shortest digits that read back to the same values.
    pub fn to_csv(&self) -> String {
        let key = Row::key(&self.case);
        match &self.outcome {
            Ok(k) => format!(
                "{key},{},{},{},{},{},{},ok",
                k.k_over_e, k.error, k.contact_ratio, k.increments, k.iterations, self.wall_s
            ),
            // a comma or a line break would end the column
            Err(reason) => format!("{key},,,,,,{},{}", self.wall_s, reason.replace([',', '\n', '"'], ";")),
        }
    }

    /// Reads the text of [`Row::to_csv`] as the row of `case`; `None` if it is not one.
    pub fn from_csv(line: &str, case: &Case) -> Option<Row> {
        let rest = line.strip_prefix(&Row::key(case))?.strip_prefix(',')?;
        let columns: Vec<&str> = rest.split(',').collect();
        let [k, error, ratio, increments, iterations, wall, status] = columns.as_slice() else { return None };
        let outcome = if *status == "ok" {
            Ok(LoadingCurvature {
                k_over_e: k.parse().ok()?,
                error: error.parse().ok()?,
                contact_ratio: ratio.parse().ok()?,
                increments: increments.parse().ok()?,
                iterations: iterations.parse().ok()?,
            })
        } else {
            Err((*status).to_string())
        };
        Some(Row { case: *case, outcome, wall_s: wall.parse().ok()? })
    }

    /// The rows of `cases` that lines of text hold; other lines are passed over.
    pub fn of_cases<'l>(cases: &[Case], lines: impl IntoIterator<Item = &'l str>) -> Vec<Row> {
        let by_key: HashMap<String, &Case> = cases.iter().map(|c| (Row::key(c), c)).collect();
        let row = |line| by_key.get(Row::key_of(line)).and_then(|case| Row::from_csv(line, case));
        lines.into_iter().filter_map(row).collect()
    }

    /// The key at the start of a line.
    pub fn key_of(line: &str) -> &str {
        let end = line.match_indices(',').nth(3).map_or(line.len(), |(i, _)| i);
        &line[..end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sweep::Sweep;

    #[test]
    fn rows_read_back() {
        let case = Sweep::default().cases()[7];
        let kick = LoadingCurvature {
            k_over_e: 0.1 + 0.2,
            error: 5e-3,
            contact_ratio: 0.7,
            increments: 28,
            iterations: 110,
        };
        for outcome in [Ok(kick), Err("stopped; at 0.3".to_string())] {
            let row = Row { case, outcome, wall_s: 0.125 };
            let text = row.to_csv();
            assert_eq!(text.split(',').count(), HEADER.split(',').count());
            assert_eq!(Row::key_of(&text), Row::key(&case));
            assert_eq!(Row::from_csv(&text, &case), Some(row.clone()));
            assert_eq!(Row::of_cases(&[case], [text.as_str(), "another"]), [row]);
        }
        assert_eq!(Row::from_csv("1,hollomon,0.5,233.333333333,1.0,0.01", &case), None);
    }
}
