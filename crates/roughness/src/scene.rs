//! What a rough scene may hold, which values make sense, and the surface it describes.

mod generate;
mod prepare;

pub use generate::GenerateScene;
pub use prepare::Prepared;

use crate::closure::{Closure, Metal};
use crate::contact::Load;
use crate::level::Level;
use crate::pressure::Profile;
use asperity_law::units::{Length, Stress};
use asperity_law::{Elastic, HardeningLaw};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;
use std::path::PathBuf;
use thiserror::Error;

/// A value of a scene that makes no sense.
#[derive(Clone, Debug, Error, PartialEq)]
#[error("{path}: {message}")]
pub struct SceneError {
    /// Where: keys joined by dots, for example `surface.generate.ra`.
    pub path: String,
    /// What is wrong: names the value, the allowed range and a way out.
    pub message: String,
}

fn error<T>(path: &str, message: impl Into<String>) -> Result<T, SceneError> {
    Err(SceneError { path: path.into(), message: message.into() })
}

/// A rough surface under a rigid plane: what `asperity rough` reads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "A scene of `asperity rough`")]
pub struct Scene {
    /// The law of an asperity, or all of them.
    pub closure: Choice,
    /// Result of a calibration, for "fitted" and "calibrated"; absent: the one that comes with the program.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coefficient: Option<PathBuf>,
    /// How the pressure of an island is spread.
    #[serde(default = "hertz")]
    pub pressure_profile: Profile,
    /// The surface: either `file` or `generate`.
    pub surface: SurfaceScene,
    /// Its material.
    pub material: Material,
    /// What presses on it: exactly one of `pressure` and `separation`.
    pub load: LoadScene,
    /// What is written.
    #[serde(default)]
    pub output: Output,
}

fn hertz() -> Profile {
    Profile::Hertz
}

/// One closure or all.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Choice {
    /// Eqs [10]-[12].
    Published,
    /// The same law with the calibration's coefficient.
    Fitted,
    /// Eqs [18]-[20], mended.
    Johnson,
    /// The exact elastic cone.
    Sneddon,
    /// The calibrated elastoplastic cone.
    Calibrated,
    /// Every closure the material allows.
    All,
}

impl Choice {
    /// The closures chosen, in the order of the tables.
    pub fn closures(self) -> Vec<Closure> {
        match self {
            Choice::Published => vec![Closure::Published],
            Choice::Fitted => vec![Closure::Fitted],
            Choice::Johnson => vec![Closure::Johnson],
            Choice::Sneddon => vec![Closure::Sneddon],
            Choice::Calibrated => vec![Closure::Calibrated],
            Choice::All => Closure::ALL.to_vec(),
        }
    }
}

/// What is done with missing points.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Missing {
    /// Cells with a missing corner are left out.
    #[default]
    Exclude,
    /// Holes are closed smoothly from their rims.
    Fill,
}

/// A unit of length by name, in metres.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightUnit {
    name: String,
    metres: f64,
}

impl JsonSchema for HeightUnit {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "HeightUnit".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let units: Vec<&str> = Length::UNITS.iter().map(|(unit, _)| *unit).collect();
        json_schema!({"enum": units})
    }
}

impl Serialize for HeightUnit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.name)
    }
}

impl<'de> Deserialize<'de> for HeightUnit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        let unit = Length::UNITS.iter().find(|(unit, _)| *unit == name).ok_or_else(|| {
            let known: Vec<&str> = Length::UNITS.iter().map(|(unit, _)| *unit).collect();
            serde::de::Error::custom(format!(
                "\"{name}\" is not a unit of length: use one of {}",
                known.join(", ")
            ))
        })?;
        Ok(HeightUnit { metres: unit.1, name })
    }
}

/// Where the surface comes from and what is done to it before the contact.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceScene {
    /// A file, relative to the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<PathBuf>,
    /// Instead of a file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub generate: Option<GenerateScene>,
    /// Distance of the points along x and y, where the file does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixel_size: Option<[Length; 2]>,
    /// Unit of the heights, where the file does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height_unit: Option<HeightUnit>,
    /// Whether `pixel_size` and `height_unit` win over what the file says.
    #[serde(default, rename = "override")]
    pub override_file: bool,
    /// What is subtracted: by default the plane from a file, nothing from a generated surface.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub level: Option<Level>,
    /// Missing points.
    #[serde(default)]
    pub missing: Missing,
    /// Cut-off of the Gaussian S-filter (removes what is shorter).
    #[schemars(example = "5 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub s_filter: Option<Length>,
    /// Cut-off of the Gaussian L-filter (removes what is longer).
    #[schemars(example = "0.8 mm")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub l_filter: Option<Length>,
    /// Whether the map is one period of an endless surface.
    #[serde(default)]
    pub periodic: bool,
}

/// The metal of the rough body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Material {
    /// Young's modulus E.
    #[schemars(example = "210 GPa")]
    pub youngs_modulus: Stress,
    /// Poisson's ratio ν.
    #[schemars(extend("exclusiveMinimum" = -1, "exclusiveMaximum" = 0.5))]
    pub poissons_ratio: f64,
    /// Hardness H.
    #[schemars(example = "1280 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardness: Option<Stress>,
    /// Yield stress σ_y.
    #[schemars(example = "300 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yield_stress: Option<Stress>,
    /// Hardening exponent n.
    #[schemars(extend("minimum" = 0, "exclusiveMaximum" = 1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_exponent: Option<f64>,
    /// Hardening law, by default that of the calibration.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hardening_law: Option<HardeningLaw>,
}

/// What presses: exactly one of the two.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadScene {
    /// Nominal pressure.
    #[schemars(example = "200 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure: Option<Stress>,
    /// Separation from the mean plane, instead of `pressure`.
    #[schemars(example = "1 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub separation: Option<Length>,
    /// Whether the load is taken off again.
    #[serde(default)]
    pub unload: bool,
}

/// What is written.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// Pictures and .vti of pressure and contact.
    #[serde(default = "yes")]
    pub maps: bool,
    /// The surface as pressed (levelled, filtered), as surface.x3p or surface.npy.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceFormat>,
}

/// Formats in which a surface is written; both in metres.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SurfaceFormat {
    /// ISO 25178-72.
    X3p,
    /// NumPy array of f64, axis 0 = y.
    Npy,
}

impl Default for Output {
    fn default() -> Self {
        Output { maps: true, surface: None }
    }
}

fn yes() -> bool {
    true
}

impl Scene {
    /// Checks every value that can be checked without reading files.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.material.validate()?;
        self.load.load()?;
        let surface = &self.surface;
        match (&surface.file, &surface.generate) {
            (None, None) => return error("surface", "name a file, or add a [surface.generate] table"),
            (Some(_), Some(_)) => {
                return error("surface.file", "give either a file or [surface.generate], not both");
            }
            (None, Some(_)) if surface.pixel_size.is_some() => {
                return error(
                    "surface.pixel_size",
                    "a generated surface has size / pixels: remove pixel_size",
                );
            }
            (None, Some(_)) if surface.height_unit.is_some() => {
                return error(
                    "surface.height_unit",
                    "a generated surface has its heights from ra: remove height_unit",
                );
            }
            (None, Some(made)) => made.request().map(|_| ())?,
            (Some(_), None) => {}
        }
        for (path, length) in [("surface.s_filter", surface.s_filter), ("surface.l_filter", surface.l_filter)]
        {
            if length.is_some_and(|l| l.0 <= 0.0) {
                return error(path, "a cut-off must be above 0: leave the key out for no filter");
            }
        }
        if let Some(p) = surface.pixel_size.filter(|p| p.iter().any(|l| l.0 <= 0.0)) {
            return error(
                "surface.pixel_size",
                format!("{} x {} is not possible: both must be above 0", p[0], p[1]),
            );
        }
        if let (Some(s), Some(l)) = (surface.s_filter, surface.l_filter)
            && s.0 >= l.0
        {
            return error(
                "surface.s_filter",
                format!("{s} must be below l_filter = {l}: else nothing is left"),
            );
        }
        Ok(())
    }
}

impl Material {
    fn validate(&self) -> Result<(), SceneError> {
        let (e, nu) = (self.youngs_modulus.0, self.poissons_ratio);
        if e <= 0.0 {
            return error(
                "material.youngs_modulus",
                format!("{} must be above 0, for example \"210 GPa\"", self.youngs_modulus),
            );
        }
        if !(nu > -1.0 && nu < 0.5) {
            return error(
                "material.poissons_ratio",
                format!("{nu} must be above -1 and below 0.5, for example 0.3"),
            );
        }
        let within = |path, value: Option<Stress>, most: f64| match value {
            Some(v) if v.0 <= 0.0 || v.0 > most => {
                error(path, format!("{v} must be above 0 and at most {most:?} Pa: check its unit"))
            }
            _ => Ok(()),
        };
        within("material.yield_stress", self.yield_stress, e / 5.0)?;
        within("material.hardness", self.hardness, e)?;
        match self.hardening_exponent {
            Some(n) if !(0.0..1.0).contains(&n) => error(
                "material.hardening_exponent",
                format!("{n} must be at least 0 and below 1, for example 0.3"),
            ),
            _ => Ok(()),
        }
    }

    /// The metal in Pa.
    pub fn metal(&self) -> Metal {
        Metal {
            elastic: Elastic { youngs_modulus: self.youngs_modulus.0, poissons_ratio: self.poissons_ratio },
            hardness: self.hardness.map(|h| h.0),
            yield_stress: self.yield_stress.map(|y| y.0),
            hardening_exponent: self.hardening_exponent,
            hardening_law: self.hardening_law,
        }
    }
}

impl LoadScene {
    /// What presses, in SI.
    pub fn load(&self) -> Result<Load, SceneError> {
        match (self.pressure, self.separation) {
            (Some(p), None) if p.0 >= 0.0 => Ok(Load::Pressure(p.0)),
            (Some(p), None) => {
                error("load.pressure", format!("{p} must be 0 or above (compression counts positive)"))
            }
            (None, Some(d)) => Ok(Load::Separation(d.0)),
            (None, None) => error("load", "give pressure = \"200 MPa\" or separation = \"1 um\""),
            (Some(_), Some(_)) => error("load.separation", "give either pressure or separation, not both"),
        }
    }
}

#[cfg(test)]
mod tests;
