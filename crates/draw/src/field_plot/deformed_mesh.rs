//! The mesh of a converged state where it is now, cut into flat facets fine enough for smooth contours.

use crate::{MEGAPASCAL, MICROMETRE};
use asperity_mesh::{Edge, Mesh};
use asperity_simulation::run::FieldFrame;
use asperity_solver::element::{quad4, quad8};

/// A field that panels show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Field {
    /// Von Mises stress, MPa.
    VonMises,
    /// Hydrostatic pressure, MPa.
    Pressure,
    /// Accumulated plastic strain.
    PlasticStrain,
    /// Distance from first yield, negative before it.
    FirstYield,
    /// Yield function over yield stress, negative where metal is elastic.
    YieldFunction,
}

impl Field {
    /// Number of fields.
    pub const COUNT: usize = 5;
}

/// Every field at a point, in their order.
pub type Values = [f64; Field::COUNT];

/// A corner of a facet.
#[derive(Clone, Copy, Debug)]
pub struct Vertex {
    /// Current position (r, z), µm.
    pub at: [f64; 2],
    /// The fields there.
    pub values: Values,
}

/// Deformed cells with their fields.
pub struct DeformedMesh {
    mesh: Mesh,
    /// Current positions of the nodes, µm.
    points: Vec<[f64; 2]>,
    values: Vec<Values>,
    contact_pressure: Vec<f64>,
    /// r and contact pressure along the surface, from the axis (left) outward, µm and MPa.
    pub surface: Vec<[f64; 2]>,
}

impl DeformedMesh {
    /// The mesh of `frame`.
    pub fn new(frame: &FieldFrame) -> DeformedMesh {
        let fields = &frame.fields;
        let moved = frame.mesh.nodes.iter().zip(&fields.displacement);
        let [v, p] = [&fields.von_mises, &fields.pressure];
        let values = |i: usize| {
            let [stress, pressure] = [v[i] / MEGAPASCAL, p[i] / MEGAPASCAL];
            [stress, pressure, fields.plastic_strain[i], fields.first_yield[i], fields.yield_function[i]]
        };
        DeformedMesh {
            mesh: frame.mesh.clone(),
            points: moved.map(|(x, u)| [0, 1].map(|k| (x[k] + u[k]) / MICROMETRE)).collect(),
            values: (0..frame.mesh.nodes.len()).map(values).collect(),
            contact_pressure: fields.contact_pressure.clone(),
            surface: fields.surface.iter().map(|p| [p.r / MICROMETRE, p.pressure / MEGAPASCAL]).collect(),
        }
    }

    /// Positions of the nodes that the tool presses.
    pub fn pressed(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        self.points.iter().zip(&self.contact_pressure).filter(|(_, p)| **p > 0.0).map(|(x, _)| *x)
    }

    /// From the first to the last foot of asperities of this height, whose summit was at height 0 before the
    /// crush.
    pub fn feet(&self, height: f64) -> [f64; 2] {
        let risen = self.mesh.sides.surface.iter().flat_map(|&edge| self.mesh.edge_nodes(edge).0);
        risen.map(|node| self.mesh.nodes[node as usize].map(|x| x / MICROMETRE)).fold(
            [0.0, 0.0],
            |[low, high], [r, z]| {
                if z > -0.999 * height { [low.min(r), high.max(r)] } else { [low, high] }
            },
        )
    }

    /// Every node.
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        self.mesh.cell_count()
    }

    /// True where some of a cell has yielded.
    pub fn yielded(&self, cell: usize) -> bool {
        self.mesh.cell(cell)[..4]
            .iter()
            .any(|&node| self.values[node as usize][Field::FirstYield as usize] > 0.0)
    }

    /// The corners of a cell.
    pub fn corners(&self, cell: usize) -> [[f64; 2]; 4] {
        let nodes = self.mesh.cell(cell);
        [0, 1, 2, 3].map(|k| self.points[nodes[k] as usize])
    }

    /// A cell cut into `parts` × `parts` quadrilaterals, each two facets.
    pub fn facets(&self, cell: usize, parts: usize) -> impl Iterator<Item = [Vertex; 3]> + use<> {
        let local = |i: usize| 2.0 * i as f64 / parts as f64 - 1.0;
        let row = parts + 1;
        let vertices: Vec<Vertex> =
            (0..row * row).map(|i| self.vertex(cell, [local(i % row), local(i / row)])).collect();
        (0..parts * parts).flat_map(move |i| {
            let first = (i / parts) * row + i % parts;
            let [a, b, c, d] = [first, first + 1, first + row + 1, first + row].map(|k| vertices[k]);
            [[a, b, c], [a, c, d]]
        })
    }

    /// The point of a cell at local coordinates in [-1, 1]²: quadratic in place, bilinear in the fields,
    /// which the solver gives at corners.
    fn vertex(&self, cell: usize, [x, y]: [f64; 2]) -> Vertex {
        let nodes = self.mesh.cell(cell);
        let (linear, quadratic) = (quad4::shape(x, y, 1.0).value, quad8::shape(x, y, 1.0).value);
        let shape = if nodes.len() == 8 { &quadratic[..] } else { &linear[..] };
        let mut vertex = Vertex { at: [0.0; 2], values: [0.0; Field::COUNT] };
        for (weight, &node) in shape.iter().zip(nodes) {
            let point = self.points[node as usize];
            vertex.at = [0, 1].map(|k| vertex.at[k] + weight * point[k]);
        }
        for (weight, &node) in linear.iter().zip(nodes) {
            let of_node = self.values[node as usize];
            vertex.values = std::array::from_fn(|i| vertex.values[i] + weight * of_node[i]);
        }
        vertex
    }

    /// The free surface: corner, corner, and the control point of the parabola between them.
    pub fn surface_sides(&self) -> impl Iterator<Item = [[f64; 2]; 3]> + '_ {
        self.mesh.sides.surface.iter().map(|&edge| self.side(edge))
    }

    /// Every side of every cell, each once.
    pub fn sides(&self) -> Vec<[[f64; 2]; 3]> {
        let mut seen = std::collections::HashSet::new();
        let edges =
            (0..self.cells()).flat_map(|cell| (0..4).map(move |side| Edge { cell: cell as u32, side }));
        edges
            .filter(|&edge| {
                let ([a, b], _) = self.mesh.edge_nodes(edge);
                seen.insert((a.min(b), a.max(b)))
            })
            .map(|edge| self.side(edge))
            .collect()
    }

    fn side(&self, edge: Edge) -> [[f64; 2]; 3] {
        let ([a, b], middle) = self.mesh.edge_nodes(edge);
        let [a, b] = [a, b].map(|node| self.points[node as usize]);
        let half = [0, 1].map(|k| 0.5 * (a[k] + b[k]));
        let control = middle.map_or(half, |node| {
            let m = self.points[node as usize];
            [0, 1].map(|k| 2.0 * m[k] - half[k])
        });
        [a, b, control]
    }
}
