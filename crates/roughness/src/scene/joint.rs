//! `[joint]`, `[thermal]`, `[electrical]`: what `asperity joint` makes of a surface.

use super::SceneError;
use super::error::error;
use crate::joint::{Bodies, BodiesAndMedium, FEWEST_LOADS, USUAL_LOADS};
use asperity_material::units::{ElectricalConductivity, Length, ThermalConductivity};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most loads of a joint.
const MOST_LOADS: usize = 200;
/// Most tiles along a side of a map.
const MOST_TILES: usize = 8;

/// The loads of a joint, and the roughness that its map does not hold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointScene {
    /// Loads from first touch to the largest: 25 by default.
    #[schemars(extend("minimum" = 5, "maximum" = 200))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub loads: Option<usize>,
    /// Height range, peak to valley, of roughness that the map does not hold: of it follow proven bounds of the elastic stiffness. By default the range that `surface.s_filter` removed.
    #[schemars(example = "20 nm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left_out: Option<Length>,
    /// Tiles along each side of the map, each levelled by a plane and pressed alone: the law is their mean, and how far they differ its repeatability. By default the whole map.
    #[schemars(extend("minimum" = 1, "maximum" = 8))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tiles: Option<usize>,
}

/// The heat that a joint lets through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Thermal {
    /// Thermal conductivity of the two bodies.
    pub conductivity: [ThermalConductivity; 2],
    /// That of the medium in the gap: without it the gap lets nothing through.
    #[schemars(example = "0.026 W/(m K)")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_conductivity: Option<ThermalConductivity>,
}

/// The electric current that a joint lets through.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Electrical {
    /// Electrical conductivity of the two bodies.
    pub conductivity: [ElectricalConductivity; 2],
    /// That of the medium in the gap: without it the gap lets nothing through.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub gap_conductivity: Option<ElectricalConductivity>,
}

impl JointScene {
    /// True where nothing was said.
    pub fn is_default(&self) -> bool {
        *self == JointScene::default()
    }

    /// Loads from first touch to the largest.
    pub fn loads(&self) -> usize {
        self.loads.unwrap_or(USUAL_LOADS)
    }

    pub(super) fn validate(&self) -> Result<(), SceneError> {
        if let Some(n) = self.loads.filter(|n| !(FEWEST_LOADS..=MOST_LOADS).contains(n)) {
            let message = format!("{n} must be between {FEWEST_LOADS} and {MOST_LOADS}");
            return error("joint.loads", message);
        }
        if let Some(n) = self.tiles.filter(|n| !(1..=MOST_TILES).contains(n)) {
            return error("joint.tiles", format!("{n} must be between 1 and {MOST_TILES}, along each side"));
        }
        match self.left_out {
            Some(range) if range.0 < 0.0 => error(
                "joint.left_out",
                format!("{range} must be 0 or above: the highest point less the lowest"),
            ),
            _ => Ok(()),
        }
    }
}

impl Thermal {
    /// The bodies with the medium, in W/(m K).
    pub fn conductors(&self) -> BodiesAndMedium {
        let conductivities = self.conductivity.map(|k| k.0);
        (Bodies { conductivities }, self.gap_conductivity.map(|k| k.0))
    }

    pub(super) fn validate(&self) -> Result<(), SceneError> {
        check("thermal", self.conductors(), "W/(m K): steel has 15 to 60 W/(m K)")
    }
}

impl Electrical {
    /// The bodies with the medium, in S/m.
    pub fn conductors(&self) -> BodiesAndMedium {
        let conductivities = self.conductivity.map(|k| k.0);
        (Bodies { conductivities }, self.gap_conductivity.map(|k| k.0))
    }

    pub(super) fn validate(&self) -> Result<(), SceneError> {
        check("electrical", self.conductors(), "S/m: copper has 58 MS/m")
    }
}

/// Bodies conduct; a medium may not.
fn check(table: &str, (bodies, medium): BodiesAndMedium, unit: &str) -> Result<(), SceneError> {
    if let Some(k) = bodies.conductivities.into_iter().find(|k| *k <= 0.0) {
        return error(&format!("{table}.conductivity"), format!("must be above 0, not {k} {unit}"));
    }
    match medium.filter(|k| *k < 0.0) {
        Some(k) => error(&format!("{table}.gap_conductivity"), format!("must be 0 or above, not {k} {unit}")),
        None => Ok(()),
    }
}
