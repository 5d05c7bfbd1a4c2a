//! The fitted dimensionless function Π of eq. (7): K/σ_r of any material and slope as a formula, and the
//! contact ratio.
//!
//! With X = E* tan β/σ_r, Y = K tan²β/σ_r and σ_r taken at ε_r = c tan β,
//!   ln Y = Σ_{k<5} a_k (ln X)^k + tan β Σ_{k<3} b_k (ln X)^k,
//! and likewise for ln(a tan β/h). The second sum is what a finite slope adds to the curve that all slopes
//! share.

use crate::fit::Data;
use asperity_numerics::least_squares::{powers, solve, value};
use serde::{Deserialize, Serialize};

/// A fitted function of ln X and tan β.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Formula {
    /// a_0 … a_4, then b_0 … b_2.
    pub coefficients: [f64; 8],
    /// Root mean square of the residuals of the logarithm: a relative error.
    #[serde(rename = "rms_error")]
    pub rms: f64,
    /// The largest of it.
    #[serde(rename = "largest_error")]
    pub largest: f64,
}

/// Π and the contact ratio with the range they were fitted in.
#[derive(Clone, Debug, PartialEq)]
pub struct Dimensionless {
    /// c of the σ_r that the formulas belong to.
    pub c: f64,
    /// ln Y.
    pub force: Formula,
    /// ln(a tan β/h).
    pub contact_ratio: Formula,
    /// Slope in degrees and the smallest and largest X at it.
    pub ranges: Vec<(f64, [f64; 2])>,
}

fn basis(ln_x: f64, tan_beta: f64) -> [f64; 8] {
    let p: [f64; 5] = powers(ln_x);
    [p[0], p[1], p[2], p[3], p[4], tan_beta * p[0], tan_beta * p[1], tan_beta * p[2]]
}

impl Formula {
    fn fit(rows: &[([f64; 8], f64, f64)]) -> Option<Formula> {
        let coefficients = solve(rows)?;
        let rest = rows.iter().map(|(b, y, _)| (y - value(&coefficients, b)).abs());
        let rms =
            (rest.clone().map(|r| r * r).sum::<f64>() / rows.len().max(9).saturating_sub(8) as f64).sqrt();
        Some(Formula { coefficients, rms, largest: rest.fold(0.0, f64::max) })
    }

    /// The value (not its logarithm) at X and tan β.
    pub fn value(&self, x: f64, tan_beta: f64) -> f64 {
        value(&self.coefficients, &basis(x.ln(), tan_beta)).exp()
    }
}

impl Dimensionless {
    /// Fits all samples of `data` with σ_r at ε_r = `c` tan β; `None` with too few slopes or materials for
    /// it.
    pub fn fit(data: &Data, c: f64) -> Option<Dimensionless> {
        let (mut force, mut ratio, mut ranges) = (Vec::new(), Vec::new(), Vec::new());
        for (beta, samples) in data.slopes.iter().filter(|s| !s.1.is_empty()) {
            let tan = beta.to_radians().tan();
            let mut range = [f64::INFINITY, 0.0_f64];
            for s in samples {
                let x = data.developed(tan, s, c);
                let stress = data.reduced_modulus * tan / x;
                range = [range[0].min(x), range[1].max(x)];
                force.push((basis(x.ln(), tan), (s.k_over_e * tan * tan / stress).ln(), 1.0));
                ratio.push((basis(x.ln(), tan), s.contact_ratio.ln(), 1.0));
            }
            ranges.push((*beta, range));
        }
        if force.len() < 16 {
            return None;
        }
        let (force, contact_ratio) = (Formula::fit(&force)?, Formula::fit(&ratio)?);
        Some(Dimensionless { c, force, contact_ratio, ranges })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::Sample;
    use crate::sweep::Sweep;

    #[test]
    fn a_function_of_the_assumed_form_is_met() {
        let truth =
            |x: f64, tan: f64| (0.3 + 0.8 * x.ln() - 0.05 * x.ln().powi(2) + 0.4 * tan * x.ln()).exp();
        let mut data = Data { slopes: Vec::new(), materials: Vec::new(), reduced_modulus: 1.1 };
        for case in Sweep::default().cases() {
            let tan = case.tan_beta();
            if data.slopes.last().is_none_or(|s| s.0 != case.beta_deg) {
                data.slopes.push((case.beta_deg, Vec::new()));
            }
            let hardening = case.hardening().unwrap();
            let stress = hardening.representative_stress(0.1 * tan);
            let x = 1.1 * tan / stress;
            let sample = Sample {
                material: 0,
                hardening,
                k_over_e: truth(x, tan) * stress / (tan * tan),
                error: 0.0,
                contact_ratio: truth(x, tan),
            };
            data.slopes.last_mut().unwrap().1.push(sample);
        }
        let fit = Dimensionless::fit(&data, 0.1).unwrap();
        assert!(fit.force.largest < 1e-6 && fit.contact_ratio.largest < 1e-6, "{fit:?}");
        assert!((fit.force.value(30.0, 0.1) / truth(30.0, 0.1) - 1.0).abs() < 1e-6);
        assert_eq!(fit.ranges.len(), 10);
    }
}
