//! Files that users write: scenes and sweeps in TOML, tables of hardening, meshes; read with errors that point at the line.

pub mod hardening_file;
pub mod scene;
pub mod suggest;
pub mod toml_file;
