//! `fields.pvd` with its `fields_NNNN.vtu`, and `surface_NNNN.csv`.

use super::table::number;
use super::{MEGAPASCAL, MICROMETRE};
use crate::error::Error;
use crate::output::{Sink, SinkExt};
use asperity_mesh::{FieldArray, Mesh, write_vtu};
use asperity_solver::body::fields::{Fields, SurfacePoint};
use asperity_solver::scene::{Field, Symmetry};
use std::io::{self, Write};

/// The collection of field files of one run, readable at any moment.
#[derive(Debug, Default)]
pub struct FieldSeries {
    /// Increments that have a file.
    increments: Vec<usize>,
}

impl FieldSeries {
    /// Adds the fields of one increment: writes its VTU, coordinates in µm, and the collection anew.
    ///
    /// # Errors
    /// A disk that refuses, arrays that do not fit the mesh.
    pub fn add(
        &mut self,
        folder: &mut dyn Sink,
        increment: usize,
        mesh: &Mesh,
        nodes: &[FieldArray],
        cells: &[FieldArray],
    ) -> Result<(), Error> {
        folder.write(&format!("fields_{increment:04}.vtu"), |out| {
            write_vtu(out, mesh, 1.0 / MICROMETRE, nodes, cells)
        })?;
        self.increments.push(increment);
        folder.write("fields.pvd", |out| self.write_collection(out))
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
pub fn field_arrays(
    fields: &Fields,
    wanted: &[Field],
    symmetry: Symmetry,
) -> (Vec<FieldArray>, Vec<FieldArray>) {
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
            // 0 never yielded, 1 has yielded, 2 flows now
            Field::PlasticZone => cells.push(array("plastic_zone", 1, fields.plastic_zone.clone())),
        }
    }
    nodes.push(stress("contact_pressure", &mut fields.contact_pressure.iter().copied()));
    (nodes, cells)
}

/// Writes the free surface from the axis outward: where it is, how it has moved, what presses on it.
///
/// # Errors
/// A writer that fails.
pub fn write_surface(out: &mut dyn Write, points: &[SurfacePoint]) -> io::Result<()> {
    writeln!(out, "r_um,z_um,u_r_um,u_z_um,pressure_MPa,yielded")?;
    for SurfacePoint { position: [r, z], displacement: [u_r, u_z], pressure, yielded } in points {
        let lengths = [r, z, u_r, u_z].map(|v| number(v / MICROMETRE));
        let pressure = number(pressure / MEGAPASCAL);
        writeln!(out, "{},{pressure},{}", lengths.join(","), u8::from(*yielded))?;
    }
    Ok(())
}
