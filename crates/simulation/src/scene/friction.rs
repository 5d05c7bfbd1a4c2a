//! The key `friction` of a tool.

use super::SceneError;
use super::messages::check_range;
use asperity_solver::contact::slip::Friction as Law;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

/// Friction between tool and surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// Coulomb's coefficient, from 0 to 2.
    Coefficient(f64),
    /// A point that touches sticks.
    Sticking,
}

/// The word for what sticks.
const STICKING: &str = "sticking";

/// The values of the key, in words.
const EXPECTED: &str = "a coefficient from 0 to 2, for example 0.15, or \"sticking\"";

impl Friction {
    /// The law; `None` where there is nothing to slip against.
    pub fn law(self) -> Option<Law> {
        match self {
            Friction::Coefficient(0.0) => None,
            Friction::Coefficient(coefficient) => Some(Law::Coulomb(coefficient)),
            Friction::Sticking => Some(Law::Sticking),
        }
    }

    /// Checks that the coefficient lies in its range.
    ///
    /// # Errors
    /// The key and its range.
    pub fn check(self) -> Result<(), SceneError> {
        match self {
            Friction::Sticking => Ok(()),
            Friction::Coefficient(value) => {
                let way_out = "published analyses take 0.1 to 0.4; \"sticking\" is the limit of rough tools";
                check_range("friction", "the coefficient of friction", value, 0.0, 2.0, way_out)
            }
        }
    }
}

impl Serialize for Friction {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Friction::Coefficient(coefficient) => serializer.serialize_f64(*coefficient),
            Friction::Sticking => serializer.serialize_str(STICKING),
        }
    }
}

impl<'de> Deserialize<'de> for Friction {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Reader)
    }
}

struct Reader;

impl Visitor<'_> for Reader {
    type Value = Friction;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{EXPECTED} for `friction`")
    }

    fn visit_f64<E: Error>(self, value: f64) -> Result<Friction, E> {
        Ok(Friction::Coefficient(value))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<Friction, E> {
        Ok(Friction::Coefficient(value as f64))
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<Friction, E> {
        Ok(Friction::Coefficient(value as f64))
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Friction, E> {
        if text == STICKING {
            return Ok(Friction::Sticking);
        }
        Err(E::custom(format!("`friction` takes {EXPECTED}, not \"{text}\"")))
    }
}

impl JsonSchema for Friction {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Friction".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [{ "type": "number", "minimum": 0, "maximum": 2 }, { "const": STICKING }],
            "examples": [0.15, STICKING],
        })
    }
}
