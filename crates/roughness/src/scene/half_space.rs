//! `[half_space]`: how the half-space is solved.

use super::SceneError;
use super::error::error;
use crate::half_space::{FINEST_TOLERANCE, TOLERANCE};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Most points of the load curve of a half-space.
const MOST_POINTS: usize = 8;
/// Points of the load curve by default on maps of up to so many nodes; on larger ones each costs minutes, and
/// there is one.
const USUAL_POINTS: [(usize, usize); 2] = [(512 * 512, MOST_POINTS), (1024 * 1024, 6)];

/// Settings of the half-space.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HalfSpaceScene {
    /// Proven relative error of the pressures in the norm of the energy at which the search ends: 1e-6 by default; the loads of a joint and the contacts of scales are found to ten times it.
    #[schemars(extend("minimum" = 1e-10, "maximum" = 1e-2))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Points of the load curve beside first touch: by default 8, on maps of more than 512 x 512 points 6, of more than 1024 x 1024 points 1, which gives no curve between first touch and the load.
    #[schemars(extend("minimum" = 1, "maximum" = 8))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load_points: Option<usize>,
    /// True where the flow through the gap is computed: by default where a fluid is given or one closure alone is chosen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leak: Option<bool>,
    /// False where `asperity rough` leaves out the contact stiffness, which no other number needs: true by default.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<bool>,
}

impl HalfSpaceScene {
    /// True where nothing was said.
    pub fn is_default(&self) -> bool {
        *self == HalfSpaceScene::default()
    }

    /// The proven error to be reached.
    pub fn tolerance(&self) -> f64 {
        self.tolerance.unwrap_or(TOLERANCE)
    }

    /// Points of the load curve of a map of so many nodes.
    pub fn load_points(&self, nodes: usize) -> usize {
        let usual = || USUAL_POINTS.iter().find(|(most, _)| nodes <= *most).map_or(1, |(_, points)| *points);
        self.load_points.unwrap_or_else(usual)
    }

    pub(super) fn validate(&self) -> Result<(), SceneError> {
        if let Some(t) = self.tolerance.filter(|t| !(FINEST_TOLERANCE..=1e-2).contains(t)) {
            let message = format!("{t:e} must be between 1e-10 and 0.01: leave the key out for 1e-6");
            return error("half_space.tolerance", message);
        }
        match self.load_points {
            Some(n) if !(1..=MOST_POINTS).contains(&n) => {
                error("half_space.load_points", format!("{n} must be between 1 and {MOST_POINTS}"))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn large_maps_have_fewer_points_unless_the_scene_says_otherwise() {
        let usual = HalfSpaceScene::default();
        let points = [512, 513, 1024, 1025].map(|n| usual.load_points(n * n));
        assert_eq!(points, [8, 6, 6, 1]);
        assert_eq!(HalfSpaceScene { load_points: Some(3), ..usual }.load_points(2048 * 2048), 3);
    }
}
