//! `asperity mesh`: the mesh of a scene with its sizes and quality, as a file.

use crate::args::MeshCommand;
use crate::failure::{Failure, InputError};
use crate::records::MICROMETRE;
use crate::{scene_file, terminal};
use asperity_mesh::{Mesh, Quality, Section, write_inp, write_msh, write_vtu};
use asperity_solver::discretise::prepare;
use asperity_solver::scene::Symmetry;
use std::io::Write;
use std::path::Path;

/// Formats by the extension of the file.
#[derive(Clone, Copy)]
enum Format {
    Vtu,
    Msh,
    Inp,
}

impl Format {
    fn of(path: &Path) -> Result<Self, InputError> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default();
        match extension.as_str() {
            "vtu" => Ok(Format::Vtu),
            "msh" => Ok(Format::Msh),
            "inp" => Ok(Format::Inp),
            _ => {
                Err(InputError::new(format!("{}: the extension does not name a mesh format", path.display()))
                    .help("write .vtu (ParaView), .msh (Gmsh 4.1) or .inp (CalculiX, Abaqus)"))
            }
        }
    }
}

/// Runs the command.
///
/// # Errors
/// A scene or a file name that is wrong; a disk that refuses.
pub fn mesh(args: &MeshCommand) -> Result<(), Failure> {
    let format = Format::of(&args.output)?;
    let file = scene_file::read(&args.scene, &args.scene_flags)?;
    let given = scene_file::read_mesh(&file)?;
    let problem = prepare(&file.value, given).map_err(|e| scene_file::point_at(&file, &e))?;
    let mut mesh = problem.mesh;
    for node in &mut mesh.nodes {
        *node = node.map(|x| x * problem.length);
    }
    write_file(&args.output, &mesh, format, file.value.symmetry)?;
    if !args.quiet {
        terminal::say(&overview(&mesh));
        terminal::say(&format!("written    {}", args.output.display()));
    }
    Ok(())
}

/// Writes beside the file and renames, so that it is whole or as it was.
fn write_file(path: &Path, mesh: &Mesh, format: Format, symmetry: Symmetry) -> Result<(), Failure> {
    let error = |e: &dyn std::fmt::Display| {
        InputError::new(format!("cannot write {}: {e}", path.display())).help("give another file with -o")
    };
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder).map_err(|e| error(&e))?;
    let mut out = std::io::BufWriter::new(file.as_file_mut());
    match format {
        Format::Vtu => write_vtu(&mut out, mesh, 1.0 / MICROMETRE, &[], &[]).map_err(|e| error(&e))?,
        Format::Msh => write_msh(&mut out, mesh).map_err(|e| error(&e))?,
        Format::Inp => {
            let section = match symmetry {
                Symmetry::Axisymmetric => Section::Axisymmetric,
                Symmetry::PlaneStrain => Section::PlaneStrain,
            };
            write_inp(&mut out, mesh, section).map_err(|e| error(&e))?;
        }
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
