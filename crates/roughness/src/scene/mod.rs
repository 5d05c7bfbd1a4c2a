//! The tables of a rough scene, the checks of their values, and the surface they describe.

mod error;
mod fluid;
mod generate;
mod half_space;
mod joint;
mod scales;
mod surface;

pub use asperity_material::range::SceneError;
pub use fluid::{Fluid, Viscosity};
pub use generate::GenerateScene;
pub use half_space::HalfSpaceScene;
pub use joint::{Electrical, JointScene, Thermal};
pub use scales::ScalesScene;
pub use surface::{HeightUnit, Missing, PointColumns, SurfaceScene};

pub use crate::contact::material::Material;
pub use crate::contact::own_closure::OwnClosure;
pub use crate::contact::pressure::PressureProfile;
pub use crate::surface::generate::KindName;
pub use crate::surface::level::Levelling;
pub use asperity_formats::surface::{Measured, Spacing};

use crate::contact::closures::Closure;
use crate::contact::islands_contact::Load;
use asperity_material::range;
use asperity_material::units::{Length, Stress, rounded};
use error::error;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A rough surface under a rigid plane.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "A scene of `asperity rough`")]
pub struct Scene {
    /// The closure, or several.
    pub closure: Choice,
    /// Result of a calibration, for "fitted" (c), "calibrated" (cones, unloading) and "johnson" (unloading).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coefficient: Option<PathBuf>,
    /// Distribution of the pressure over an island.
    #[serde(default)]
    pub pressure_profile: PressureProfile,
    /// True where every closure is compared with the half-space: by default on maps of up to 1024 x 1024 points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub judge: Option<bool>,
    /// The surface.
    pub surface: SurfaceScene,
    /// Its material.
    pub material: Material,
    /// Its load; a joint may go without one.
    #[serde(default)]
    pub load: LoadScene,
    /// Settings of the half-space.
    #[serde(default, skip_serializing_if = "HalfSpaceScene::is_default")]
    pub half_space: HalfSpaceScene,
    /// A fluid in the gap.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fluid: Option<Fluid>,
    /// For `asperity joint`: its loads.
    #[serde(default, skip_serializing_if = "JointScene::is_default")]
    pub joint: JointScene,
    /// For `asperity joint`: the conductivities of heat.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thermal: Option<Thermal>,
    /// For `asperity joint`: the conductivities of electric current.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub electrical: Option<Electrical>,
    /// For `asperity scales`: the instrument.
    #[serde(default, skip_serializing_if = "ScalesScene::is_default")]
    pub scales: ScalesScene,
    /// Output files.
    #[serde(default)]
    pub output: Output,
    /// For closure = "custom": the closure, handed in by a program; a file cannot hold it.
    #[schemars(skip)]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub custom: Option<OwnClosure>,
}

/// One closure or several.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Choice {
    /// Eqs (10)-(12).
    Published,
    /// The same law with the calibration's coefficient.
    Fitted,
    /// Eqs (18)-(20), corrected.
    Johnson,
    /// The exact elastic cone.
    Sneddon,
    /// The calibrated elastoplastic cone.
    Calibrated,
    /// The whole surface on an elastic half-space.
    HalfSpace,
    /// The same with pressures up to the limit of the metal.
    HalfSpacePlastic,
    /// Every closure the material allows.
    All,
    /// Every closure of single islands that the material allows: all but the half-spaces.
    Islands,
    /// A closure that a program hands in.
    #[schemars(skip)]
    Custom,
}

impl Choice {
    /// The closures chosen, in the order of the tables.
    pub fn closures(self) -> Vec<Closure> {
        let of_islands = |closure: &Closure| !closure.is_half_space();
        match self {
            Choice::Custom => vec![Closure::Custom],
            Choice::Islands => Closure::ALL.into_iter().filter(of_islands).collect(),
            // the choices are the closures in their order, then all
            _ => Closure::ALL.get(self as usize).map_or(Closure::ALL.to_vec(), |closure| vec![*closure]),
        }
    }

    /// True of a choice of several closures, of which one that cannot be used is a warning and no error.
    pub fn is_several(self) -> bool {
        matches!(self, Choice::All | Choice::Islands)
    }
}

/// Load of the plane: exactly one of pressure and separation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadScene {
    /// Nominal pressure.
    #[schemars(example = "200 MPa")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pressure: Option<Stress>,
    /// Separation from the mean plane.
    #[schemars(example = "1 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub separation: Option<Length>,
    /// True where the load is removed again.
    #[serde(default)]
    pub unload: bool,
}

/// Output files.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Pictures and .vti of pressure and contact.
    pub maps: bool,
    /// The surface as pressed (levelled, filtered), as surface.x3p or surface.npy (heights in metres: `height_unit = "m"`).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface: Option<SurfaceFormat>,
    /// The power spectrum of the surface, as spectrum.csv: by default of maps of up to 1024 x 1024 points.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub spectrum: Option<bool>,
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
        Output { maps: true, surface: None, spectrum: None }
    }
}

impl Scene {
    /// A scene of these parts under `closure`; the other keys are absent.
    pub fn new(closure: Choice, surface: SurfaceScene, material: Material, load: LoadScene) -> Scene {
        Scene {
            closure,
            coefficient: None,
            pressure_profile: PressureProfile::default(),
            judge: None,
            surface,
            material,
            load,
            half_space: HalfSpaceScene::default(),
            fluid: None,
            joint: JointScene::default(),
            thermal: None,
            electrical: None,
            scales: ScalesScene::default(),
            output: Output::default(),
            custom: None,
        }
    }

    /// Checks every value that can be checked without reading files.
    ///
    /// # Errors
    /// The first value that makes no sense, by the path of its key.
    pub fn validate(&self) -> Result<(), SceneError> {
        self.validate_but_load()?;
        self.load.load().map(|_| ())
    }

    /// The same of a joint, which may have no load.
    ///
    /// # Errors
    /// As for [`Scene::validate`].
    pub fn validate_joint(&self) -> Result<(), SceneError> {
        self.validate_but_load()?;
        self.load.of_joint().map(|_| ())
    }

    fn validate_but_load(&self) -> Result<(), SceneError> {
        match (self.closure, &self.custom) {
            (Choice::Custom, None) => {
                let message = "\"custom\" is a closure that a program hands in: a file takes a built-in one, \"islands\" or \"all\"";
                return error("closure", message);
            }
            (choice, Some(_)) if choice != Choice::Custom => {
                return error("custom", "needs closure = \"custom\" beside it: set that, or leave it out");
            }
            _ => {}
        }
        check_material(&self.material)?;
        self.half_space.validate()?;
        self.fluid.as_ref().map_or(Ok(()), Fluid::validate)?;
        self.joint.validate()?;
        self.thermal.as_ref().map_or(Ok(()), Thermal::validate)?;
        self.electrical.as_ref().map_or(Ok(()), Electrical::validate)?;
        self.scales.validate()?;
        self.surface.validate()
    }
}

fn check_material(material: &Material) -> Result<(), SceneError> {
    let e = material.youngs_modulus;
    let at = |key: &str, m: String| SceneError::new(format!("material.{key}"), m);
    range::youngs_modulus(e).map_err(|m| at("youngs_modulus", m + ": steel has 210 GPa"))?;
    range::poissons_ratio(material.poissons_ratio)
        .map_err(|m| at("poissons_ratio", m + ": metals have 0.25 to 0.35"))?;
    let strengths = [
        ("material.yield_stress", material.yield_stress, e.0 / range::MODULUS_OVER_YIELD[0]),
        ("material.hardness", material.hardness, e.0),
    ];
    for (path, value, most) in strengths {
        if let Some(v) = value.filter(|v| !(v.0 > 0.0 && v.0 <= most)) {
            let [v, most] = [v.0, most].map(|v| rounded(v * 1e-6, 6));
            let message = format!("must be above 0 and at most {most} MPa, not {v} MPa: check its unit");
            return error(path, message);
        }
    }
    material
        .hardening_exponent
        .map_or(Ok(()), range::hardening_exponent)
        .map_err(|m| at("hardening_exponent", m + ": 0 is perfect plasticity"))
}

impl LoadScene {
    /// The load of a joint, in SI; None where none is given: then the surface or the metal says where it
    /// ends.
    ///
    /// # Errors
    /// Both, or a negative pressure.
    pub fn of_joint(&self) -> Result<Option<Load>, SceneError> {
        if *self == (LoadScene { unload: self.unload, ..LoadScene::default() }) {
            return Ok(None);
        }
        self.load().map(Some)
    }

    /// The load, in SI.
    ///
    /// # Errors
    /// Both, none, or a negative pressure.
    pub fn load(&self) -> Result<Load, SceneError> {
        match (self.pressure, self.separation) {
            (Some(p), None) if p.0 >= 0.0 => Ok(Load::Pressure(p.0)),
            (Some(p), None) => {
                let p = p.in_unit("MPa");
                error(
                    "load.pressure",
                    format!("must be 0 or above, not {p} MPa: compression counts positive"),
                )
            }
            (None, Some(d)) => Ok(Load::Separation(d.0)),
            (None, None) => error("load", "give pressure = \"200 MPa\" or separation = \"1 um\""),
            (Some(_), Some(_)) => error(
                "load.separation",
                "give either pressure or separation, not both: --set \"load={separation='1 um'}\" gives one in place of the other",
            ),
        }
    }
}

#[cfg(test)]
mod tests;
