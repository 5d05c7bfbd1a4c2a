//! Meshes of conical asperities on a substrate: profiles, grading, quality, files.

mod inp;
mod mesh;
mod msh;
mod quality;
mod vtu;

pub use inp::{Section, write_inp};
pub use mesh::{Edge, ElementKind, Mesh, Sides};
pub use msh::{MshError, read_msh, write_msh};
pub use quality::Quality;
pub use vtu::{FieldArray, VtuError, write_vtu};
