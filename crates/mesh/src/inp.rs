//! A mesh as CalculiX (and Abaqus) input: nodes, elements, and the sides as node sets and surfaces.

use crate::mesh::numbers;
use crate::{Edge, ElementKind, Mesh};
use std::collections::BTreeSet;
use std::io::{self, Write};

/// The two-dimensional idealisation of the elements.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Section {
    /// Body of revolution about x = 0: CAX4, CAX8R.
    Axisymmetric,
    /// Plane strain: CPE4, CPE8R.
    PlaneStrain,
}

impl Section {
    /// Name of the element.
    pub fn element(self, kind: ElementKind) -> &'static str {
        match (self, kind) {
            (Section::Axisymmetric, ElementKind::Quad4) => "CAX4",
            (Section::Axisymmetric, ElementKind::Quad8) => "CAX8R",
            (Section::PlaneStrain, ElementKind::Quad4) => "CPE4",
            (Section::PlaneStrain, ElementKind::Quad8) => "CPE8R",
        }
    }
}

/// Numbers a node set has on one line.
const PER_LINE: usize = 12;

/// Writes the mesh with its coordinates as they are, in `unit`; nodes and elements count from 1.
///
/// The elements are the set `BODY`; each side that has edges is a node set and an element surface with its
/// name in capitals.
///
/// # Errors
/// A writer that fails.
pub fn write_inp(mut out: impl Write, mesh: &Mesh, section: Section, unit: &str) -> io::Result<()> {
    let element = section.element(mesh.kind);
    writeln!(out, "** x is the radius (plane strain: the width), y the height; lengths in {unit}")?;
    writeln!(out, "*NODE, NSET=ALL")?;
    // a field of CalculiX holds 20 characters: twelve digits fit with sign and exponent
    for (i, [r, z]) in mesh.nodes.iter().enumerate() {
        writeln!(out, "{}, {r:.11e}, {z:.11e}, 0.", i + 1)?;
    }
    writeln!(out, "*ELEMENT, TYPE={element}, ELSET=BODY")?;
    for (i, cell) in mesh.cells.chunks_exact(mesh.kind.nodes()).enumerate() {
        writeln!(out, "{}, {}", i + 1, numbers(cell.iter().copied()).join(", "))?;
    }
    for (name, edges) in mesh.sides.named() {
        if !edges.is_empty() {
            write_inp_side(&mut out, mesh, &name.to_uppercase(), edges)?;
        }
    }
    Ok(())
}

/// Writes `edges` as a node set and an element surface with the same name.
///
/// # Errors
/// A writer that fails.
pub fn write_inp_side(mut out: impl Write, mesh: &Mesh, name: &str, edges: &[Edge]) -> io::Result<()> {
    let nodes: BTreeSet<u32> = edges.iter().flat_map(|&edge| mesh.nodes_along(edge)).collect();
    writeln!(out, "*NSET, NSET={name}")?;
    for line in numbers(nodes).chunks(PER_LINE) {
        writeln!(out, "{},", line.join(", "))?;
    }
    writeln!(out, "*SURFACE, NAME={name}, TYPE=ELEMENT")?;
    for edge in edges {
        writeln!(out, "{}, S{}", edge.cell + 1, edge.side + 1)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Sides;

    #[test]
    fn a_deck_counts_from_one_and_names_the_sides() {
        let mesh = Mesh {
            kind: ElementKind::Quad4,
            nodes: vec![[0.0, 0.0], [1e-6, 0.0], [1e-6, 2e-6], [0.0, 2e-6]],
            cells: vec![0, 1, 2, 3],
            sides: Sides {
                axis: vec![Edge { cell: 0, side: 3 }],
                surface: vec![Edge { cell: 0, side: 2 }],
                ..Sides::default()
            },
        };
        let mut text = Vec::new();
        write_inp(&mut text, &mesh, Section::Axisymmetric, "m").unwrap();
        let text = String::from_utf8(text).unwrap();
        for line in [
            "3, 1.00000000000e-6, 2.00000000000e-6, 0.",
            "*ELEMENT, TYPE=CAX4, ELSET=BODY",
            "1, 1, 2, 3, 4",
            "*NSET, NSET=SURFACE",
            "1, S3",
        ] {
            assert!(text.lines().any(|l| l == line), "{line}\n{text}");
        }
        assert!(!text.contains("OUTER"));
    }
}
