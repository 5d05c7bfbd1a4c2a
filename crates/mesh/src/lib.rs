//! Meshes of conical asperities on a substrate: profiles, grading, quality, files.

pub mod build;
pub mod grading;
mod mesh;
pub mod profile;

pub use mesh::{Edge, ElementKind, Mesh, Sides};
