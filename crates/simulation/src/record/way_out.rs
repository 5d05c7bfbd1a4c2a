//! The key of a scene that lets its run go further than it did.

use crate::load_path::Stop;
use crate::record::outcome::Stopped;
use crate::scene::{Asperity, Scene, messages::length};

/// Slope (degrees) from which a sharp flank is steep: sharp cones of metal that does not harden reach their
/// depth at every level up to 45°, those of 60° do not.
const STEEP_DEG: f64 = 45.0;

/// Hardening exponent up to which the shear under a sharp flank gathers in one row of elements.
const HARDLY_HARDENS: f64 = 0.1;

/// Tip radius over height with which cones of 50° to 75° reached half of their height at draft and standard.
const ROUNDED: f64 = 0.1;

impl Stopped {
    /// The key of `scene` that lets such a run go on, in words; `None` where none is known.
    pub fn way_out(&self, scene: &Scene) -> Option<String> {
        if !matches!(self.reason, Stop::NoEquilibrium | Stop::Distorted | Stop::Leaps | Stop::FlanksMeet) {
            return None;
        }
        let hardening = scene.material.hardening()?;
        let hardens = hardening.exponent(scene.material.youngs_modulus.0) > HARDLY_HARDENS;
        let (index, asperity) = scene.asperity.iter().enumerate().find(|(_, asperity)| is_steep(asperity))?;
        let radius = length(ROUNDED * asperity.height?.0);
        let also =
            if hardens { "" } else { "; such metal hardly hardens, and its flow gathers at a sharp edge" };
        Some(format!("give asperity[{index}].tip_radius = \"{radius}\" or so to the sharp flank{also}"))
    }
}

/// A sharp flank that lies down under the tool as it is pressed.
fn is_steep(asperity: &Asperity) -> bool {
    let sharp = asperity.tip_radius.is_none_or(|radius| radius.0 == 0.0);
    sharp && asperity.slope_deg.is_some_and(|slope| slope > STEEP_DEG)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::record::rows::Phase;
    use crate::scene::{Loading, Material, Symmetry, Tool};
    use asperity_material::units::{Length, Stress};

    fn said(slope_deg: f64, exponent: f64, tip: Option<f64>, reason: Stop) -> Option<String> {
        let metal = Material::elastic_body(Stress(210e9), 0.3).yielding(Stress(7e8), exponent);
        let mut cone = Asperity::cone(Length(20e-6), slope_deg);
        cone.tip_radius = tip.map(Length);
        let loading = Loading::to_depth(Length(10e-6));
        let scene = Scene::new(Symmetry::Axisymmetric, metal, Tool::plane(), loading).with(cone);
        Stopped { reason, depth: 1e-6, phase: Phase::Load }.way_out(&scene)
    }

    #[test]
    fn a_sharp_steep_flank_is_told_to_take_a_tip() {
        let way_out = said(60.0, 0.0, None, Stop::NoEquilibrium).unwrap();
        assert!(way_out.contains("asperity[0].tip_radius = \"2 um\""), "{way_out}");
        assert!(way_out.contains("hardly hardens"), "{way_out}");
        assert!(!said(60.0, 0.3, Some(0.0), Stop::Leaps).unwrap().contains("hardly"));
        assert_eq!(said(30.0, 0.0, None, Stop::NoEquilibrium), None);
        assert_eq!(said(60.0, 0.0, Some(1e-6), Stop::NoEquilibrium), None);
        assert_eq!(said(60.0, 0.0, None, Stop::Interrupted), None);
    }
}
