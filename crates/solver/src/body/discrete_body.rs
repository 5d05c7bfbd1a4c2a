//! The discretised body: what stays the same while it is loaded.

use crate::body::analysis::{Analyses, Analysis};
use crate::body::failure::Failure;
use crate::contact::edge::{ContactContext, ContactEdge};
use crate::contact::slip::{Friction, Rubbing};
use crate::contact::tool::Tool;
use crate::element::kernel::POINTS;
use crate::element::{quad4, quad8};
use crate::point::kinematics::{ShapePoint, Symmetry, motion};
use crate::point::material::Metal;
use asperity_mesh::{ElementKind, Mesh};
use asperity_numerics::lanes::Lanes;
use pulp::Arch;
use std::sync::Arc;

/// A tool in contact with the surface of the body.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolContact {
    /// Its shape.
    pub tool: Tool,
    /// Pressure per penetration in the stress-free state; a load path may change it.
    pub penalty: f64,
    /// Its friction; `None`: it is smooth.
    pub friction: Option<Friction>,
}

impl ToolContact {
    /// The contact with the tool's tip at rest at height `tip`.
    pub fn context(&self, tip: f64, penalty: f64, symmetry: Symmetry) -> ContactContext<'_> {
        self.context_from(tip, tip, penalty, symmetry)
    }

    /// The contact with the tool's tip at height `tip`, which comes from the height `tip_before`.
    pub fn context_from(
        &self,
        tip_before: f64,
        tip: f64,
        penalty: f64,
        symmetry: Symmetry,
    ) -> ContactContext<'_> {
        let rubbing = self.friction.map(|friction| Rubbing { friction, tip_before, holds: false });
        ContactContext { tool: &self.tool, tip, penalty, spring: penalty, symmetry, rubbing }
    }
}

/// Mesh, material, fixed components and tool. Lengths are in units of the peak depth of a scene, stresses in
/// units of E.
#[derive(Clone, Debug)]
pub struct Body<'m> {
    /// The mesh before loading.
    pub mesh: &'m Mesh,
    /// Axisymmetric or plane strain.
    pub symmetry: Symmetry,
    /// The material.
    pub material: Metal,
    /// The tool, if there is one.
    pub contact: Option<ToolContact>,
    /// Numbers of the unknown displacement components, and the pattern of their stiffness.
    pub analysis: Arc<Analysis>,
    /// Reference volume of every integration point, four to an element.
    pub volume: Vec<f64>,
    /// Integration points of the eight-node element.
    pub points8: ShapePoint<8, Lanes>,
    /// Integration points of the four-node element.
    pub points4: ShapePoint<4, Lanes>,
    /// The vector registers of the processor.
    pub(crate) arch: Arch,
}

impl<'m> Body<'m> {
    /// The body of `mesh` whose displacement components named by `fixed(node)` are prescribed; its topology
    /// is analysed unless it is one of `analyses`.
    ///
    /// # Errors
    /// An element that is inside out in the mesh.
    pub fn new(
        analyses: &Analyses,
        mesh: &'m Mesh,
        symmetry: Symmetry,
        material: Metal,
        fixed: impl Fn(usize) -> [bool; 2],
        contact: Option<ToolContact>,
    ) -> Result<Self, Failure> {
        let fixed: Vec<[bool; 2]> = (0..mesh.nodes.len()).map(fixed).collect();
        let analysis =
            analyses.analyse(&mesh.cells, mesh.kind.nodes(), &fixed).map_err(|_| Failure::Singular)?;
        let points8 = ShapePoint::side_by_side(&quad8::points());
        let points4 = ShapePoint::side_by_side(&quad4::points());
        let volume = Vec::with_capacity(mesh.cell_count() * POINTS);
        let mut body =
            Body { mesh, symmetry, material, contact, analysis, volume, points8, points4, arch: Arch::new() };
        for cell in 0..mesh.cell_count() {
            let volumes = body.volumes_at(&mesh.nodes, cell)?;
            body.volume.extend(volumes);
        }
        Ok(body)
    }

    /// Volumes of the integration points of `cell` with the nodes of the mesh at `position`.
    ///
    /// # Errors
    /// The element is inside out there.
    pub fn volumes_at(&self, position: &[[f64; 2]], cell: usize) -> Result<[f64; POINTS], Failure> {
        let nodes = self.mesh.cell(cell);
        let volume = match self.mesh.kind {
            ElementKind::Quad8 => {
                let x = gather::<8>(position, nodes);
                motion(&self.points8, &x, &[[0.0; 2]; 8], self.symmetry).map(|motion| motion.volume)
            }
            ElementKind::Quad4 => {
                let x = gather::<4>(position, nodes);
                motion(&self.points4, &x, &[[0.0; 2]; 4], self.symmetry).map(|motion| motion.volume)
            }
        };
        volume.map(|volume| volume.0).map_err(|cause| Failure::Element { cell, cause })
    }

    /// The edges of the free surface with the nodes of the mesh at `nodes`, in its order; none without a
    /// tool.
    pub fn surface(&self, nodes: &[[f64; 2]]) -> Vec<ContactEdge> {
        let edges = self.contact.as_ref().map_or(&[][..], |_| &self.mesh.sides.surface);
        edges
            .iter()
            .map(|&edge| {
                let (corners, middle) = self.mesh.edge_nodes(edge);
                ContactEdge::new(corners, middle, |node| nodes[node as usize], self.symmetry)
            })
            .collect()
    }

    /// Integration points of the element `cell`.
    pub fn points_of(cell: usize) -> std::ops::Range<usize> {
        cell * POINTS..(cell + 1) * POINTS
    }
}

/// The node values of a cell.
#[inline(always)]
pub fn gather<const N: usize>(values: &[[f64; 2]], cell: &[u32]) -> [[f64; 2]; N] {
    // `array::from_fn` is not inlined into code for other registers than the program's
    let mut out = [[0.0; 2]; N];
    for (out, &node) in out.iter_mut().zip(cell) {
        *out = values[node as usize];
    }
    out
}
