//! Result of a calibration: the representative strain and the force and contact radius of a crushed cone.
//!
//! The file `coefficient.toml`:
//! ```toml
//! law = "hollomon"                     # hardening law of the calibration
//! poissons_ratio = 0.3
//! c = 0.0975                           # ε_r = c tan β
//! ci95 = [0.095, 0.100]                # 95 % interval of c
//! unloading_exponent = 1.22            # m of F = F_j (1 - u/u_j)^m
//! beta_deg = [1.0, 10.0]               # range of slopes
//! modulus_over_stress = [20.0, 800.0]  # range of E*/σ_r
//! [[angle]]                            # one per slope, ascending
//! beta_deg = 1.0
//! modulus_over_stress = [200.0, 400.0] # E*/σ_r, ascending
//! k_over_stress = [1.2e4, 1.4e4]       # K/σ_r, F = K h²
//! contact_ratio = [0.65, 0.8]          # a tan β/h
//! ```

use asperity_law::HardeningLaw;
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_2_PI, PI};
use std::fmt::Display;
use thiserror::Error;

/// Why a coefficient cannot be used.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum CoefficientError {
    /// The text is not what the file should be.
    #[error(
        "the coefficient file cannot be read: {0}; it is the `coefficient.toml` that `asperity calibrate` writes"
    )]
    Syntax(String),
    /// A value makes no sense.
    #[error(
        "in the coefficient file {name} = {value}, but it must be {allowed}; `asperity calibrate` writes a new one"
    )]
    Value {
        /// Which value.
        name: String,
        /// Its value.
        value: String,
        /// The allowed range.
        allowed: &'static str,
    },
}

/// Force and contact radius of cones of one slope, against E*/σ_r.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlopeTable {
    /// Slope β in degrees.
    pub beta_deg: f64,
    /// E*/σ_r, ascending, pure numbers.
    pub modulus_over_stress: Vec<f64>,
    /// K/σ_r with F = K h² (eq. (7)), one per entry of `modulus_over_stress`.
    pub k_over_stress: Vec<f64>,
    /// Contact radius times tan β over depth, one per entry.
    pub contact_ratio: Vec<f64>,
}

/// The result of a calibration.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coefficient {
    /// Hardening law the representative stress belongs to.
    pub law: HardeningLaw,
    /// Poisson's ratio of the cases.
    pub poissons_ratio: f64,
    /// c of ε_r = c tan β (eq. (9) prints 0.13).
    pub c: f64,
    /// 95 % interval of c.
    pub ci95: [f64; 2],
    /// m of the unloading curve F = F_j (1 - u/u_j)^m, from unloaded cones.
    pub unloading_exponent: f64,
    /// Range of slopes, degrees.
    pub beta_deg: [f64; 2],
    /// Range of E*/σ_r.
    pub modulus_over_stress: [f64; 2],
    /// The table, slopes ascending.
    #[serde(rename = "angle")]
    pub angles: Vec<SlopeTable>,
}

/// Force and contact of a cone as the calibration sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// K/σ_r.
    pub k_over_stress: f64,
    /// a tan β/h.
    pub contact_ratio: f64,
    /// Whether slope and stiffness lie inside the calibrated range.
    pub inside: bool,
}

/// The coefficient file of the default sweep, as `asperity calibrate` writes it.
const COMMITTED: &str = include_str!("../../data/coefficient.toml");

impl Coefficient {
    /// The result of the default sweep that comes with the program; `asperity calibrate` regenerates it.
    pub fn committed() -> Result<Coefficient, CoefficientError> {
        Coefficient::from_toml(COMMITTED)
    }

    /// Reads and checks the TOML text of a coefficient file.
    pub fn from_toml(text: &str) -> Result<Coefficient, CoefficientError> {
        let read: Coefficient =
            toml::from_str(text).map_err(|e| CoefficientError::Syntax(e.message().into()))?;
        read.checked()
    }

    /// The TOML text of this coefficient.
    pub fn to_toml(&self) -> Result<String, CoefficientError> {
        toml::to_string(self).map_err(|e| CoefficientError::Syntax(e.to_string()))
    }

    fn checked(self) -> Result<Coefficient, CoefficientError> {
        let check = |ok: bool, name: &str, value: &dyn Display, allowed: &'static str| {
            let (name, value) = (name.into(), value.to_string());
            ok.then_some(()).ok_or(CoefficientError::Value { name, value, allowed })
        };
        let ascending = |v: &[f64]| v.windows(2).all(|w| w[0] < w[1]);
        let positive = |v: &[f64]| !v.is_empty() && v.iter().all(|x| x.is_finite() && *x > 0.0);
        let (c, m, nu) = (self.c, self.unloading_exponent, self.poissons_ratio);
        check(c.is_finite() && c > 0.0 && c < 10.0, "c", &c, "between 0 and 10")?;
        check((1.0..=3.0).contains(&m), "unloading_exponent", &m, "between 1 and 3")?;
        check(nu > -1.0 && nu < 0.5, "poissons_ratio", &nu, "in (-1, 0.5)")?;
        let slopes: Vec<f64> = self.angles.iter().map(|a| a.beta_deg).collect();
        let slopes_fit = positive(&slopes) && ascending(&slopes) && slopes.iter().all(|b| *b < 90.0);
        let allowed = "one or more slopes between 0 and 90, ascending";
        check(slopes_fit, "[[angle]] beta_deg", &"…", allowed)?;
        for angle in &self.angles {
            let n = angle.modulus_over_stress.len();
            let lists = [&angle.modulus_over_stress, &angle.k_over_stress, &angle.contact_ratio];
            let equal = lists.iter().all(|v| positive(v) && v.len() == n);
            let allowed = "three lists of equal length, positive, modulus_over_stress ascending";
            check(equal && ascending(&angle.modulus_over_stress), "[[angle]]", &"…", allowed)?;
        }
        Ok(self)
    }

    /// K/σ_r and contact ratio of a cone of slope `tan_beta` at stiffness `modulus_over_stress` = E*/σ_r.
    ///
    /// 1. In each row of the table Y = K tan²β/σ_r is a function of X = E* tan β/σ_r; both are nearly the same for
    ///    all slopes, so rows are read at equal X and mixed linearly in β, in logarithms.
    /// 2. Below the first X of a row the cone is elastic: the lower of Sneddon's Y = 2X/π and the row's own line
    ///    extrapolated. Above the last X the line is extrapolated.
    /// 3. Slopes outside the rows take the nearest row.
    pub fn cone(&self, tan_beta: f64, modulus_over_stress: f64) -> Cone {
        let beta = tan_beta.atan().to_degrees();
        let x = (modulus_over_stress * tan_beta).ln();
        let above = self.angles.iter().position(|a| a.beta_deg >= beta).unwrap_or(self.angles.len() - 1);
        let below = if self.angles[above].beta_deg > beta { above.saturating_sub(1) } else { above };
        let (low, high) = (&self.angles[below], &self.angles[above]);
        let width = high.beta_deg - low.beta_deg;
        let t = if width > 0.0 { ((beta - low.beta_deg) / width).clamp(0.0, 1.0) } else { 0.0 };
        let ((y0, r0), (y1, r1)) = (low.at(x), high.at(x));
        let within = |range: [f64; 2], v: f64| v >= range[0] && v <= range[1];
        // the table is no rectangle: every row has its own range
        let in_rows = low.holds(x) && high.holds(x);
        Cone {
            k_over_stress: (y0 + t * (y1 - y0)).exp() / (tan_beta * tan_beta),
            contact_ratio: (r0 + t * (r1 - r0)).exp(),
            inside: within(self.beta_deg, beta)
                && within(self.modulus_over_stress, modulus_over_stress)
                && in_rows,
        }
    }
}

impl SlopeTable {
    /// Whether ln X = `x` lies between the first and the last of the row, to a rounding.
    fn holds(&self, x: f64) -> bool {
        let tan = self.beta_deg.to_radians().tan();
        let end = |v: Option<&f64>| v.map_or(f64::NAN, |v| (v * tan).ln());
        x >= end(self.modulus_over_stress.first()) - 1e-9 && x <= end(self.modulus_over_stress.last()) + 1e-9
    }

    /// ln Y and ln of the contact ratio at ln X = `x`.
    fn at(&self, x: f64) -> (f64, f64) {
        let tan = self.beta_deg.to_radians().tan();
        let node = |i: usize| {
            (
                (self.modulus_over_stress[i] * tan).ln(),
                (self.k_over_stress[i] * tan * tan).ln(),
                self.contact_ratio[i].ln(),
            )
        };
        let sneddon = |x: f64| x + FRAC_2_PI.ln();
        let last = self.modulus_over_stress.len() - 1;
        let (x0, y0, r0) = node(0);
        if last == 0 || x < x0 {
            // the row's first line carried down until it meets the elastic one
            let slope = if last == 0 { 0.0 } else { ((node(1).1 - y0) / (node(1).0 - x0)).clamp(0.0, 0.95) };
            let (line, elastic) = (y0 + slope * (x - x0), sneddon(x));
            let meets = (x0 - (sneddon(x0) - y0).max(0.0) / (1.0 - slope)).min(x0);
            let t = if x < x0 && meets < x0 { ((x0 - x) / (x0 - meets)).clamp(0.0, 1.0) } else { 0.0 };
            let t = if x < x0 && meets >= x0 { 1.0 } else { t };
            return (line.min(elastic), r0 + t * (FRAC_2_PI.ln() - r0));
        }
        let i = (0..last).find(|i| x <= node(i + 1).0).unwrap_or(last - 1);
        let ((xa, ya, ra), (xb, yb, rb)) = (node(i), node(i + 1));
        let t = (x - xa) / (xb - xa);
        // the contact ratio is not carried beyond the table: it would leave the range of possible values
        (ya + t * (yb - ya), ra + t.min(1.0) * (rb - ra))
    }
}

/// Mean pressure over the island in units of σ_r, K tan²β/(π σ_r).
pub fn island_pressure(cone: &Cone, tan_beta: f64) -> f64 {
    cone.k_over_stress * tan_beta * tan_beta / PI
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A table on the published master curve of indentation data (E* tan β/σ_r from 5 to 200).
    pub(crate) fn master_curve() -> Coefficient {
        let xy =
            [(5.0, 2.895), (10.0, 4.731), (20.0, 6.787), (50.0, 9.276), (100.0, 10.646), (200.0, 11.471)];
        let angle = |beta_deg: f64| {
            let tan = beta_deg.to_radians().tan();
            SlopeTable {
                beta_deg,
                modulus_over_stress: xy.iter().map(|(x, _)| x / tan).collect(),
                k_over_stress: xy.iter().map(|(_, y)| y / (tan * tan)).collect(),
                contact_ratio: vec![0.7, 0.8, 0.9, 0.95, 1.0, 1.02],
            }
        };
        Coefficient {
            law: HardeningLaw::Hollomon,
            poissons_ratio: 0.3,
            c: 0.0975,
            ci95: [0.095, 0.1],
            unloading_exponent: 1.22,
            beta_deg: [1.0, 10.0],
            modulus_over_stress: [28.0, 11000.0],
            angles: vec![angle(1.0), angle(4.0), angle(10.0)],
        }
    }

    #[test]
    fn the_table_is_met_joins_the_elastic_cone_and_reads_back() {
        let table = master_curve();
        let tan = 2.5f64.to_radians().tan();
        let y = |x: f64| table.cone(tan, x / tan).k_over_stress * tan * tan;
        assert!((y(20.0) / 6.787 - 1.0).abs() < 1e-9);
        assert!((y(0.1) / (0.1 * FRAC_2_PI) - 1.0).abs() < 1e-9);
        assert!((table.cone(tan, 0.01 / tan).contact_ratio - FRAC_2_PI).abs() < 1e-9);
        // monotone and without a jump
        let xs: Vec<f64> = (0..2000).map(|i| 0.1 * 1.005f64.powi(i)).collect();
        for w in xs.windows(2) {
            let (a, b) = (y(w[0]), y(w[1]));
            assert!(b > a && b < 1.011 * a, "{w:?} {a} {b}");
            let (a, b) =
                (table.cone(tan, w[0] / tan).contact_ratio, table.cone(tan, w[1] / tan).contact_ratio);
            assert!((b / a - 1.0).abs() < 0.02);
        }
        assert_eq!(Coefficient::from_toml(&table.to_toml().unwrap()).unwrap(), table);
    }

    #[test]
    fn a_table_that_makes_no_sense_is_refused() {
        let good = master_curve();
        let mut bad = vec![good.clone(); 5];
        bad[0].c = f64::NAN;
        bad[1].angles.clear();
        bad[2].angles[0].contact_ratio.pop();
        bad[3].angles.reverse();
        bad[4].unloading_exponent = 0.5;
        for b in bad {
            assert!(b.checked().is_err());
        }
        assert!(Coefficient::from_toml("c = 1").is_err());
    }
}
