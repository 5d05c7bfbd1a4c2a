//! The content of a scene file: bodies, tool, loading, accuracy.
//!
//! The types say what a scene may hold; [`Scene::validate`] says which values make sense. Quantities are in
//! SI. Keys that are absent are `None`: what a run uses in their place follows from the accuracy level.

mod accuracy;
mod area_function;
mod build;
mod earlier_loads;
mod friction;
mod geometry;
mod initial;
mod keys_together;
mod line;
mod loading;
mod material;
mod measured;
pub(crate) mod messages;
mod tool;
mod warnings;
mod whole;

pub use accuracy::{Accuracy, AccuracyError, Level};
pub use area_function::AreaFunction;
pub use friction::Friction;
pub use geometry::{Asperity, AsperityForm, Lateral, Substrate};
pub use initial::{EarlierLoad, Initial};
pub use line::{Line, LineAsperity, LineProfile};
pub use loading::{Loading, Target, ToolForce};
pub use material::{HardeningChoice, Material};
pub use measured::{Points, Smoothing};
pub use tool::{Tool, ToolForm, ToolShape};

pub use asperity_material::range::SceneError;
pub use asperity_material::{HardeningMode, StressMeasure};
pub use asperity_solver::point::kinematics::Symmetry;

use asperity_material::units::Length;
use asperity_mesh::ElementKind;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// Everything that defines a run: what `asperity crush` and `asperity mesh` read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "A scene of `asperity crush` and `asperity mesh`")]
#[schemars(extend("anyOf" = [{ "required": ["material"] }, { "required": ["initial"] }]))]
pub struct Scene {
    /// Body of revolution, or ridges of constant section.
    #[serde(default = "axisymmetric")]
    pub symmetry: Symmetry,
    /// Error of the force: draft 5 %, standard 1 %, reference 0.2 %, or a percentage from 0.2% to 5%.
    #[serde(default)]
    pub accuracy: Accuracy,
    /// The side of the substrate: free, or a frictionless wall beyond which the body repeats.
    #[serde(default)]
    pub lateral: Lateral,
    /// The material of asperities and substrate. A scene that starts from an earlier result has that of the result.
    #[schemars(with = "Option<Material>")]
    pub material: Material,
    /// From the axis (left side in plane strain) outward. May be empty under a cone or sphere.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub asperity: Vec<Asperity>,
    /// A measured line instead of asperities, in plane strain: one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub profile: Vec<LineProfile>,
    /// The body under the asperities; absent in axisymmetry: sized from the contact.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub substrate: Option<Substrate>,
    /// The tool, rigid unless it has a modulus and smooth unless it has friction; absent: a smooth rigid plane.
    #[serde(default = "Tool::plane")]
    pub tool: Tool,
    /// Goal of the tool: exactly one of `depth` and `force`.
    pub loading: Loading,
    /// Earlier loads of the body; absent: it starts undeformed and free of stress.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial: Option<Initial>,
    /// Fields that are written, and their interval.
    #[serde(default)]
    pub output: Output,
    /// Discretisation; what is absent follows from `accuracy`.
    #[serde(default)]
    pub numerics: Numerics,
    /// A mesh to read instead of building one.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<MeshFile>,
}

fn axisymmetric() -> Symmetry {
    Symmetry::Axisymmetric
}

/// A quantity drawn over the section.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Field {
    /// Displacement of the nodes.
    Displacement,
    /// Cauchy stress: rr, zz, θθ, rz (xx, zz, yy, xz).
    Stress,
    /// Von Mises stress.
    VonMises,
    /// Accumulated plastic strain.
    PlasticStrain,
    /// Hydrostatic pressure, positive in compression.
    Pressure,
    /// State of the metal: it yields now, has yielded, or never has.
    PlasticZone,
}

impl Field {
    /// Every field.
    pub const ALL: [Field; 6] = [
        Field::Displacement,
        Field::Stress,
        Field::VonMises,
        Field::PlasticStrain,
        Field::Pressure,
        Field::PlasticZone,
    ];
}

/// Field output.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Output {
    /// The fields of a field file; absent: all.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fields: Option<Vec<Field>>,
    /// Increments between field files; 0: no files. Absent: 5 where `fields` are named, else 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub every: Option<usize>,
}

impl Output {
    /// Increments between field files, 0 for none.
    pub fn interval(&self) -> usize {
        match (&self.fields, self.every) {
            (Some(fields), _) if fields.is_empty() => 0,
            (_, Some(every)) => every,
            (Some(_), None) => 5,
            (None, None) => 0,
        }
    }

    /// The fields of a field file.
    pub fn fields(&self) -> &[Field] {
        self.fields.as_deref().unwrap_or(&Field::ALL)
    }
}

/// Kind of quadrilateral.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ElementChoice {
    /// Eight nodes, reduced integration.
    Q8r,
    /// Four nodes, mean dilatation.
    Q4,
}

impl ElementChoice {
    /// The cells that it needs.
    pub fn kind(self) -> ElementKind {
        match self {
            ElementChoice::Q8r => ElementKind::Quad8,
            ElementChoice::Q4 => ElementKind::Quad4,
        }
    }
}

/// Discretisation by hand; each value overrides what `accuracy` chooses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// Kind of element.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub element: Option<ElementChoice>,
    /// Elements across the contact radius at the peak.
    #[schemars(range(min = 2, max = 1000))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub elements_in_contact: Option<usize>,
    /// Load steps to the peak.
    #[schemars(range(min = 1, max = 10_000))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<usize>,
    /// Mean penetration over depth that sets the penalty.
    #[schemars(range(min = 1e-6, max = 0.1))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub penetration: Option<f64>,
    /// Relative residual at which Newton stops; a tenth of it counts while nothing yields.
    #[schemars(extend("exclusiveMinimum" = 0, "maximum" = 1e-3))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub newton_tolerance: Option<f64>,
    /// Size of an automatic substrate, in contact radii.
    #[schemars(range(min = 3, max = 10_000))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub domain: Option<f64>,
    /// True where a run that misses what `accuracy` promises is made again with finer numbers; absent: it is. With `elements_in_contact` or
    /// a mesh by hand there is one run.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refine: Option<bool>,
}

/// A mesh on disk, its sides named axis, base, surface, outer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MeshFile {
    /// A Gmsh MSH 4.1 file, relative to the scene file.
    pub file: PathBuf,
    /// The length of 1 in the file; absent: 1 m.
    #[schemars(example = "1 um")]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<Length>,
}

#[cfg(test)]
mod tests;
