//! What accuracy costs on a scene.

pub mod case;
pub mod errors;
pub mod picture;
pub mod settings;
pub mod table;
