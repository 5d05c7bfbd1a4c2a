//! Writing MSH.

use super::BODY;
use crate::mesh::{extent, numbers};
use crate::{ElementKind, Mesh};
use std::io::{self, Write};

/// Least and largest coordinate of some nodes, as MSH wants boxes: x y z of the one, then of the other.
fn bounding_box(mesh: &Mesh, nodes: impl Iterator<Item = u32>) -> String {
    let [[left, right], [low, high]] = extent(nodes.map(|node| mesh.nodes[node as usize]));
    format!("{left:?} {low:?} 0 {right:?} {high:?} 0")
}

/// Writes the mesh in the plane z = 0 with its coordinates as they are, shortest digits that read back to the
/// same bits. Tags count from 1: nodes and cells in their order, sides as curves 1 to 4, the metal as surface
/// 1.
///
/// # Errors
/// A writer that fails.
pub fn write_msh(mut out: impl Write, mesh: &Mesh) -> io::Result<()> {
    let sides: Vec<_> =
        mesh.sides.named().into_iter().enumerate().filter(|(_, (_, e))| !e.is_empty()).collect();
    writeln!(out, "$MeshFormat\n4.1 0 8\n$EndMeshFormat")?;
    writeln!(out, "$Comments\nx is the radius (plane strain: the width), y the height\n$EndComments")?;

    writeln!(out, "$PhysicalNames\n{}", sides.len() + 1)?;
    for (i, (name, _)) in &sides {
        writeln!(out, "1 {} \"{name}\"", i + 1)?;
    }
    writeln!(out, "2 1 \"{BODY}\"\n$EndPhysicalNames")?;

    writeln!(out, "$Entities\n0 {} 1 0", sides.len())?;
    for (i, (_, edges)) in &sides {
        let nodes = edges.iter().flat_map(|&edge| mesh.nodes_along(edge));
        let tag = i + 1;
        writeln!(out, "{tag} {} 1 {tag} 0", bounding_box(mesh, nodes))?;
    }
    writeln!(out, "1 {} 1 1 0\n$EndEntities", bounding_box(mesh, 0..mesh.nodes.len() as u32))?;

    let count = mesh.nodes.len();
    writeln!(out, "$Nodes\n1 {count} 1 {count}\n2 1 0 {count}")?;
    for tag in 1..=count {
        writeln!(out, "{tag}")?;
    }
    for [r, z] in &mesh.nodes {
        writeln!(out, "{r:?} {z:?} 0")?;
    }
    writeln!(out, "$EndNodes")?;

    let (line, quad) = match mesh.kind {
        ElementKind::Quad4 => (1, 3),
        ElementKind::Quad8 => (8, 16),
    };
    let cells = mesh.cell_count();
    let lines: usize = sides.iter().map(|(_, (_, edges))| edges.len()).sum();
    writeln!(out, "$Elements\n{} {} 1 {}", sides.len() + 1, cells + lines, cells + lines)?;
    writeln!(out, "2 1 {quad} {cells}")?;
    for (i, cell) in mesh.cells.chunks_exact(mesh.kind.nodes()).enumerate() {
        writeln!(out, "{} {}", i + 1, numbers(cell.iter().copied()).join(" "))?;
    }
    let mut tag = cells;
    for (i, (_, edges)) in &sides {
        writeln!(out, "1 {} {line} {}", i + 1, edges.len())?;
        for &edge in *edges {
            tag += 1;
            let (corners, middle) = mesh.edge_nodes(edge);
            writeln!(out, "{tag} {}", numbers(corners.into_iter().chain(middle)).join(" "))?;
        }
    }
    writeln!(out, "$EndElements")
}
