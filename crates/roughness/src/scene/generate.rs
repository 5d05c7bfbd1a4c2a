//! The table of a generated surface.

use super::SceneError;
use super::error::error;
use crate::surface::generate::{Grid, Kind, KindName, Target};
use asperity_material::units::Length;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A surface made from random numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GenerateScene {
    /// Ground, milled, sanded or self-affine.
    pub kind: KindName,
    /// Arithmetic mean height.
    #[schemars(example = "2.95 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ra: Option<Length>,
    /// atan of the mean |∇h|, degrees.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 80))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mean_slope_deg: Option<f64>,
    /// Length along x and y.
    #[schemars(extend("examples" = [["1 mm", "1 mm"]]))]
    pub size: [Length; 2],
    /// Points along x and y, at least 2.
    #[schemars(extend("examples" = [[1024, 1024]]))]
    pub pixels: [usize; 2],
    /// Seed of the random numbers.
    #[serde(default = "one")]
    pub seed: u64,
    /// Hurst exponent, of "self-affine".
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hurst: Option<f64>,
    /// Longest wave of the power law, of "self-affine".
    #[schemars(example = "128 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rolloff: Option<Length>,
    /// Shortest wave, of "self-affine".
    #[schemars(example = "16 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cutoff: Option<Length>,
}

fn one() -> u64 {
    1
}

impl GenerateScene {
    /// Arguments of the generator, checked.
    pub(super) fn request(&self) -> Result<(Kind, Grid, Target), SceneError> {
        let at = |key: &str| format!("surface.generate.{key}");
        let [nx, ny] = self.pixels;
        if nx < 2 || ny < 2 || nx.saturating_mul(ny) > 1 << 28 {
            return error(
                &at("pixels"),
                format!("{nx} x {ny}: at least 2 along each side and at most 268435456 in all"),
            );
        }
        if self.size.iter().any(|l| l.0 <= 0.0) {
            return error(&at("size"), format!("{} x {}: both must be above 0", self.size[0], self.size[1]));
        }
        if self.ra.is_some_and(|r| r.0 <= 0.0) {
            return error(&at("ra"), "Ra must be above 0");
        }
        if self.mean_slope_deg.is_some_and(|b| !(b > 0.0 && b < 80.0)) {
            return error(&at("mean_slope_deg"), "the mean slope must be above 0 and below 80 degrees");
        }
        let target = match (self.ra, self.mean_slope_deg) {
            (Some(ra), Some(slope)) => Target::Both(ra.0, slope.to_radians().tan()),
            (Some(ra), None) => Target::Height(ra.0),
            (None, Some(slope)) => Target::Slope(slope.to_radians().tan()),
            (None, None) => return error("surface.generate", "give ra, mean_slope_deg, or both"),
        };
        let spectrum = [
            ("hurst", self.hurst.is_some()),
            ("rolloff", self.rolloff.is_some()),
            ("cutoff", self.cutoff.is_some()),
        ];
        let kind = match (self.kind, spectrum.iter().find(|(_, given)| *given)) {
            (KindName::SelfAffine, _) => self.self_affine(target)?,
            (_, Some((key, _))) => return error(&at(key), "only kind = \"self-affine\" has this key"),
            (KindName::Ground, None) => Kind::Ground,
            (KindName::Milled, None) => Kind::Milled,
            (KindName::Sanded, None) => Kind::Sanded,
        };
        let pixel = [self.size[0].0 / nx as f64, self.size[1].0 / ny as f64];
        Ok((kind, Grid { nodes: self.pixels, pixel, seed: self.seed }, target))
    }

    fn self_affine(&self, target: Target) -> Result<Kind, SceneError> {
        let (Some(hurst), Some(rolloff), Some(cutoff)) = (self.hurst, self.rolloff, self.cutoff) else {
            return error("surface.generate", "kind = \"self-affine\" needs hurst, rolloff and cutoff");
        };
        if !(hurst > 0.0 && hurst <= 1.0) {
            return error(
                "surface.generate.hurst",
                format!("{hurst} must be above 0 and at most 1, for example 0.8"),
            );
        }
        if matches!(target, Target::Both(..)) {
            return error(
                "surface.generate.mean_slope_deg",
                "a self-affine surface of given spectrum has one free number: give ra or mean_slope_deg, not both",
            );
        }
        Ok(Kind::SelfAffine { hurst, rolloff: rolloff.0, cutoff: cutoff.0 })
    }
}
