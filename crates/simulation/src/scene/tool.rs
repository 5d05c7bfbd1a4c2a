//! The tool of a scene: its shape, by keys, by name or measured, and how it gives way.

use super::SceneError;
use super::area_function::AreaFunction;
use super::friction::Friction;
use super::measured::{self, Points};
use super::messages::{Check, error, half_apex, inside, length, not_negative, positive, slope};
use asperity_material::units::{Compliance, Length, Stress};
use asperity_material::{Elastic, range, refuse_custom, write_custom};
use asperity_mesh::outline::Outline;
use asperity_mesh::{OwnTool, Punch};
use asperity_solver::contact::tool;
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::f64::consts::PI;
use std::path::PathBuf;
use std::sync::Arc;

/// Outline of the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ToolShape {
    /// A plane that flattens the summits.
    Plane,
    /// A cone (wedge) on the axis.
    Cone,
    /// A sphere (cylinder) on the axis.
    Sphere,
    /// A measured outline.
    Profile,
    /// The cone of the same projected area as Berkovich's three-sided pyramid: half apex angle 70.30 degrees.
    Berkovich,
    /// The cone of the same projected area as Vickers' four-sided pyramid: half apex angle 70.30 degrees.
    Vickers,
    /// A cone by its half apex angle, with a spherical tip.
    Conospherical,
    /// A flat-ended cylinder (block) with a rounded edge and an upright flank.
    Punch,
    /// An outline that a program hands in.
    #[schemars(skip)]
    Custom,
}

/// The tool as written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// Its outline.
    pub shape: ToolShape,
    /// Cone: angle between its flank and the horizontal, degrees.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 90))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slope_deg: Option<f64>,
    /// Cone: angle between its flank and its axis, degrees, instead of `slope_deg`.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 90))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half_apex_deg: Option<f64>,
    /// Cone, pyramid: tip radius; absent or 0: sharp.
    #[schemars(example = "1 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tip_radius: Option<Length>,
    /// Sphere, punch: its radius.
    #[schemars(example = "1 mm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub radius: Option<Length>,
    /// Punch: radius of the arc between its flat end and its flank, above 0 and at most `radius`.
    #[schemars(example = "0.2 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edge_radius: Option<Length>,
    /// Profile: a csv file, relative to the scene file, with columns such as r_um,z_um (or nm, mm, m): from the apex on the axis
    /// outward, z up. It must be convex. A resolved scene has `points` in its place.
    #[schemars(example = "tip.csv")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Instead of `file`: r and z, point by point.
    #[schemars(extend("examples" = [[["0 um", "0 um"], ["40 um", "10 um"]]]))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub points: Option<Points>,
    /// Profile: standard deviation of its heights that is smoothed away; absent: as far as neighbouring points scatter.
    #[schemars(example = "10 nm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<Length>,
    /// Young's modulus of the tool; absent: rigid. Its deflection as a half-space is part of depth, stiffness and the reduced
    /// modulus of Oliver and Pharr.
    #[schemars(example = "1141 GPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub youngs_modulus: Option<Stress>,
    /// Poisson's ratio of the tool, beside its modulus; in (-1, 0.5).
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub poissons_ratio: Option<f64>,
    /// Compliance of the load frame, displacement per force; reported depths include its deflection.
    #[schemars(example = "0.5 nm/mN")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub machine_compliance: Option<Compliance>,
    /// Coulomb's coefficient of friction between tool and surface, from 0 to 2, or "sticking": what touches sticks. Absent: 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub friction: Option<Friction>,
    /// Area function of the tip by which the reading of Oliver and Pharr goes; absent: the outline of the tool.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub area_function: Option<AreaFunction>,
    /// For shape = "custom": the outline, handed in by a program; a file cannot hold it.
    #[schemars(skip)]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[serde(serialize_with = "write_outline", deserialize_with = "refuse_outline")]
    pub custom: Option<OwnTool>,
}

fn write_outline<S: Serializer>(tool: &Option<OwnTool>, serializer: S) -> Result<S::Ok, S::Error> {
    match tool {
        Some(tool) => write_custom(serializer, tool.outline().name(), tool.outline().parameters()),
        None => serializer.serialize_none(),
    }
}

fn refuse_outline<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<OwnTool>, D::Error> {
    Err(refuse_custom(deserializer, "tool"))
}

/// The shape of a tool, complete. Lengths in metres.
#[derive(Clone, Debug, PartialEq)]
pub enum ToolForm {
    /// A horizontal plane.
    Plane,
    /// A cone (wedge) pointing down.
    Cone {
        /// Angle between flank and horizontal, radians.
        slope: f64,
        /// Tip radius, m; 0: sharp.
        tip_radius: f64,
    },
    /// A sphere (cylinder).
    Sphere {
        /// Radius, m.
        radius: f64,
    },
    /// A measured outline, as the rise from its apex, m.
    Measured(Arc<Outline>),
    /// An outline that is given by functions, m.
    Own(OwnTool),
}

impl ToolForm {
    /// The tool, lengths over `length` (m).
    pub fn in_units_of(&self, length: f64) -> tool::Tool {
        match self {
            ToolForm::Plane => tool::Tool::Plane,
            ToolForm::Cone { slope, tip_radius } => {
                tool::Tool::Cone { tan_slope: slope.tan(), tip_radius: tip_radius / length }
            }
            ToolForm::Sphere { radius } => tool::Tool::Sphere { radius: radius / length },
            ToolForm::Measured(outline) => tool::Tool::Measured(outline.scaled(length.recip()).shared()),
            ToolForm::Own(own) => tool::Tool::Own(own.in_units_of(length)),
        }
    }
}

/// Angle between the axis of Berkovich's pyramid (with the area of Vickers') and its faces, degrees: ISO
/// 14577-2.
const BERKOVICH_FACE: f64 = 65.27;

/// Angle between the axis of Vickers' pyramid and its faces, degrees: ISO 6507-1.
const VICKERS_FACE: f64 = 68.0;

impl ToolShape {
    /// Name in a scene.
    fn name(self) -> &'static str {
        match self {
            ToolShape::Plane => "plane",
            ToolShape::Cone => "cone",
            ToolShape::Sphere => "sphere",
            ToolShape::Profile => "profile",
            ToolShape::Berkovich => "berkovich",
            ToolShape::Vickers => "vickers",
            ToolShape::Conospherical => "conospherical",
            ToolShape::Punch => "punch",
            ToolShape::Custom => "custom tool",
        }
    }

    /// Keys that describe it.
    fn keys(self) -> &'static [&'static str] {
        match self {
            ToolShape::Plane | ToolShape::Custom => &[],
            ToolShape::Cone | ToolShape::Conospherical => &["slope_deg", "half_apex_deg", "tip_radius"],
            ToolShape::Sphere => &["radius"],
            ToolShape::Punch => &["radius", "edge_radius"],
            ToolShape::Profile => &["file", "points", "tolerance"],
            ToolShape::Berkovich | ToolShape::Vickers => &["tip_radius"],
        }
    }

    /// Half apex angle, degrees, of the cone whose section at every height has the area of the pyramid's;
    /// `None` of what is no pyramid.
    ///
    /// An equilateral triangle whose inscribed circle has the radius ρ has the area 3√3 ρ², a square 4 ρ².
    pub fn equivalent_half_apex_deg(self) -> Option<f64> {
        let (area, face) = match self {
            ToolShape::Berkovich => (3.0 * 3f64.sqrt(), BERKOVICH_FACE),
            ToolShape::Vickers => (4.0, VICKERS_FACE),
            _ => return None,
        };
        Some(((area / PI).sqrt() * face.to_radians().tan()).atan().to_degrees())
    }
}

impl Tool {
    /// True of all but a plane: it has an axis, and comes down at 0.
    pub(crate) fn is_curved(&self) -> bool {
        !matches!(self.form(), Ok(ToolForm::Plane))
    }

    /// The shape that the keys describe.
    ///
    /// # Errors
    /// Keys that are missing or belong to another shape; the path is relative to the tool's table. Ranges are
    /// checked by [`super::Scene::validate`].
    pub fn form(&self) -> Result<ToolForm, SceneError> {
        self.check_keys()?;
        let tip_radius = self.tip_radius.map_or(0.0, |r| r.0);
        match self.shape {
            ToolShape::Plane => Ok(ToolForm::Plane),
            ToolShape::Cone | ToolShape::Conospherical => {
                if self.shape == ToolShape::Conospherical && self.tip_radius.is_none() {
                    return Err(error(
                        "",
                        "`tip_radius` of the conospherical tip is missing: give tip_radius = \"5 um\"",
                    ));
                }
                let slope_deg = self.slope_deg.or(self.half_apex_deg.map(|half| 90.0 - half));
                let slope_deg = slope_deg.ok_or_else(|| {
                    error(
                        "",
                        "`slope_deg` of the cone is missing: give slope_deg = 19.7, or half_apex_deg = 70.3",
                    )
                })?;
                Ok(ToolForm::Cone { slope: slope_deg.to_radians(), tip_radius })
            }
            ToolShape::Sphere => {
                let radius = self
                    .radius
                    .ok_or_else(|| error("", "`radius` of the sphere is missing: give radius = \"1 mm\""))?;
                Ok(ToolForm::Sphere { radius: radius.0 })
            }
            ToolShape::Punch => {
                self.punch_of_keys().map(|punch| ToolForm::Own(OwnTool::new(Arc::new(punch))))
            }
            ToolShape::Custom => self.custom.clone().map(ToolForm::Own).ok_or_else(|| {
                error("shape", "\"custom\" is an outline that a program hands in: a file takes another shape")
            }),
            ToolShape::Profile => self.measured_outline().map(ToolForm::Measured),
            ToolShape::Berkovich | ToolShape::Vickers => {
                let half = self.shape.equivalent_half_apex_deg().unwrap_or(90.0);
                Ok(ToolForm::Cone { slope: (90.0 - half).to_radians(), tip_radius })
            }
        }
    }

    /// Checks that every key belongs to the shape.
    fn check_keys(&self) -> Check {
        let given = [
            ("slope_deg", self.slope_deg.is_some()),
            ("half_apex_deg", self.half_apex_deg.is_some()),
            ("tip_radius", self.tip_radius.is_some()),
            ("radius", self.radius.is_some()),
            ("edge_radius", self.edge_radius.is_some()),
            ("file", self.file.is_some()),
            ("points", self.points.is_some()),
            ("tolerance", self.tolerance.is_some()),
        ];
        let (shape, allowed) = (self.shape.name(), self.shape.keys());
        if let Some((key, _)) = given.iter().find(|(key, given)| *given && !allowed.contains(key)) {
            let keys = if allowed.is_empty() {
                "has no size".into()
            } else {
                format!("takes {}", allowed.join(" and "))
            };
            return Err(error(
                *key,
                format!("does not belong to a {shape}, which {keys}: remove it, or change `shape`"),
            ));
        }
        if self.slope_deg.is_some() && self.half_apex_deg.is_some() {
            return Err(error(
                "half_apex_deg",
                "does not go with `slope_deg`, which is 90 degrees less it: remove one",
            ));
        }
        Ok(())
    }

    /// The punch that the keys give.
    fn punch_of_keys(&self) -> Result<Punch, SceneError> {
        let missing = |key: &str, example: &str| {
            error("", format!("`{key}` of the punch is missing: give {key} = \"{example}\""))
        };
        let radius = self.radius.ok_or_else(|| missing("radius", "20 um"))?;
        let edge_radius = self.edge_radius.ok_or_else(|| missing("edge_radius", "0.2 um"))?;
        if edge_radius.0 > radius.0 {
            let [most, given] = [radius, edge_radius].map(|r| length(r.0));
            return Err(error("edge_radius", format!("must be at most `radius`, {most}, not {given}")));
        }
        Ok(Punch { radius: radius.0, edge_radius: edge_radius.0 })
    }

    /// The measured outline that the keys give.
    fn measured_outline(&self) -> Result<Arc<Outline>, SceneError> {
        match (&self.points, &self.file) {
            (Some(_), Some(_)) => Err(error("file", "does not go with `points`: remove one of the two")),
            (Some(points), None) => measured::tool(points, self.tolerance),
            (None, Some(_)) => {
                Err(error("file", "was not read: give `points`, or read the scene with its files"))
            }
            (None, None) => Err(error("", "`file` of the profile is missing: give file = \"tip.csv\"")),
        }
    }

    /// The same tool, rigid and on a stiff machine.
    #[must_use]
    pub fn rigid(&self) -> Tool {
        Tool { youngs_modulus: None, poissons_ratio: None, machine_compliance: None, ..self.clone() }
    }

    /// Elastic constants, Pa; `None` of a rigid tool.
    pub fn elastic(&self) -> Option<Elastic> {
        let youngs_modulus = self.youngs_modulus?.0;
        Some(Elastic { youngs_modulus, poissons_ratio: self.poissons_ratio? })
    }

    pub(super) fn check(&self) -> Check {
        slope("slope_deg", self.slope_deg)?;
        half_apex("half_apex_deg", self.half_apex_deg)?;
        not_negative("tip_radius", "the tip radius", self.tip_radius)?;
        not_negative("tolerance", "the tolerance", self.tolerance)?;
        self.radius.map_or(Ok(()), |r| positive("radius", "the radius", r))?;
        self.edge_radius.map_or(Ok(()), |r| positive("edge_radius", "the radius of the edge", r))?;
        self.friction.map_or(Ok(()), Friction::check)?;
        if self.custom.is_some() && self.shape != ToolShape::Custom {
            return Err(error("custom", "needs shape = \"custom\" beside it: set that, or leave it out"));
        }
        if let Some(function) = &self.area_function {
            if self.shape == ToolShape::Plane {
                let message = "does not belong to a plane, which has no tip: remove it, or change `shape`";
                return Err(error("area_function", message));
            }
            function.check().map_err(|e| inside("area_function", e))?;
        }
        self.form()?;
        self.check_compliance()
    }

    fn check_compliance(&self) -> Check {
        self.youngs_modulus.map_or(Ok(()), range::youngs_modulus).map_err(|m| {
            error("youngs_modulus", m + ": diamond has 1141 GPa; leave it out for a rigid tool")
        })?;
        self.poissons_ratio
            .map_or(Ok(()), range::poissons_ratio)
            .map_err(|m| error("poissons_ratio", m + ": diamond has 0.07"))?;
        match self.poissons_ratio {
            Some(_) if self.youngs_modulus.is_none() => {
                return Err(error(
                    "poissons_ratio",
                    "needs `youngs_modulus` beside it: a tool without one is rigid",
                ));
            }
            None if self.youngs_modulus.is_some() => {
                return Err(error(
                    "",
                    "`poissons_ratio` is missing beside `youngs_modulus`: diamond has 0.07",
                ));
            }
            _ => {}
        }
        match self.machine_compliance {
            Some(c) if !(c.0 >= 0.0 && c.0.is_finite()) => Err(error(
                "machine_compliance",
                format!(
                    "must be finite and at least 0, not {} nm/mN: leave it out for a stiff machine",
                    c.in_unit("nm/mN")
                ),
            )),
            _ => Ok(()),
        }
    }
}
