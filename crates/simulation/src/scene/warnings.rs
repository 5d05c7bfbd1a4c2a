//! Warnings for inputs without effect, and for those that take much memory.

use super::messages::{error, length};
use super::{ElementChoice, Lateral, Scene, SceneError, Symmetry};
use crate::setup::discretisation::Discretisation;

/// Memory from which a run is worth a word before it begins, bytes.
const MUCH_MEMORY: f64 = 1e9;

/// Memory of a run with its companion over the cells of its mesh, bytes: four ridges of 6,400 and of 67,700
/// cells of eight nodes took 17 kB a cell. One of four nodes has a third of the unknowns.
const MEMORY_OF_CELL: [f64; 2] = [18e3, 6e3];

/// Cells under a contact that is `elements` wide: read off meshes of four ridges with 50, 200 and 1000,
/// within 6 %.
fn cells_of_contact(elements: f64) -> f64 {
    0.34 * elements * elements + 15.0 * elements
}

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

    /// The word before a run that takes more than a gigabyte of memory: the key that asks for it, and about
    /// how much; `None` of others, and of a mesh that is given.
    pub fn costly(&self) -> Option<SceneError> {
        let numbers = Discretisation::new(self);
        let elements = numbers.elements_in_contact;
        let contacts = if let Some(line) = self.profile.first() {
            line.line().ok()?.asperities.len()
        } else {
            self.asperity.len()
        };
        let contacts = contacts.max(1);
        let [quadratic, linear] = MEMORY_OF_CELL;
        let each = if numbers.element == ElementChoice::Q8r { quadratic } else { linear };
        let memory = each * contacts as f64 * cells_of_contact(elements as f64);
        if self.mesh.is_some() || memory < MUCH_MEMORY {
            return None;
        }
        let (path, fewer) = match self.numerics.elements_in_contact {
            Some(_) => ("numerics.elements_in_contact", "give fewer elements"),
            None if self.profile.is_empty() => ("asperity", "leave out those that the tool does not reach"),
            None => ("profile", "cut the line to the part that the tool reaches"),
        };
        let message = format!(
            "{elements} elements across each of {contacts} contacts take up to about {:.0} GB of memory: {fewer} where that is too much",
            memory / 1e9
        );
        Some(error(path, message))
    }
}
