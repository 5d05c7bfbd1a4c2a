//! `[fluid]`: what may leak through the gap.

use super::SceneError;
use super::error::error;
use asperity_material::units::{Stress, from_text};
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
}

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
    pub(super) fn validate(&self) -> Result<(), SceneError> {
        let value = self.viscosity.pascal_seconds;
        if !(value.is_finite() && value > 0.0) {
            let message = format!("{} must be above 0, for example \"1 mPa s\" (water)", self.viscosity.text);
            return error("fluid.viscosity", message);
        }
        Ok(())
    }
}
