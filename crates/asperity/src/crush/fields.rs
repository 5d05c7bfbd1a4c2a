//! `fields.pvd` with its `fields_NNNN.vtu` and `surface_NNNN.csv`: the fields of some increments, as they are written.

use super::record::{Phase, SurfaceRow, write_rows};
use crate::error::Error;
use crate::output::{Sink, SinkExt};
use crate::units::{MEGAPASCAL, MICROMETRE};
use asperity_mesh::{FieldArray, Mesh, write_vtu};
use asperity_solver::body::fields::Fields;
use asperity_solver::run::crush::FieldFrame;
use asperity_solver::scene::{Field, Scene as Tables, Symmetry};
use std::io::{self, Write};
use std::sync::Arc;

/// Fields of one increment, in the units of the files, which the arrays carry in their names.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// The mesh before the crush, m; the frames of a run share it.
    pub mesh: Arc<Mesh>,
    /// Arrays over the nodes, such as `displacement_um`, `stress_rr_MPa`, `von_mises_MPa`, `contact_pressure_MPa`.
    pub nodes: Vec<FieldArray>,
    /// Arrays over the cells: `plastic_zone`, 0 never yielded, 1 has yielded, 2 yields now.
    pub cells: Vec<FieldArray>,
    /// The free surface from the axis outward.
    pub surface: Vec<SurfaceRow>,
}

impl Frame {
    /// The fields that `scene` asks for.
    pub(super) fn new(frame: &FieldFrame, mesh: Arc<Mesh>, scene: &Tables) -> Frame {
        let (nodes, cells) = field_arrays(&frame.fields, scene.output.fields(), scene.symmetry);
        let surface = frame.fields.surface.iter().map(SurfaceRow::new).collect();
        Frame { increment: frame.increment, phase: frame.phase.into(), mesh, nodes, cells, surface }
    }

    /// The values of the array `name` over nodes or cells, all components of a point together.
    pub fn array(&self, name: &str) -> Option<&[f64]> {
        let mut arrays = self.nodes.iter().chain(&self.cells);
        arrays.find(|array| array.name == name).map(|array| &array.values[..])
    }
}

/// The collection of field files of one run, readable at any moment.
#[derive(Debug, Default)]
pub struct FieldSeries {
    /// Increments that have a file.
    increments: Vec<usize>,
}

impl FieldSeries {
    /// Adds the fields of one increment: writes its VTU, coordinates in µm, its surface, and the collection anew.
    ///
    /// # Errors
    /// A disk that refuses, arrays that do not fit the mesh.
    pub fn add(&mut self, folder: &mut dyn Sink, frame: &Frame) -> Result<(), Error> {
        let increment = frame.increment;
        folder.write(&format!("fields_{increment:04}.vtu"), |out| {
            write_vtu(out, &frame.mesh, 1.0 / MICROMETRE, &frame.nodes, &frame.cells)
        })?;
        self.increments.push(increment);
        folder.write("fields.pvd", |out| self.write_collection(out))?;
        // the columns of a surface have one name in both symmetries
        folder.write(&format!("surface_{increment:04}.csv"), |out| {
            write_rows(out, &frame.surface, Symmetry::Axisymmetric)
        })
    }

    /// The ParaView collection; its time is the increment.
    fn write_collection(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(
            out,
            "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>"
        )?;
        for i in &self.increments {
            writeln!(
                out,
                "    <DataSet timestep=\"{i}\" group=\"\" part=\"0\" file=\"fields_{i:04}.vtu\"/>"
            )?;
        }
        writeln!(out, "  </Collection>\n</VTKFile>")
    }
}

/// The arrays of a field file on nodes and on cells: the fields that are `wanted`, and the contact pressure.
fn field_arrays(fields: &Fields, wanted: &[Field], symmetry: Symmetry) -> (Vec<FieldArray>, Vec<FieldArray>) {
    let array = |name: &str, components: usize, values: Vec<f64>| FieldArray {
        name: name.into(),
        components,
        values,
    };
    let stress = |name: &str, values: &mut dyn Iterator<Item = f64>| {
        array(&format!("{name}_MPa"), 1, values.map(|v| v / MEGAPASCAL).collect())
    };
    let (mut nodes, mut cells) = (Vec::new(), Vec::new());
    for field in wanted {
        match field {
            Field::Displacement => {
                let values = fields.displacement.iter().flatten().map(|u| u / MICROMETRE).collect();
                nodes.push(array("displacement_um", 2, values));
            }
            Field::Stress => {
                let names = match symmetry {
                    Symmetry::Axisymmetric => ["rr", "zz", "tt", "rz"],
                    Symmetry::PlaneStrain => ["xx", "zz", "yy", "xz"],
                };
                for (i, name) in names.iter().enumerate() {
                    nodes.push(stress(&format!("stress_{name}"), &mut fields.stress.iter().map(|s| s[i])));
                }
            }
            Field::VonMises => nodes.push(stress("von_mises", &mut fields.von_mises.iter().copied())),
            Field::PlasticStrain => nodes.push(array("plastic_strain", 1, fields.plastic_strain.clone())),
            Field::Pressure => nodes.push(stress("pressure", &mut fields.pressure.iter().copied())),
            Field::PlasticZone => cells.push(array("plastic_zone", 1, fields.plastic_zone.clone())),
        }
    }
    nodes.push(stress("contact_pressure", &mut fields.contact_pressure.iter().copied()));
    (nodes, cells)
}
