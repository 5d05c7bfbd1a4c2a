//! Gmsh MSH 4.1 in ASCII, with the sides as physical curves and the metal as a physical surface.

mod error;
mod file;
mod sides;
mod write;

use crate::{Edge, Mesh, Sides};

pub use error::MshError;
pub use write::write_msh;

/// The physical surface that holds all cells.
const BODY: &str = "body";

impl Sides {
    /// The sides with their names in files.
    pub fn named(&self) -> [(&'static str, &[Edge]); 4] {
        [("axis", &self.axis), ("base", &self.base), ("surface", &self.surface), ("outer", &self.outer)]
    }

    /// The side of that name.
    fn by_name(&mut self, name: &str) -> Option<&mut Vec<Edge>> {
        match name {
            "axis" => Some(&mut self.axis),
            "base" => Some(&mut self.base),
            "surface" => Some(&mut self.surface),
            "outer" => Some(&mut self.outer),
            _ => None,
        }
    }
}

/// Reads a mesh of 4-node or 8-node quadrilaterals whose physical curves are named axis, base, surface,
/// outer.
///
/// The section may lie in the plane z = 0 (x is r, y the height) or y = 0 (x is r, z the height). Cells are
/// turned counterclockwise, nodes without cells are dropped, the surface is put in order from the axis
/// outward; otherwise nodes and cells keep the order of the file, and coordinates their bits.
///
/// # Errors
/// Anything that is not such a mesh, with the line and what was expected there.
pub fn read_msh(bytes: &[u8]) -> Result<Mesh, MshError> {
    let text = std::str::from_utf8(bytes).map_err(|e| {
        let line = 1 + bytes[..e.valid_up_to()].iter().filter(|&&b| b == b'\n').count();
        MshError::new(line, "is not text: save the mesh as Gmsh \"Version 4 ASCII\" (Mesh.Binary = 0)")
    })?;
    sides::mesh(file::parse(text)?)
}

#[cfg(test)]
mod tests;
