//! Files that users write: scenes and sweeps in TOML, tables of hardening, measured outlines, meshes; read with errors that point at the line.

pub mod hardening_file;
pub mod profile_file;
pub mod scene;
pub mod suggest;
pub mod table_file;
pub mod toml_file;
