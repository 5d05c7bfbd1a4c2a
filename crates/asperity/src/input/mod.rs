//! Files that users write: scenes and sweeps in TOML, tables of hardening, measured outlines, meshes; read
//! with errors that point at the line.

/// Behind a file that a scene names and that cannot be read.
pub(crate) const RELATIVE_PATH_NOTE: &str = "a path is relative to the folder of the file that names it";

pub mod hardening_file;
mod kind;
pub mod missing_file;
pub mod profile_file;
pub mod scene;
pub mod suggest;
pub mod table_file;
pub mod toml_file;
