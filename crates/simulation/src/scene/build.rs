//! Scenes built in code: what a kind of part needs, and nothing for the rest.

use super::{
    Accuracy, Asperity, Friction, HardeningChoice, Lateral, Loading, Material, Numerics, Output, Points,
    Scene, Substrate, Symmetry, Tool, ToolForce, ToolShape,
};
use asperity_material::units::{Length, Stress};
use asperity_material::{FlowCurve, HardeningMode, OwnLaw, StressMeasure};
use asperity_mesh::{OwnTool, ToolOutline};
use std::sync::Arc;

impl Scene {
    /// A scene of these parts without asperities, at `standard`, its sides free; the other keys are absent.
    pub fn new(symmetry: Symmetry, material: Material, tool: Tool, loading: Loading) -> Scene {
        Scene {
            symmetry,
            accuracy: Accuracy::Standard,
            lateral: Lateral::Free,
            material,
            asperity: Vec::new(),
            profile: Vec::new(),
            substrate: None,
            tool,
            loading,
            initial: None,
            output: Output::default(),
            numerics: Numerics::default(),
            mesh: None,
        }
    }

    /// The scene with one more asperity, outside of those it has.
    #[must_use]
    pub fn with(mut self, asperity: Asperity) -> Scene {
        self.asperity.push(asperity);
        self
    }

    /// The scene at another accuracy.
    #[must_use]
    pub fn with_accuracy(self, accuracy: Accuracy) -> Scene {
        Scene { accuracy, ..self }
    }

    /// The scene on a block of this outer radius (in plane strain half width) and depth.
    #[must_use]
    pub fn on(self, radius: Length, depth: Length) -> Scene {
        Scene { substrate: Some(Substrate { radius: Some(radius), depth: Some(depth) }), ..self }
    }
}

impl Material {
    /// A material that never yields.
    pub fn elastic_body(youngs_modulus: Stress, poissons_ratio: f64) -> Material {
        Material {
            youngs_modulus,
            poissons_ratio,
            yield_stress: None,
            hardening_exponent: None,
            hardening_law: HardeningChoice::Hollomon,
            saturation_stress: None,
            saturation_strain: None,
            hardening_file: None,
            hardening_table: None,
            stress_measure: StressMeasure::Cauchy,
            hardening_mode: HardeningMode::Isotropic,
            kinematic_share: None,
            custom: None,
        }
    }

    /// The material with power-law hardening (`hollomon`) from this yield stress on.
    #[must_use]
    pub fn yielding(self, yield_stress: Stress, hardening_exponent: f64) -> Material {
        Material {
            yield_stress: Some(yield_stress),
            hardening_exponent: Some(hardening_exponent),
            hardening_law: HardeningChoice::Hollomon,
            ..self
        }
    }

    /// The material with Voce's law: the yield stress goes to `saturation_stress`, by all but 1/e over
    /// `saturation_strain`.
    #[must_use]
    pub fn saturating(
        self,
        yield_stress: Stress,
        saturation_stress: Stress,
        saturation_strain: f64,
    ) -> Material {
        Material {
            yield_stress: Some(yield_stress),
            saturation_stress: Some(saturation_stress),
            saturation_strain: Some(saturation_strain),
            hardening_law: HardeningChoice::Voce,
            ..self
        }
    }

    /// The material with a hardening law of another crate.
    #[must_use]
    pub fn hardening_as(self, law: Arc<dyn FlowCurve>) -> Material {
        Material { hardening_law: HardeningChoice::Custom, custom: Some(OwnLaw::new(law)), ..self }
    }

    /// The material with the yield stress over plastic strain of a table, whose first point is first yield.
    /// It is straight between the points: chords of a step s lie s²/8 |σ''| below a smooth law, which no
    /// stated error includes.
    #[must_use]
    pub fn hardening_by(self, points: impl IntoIterator<Item = (f64, Stress)>) -> Material {
        Material {
            hardening_law: HardeningChoice::Table,
            hardening_table: Some(points.into_iter().collect()),
            ..self
        }
    }
}

impl Asperity {
    /// A sharp cone (wedge in plane strain) of this height and slope against its base plane in degrees.
    pub fn cone(height: Length, slope_deg: f64) -> Asperity {
        Asperity { height: Some(height), slope_deg: Some(slope_deg), ..Asperity::default() }
    }

    /// A measured outline through places and heights in metres: half of it from its axis outward, or the
    /// whole of a ridge.
    pub fn measured(points: Vec<[f64; 2]>) -> Asperity {
        Asperity { points: Some(Points::new(points)), ..Asperity::default() }
    }

    /// The cone with a rounded tip.
    #[must_use]
    pub fn rounded(self, tip_radius: Length) -> Asperity {
        Asperity { tip_radius: Some(tip_radius), ..self }
    }
}

impl Tool {
    /// A rigid plane.
    pub fn plane() -> Tool {
        Tool {
            shape: ToolShape::Plane,
            slope_deg: None,
            half_apex_deg: None,
            tip_radius: None,
            radius: None,
            edge_radius: None,
            file: None,
            points: None,
            tolerance: None,
            youngs_modulus: None,
            poissons_ratio: None,
            machine_compliance: None,
            friction: None,
            area_function: None,
            custom: None,
        }
    }

    /// The tool with this friction.
    #[must_use]
    pub fn rubbing(self, friction: Friction) -> Tool {
        Tool { friction: Some(friction), ..self }
    }

    /// A flat punch with an edge rounded by `edge_radius`.
    pub fn punch(radius: Length, edge_radius: Length) -> Tool {
        Tool {
            shape: ToolShape::Punch,
            radius: Some(radius),
            edge_radius: Some(edge_radius),
            ..Tool::plane()
        }
    }

    /// An outline of another crate.
    pub fn custom(outline: Arc<dyn ToolOutline>) -> Tool {
        Tool { shape: ToolShape::Custom, custom: Some(OwnTool::new(outline)), ..Tool::plane() }
    }

    /// A measured outline through places and heights in metres, from its apex on the axis outward, z up.
    pub fn measured(points: Vec<[f64; 2]>) -> Tool {
        Tool { shape: ToolShape::Profile, points: Some(Points::new(points)), ..Tool::plane() }
    }

    /// A sharp cone whose flank has this angle to the horizontal, degrees.
    pub fn cone(slope_deg: f64) -> Tool {
        Tool { shape: ToolShape::Cone, slope_deg: Some(slope_deg), ..Tool::plane() }
    }

    /// A sphere.
    pub fn sphere(radius: Length) -> Tool {
        Tool { shape: ToolShape::Sphere, radius: Some(radius), ..Tool::plane() }
    }
}

impl Loading {
    /// To this depth.
    pub fn to_depth(depth: Length) -> Loading {
        Loading { depth: Some(depth), force: None, unload: false, reloads: 0 }
    }

    /// To this force.
    pub fn to_force(force: ToolForce) -> Loading {
        Loading { depth: None, force: Some(force), unload: false, reloads: 0 }
    }

    /// The loading with the unloading after it.
    #[must_use]
    pub fn unloaded(self) -> Loading {
        Loading { unload: true, ..self }
    }
}
