//! A scene from its file: read, overridden, validated, with its mesh.

use crate::args::SceneFlags;
use crate::failure::InputError;
use crate::toml_file::TomlFile;
use asperity_mesh::{Mesh, read_msh};
use asperity_solver::scene::{Scene, SceneError};
use std::path::Path;

/// Reads and validates a scene; flags win over the file.
///
/// # Errors
/// A scene that cannot be read or makes no sense, pointing at the line.
pub fn read(path: &Path, flags: &SceneFlags) -> Result<TomlFile<Scene>, InputError> {
    let mut file: TomlFile<Scene> = TomlFile::read(path, &flags.overrides)?;
    if let Some(level) = flags.accuracy {
        file.value.accuracy = level.into();
    }
    file.value.validate().map_err(|e| point_at(&file, &e))?;
    Ok(file)
}

/// An error of the scene with its line.
pub fn point_at(file: &TomlFile<Scene>, error: &SceneError) -> InputError {
    file.error_at(&error.path, &error.message)
}

/// The mesh that the scene names, in metres, its highest point at height 0; `None` if it is to be built.
///
/// # Errors
/// A file that cannot be read or is no mesh.
pub fn read_mesh(file: &TomlFile<Scene>) -> Result<Option<Mesh>, InputError> {
    let Some(named) = &file.value.mesh else { return Ok(None) };
    let path = file.resolve(&named.file);
    let error = |reason: String| {
        file.error_at("mesh.file", &format!("{}: {reason}", path.display()))
            .help("a mesh is a Gmsh MSH 4.1 ASCII file of quadrangles with physical curves axis, base, surface, outer")
    };
    let bytes = std::fs::read(&path).map_err(|e| error(format!("cannot be read: {e}")))?;
    let mut mesh = read_msh(&bytes).map_err(|e| error(e.to_string()))?;
    let scale = named.unit.map_or(1.0, |unit| unit.0);
    let summit = mesh.nodes.iter().map(|node| node[1]).fold(f64::NEG_INFINITY, f64::max);
    for [r, z] in &mut mesh.nodes {
        (*r, *z) = (*r * scale, (*z - summit) * scale);
    }
    Ok(Some(mesh))
}
