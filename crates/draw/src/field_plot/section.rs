//! The tool and the body of one converged state in the part of the section that is drawn.

use super::deformed_mesh::DeformedMesh;
use super::window::{AsperityRow, Reach, Window};
use crate::{MEGAPASCAL, MICROMETRE};
use asperity_mesh::profile::Asperity;
use asperity_simulation::run::FieldFrame;
use asperity_simulation::scene::{Scene, Symmetry};

/// The tool and the body of one converged state, ready to be drawn. Lengths in µm, stresses in MPa.
pub struct Section {
    /// The body.
    pub(super) mesh: DeformedMesh,
    /// The part that is drawn.
    pub(super) window: Window,
    /// The tool as an asperity of the same outline; `None` for a plane.
    tool: Option<Asperity>,
    /// Height of the tool's lowest point; `None` if nothing touches it.
    pub(super) tip: Option<f64>,
    /// True where the other half of a body of revolution is drawn too.
    pub(super) mirrored: bool,
    /// True where the body is one of revolution.
    pub(super) revolved: bool,
    /// First yield stress.
    pub(super) yield_stress: Option<f64>,
}

impl Section {
    /// The section of `frame`, a state of `scene`, as far as `reach` says.
    ///
    /// # Errors
    /// A text for a person where the scene's tool is none.
    pub fn new(frame: &FieldFrame, scene: &Scene, reach: Reach) -> Result<Section, String> {
        let mesh = DeformedMesh::new(frame);
        let revolved = scene.symmetry == Symmetry::Axisymmetric;
        let mirrored = revolved && scene.asperity_count() < 2;
        let tool = scene.tool.form().map_err(|e| e.to_string())?.in_units_of(MICROMETRE).mirrored();
        let tips = mesh.pressed().map(|[r, z]| z - rise(&tool, r));
        let tip = tips.reduce(f64::max);
        let height = scene.highest() / MICROMETRE;
        let row = AsperityRow { feet: mesh.feet(height), height, count: scene.asperity_count() };
        let window = Window::around_contact(&mesh, mirrored, revolved, reach, &row);
        let yield_stress = scene.material.yield_stress.map(|s| s.0 / MEGAPASCAL);
        Ok(Section { mesh, window, tool, tip, mirrored, revolved, yield_stress })
    }

    /// The face of the tool from the right end of the window to its left, (r, z); empty if nothing touches
    /// it.
    pub(super) fn face(&self) -> Vec<[f64; 2]> {
        let Some(tip) = self.tip else { return Vec::new() };
        let (left, right) = (self.window.low[0], self.window.high[0]);
        let at = |i: u32| left + f64::from(i) / 200.0 * (right - left);
        (0..=200).rev().map(|i| [at(i), tip + rise(&self.tool, at(i))]).collect()
    }
}

/// Height of the tool's face above its lowest point, at a distance `r` from the axis, both in µm.
fn rise(tool: &Option<Asperity>, r: f64) -> f64 {
    tool.as_ref().map_or(0.0, |tool| tool.drop(r))
}
