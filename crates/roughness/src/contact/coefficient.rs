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

use asperity_material::{HardeningLaw, range};
use serde::{Deserialize, Serialize};
use std::fmt::Display;
use thiserror::Error;

/// The reason why a coefficient cannot be used.
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
        /// The value.
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

/// The place of the table that is nearest to a cone: inside its range the cone itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// ln of Y = K tan²β/σ_r and of the contact ratio a tan β/h at that place.
    pub logarithms: [f64; 2],
    /// Its tan β.
    pub tan: f64,
    /// Its X = E* tan β/σ_r.
    pub x: f64,
    /// True where slope and stiffness lie inside the calibrated range.
    pub inside: bool,
}

/// The coefficient file of the default sweep, as `asperity calibrate` writes it.
const COMMITTED_FILE: &str = include_str!("../../data/coefficient.toml");

impl Coefficient {
    /// The result of the default sweep that comes with the program; `asperity calibrate` regenerates it.
    ///
    /// # Errors
    /// As for [`Coefficient::from_toml`]: only if the file is damaged.
    pub fn committed() -> Result<Coefficient, CoefficientError> {
        Coefficient::from_toml(COMMITTED_FILE)
    }

    /// Reads and checks the TOML text of a coefficient file.
    ///
    /// # Errors
    /// Text that is no such file, or the first value that makes no sense with the allowed range.
    pub fn from_toml(text: &str) -> Result<Coefficient, CoefficientError> {
        let read: Coefficient =
            toml::from_str(text).map_err(|e| CoefficientError::Syntax(e.message().into()))?;
        read.checked()
    }

    /// The TOML text of this coefficient.
    ///
    /// # Errors
    /// A number that TOML cannot write.
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
        check(range::poissons_ratio(nu).is_ok(), "poissons_ratio", &nu, "in (-1, 0.5)")?;
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

    /// The entry of the table nearest to a cone of slope `tan_beta` at X = `x`.
    ///
    /// In each row of the table Y = K tan²β/σ_r is a function of X = E* tan β/σ_r; both are nearly the same
    /// for all slopes, so rows are read at equal X and mixed linearly in β, in logarithms. A slope outside
    /// the rows takes the nearest row, an X outside the rows their nearest.
    pub fn nearest(&self, tan_beta: f64, x: f64) -> Nearest {
        let beta = tan_beta.atan().to_degrees();
        let stiffness = x / tan_beta;
        let last = self.angles.len() - 1;
        let above = self.angles.iter().position(|a| a.beta_deg >= beta).unwrap_or(last);
        let below = if self.angles[above].beta_deg > beta { above.saturating_sub(1) } else { above };
        let (low, high) = (&self.angles[below], &self.angles[above]);
        let width = high.beta_deg - low.beta_deg;
        let t = if width > 0.0 { ((beta - low.beta_deg) / width).clamp(0.0, 1.0) } else { 0.0 };
        // the table is no rectangle: every row has its own range
        let (from, to) = (self.ends(below), self.ends(above));
        let [first, end]: [f64; 2] = std::array::from_fn(|i| from[i] + t * (to[i] - from[i]));
        // to a rounding
        let in_rows = x.ln() >= first - 1e-9 && x.ln() <= end + 1e-9;
        let at = if first < end { x.ln().clamp(first, end) } else { 0.5 * (first + end) };
        let (from, to) = (low.interpolated(at), high.interpolated(at));
        let within = |range: [f64; 2], v: f64| v >= range[0] && v <= range[1];
        let in_slopes = within([self.angles[0].beta_deg, self.angles[last].beta_deg], beta);
        Nearest {
            logarithms: std::array::from_fn(|i| from[i] + t * (to[i] - from[i])),
            tan: if in_slopes { tan_beta } else { high.beta_deg.to_radians().tan() },
            x: if in_rows { x } else { at.exp() },
            inside: in_rows
                && in_slopes
                && within(self.beta_deg, beta)
                && within(self.modulus_over_stress, stiffness),
        }
    }

    /// ln X of the first and last place that row `i` and those beside it hold: what lies on lines between
    /// such ends is held by both rows.
    fn ends(&self, i: usize) -> [f64; 2] {
        let beside = &self.angles[i.saturating_sub(1)..(i + 2).min(self.angles.len())];
        let ends = beside.iter().map(SlopeTable::ends);
        ends.reduce(|a, b| [a[0].max(b[0]), a[1].min(b[1])]).unwrap_or([f64::NAN; 2])
    }
}

impl SlopeTable {
    /// ln X of its first and last place.
    fn ends(&self) -> [f64; 2] {
        let tan = self.beta_deg.to_radians().tan();
        let end = |v: Option<&f64>| v.map_or(f64::NAN, |v| (v * tan).ln());
        [end(self.modulus_over_stress.first()), end(self.modulus_over_stress.last())]
    }

    /// ln Y and ln of the contact ratio at ln X = `x`, between lines from place to place.
    fn interpolated(&self, x: f64) -> [f64; 2] {
        let tan = self.beta_deg.to_radians().tan();
        let node = |i: usize| {
            let (y, ratio) = (self.k_over_stress[i] * tan * tan, self.contact_ratio[i]);
            ((self.modulus_over_stress[i] * tan).ln(), [y.ln(), ratio.ln()])
        };
        let last = self.modulus_over_stress.len() - 1;
        let Some(i) = (0..last).find(|i| x <= node(i + 1).0) else { return node(last).1 };
        let ((xa, a), (xb, b)) = (node(i), node(i + 1));
        let t = ((x - xa) / (xb - xa)).max(0.0);
        std::array::from_fn(|k| a[k] + t * (b[k] - a[k]))
    }
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
    fn the_table_is_met_and_reads_back() {
        let table = master_curve();
        let tan = 2.5f64.to_radians().tan();
        let found = table.nearest(tan, 20.0);
        assert!((found.logarithms[0].exp() / 6.787 - 1.0).abs() < 1e-9 && found.inside);
        assert_eq!((found.tan, found.x), (tan, 20.0));
        // beyond it the nearest place
        let steep = table.nearest(20f64.to_radians().tan(), 1e3);
        assert!((steep.x - 200.0).abs() < 1e-9 && (steep.tan - 10f64.to_radians().tan()).abs() < 1e-12);
        assert!((steep.logarithms[0].exp() / 11.471 - 1.0).abs() < 1e-9 && !steep.inside);
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
