//! `asperity mesh`: the mesh of a scene with its sizes and quality, as a file.

use crate::flags::SceneFlags;
use crate::terminal;
use asperity::calculix::{Reader, deck, is_alike};
use asperity::error::{Error, InputError};
use asperity::input::scene::Scene;
use asperity::mesh::{Mesh, Quality, write_msh, write_vtu};
use asperity::output::write_whole;
use asperity::units::MICROMETRE;
use clap::{Args, ValueEnum};
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// Arguments of `asperity mesh`.
#[derive(Debug, Args)]
pub struct MeshCommand {
    /// Scene file (TOML)
    pub scene: PathBuf,
    /// File to write: .vtu (ParaView), .msh (Gmsh 4.1) or .inp (CalculiX; with --format abaqus for Abaqus) [default with --format: named after the scene]
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Format, where the extension of the file does not say
    #[arg(long, value_enum)]
    pub format: Option<MeshFormat>,
    #[command(flatten)]
    pub scene_flags: SceneFlags,
    /// Without -o: write over a file of that name, whatever it is [default: over an earlier mesh or deck of the same kind]
    #[arg(long)]
    pub force: bool,
    /// Print nothing but errors
    #[arg(long)]
    pub quiet: bool,
}

/// Formats of `asperity mesh`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum MeshFormat {
    /// The mesh for ParaView
    Vtu,
    /// The mesh for Gmsh 4.1; a scene can read it
    Msh,
    /// The whole scene for CalculiX: mesh, material, tool, contact, steps, output
    Inp,
    /// The same for Abaqus, in a file .inp
    Abaqus,
}

/// The format that the extension of the file names.
fn format_of(path: &Path) -> Result<MeshFormat, InputError> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
    MeshFormat::from_str(&extension, true).map_err(|_| {
        InputError::new(format!("{}: the extension does not name a mesh format", path.display()))
            .help("write .vtu (ParaView), .msh (Gmsh 4.1) or .inp (CalculiX, Abaqus), or give --format")
    })
}

/// Path and format of the file: `--format` wins over the extension, and alone writes a file with the scene's
/// name.
fn target(args: &MeshCommand) -> Result<(PathBuf, MeshFormat), InputError> {
    match (&args.output, args.format) {
        (Some(path), format) => Ok((path.clone(), format.map_or_else(|| format_of(path), Ok)?)),
        (None, Some(format)) => {
            let name = args.scene.file_stem().unwrap_or("scene".as_ref());
            let value = format.to_possible_value();
            let extension = match format {
                MeshFormat::Abaqus => "inp",
                _ => value.as_ref().map_or("", |value| value.get_name()),
            };
            Ok((Path::new(name).with_extension(extension), format))
        }
        (None, None) => Err(InputError::new("no file to write")
            .help("name it with -o, for example -o body.msh, or give --format vtu, msh or inp")),
    }
}

/// Runs the command.
///
/// # Errors
/// A scene or a file name that is wrong; a disk that refuses.
pub fn mesh(args: &MeshCommand) -> Result<(), Error> {
    let (path, format) = target(args)?;
    let scene = args.scene_flags.read(&args.scene)?;
    let mesh = asperity::mesh::mesh(&scene)?;
    let (bytes, warnings) = content(&scene, &mesh, format)?;
    let is_named = args.output.is_some() || args.force;
    if !is_named && std::fs::read(&path).is_ok_and(|old| !is_alike(&old, &bytes)) {
        let message = format!("{} is there and no earlier file of this command", path.display());
        return Err(InputError::new(message).help("name another with -o, or give --force").into());
    }
    write_whole(&path, &bytes)
        .map_err(|e| InputError::new(e.to_string()).help("give another file with -o"))?;
    if !args.quiet {
        warnings.iter().for_each(terminal::warn);
        terminal::say(&format!("{}\nwritten    {}", overview(&mesh), path.display()))?;
    }
    Ok(())
}

/// The content of the file: the mesh for ParaView in µm, for Gmsh in m, or the whole scene for CalculiX; and
/// what it says worse than the scene.
fn content(scene: &Scene, mesh: &Mesh, format: MeshFormat) -> Result<(Vec<u8>, Vec<String>), Error> {
    fn failed(e: impl Display) -> Error {
        Error::Unfinished(format!("the mesh cannot be written: {e}"))
    }
    let (mut out, mut warnings) = (Vec::new(), Vec::new());
    let mut write_deck = |out: &mut Vec<u8>, reader| -> Result<(), Error> {
        let deck = deck(&scene.name(), scene, reader)?;
        warnings = deck.warnings();
        deck.write(out).map_err(failed)
    };
    match format {
        MeshFormat::Vtu => write_vtu(&mut out, mesh, 1.0 / MICROMETRE, &[], &[], &[]).map_err(failed)?,
        MeshFormat::Msh => write_msh(&mut out, mesh).map_err(failed)?,
        MeshFormat::Inp => write_deck(&mut out, Reader::CalculiX)?,
        MeshFormat::Abaqus => write_deck(&mut out, Reader::Abaqus)?,
    }
    Ok((out, warnings))
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
