//! Meshing anew: when a mesh is distorted, where its nodes go, and the state that is carried over.

pub mod distortion;

mod surface_curve;

pub mod transfer;
