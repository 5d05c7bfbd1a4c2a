//! `[fluid]`: what may leak through the gap.

use super::SceneError;
use super::error::error;
use asperity_material::units::{Length, Stress, from_text};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize};
use std::str::FromStr;

/// A fluid in the gap between surface and plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fluid {
    /// Its viscosity.
    #[schemars(schema_with = "viscosity_schema")]
    pub viscosity: Viscosity,
    /// Its pressure on both sides that a flow joins: left and right, then first and last row.
    pub pressures: [Stress; 2],
    /// True where it is a gas, which expands on its way: its flow is counted in pressure times volume.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub gas: bool,
    /// Mean free path of a gas: below ten of them the flow is no longer that of a continuum, and a warning says so.
    #[schemars(example = "68 nm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_free_path: Option<Length>,
    /// Of `asperity joint`: width of a seal across the flow over its length along it; by default that of the map.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_over_length: Option<f64>,
}

/// Gaps of so many mean free paths are taken for a continuum.
const CONTINUUM: f64 = 10.0;

/// A dynamic viscosity as it was written, in Pa s.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "String")]
pub struct Viscosity {
    text: String,
    /// In Pa s.
    pub pascal_seconds: f64,
}

impl Viscosity {
    /// The units it may be written in, in Pa s.
    pub const UNITS: &'static [(&'static str, f64)] = &[
        ("mPa s", 1e-3),
        ("Pa s", 1.0),
        ("mPa.s", 1e-3),
        ("Pa.s", 1.0),
        ("mPa·s", 1e-3),
        ("Pa·s", 1.0),
        ("cP", 1e-3),
    ];
}

fn viscosity_schema(_: &mut SchemaGenerator) -> Schema {
    json_schema!({"type": "string", "examples": ["1 mPa s", "18e-6 Pa s"]})
}

impl FromStr for Viscosity {
    type Err = String;

    fn from_str(text: &str) -> Result<Viscosity, String> {
        let read = |(unit, scale): &(&str, f64)| {
            let number = text.trim().strip_suffix(unit)?.trim().parse::<f64>().ok()?;
            Some(number * scale)
        };
        match Viscosity::UNITS.iter().find_map(read) {
            Some(pascal_seconds) => Ok(Viscosity { pascal_seconds, text: text.into() }),
            None => Err(format!(
                "\"{text}\" is not a viscosity: write a number with mPa s, Pa s or cP, for example \"1 mPa s\""
            )),
        }
    }
}

impl<'de> Deserialize<'de> for Viscosity {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Viscosity, D::Error> {
        from_text(deserializer, "a viscosity as a string with a unit, for example \"1 mPa s\"")
    }
}

impl From<Viscosity> for String {
    fn from(viscosity: Viscosity) -> String {
        viscosity.text
    }
}

impl Fluid {
    /// Flow of this `conductance` (volume flux times viscosity over pressure difference, m³): m³/s of a
    /// liquid; of a gas, whose density rises with its pressure, pressure times volume in Pa m³/s.
    pub fn flow(&self, conductance: f64) -> f64 {
        let [one, other] = self.pressures.map(|p| p.0);
        let drive = if self.gas { 0.5 * (one * one - other * other) } else { one - other };
        conductance * drive / self.viscosity.pascal_seconds
    }

    /// Conductance of the seal over that of a map of this width over length along the flow.
    pub fn seal_over_map(&self, width_over_length: f64) -> f64 {
        self.width_over_length.map_or(1.0, |shape| shape / width_over_length)
    }

    /// True where a gap (m) is so narrow that the molecules of the gas meet its walls more than each other.
    pub fn is_rare(&self, gap: f64) -> bool {
        self.gas && self.mean_free_path.is_some_and(|path| gap < CONTINUUM * path.0)
    }

    pub(super) fn validate(&self) -> Result<(), SceneError> {
        let value = self.viscosity.pascal_seconds;
        if !(value.is_finite() && value > 0.0) {
            let message = format!("{} must be above 0, for example \"1 mPa s\" (water)", self.viscosity.text);
            return error("fluid.viscosity", message);
        }
        if let Some(shape) = self.width_over_length.filter(|shape| !(shape.is_finite() && *shape > 0.0)) {
            return error(
                "fluid.width_over_length",
                format!("{shape} must be above 0: width over length of the seal"),
            );
        }
        if let Some(path) = self.mean_free_path.filter(|path| path.0 <= 0.0) {
            return error("fluid.mean_free_path", format!("{path} must be above 0: air has 68 nm at 1 bar"));
        }
        if self.gas && self.pressures.iter().any(|p| p.0 < 0.0) {
            return error("fluid.pressures", "those of a gas are absolute, so 0 or above");
        }
        Ok(())
    }
}
