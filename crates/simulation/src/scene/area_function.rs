//! The area function of a tool as an instrument was calibrated: its projected area over the contact depth.

use super::messages::{Check, error};
use asperity_material::units::{Length, from_text};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};

/// A(h) = C0 h² + C1 h + C2 h^½ + C3 h^¼ + …, up to h^(1/128): Oliver, Pharr, J. Mater. Res. 7 (1992) 1564, eq. 22.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AreaFunction {
    /// Unit of the depths that the coefficients are for, as a word: areas come in its square.
    #[schemars(example = &"nm")]
    #[serde(deserialize_with = "word")]
    pub unit: String,
    /// C0, C1, C2, …: one to nine.
    #[schemars(extend("minItems" = 1, "maxItems" = 9, "examples" = [[24.5, 310.0]]))]
    pub coefficients: Vec<f64>,
}

fn word<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    from_text(deserializer, "a unit of length as a word, for example \"nm\"")
}

/// Coefficients at most: eq. 22 ends with h^(1/128).
const MOST: usize = 9;

impl AreaFunction {
    /// Projected area (m²) at the contact depth `depth` (m).
    pub fn area(&self, depth: f64) -> f64 {
        let unit = self.metres();
        let power = |k: usize| if k == 0 { 2.0 } else { 0.5f64.powi(k as i32 - 1) };
        let terms = self.coefficients.iter().enumerate().map(|(k, c)| c * (depth / unit).powf(power(k)));
        terms.sum::<f64>() * unit * unit
    }

    /// Metres of its unit; NaN where it is none.
    fn metres(&self) -> f64 {
        Length(1.0).in_unit(&self.unit).recip()
    }

    /// Paths are relative to the table.
    pub(super) fn check(&self) -> Check {
        if !self.metres().is_finite() {
            let units: Vec<&str> = Length::UNITS.iter().map(|(name, _)| *name).collect();
            let units = units.join(", ");
            return Err(error("unit", format!("must be one of {units}, not \"{}\"", self.unit)));
        }
        let count = self.coefficients.len();
        if !(1..=MOST).contains(&count) {
            return Err(error(
                "coefficients",
                format!("must be from 1 to {MOST} numbers, C0 first, not {count}: leave out the last ones"),
            ));
        }
        let wrong = |(k, c): &(usize, &f64)| !c.is_finite() || (*k == 0 && **c < 0.0);
        if let Some((k, c)) = self.coefficients.iter().enumerate().find(wrong) {
            let least = if k == 0 { " and at least 0" } else { "" };
            return Err(error(
                format!("coefficients[{k}]"),
                format!("must be finite{least}, not {c}: a sharp Berkovich tip has C0 = 24.5 alone"),
            ));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: 24.5 · 100² + 300 · 100 + 40 · 10 + 8 · 100^¼ nm² at 100 nm.
    #[test]
    fn an_area_is_that_of_a_calculation_by_hand() {
        let worn = AreaFunction { unit: "nm".into(), coefficients: vec![24.5, 300.0, 40.0, 8.0] };
        let by_hand = 245_000.0 + 30_000.0 + 400.0 + 8.0 * 3.162_277_660_168_379_5;
        assert!((worn.area(100e-9) / (by_hand * 1e-18) - 1.0).abs() < 1e-14);
        // the same tip in another unit
        let coefficients = vec![24.5, 0.3, 40.0 * 1e-6 * 1e3f64.sqrt(), 8.0 * 1e-6 * 1e3f64.powf(0.25)];
        let same = AreaFunction { unit: "um".into(), coefficients };
        assert!((same.area(100e-9) / worn.area(100e-9) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn what_is_no_area_function_is_refused() {
        let of = |unit: &str, coefficients: &[f64]| AreaFunction {
            unit: unit.into(),
            coefficients: coefficients.to_vec(),
        };
        assert_eq!(of("nm", &[24.5, -3.0]).check(), Ok(()));
        for (function, path, word) in [
            (of("inch", &[24.5]), "unit", "nm"),
            (of("nm", &[]), "coefficients", "1 to 9"),
            (of("nm", &[1.0; 10]), "coefficients", "not 10"),
            (of("nm", &[-24.5]), "coefficients[0]", "at least 0"),
            (of("nm", &[24.5, f64::NAN]), "coefficients[1]", "finite"),
        ] {
            let error = function.check().unwrap_err();
            assert!(error.path == path && error.message.contains(word), "{error:?}");
        }
    }
}
