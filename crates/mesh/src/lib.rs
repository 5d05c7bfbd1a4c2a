//! Meshes of conical asperities on a substrate: profiles, grading, quality, files.

mod mesh;

pub use mesh::{Edge, ElementKind, Mesh, Sides};
