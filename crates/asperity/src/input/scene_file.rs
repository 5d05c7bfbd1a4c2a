//! A scene from its file: read, overridden, validated, with its mesh.

use crate::cli::args::SceneFlags;
use crate::error::InputError;
use crate::input::hardening_file;
use crate::input::toml_file::TomlFile;
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
        file.value.accuracy = level;
    }
    let curve = hardening_file::read(&file)?;
    if let Some(curve) = &curve {
        curve.put_into(&mut file.value.material);
    }
    // what is wrong with a table shows in the file that holds it
    file.value
        .validate()
        .map_err(|e| curve.and_then(|curve| curve.point_at(&e)).unwrap_or_else(|| point_at(&file, &e)))?;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A scene with some words replaced by others of it, or by extremes, is an error or a scene, never a panic.
    #[test]
    fn a_scrambled_scene_does_not_panic() {
        let text = include_str!("../../scenes/single-asperity.toml");
        let lines: Vec<&str> = text.lines().map(|l| l.split('#').next().unwrap_or_default()).collect();
        let text = lines.join("\n");
        let odd = [
            "-1",
            "0",
            "1e308",
            "1e-308",
            "nan",
            "\"inf um\"",
            "[",
            "]",
            "=",
            "\"",
            "\n",
            "true",
            "{}",
            "[[x]]",
            "\"1e300 km\"",
        ];
        let words: Vec<&str> = text.split_inclusive(char::is_whitespace).collect();
        let mut state = 7_u64;
        let mut next = move |n: usize| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 33) as usize % n
        };
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("scene.toml");
        let flags = SceneFlags { accuracy: None, overrides: Vec::new() };
        let mut scenes = 0;
        for _ in 0..2_000 {
            let mut scrambled: Vec<String> = words.iter().map(|w| w.to_string()).collect();
            for _ in 0..1 + next(3) {
                let at = next(words.len());
                let space: String = words[at].chars().filter(|c| c.is_whitespace()).collect();
                let new = if next(2) == 0 { odd[next(odd.len())] } else { words[next(words.len())].trim() };
                scrambled[at] = format!("{new}{space}");
            }
            std::fs::write(&path, scrambled.concat()).unwrap();
            match read(&path, &flags) {
                Ok(_) => scenes += 1,
                Err(error) => assert!(crate::cli::failure::report(error.into()).len() > 15),
            }
        }
        assert!((20..1_900).contains(&scenes), "{scenes}");
    }
}
