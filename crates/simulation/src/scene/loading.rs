//! Goal of a loading: a depth or a force.

use super::messages::{Check, check_range, error, positive};
use asperity_material::range::SceneError;
use asperity_material::units::{Force, Length, LineForce, UnitError, from_text, quantity_schema};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

/// Goal of the tool: exactly one of `depth` and `force`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Loading {
    /// Tool travel from first touch of the highest summit, corrected for penetration.
    #[schemars(example = "5 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<Length>,
    /// Force at the peak, instead of `depth`; per length of ridge in plane strain.
    #[schemars(example = "4 N", example = "4 N/mm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force: Option<ToolForce>,
    /// True where the tool then retreats to zero force.
    #[serde(default)]
    pub unload: bool,
    /// Number of times that the tool then returns to the same depth (or force) and retreats again; needs `unload`.
    #[schemars(range(max = 1000))]
    #[serde(default, skip_serializing_if = "is_zero")]
    pub reloads: usize,
}

fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// The end of loading, complete.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// At this corrected depth, m.
    Depth(f64),
    /// At this force, N (N/m in plane strain).
    Force(f64),
}

/// A force on a body of revolution, or per length of ridge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ToolForce {
    /// On the full body of revolution.
    Total(Force),
    /// Per length of ridge, in plane strain.
    PerLength(LineForce),
}

impl std::str::FromStr for ToolForce {
    type Err = UnitError;
    fn from_str(text: &str) -> Result<Self, UnitError> {
        if text.contains('/') {
            text.parse().map(ToolForce::PerLength)
        } else {
            text.parse().map(ToolForce::Total)
        }
    }
}

impl JsonSchema for ToolForce {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "ToolForce".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        quantity_schema(Force::UNITS.iter().chain(LineForce::UNITS))
    }
}

impl Serialize for ToolForce {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            ToolForce::Total(force) => force.serialize(serializer),
            ToolForce::PerLength(force) => force.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for ToolForce {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        from_text(
            deserializer,
            "a force as a string with a unit, for example \"4 N\" (\"4 N/mm\" in plane strain)",
        )
    }
}

impl Loading {
    /// The end of loading.
    ///
    /// # Errors
    /// Neither or both of `depth` and `force`; the path is relative to the loading table.
    pub fn target(&self) -> Result<Target, SceneError> {
        match (self.depth, self.force) {
            (Some(depth), None) => Ok(Target::Depth(depth.0)),
            (None, Some(ToolForce::Total(force))) => Ok(Target::Force(force.0)),
            (None, Some(ToolForce::PerLength(force))) => Ok(Target::Force(force.0)),
            (Some(_), Some(_)) => {
                let message = "does not go with `depth`: remove one of the two; --set \"loading={force='4 N', unload=true}\" \
                               replaces the whole table";
                Err(error("force", message))
            }
            (None, None) => Err(error(
                "",
                "set exactly one of `depth` or `force`, for example depth = \"5 um\" or force = \"4 N\"",
            )),
        }
    }

    pub(super) fn check(&self) -> Check {
        if self.reloads > 0 && !self.unload {
            return Err(error(
                "reloads",
                "needs unload = true: a body must be unloaded before it is loaded again",
            ));
        }
        let way_out = "each cycle costs as much as two unloadings";
        check_range("reloads", "the number of reloads", self.reloads as f64, 0.0, 1000.0, way_out)?;
        match self.target()? {
            Target::Depth(depth) => positive("depth", "the depth", Length(depth)),
            Target::Force(force) if force > 0.0 && force.is_finite() => Ok(()),
            Target::Force(force) => Err(error(
                "force",
                format!("must be finite and above 0, not {force} N: compression is positive"),
            )),
        }
    }
}
