//! The units of a dimensionless problem.
//!
//! The unit of length belongs to the scene, not to the depth of one of its runs: mesh, tool and surface are
//! converted once, and every run of the scene computes with the same numbers.

use crate::scene::{Scene, SceneError, Target, ToolForm};
use asperity_solver::point::kinematics::Symmetry;

/// Values of 1 in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Units {
    /// m.
    pub length: f64,
    /// Pa.
    pub stress: f64,
    /// N, or N/m in plane strain.
    pub force: f64,
    /// m², or m.
    pub area: f64,
    /// J, or J/m.
    pub energy: f64,
}

impl Units {
    /// Those of `scene`, which is valid: its Young's modulus and the power of two of a metre nearest to its
    /// own length. With any other power of two a run has the same bits.
    ///
    /// # Errors
    /// A tool or a goal that cannot be: path and reason.
    pub fn of_scene(scene: &Scene) -> Result<Units, SceneError> {
        let length = own_length(scene)?.log2().round().exp2();
        Ok(Units::new(length, scene.material.elastic().youngs_modulus, scene.symmetry))
    }

    /// Those that follow from a `length` (m) and a `stress` (Pa).
    pub fn new(length: f64, stress: f64, symmetry: Symmetry) -> Units {
        let (l, e) = (length, stress);
        match symmetry {
            Symmetry::Axisymmetric => {
                Units { length: l, stress: e, force: e * l * l, area: l * l, energy: e * l * l * l }
            }
            Symmetry::PlaneStrain => Units { length: l, stress: e, force: e * l, area: l, energy: e * l * l },
        }
    }
}

/// The length (m) that a scene brings with it: the height of its highest asperity, or else a radius of its
/// tool; of a sharp tool on flat metal the depth that is asked for, under a force F that at which metal of E
/// carries it over its square.
fn own_length(scene: &Scene) -> Result<f64, SceneError> {
    let highest = scene.highest();
    if highest > 0.0 {
        return Ok(highest);
    }
    let of_tool = match scene.tool.form()? {
        ToolForm::Plane => 0.0,
        ToolForm::Cone { tip_radius, .. } => tip_radius,
        ToolForm::Sphere { radius } => radius,
        ToolForm::Measured(outline) => outline.lowest(),
        ToolForm::Own(own) => own.kinks().into_iter().fold(0.0, f64::max),
    };
    if of_tool > 0.0 {
        return Ok(of_tool);
    }
    Ok(match scene.loading.target()? {
        Target::Depth(depth) => depth,
        Target::Force(force) => {
            let over_modulus = force / scene.material.elastic().youngs_modulus;
            match scene.symmetry {
                Symmetry::Axisymmetric => over_modulus.sqrt(),
                Symmetry::PlaneStrain => over_modulus,
            }
        }
    })
}
