//! The grid of a calibration: which cones of which materials.

use crate::case::{Case, Tool, Yielding};
use asperity_material::units::{Stress, rounded};
use asperity_material::{HardeningLaw, StressMeasure, range};
use asperity_simulation::scene::{Accuracy, Friction, SceneError};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A sweep as its file says it; what is absent is the paper's grid of 480 cases.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
#[schemars(title = "A sweep of `asperity calibrate`; what is absent is the default of 480 cases")]
pub struct Sweep {
    /// Slopes β of the cones against the plane, degrees; at most 30, under a cone 50.
    #[schemars(length(min = 1), inner(range(min = 0, max = 50)))]
    pub slopes_deg: Vec<f64>,
    /// Young's moduli.
    #[schemars(length(min = 1))]
    pub youngs_modulus: Vec<Stress>,
    /// Yield stresses.
    #[schemars(length(min = 1))]
    pub yield_stress: Vec<Stress>,
    /// Hardening exponents n.
    #[schemars(length(min = 1), inner(range(min = 0, max = 0.9)))]
    pub hardening_exponent: Vec<f64>,
    /// Hardening law: `hollomon` (power law in total strain) or `swift` (power law in plastic strain).
    pub hardening_law: HardeningLaw,
    /// Poisson's ratio.
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    pub poissons_ratio: f64,
    /// Crush by a plane, or indentation by a cone.
    pub tool: Tool,
    /// The stress that the hardening law speaks of.
    #[serde(alias = "stress")]
    pub stress_measure: StressMeasure,
    /// Coulomb's coefficient of friction between plane or cone and metal, from 0 to 2, or "sticking". Absent: 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// Error of K: draft 5 %, standard 1 %, reference 0.2 %, or a percentage from 0.2% to 5%.
    pub accuracy: Accuracy,
}

/// The grid of the paper's 480 tests, as far as it can be told: 10 slopes by 48 materials.
impl Default for Sweep {
    fn default() -> Self {
        let gpa = |e: f64| Stress(e * 1e9);
        let mpa = |s: f64| Stress(s * 1e6);
        Sweep {
            slopes_deg: (1..=10).map(f64::from).collect(),
            youngs_modulus: [70.0, 130.0, 210.0].map(gpa).to_vec(),
            yield_stress: [200.0, 300.0, 450.0, 700.0].map(mpa).to_vec(),
            hardening_exponent: vec![0.1, 0.2, 0.3, 0.5],
            hardening_law: HardeningLaw::Hollomon,
            poissons_ratio: 0.3,
            tool: Tool::Plane,
            stress_measure: StressMeasure::Cauchy,
            friction: None,
            accuracy: Accuracy::Standard,
        }
    }
}

/// More cases than this in one sweep are a slip of the pen.
const MOST_CASES: usize = 1_000_000;

impl Sweep {
    /// Checks every value.
    ///
    /// # Errors
    /// The first value that makes no sense, with the allowed range.
    pub fn validate(&self) -> Result<(), SceneError> {
        // before anything goes through pairs of values
        let Sweep { slopes_deg, youngs_modulus, yield_stress, hardening_exponent, .. } = self;
        let lists = [slopes_deg.len(), youngs_modulus.len(), yield_stress.len(), hardening_exponent.len()];
        let cases = lists.iter().try_fold(1_usize, |cases, &count| cases.checked_mul(count));
        if cases.is_none_or(|cases| cases > MOST_CASES) {
            let message = format!("more than {MOST_CASES} cases: give fewer values, or cut the sweep in two");
            return Err(error("", &message));
        }
        let slope_limit = match self.tool {
            Tool::Plane => 30.0,
            Tool::Cone => 50.0,
        };
        check_list(
            "slopes_deg",
            &self.slopes_deg,
            |b| b > 0.0 && b <= slope_limit,
            || format!("a slope must lie above 0 and at most at {slope_limit} degrees"),
        )?;
        let [flat, steepest] = range::VARIED_EXPONENTS;
        let moduli: Vec<f64> = self.youngs_modulus.iter().map(|s| s.0).collect();
        let yields: Vec<f64> = self.yield_stress.iter().map(|s| s.0).collect();
        check_list("youngs_modulus", &moduli, |e| e > 0.0, || "must be above 0".into())?;
        check_list("yield_stress", &yields, |s| s > 0.0, || "must be above 0".into())?;
        check_list(
            "hardening_exponent",
            &self.hardening_exponent,
            |n| (flat..=steepest).contains(&n),
            || format!("must lie from {flat} (perfect plasticity) to {steepest}"),
        )?;
        range::poissons_ratio(self.poissons_ratio)
            .map_err(|m| error("poissons_ratio", &(m + ": metals have 0.25 to 0.35")))?;
        for (i, s) in self.yield_stress.iter().enumerate() {
            for e in &self.youngs_modulus {
                range::yield_stress(*s, *e).map_err(|m| {
                    let message = format!("{m}, with E = {} GPa: check its unit", e.in_unit("GPa"));
                    error(&format!("yield_stress[{i}]"), &message)
                })?;
            }
        }
        self.friction.map_or(Ok(()), Friction::check)?;
        self.accuracy.check()?;
        Ok(())
    }

    /// Every case of the grid in its order: slope, modulus, yield stress, exponent (the last runs fastest).
    pub fn cases(&self) -> Vec<Case> {
        let mut cases = Vec::new();
        for &beta_deg in &self.slopes_deg {
            for e in &self.youngs_modulus {
                for s in &self.yield_stress {
                    for &exponent in &self.hardening_exponent {
                        let y =
                            Yielding { law: self.hardening_law, exponent, e_over_sy: rounded(e.0 / s.0, 12) };
                        cases.push(Case {
                            beta_deg,
                            yielding: Some(y),
                            poissons_ratio: self.poissons_ratio,
                            tool: self.tool,
                            stress_measure: self.stress_measure,
                            friction: self.friction.and_then(Friction::law),
                        });
                    }
                }
            }
        }
        cases
    }
}

fn error(path: &str, message: &str) -> SceneError {
    SceneError { path: path.into(), message: message.into() }
}

/// A list with at least one value, all of them `good`, none of them twice.
fn check_list(
    path: &str,
    values: &[f64],
    good: impl Fn(f64) -> bool,
    allowed: impl Fn() -> String,
) -> Result<(), SceneError> {
    if values.is_empty() {
        return Err(error(path, "must hold at least one value"));
    }
    for (i, &v) in values.iter().enumerate() {
        let path = format!("{path}[{i}]");
        if !v.is_finite() || !good(v) {
            return Err(SceneError { path, message: format!("{v} is not possible: {}", allowed()) });
        }
        if values[..i].contains(&v) {
            return Err(SceneError { path, message: format!("{v} stands in the list twice") });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_is_480_cases_of_12_ratios() {
        let sweep = Sweep::default();
        sweep.validate().unwrap();
        let cases = sweep.cases();
        assert_eq!(cases.len(), 480);
        let mut ratios: Vec<f64> = cases.iter().map(|c| c.yielding.unwrap().e_over_sy).collect();
        ratios.sort_by(f64::total_cmp);
        ratios.dedup();
        assert_eq!(ratios.len(), 12);
        assert_eq!((ratios[0], ratios[11]), (100.0, 1050.0));
    }

    #[test]
    fn impossible_values_are_named() {
        let path = |change: fn(&mut Sweep)| {
            let mut sweep = Sweep::default();
            change(&mut sweep);
            sweep.validate().unwrap_err().path
        };
        assert_eq!(path(|s| s.slopes_deg[2] = 0.0), "slopes_deg[2]");
        assert_eq!(path(|s| s.slopes_deg[1] = 1.0), "slopes_deg[1]");
        assert_eq!(path(|s| s.slopes_deg.clear()), "slopes_deg");
        assert_eq!(path(|s| s.hardening_exponent[0] = f64::NAN), "hardening_exponent[0]");
        assert_eq!(path(|s| s.yield_stress[3] = Stress(1e12)), "yield_stress[3]");
        assert_eq!(path(|s| s.poissons_ratio = 0.5), "poissons_ratio");
    }
}
