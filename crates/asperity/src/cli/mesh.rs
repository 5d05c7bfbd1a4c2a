//! `asperity mesh`: the mesh of a scene with its sizes and quality, as a file.

use crate::calculix::Deck;
use crate::cli::args::{MeshCommand, MeshFormat};
use crate::cli::terminal;
use crate::crush::MICROMETRE;
use crate::error::{Error, InputError};
use crate::input::scene_file;
use asperity_mesh::{Mesh, Quality, write_msh, write_vtu};
use asperity_solver::run::depth_for_force::target_depth;
use asperity_solver::run::prepare::prepare;
use std::io::Write;
use std::path::{Path, PathBuf};

/// The format that the extension of the file names.
fn format_of(path: &Path) -> Result<MeshFormat, InputError> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    match extension.as_str() {
        "vtu" => Ok(MeshFormat::Vtu),
        "msh" => Ok(MeshFormat::Msh),
        "inp" => Ok(MeshFormat::Inp),
        _ => Err(InputError::new(format!("{}: the extension does not name a mesh format", path.display()))
            .help("write .vtu (ParaView), .msh (Gmsh 4.1) or .inp (CalculiX, Abaqus), or give --format")),
    }
}

/// Where to write what: `--format` wins over the extension, and alone writes a file with the scene's name.
fn target(args: &MeshCommand) -> Result<(PathBuf, MeshFormat), InputError> {
    match (&args.output, args.format) {
        (Some(path), Some(format)) => Ok((path.clone(), format)),
        (Some(path), None) => Ok((path.clone(), format_of(path)?)),
        (None, Some(format)) => Ok((format!("{}.{}", scene_name(args), format.extension()).into(), format)),
        (None, None) => Err(InputError::new("no file to write")
            .help("name it with -o, for example -o body.msh, or give --format vtu, msh or inp")),
    }
}

/// The file name of the scene without its extension.
fn scene_name(args: &MeshCommand) -> String {
    args.scene.file_stem().map(|s| s.to_string_lossy().into_owned()).unwrap_or_else(|| "scene".into())
}

/// Runs the command.
///
/// # Errors
/// A scene or a file name that is wrong; a disk that refuses.
pub fn mesh(args: &MeshCommand) -> Result<(), Error> {
    let (path, format) = target(args)?;
    let file = scene_file::read(&args.scene, &args.scene_flags)?;
    let given = scene_file::read_mesh(&file)?;
    let depth = target_depth(&file.value, given.as_ref());
    let problem = depth
        .and_then(|depth| prepare(&file.value, given, depth))
        .map_err(|e| scene_file::point_at(&file, &e))?;
    let content = match format {
        MeshFormat::Inp => {
            let deck = Deck::new(&scene_name(args), &file.value, &problem);
            Content::Deck(Box::new(deck.map_err(|e| scene_file::point_at(&file, &e))?))
        }
        MeshFormat::Vtu => Content::Vtu,
        MeshFormat::Msh => Content::Msh,
    };
    let mut mesh = problem.mesh;
    for node in &mut mesh.nodes {
        *node = node.map(|x| x * problem.units.length);
    }
    write_file(&path, &mesh, &content)?;
    if !args.quiet {
        terminal::say(&overview(&mesh));
        terminal::say(&format!("written    {}", path.display()));
    }
    Ok(())
}

/// What goes into the file.
enum Content {
    /// The mesh for ParaView, in µm.
    Vtu,
    /// The mesh for Gmsh, in m.
    Msh,
    /// The whole scene for CalculiX.
    Deck(Box<Deck>),
}

/// Writes beside the file and renames, so that it is whole or as it was.
fn write_file(path: &Path, mesh: &Mesh, content: &Content) -> Result<(), Error> {
    let error = |e: &dyn std::fmt::Display| {
        InputError::new(format!("cannot write {}: {e}", path.display())).help("give another file with -o")
    };
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(|e| error(&e))?;
    let mut out = std::io::BufWriter::new(file.as_file_mut());
    match content {
        Content::Vtu => write_vtu(&mut out, mesh, 1.0 / MICROMETRE, &[], &[]).map_err(|e| error(&e))?,
        Content::Msh => write_msh(&mut out, mesh).map_err(|e| error(&e))?,
        Content::Deck(deck) => deck.write(&mut out).map_err(|e| error(&e))?,
    }
    out.flush().map_err(|e| error(&e))?;
    drop(out);
    file.persist(path).map_err(|e| error(&e))?;
    Ok(())
}

/// Sizes and quality, a line each.
fn overview(mesh: &Mesh) -> String {
    let cells = mesh.cell_count();
    let kind = mesh.kind.nodes();
    let sides: Vec<String> =
        mesh.sides.named().iter().map(|(name, edges)| format!("{name} {}", edges.len())).collect();
    let mut text = format!(
        "mesh       {cells} cells of {kind} nodes, {} nodes, sides {}",
        mesh.nodes.len(),
        sides.join(", ")
    );
    if let Some(q) = mesh.quality() {
        let Quality { min_scaled_jacobian, min_angle_deg, max_aspect, median_aspect, min_size, max_size } = q;
        text += &format!(
            "\nsize       {:.4} to {:.4} um\nquality    scaled Jacobian {min_scaled_jacobian:.3} or better, \
             corners {min_angle_deg:.1} degrees or more, aspect ratio {median_aspect:.2} (median) to {max_aspect:.2}",
            min_size / MICROMETRE,
            max_size / MICROMETRE
        );
    }
    text
}
