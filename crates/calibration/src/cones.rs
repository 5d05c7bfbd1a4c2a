//! The cones of the atlas: the rule that draws them, and the row of each.
//!
//! Cone i is point i of Sobol's sequence: of four successive ones each combination of hardening law and
//! contact has one, and further ones fill the gaps, so that an atlas that was begun can be continued by any
//! number of tasks. A row is what [`crate::indentation::solve`] finds of a cone that is loaded and unloaded,
//! with the stated errors, or the reason why it found nothing. The function through them is
//! [`asperity_material::cone_atlas`].

use crate::case::{Case, Tool, Yielding};
use crate::indentation::{Errors, FORCES, Indentation, solve};
use asperity_material::cone_atlas::{
    Contact, EXPONENTS, OUTPUTS, POISSONS_RATIOS, RATIOS, SLOPES, SharpCone,
};
use asperity_material::units::rounded;
use asperity_material::{HardeningLaw, StressMeasure};
use asperity_numerics::sobol::Sobol;
use asperity_simulation::scene::Accuracy;
use asperity_solver::body::analysis::Analyses;

/// Cone number `index` of the atlas, slope and E/σ_y drawn evenly in their logarithms: the coordinates of
/// Sobol's point choose law and contact, slope, E/σ_y, n, ν.
pub fn cone(index: usize) -> Case {
    drawn(index, [0.0; 4])
}

/// Cone number `index` of those that the atlas is held against: Sobol's points moved around the range, so
/// that none is in the atlas.
pub fn fresh(index: usize) -> Case {
    // parts of the golden ratio's generalisation to four dimensions, which no power of two divides
    drawn(index, [0.856_675, 0.733_892, 0.628_707, 0.538_597])
}

fn drawn(index: usize, moved: [f64; 4]) -> Case {
    // five dimensions are there
    let at = |dimension: usize| Sobol::new(5).map_or(0.0, |sobol| sobol.coordinate(dimension, index));
    let share = |i: usize| (at(i + 1) + moved[i]).fract();
    let even = |[low, high]: [f64; 2], share: f64| low + share * (high - low);
    // six digits, so that a table of the cones says exactly which they are
    let logarithmic = |range: [f64; 2], share: f64| rounded(even(range.map(f64::ln), share).exp(), 6);
    let combination = (4.0 * at(0)) as usize;
    Case {
        beta_deg: logarithmic(SLOPES, share(0)),
        yielding: Some(Yielding {
            law: [HardeningLaw::Hollomon, HardeningLaw::Swift][combination & 1],
            e_over_sy: logarithmic(RATIOS, share(1)),
            exponent: rounded(even(EXPONENTS, share(2)), 6),
        }),
        poissons_ratio: rounded(even(POISSONS_RATIOS, share(3)), 6),
        tool: [Tool::Plane, Tool::Cone][combination >> 1],
        stress_measure: StressMeasure::Cauchy,
        friction: None,
    }
}

/// A solved cone, or one that failed with its reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its number.
    pub index: usize,
    /// The cone.
    pub case: Case,
    /// The result.
    pub outcome: Result<(Indentation, Errors), String>,
}

/// The columns of a row: the elastic recovery has one for each of [`FORCES`].
pub fn header() -> String {
    let back = FORCES.map(|force| format!("back_{force}")).join(",");
    format!(
        "index,slope_deg,E_over_sy,n,nu,law,contact,K_over_E,K_error,contact_ratio,contact_ratio_error,S_over_Eh,S_error,elastic_share,\
         elastic_share_error,{back},K_difference,contact_ratio_difference,S_difference,elastic_share_difference,reached,iterations,status"
    )
}

impl Row {
    /// Solves `case`; cones of one sweep share `analyses` of their meshes.
    pub fn solve(index: usize, case: &Case, accuracy: Accuracy, analyses: &Analyses) -> Row {
        let outcome = solve(&case.cone(), accuracy, analyses).map_err(|e| e.to_string());
        Row { index, case: *case, outcome }
    }

    /// The cone as the formula knows it, what was found as its answer, and the errors; `None` of a cone that
    /// failed.
    pub fn answer(&self) -> Option<(SharpCone, [f64; OUTPUTS], [f64; 4])> {
        let (found, errors) = self.outcome.as_ref().ok()?;
        let contact = match self.case.tool {
            Tool::Plane => Contact::Crushed,
            Tool::Cone => Contact::Indenting,
        };
        let cone = SharpCone::new(self.case.beta_deg, &self.case.elastic(), self.case.hardening()?, contact);
        let mut answer = [0.0; OUTPUTS];
        answer[..4].copy_from_slice(&[
            found.k_over_e,
            found.contact_ratio,
            found.stiffness,
            found.elastic_share,
        ]);
        answer[4..].copy_from_slice(&found.recovery);
        let Errors { loading_curvature, contact_ratio, stiffness, elastic_share, .. } = *errors;
        Some((cone, answer, [loading_curvature, contact_ratio, stiffness, elastic_share]))
    }

    /// The row as a line of the table, in single precision.
    pub fn line(&self) -> String {
        let case = &self.case;
        let (ratio, exponent, law) = case
            .yielding
            .map_or((f64::INFINITY, 0.0, "elastic"), |y| (y.e_over_sy, y.exponent, y.law.name()));
        let contact = match case.tool {
            Tool::Plane => "plane",
            Tool::Cone => "cone",
        };
        let place = format!(
            "{},{},{ratio},{exponent},{},{law},{contact}",
            self.index, case.beta_deg, case.poissons_ratio
        );
        match &self.outcome {
            Ok((found, errors)) => {
                let pairs = [
                    (found.k_over_e, errors.loading_curvature),
                    (found.contact_ratio, errors.contact_ratio),
                    (found.stiffness, errors.stiffness),
                    (found.elastic_share, errors.elastic_share),
                ];
                let numbers: String = pairs
                    .iter()
                    .map(|(value, error)| format!(",{},{:.5}", rounded(*value, 7), error))
                    .collect();
                let back: String =
                    found.recovery.iter().map(|way| format!(",{}", rounded(*way, 5))).collect();
                let differences: String = errors.differences.iter().map(|d| format!(",{d:.5}")).collect();
                format!(
                    "{place}{numbers}{back}{differences},{},{},ok",
                    rounded(found.reached, 3),
                    found.iterations
                )
            }
            Err(reason) => {
                format!("{place}{},{}", ",".repeat(14 + FORCES.len()), reason.replace([',', '\n', '"'], ";"))
            }
        }
    }

    /// Reads a line of [`Row::line`]; `None` if it is not one.
    pub fn of_line(line: &str) -> Option<Row> {
        let words: Vec<&str> = line.split(',').collect();
        let ([index, slope, ratio, exponent, nu, law, contact], rest) = words.split_first_chunk::<7>()?;
        let case = Case {
            beta_deg: slope.parse().ok()?,
            yielding: Some(Yielding {
                law: [HardeningLaw::Hollomon, HardeningLaw::Swift].into_iter().find(|l| l.name() == *law)?,
                e_over_sy: ratio.parse().ok()?,
                exponent: exponent.parse().ok()?,
            }),
            poissons_ratio: nu.parse().ok()?,
            tool: if *contact == "plane" { Tool::Plane } else { Tool::Cone },
            stress_measure: StressMeasure::Cauchy,
            friction: None,
        };
        let (status, numbers) = rest.split_last()?;
        let outcome = match *status {
            "ok" => {
                let numbers: Vec<f64> = numbers.iter().map(|x| x.parse().ok()).collect::<Option<_>>()?;
                let ([k, k_error, ratio, ratio_error, s, s_error, share, share_error], numbers) =
                    numbers.split_first_chunk::<8>()?;
                let (recovery, numbers) = numbers.split_first_chunk::<{ FORCES.len() }>()?;
                let (differences, numbers) = numbers.split_first_chunk::<4>()?;
                let [reached, iterations] = numbers else { return None };
                let found = Indentation {
                    k_over_e: *k,
                    contact_ratio: *ratio,
                    stiffness: *s,
                    recovery: *recovery,
                    elastic_share: *share,
                    reached: *reached,
                    iterations: *iterations as usize,
                };
                let errors = Errors {
                    loading_curvature: *k_error,
                    contact_ratio: *ratio_error,
                    stiffness: *s_error,
                    elastic_share: *share_error,
                    differences: *differences,
                };
                Ok((found, errors))
            }
            reason => Err(reason.to_string()),
        };
        Some(Row { index: index.parse().ok()?, case, outcome })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    /// Of every four successive cones each combination has one, and 64 of them lie one each in 64 parts of
    /// every range.
    #[test]
    fn the_rule_fills_the_range_evenly_for_every_law_and_contact() {
        let cases: Vec<Case> = (0..256).map(cone).collect();
        for four in cases.chunks(4) {
            let found: HashSet<_> = four.iter().map(|c| (c.yielding.unwrap().law, c.tool)).collect();
            assert_eq!(found.len(), 4);
        }
        let inside = |[low, high]: [f64; 2], x: f64| x >= low && x <= high;
        for case in cases.iter().chain(&(0..256).map(fresh).collect::<Vec<_>>()) {
            let y = case.yielding.unwrap();
            assert!(inside(SLOPES, case.beta_deg) && inside(RATIOS, y.e_over_sy), "{case:?}");
            assert!(inside(EXPONENTS, y.exponent) && inside(POISSONS_RATIOS, case.poissons_ratio));
        }
        let crushed =
            cases.iter().filter(|c| c.tool == Tool::Plane && c.yielding.unwrap().law == HardeningLaw::Swift);
        let [low, high] = SLOPES.map(f64::ln);
        let parts: HashSet<usize> =
            crushed.map(|c| (16.0 * (c.beta_deg.ln() - low) / (high - low)) as usize).collect();
        assert_eq!(parts.len(), 16);
    }

    #[test]
    fn rows_read_back() {
        let (index, case) = (17, cone(17));
        for row in [
            Row::solve(index, &case, Accuracy::Draft, &Analyses::default()),
            Row { index, case, outcome: Err("stopped; at 0.3".into()) },
        ] {
            let line = row.line();
            assert_eq!(line.matches(',').count(), header().matches(',').count(), "{line}");
            assert_eq!(Row::of_line(&line).unwrap().line(), line);
        }
        assert_eq!(Row::of_line("17,3"), None);
    }
}
