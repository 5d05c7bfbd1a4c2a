//! Axisymmetric and plane-strain large-strain elastoplastic finite elements with a rigid tool.

pub mod record;
pub mod scene;
