//! Warnings for inputs without effect.

use super::messages::{error, length};
use super::{Lateral, Scene, SceneError, Symmetry};

impl Scene {
    /// Values of a valid scene that its run does not use, each with what holds instead: worth a warning, no
    /// error.
    pub fn unused(&self) -> Vec<SceneError> {
        let mut unused = Vec::new();
        let mut note = |given: bool, path: &str, instead: String| {
            if given {
                unused.push(error(path, format!("is not used: {instead}")));
            }
        };
        let substrate = self.substrate.unwrap_or_default();
        if self.mesh.is_some() {
            for (given, path) in [
                (substrate.radius.is_some(), "substrate.radius"),
                (substrate.depth.is_some(), "substrate.depth"),
                (self.numerics.domain.is_some(), "numerics.domain"),
                (self.numerics.element.is_some(), "numerics.element"),
                (self.numerics.elements_in_contact.is_some(), "numerics.elements_in_contact"),
            ] {
                note(given, path, "the body and its elements are those of the mesh".into());
            }
            return unused;
        }
        if self.has_repeated_asperities() {
            let radius = self.extent() + self.end_gap();
            let other = substrate.radius.is_some_and(|given| (given.0 / radius - 1.0).abs() > 1e-6);
            let what = if self.symmetry == Symmetry::Axisymmetric { "radius" } else { "half width" };
            note(
                other,
                "substrate.radius",
                format!(
                    "symmetric sides repeat the asperities, in a cell of {what} {}; the spacing of the last asperity widens it",
                    length(radius)
                ),
            );
        }
        let sized =
            substrate.depth.is_some() && (substrate.radius.is_some() || self.lateral == Lateral::Symmetric);
        note(
            self.numerics.domain.is_some() && sized,
            "numerics.domain",
            "the scene says how large the body is".into(),
        );
        unused
    }
}
