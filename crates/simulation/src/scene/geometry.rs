//! The bodies of a scene: asperities, substrate, tool.

use super::SceneError;
use super::measured::{self, Points};
use asperity_material::units::Length;
use asperity_mesh::outline::Outline;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;
use std::sync::Arc;

/// One asperity as written: a cone (`height`, `slope_deg`, …), a sphere (`radius`) or a measured outline (`profile`).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Asperity {
    /// Base plane to the real (rounded) summit.
    #[schemars(example = "20 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Length>,
    /// Angle β between flank and base plane, degrees.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 90))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_deg: Option<f64>,
    /// Radius of the sphere (cylinder) tangent to the flanks that rounds the tip; absent or 0: sharp.
    #[schemars(example = "10 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_radius: Option<Length>,
    /// Radius of the fillet at its outer foot; absent or 0: sharp.
    #[schemars(example = "5 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub valley_radius: Option<Length>,
    /// Flat distance between its outer foot and the next asperity; absent: 0.
    #[schemars(example = "20 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<Length>,
    /// Radius of a spherical (cylindrical) asperity; excludes the keys above but `height` and `spacing`. Its height is
    /// a quarter of the radius if absent, and half the radius at most: the foot of half a ball is vertical.
    #[schemars(example = "50 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<Length>,
    /// A measured outline instead of the keys above but `spacing`: a csv file, relative to the scene file, with columns such as
    /// r_um,z_um (or nm, mm, m), z up. Half of it from its axis outward, in plane strain also the whole ridge from foot to foot.
    /// A resolved scene has `points` in its place.
    #[schemars(example = "asperity.csv")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub profile: Option<PathBuf>,
    /// Instead of `profile`: r and z, point by point.
    #[schemars(extend("examples" = [[["0 um", "20 um"], ["114 um", "0 um"]]]))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Points>,
    /// Of a measured outline: standard deviation of its heights that is smoothed away; absent: as far as neighbouring points
    /// scatter.
    #[schemars(example = "10 nm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Length>,
}

/// Height over radius of a spherical asperity whose height is not given: its foot is 41 degrees steep.
pub const CAP_HEIGHT: f64 = 0.25;

/// The greatest height over radius: a foot of 60 degrees.
pub const HIGHEST_CAP: f64 = 0.5;

/// The shape of an asperity, complete. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum AsperityForm {
    /// A cone (a wedge in plane strain), sharp or rounded.
    Cone {
        /// Base plane to the real summit, m.
        height: f64,
        /// Angle β between flank and base plane, radians.
        slope: f64,
        /// Tip radius, m; 0: sharp.
        tip_radius: f64,
        /// Fillet radius at the outer foot, m; 0: sharp.
        valley_radius: f64,
    },
    /// A cap of a ball (of a cylinder in plane strain).
    Sphere {
        /// Radius of the ball, m.
        radius: f64,
        /// Base plane to summit, m.
        height: f64,
    },
    /// A measured outline.
    Measured {
        /// Seen from its summit, from foot to foot, m.
        outline: Arc<Outline>,
        /// Base plane to summit, m.
        height: f64,
    },
}

impl AsperityForm {
    /// Base plane to summit, m.
    pub fn height(&self) -> f64 {
        match *self {
            AsperityForm::Cone { height, .. }
            | AsperityForm::Sphere { height, .. }
            | AsperityForm::Measured { height, .. } => height,
        }
    }

    /// Half width of the foot on the base plane, fillets left out, m; of an outline that is not symmetric the
    /// mean of both sides.
    pub fn base_radius(&self) -> f64 {
        let [left, right] = self.feet();
        if left == right { left } else { 0.5 * (left + right) }
    }

    /// Widths of its left and right side on the base plane, fillets left out, m.
    pub fn feet(&self) -> [f64; 2] {
        if let AsperityForm::Measured { outline, .. } = self {
            let [left, right] = outline.ends();
            return [-left, right];
        }
        let half = match *self {
            // the flanks meet R (1/cos β - 1) above the rounded summit
            AsperityForm::Cone { height, slope, tip_radius, .. } => {
                (height + tip_radius * (slope.cos().recip() - 1.0)) / slope.tan()
            }
            AsperityForm::Sphere { radius, height } => (height * (2.0 * radius - height)).sqrt(),
            AsperityForm::Measured { .. } => f64::NAN,
        };
        [half; 2]
    }
}

/// The block of metal under the asperities.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Substrate {
    /// Outer radius; in plane strain half the width of the block, the ridges in its middle. Absent: sized from the
    /// contact. Under asperities between symmetric sides it is always that of the row, with half the last spacing at its ends.
    #[schemars(example = "2 mm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<Length>,
    /// From the base plane of the asperities down to the fixed base. Absent in axisymmetry: sized from the contact.
    #[schemars(example = "2 mm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub depth: Option<Length>,
}

impl Asperity {
    /// The shape that the keys describe.
    ///
    /// # Errors
    /// Keys that are missing or exclude each other; the path is relative to the asperity's table. Ranges are
    /// checked by [`super::Scene::validate`].
    pub fn form(&self) -> Result<AsperityForm, SceneError> {
        let error = |path: &str, message: &str| SceneError { path: path.into(), message: message.into() };
        if self.profile.is_some() || self.points.is_some() {
            return self.measured_form();
        }
        if self.tolerance.is_some() {
            return Err(error("tolerance", "belongs to a measured outline: remove it, or give `profile`"));
        }
        if let Some(radius) = self.radius {
            let others = [
                ("slope_deg", self.slope_deg.is_some()),
                ("tip_radius", self.tip_radius.is_some()),
                ("valley_radius", self.valley_radius.is_some()),
            ];
            return match others.iter().find(|(_, given)| *given) {
                Some((key, _)) => Err(error(
                    key,
                    "does not go with `radius`, which makes a spherical asperity: remove one of the two",
                )),
                None => Ok(AsperityForm::Sphere {
                    radius: radius.0,
                    height: self.height.map_or(CAP_HEIGHT * radius.0, |h| h.0),
                }),
            };
        }
        let missing = |key: &str, example: &str| {
            error(
                "",
                &format!("`{key}` is missing: give {example}, or `radius` alone for a spherical asperity"),
            )
        };
        let height = self.height.ok_or_else(|| missing("height", "height = \"20 um\""))?;
        let slope_deg = self.slope_deg.ok_or_else(|| missing("slope_deg", "slope_deg = 10"))?;
        Ok(AsperityForm::Cone {
            height: height.0,
            slope: slope_deg.to_radians(),
            tip_radius: self.tip_radius.map_or(0.0, |r| r.0),
            valley_radius: self.valley_radius.map_or(0.0, |r| r.0),
        })
    }

    /// The measured outline that the keys give.
    fn measured_form(&self) -> Result<AsperityForm, SceneError> {
        let error = |path: &str, message: &str| SceneError { path: path.into(), message: message.into() };
        let others = [
            ("height", self.height.is_some()),
            ("slope_deg", self.slope_deg.is_some()),
            ("tip_radius", self.tip_radius.is_some()),
            ("valley_radius", self.valley_radius.is_some()),
            ("radius", self.radius.is_some()),
        ];
        if let Some((key, _)) = others.iter().find(|(_, given)| *given) {
            return Err(error(
                key,
                "does not go with a measured outline, which has its own: remove one of the two",
            ));
        }
        let Some(points) = &self.points else {
            return Err(error("profile", "was not read: give `points`, or read the scene with its files"));
        };
        if self.profile.is_some() {
            return Err(error("profile", "does not go with `points`: remove one of the two"));
        }
        let (outline, height) = measured::asperity(points, self.tolerance)?;
        Ok(AsperityForm::Measured { outline, height })
    }
}

/// Support of the lateral side of the substrate.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Lateral {
    /// Nothing.
    #[default]
    Free,
    /// A frictionless wall: the body repeats beyond it.
    Symmetric,
}
