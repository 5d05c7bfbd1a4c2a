//! `[scales]`: what `asperity scales` is told of the measurement.

use super::SceneError;
use super::error::error;
use asperity_material::units::Length;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The instrument that measured a map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScalesScene {
    /// Radius of the tip of the stylus or of the probe: where the surface is more curved than it, the measurement is of the tip.
    #[schemars(example = "2 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_radius: Option<Length>,
}

impl ScalesScene {
    /// True where nothing was said.
    pub fn is_default(&self) -> bool {
        *self == ScalesScene::default()
    }

    pub(super) fn validate(&self) -> Result<(), SceneError> {
        match self.tip_radius {
            Some(radius) if radius.0 <= 0.0 => error(
                "scales.tip_radius",
                format!("{radius} must be above 0: a stylus has 2 um to 10 um, a sharp probe 10 nm"),
            ),
            _ => Ok(()),
        }
    }
}
