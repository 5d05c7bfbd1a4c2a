//! `fields.pvd` with its `fields_NNNN.vtu` and `surface_NNNN.csv`: the fields of some increments, as they are
//! written.

use crate::error::Error;
use crate::results::columns::{Unit, names, values, write_rows, write_values};
use crate::results::output::{Sink, SinkExt};
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use asperity_mesh::{FieldArray, Mesh, write_vtu};
use asperity_simulation::record::rows::{CurveRow, Phase};
use asperity_simulation::run::FieldFrame;
use asperity_simulation::scene::{Field, Scene as Tables, Symmetry};
use asperity_solver::body::fields::{Fields, SurfacePoint};
use serde_json::{Value, json};
use std::io::{self, Write};
use std::sync::Arc;

/// Fields of one increment; the arrays are in the units of the files, which they carry in their names.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Increment of the curve.
    pub increment: usize,
    /// Loading or unloading.
    pub phase: Phase,
    /// Depth of the increment, m, as the observer hears of it: the curve is free of ripple once the run has
    /// ended.
    pub depth: f64,
    /// Likewise its force, N (N/m in plane strain).
    pub force: f64,
    /// Symmetry of the body.
    pub symmetry: Symmetry,
    /// The mesh before the crush, m; the frames of a run share it.
    pub mesh: Arc<Mesh>,
    /// Arrays over the nodes, such as `displacement_um`, `stress_rr_MPa`, `von_mises_MPa`,
    /// `contact_pressure_MPa`.
    pub nodes: Vec<FieldArray>,
    /// Arrays over the cells: `plastic_zone`, 0 never yielded, 1 has yielded, 2 yields now.
    pub cells: Vec<FieldArray>,
    /// The free surface from the axis outward.
    pub surface: Vec<SurfacePoint>,
}

impl Frame {
    /// The fields that `scene` asks for.
    pub(super) fn new(frame: &FieldFrame, mesh: Arc<Mesh>, scene: &Tables, row: Option<&CurveRow>) -> Frame {
        let (nodes, cells) = field_arrays(&frame.fields, scene.output.fields(), scene.symmetry);
        // before the first increment nothing has happened
        let [depth, force] = row.map_or([0.0; 2], |row| [row.depth, row.force]);
        Frame {
            increment: frame.increment,
            phase: frame.phase,
            depth,
            force,
            symmetry: scene.symmetry,
            mesh,
            nodes,
            cells,
            surface: frame.fields.surface.clone(),
        }
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
    /// Increments that have a file, with their times.
    times: Vec<(usize, f64)>,
    /// Depth of the last of them.
    depth_um: f64,
    /// The surfaces so far, each with increment, phase and depth in µm.
    surfaces: Vec<([Value; 3], Vec<SurfacePoint>)>,
}

impl FieldSeries {
    /// Adds the fields of one increment: writes its VTU, coordinates in µm, its surface, and the collection
    /// anew.
    ///
    /// # Errors
    /// A disk that refuses, arrays that do not fit the mesh.
    pub fn add(&mut self, folder: &mut dyn Sink, frame: &Frame) -> Result<(), Error> {
        let increment = frame.increment;
        folder.write(&format!("fields_{increment:04}.vtu"), |out| {
            let force = Unit::Force.name("force", frame.symmetry);
            let whole = [
                ("depth_um", frame.depth / MICROMETRE),
                (&force, frame.force / Unit::Force.value(frame.symmetry)),
            ];
            write_vtu(out, &frame.mesh, 1.0 / MICROMETRE, &frame.nodes, &frame.cells, &whole)
        })?;
        self.count(frame);
        folder.write("fields.pvd", |out| self.write_collection(out))?;
        folder.write(&format!("surface_{increment:04}.csv"), |out| {
            write_rows(out, &frame.surface, frame.symmetry)
        })
    }

    /// Removes the files of its frames: a finer round has others.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn remove(self, folder: &mut dyn Sink) -> Result<(), Error> {
        for (increment, _) in self.times {
            for name in [format!("fields_{increment:04}.vtu"), format!("surface_{increment:04}.csv")] {
                folder.remove(&name)?;
            }
        }
        Ok(())
    }

    /// Takes down the time and the surface of a frame.
    fn count(&mut self, frame: &Frame) {
        let depth_um = frame.depth / MICROMETRE;
        let way = self.times.last().map_or(0.0, |(_, time)| *time) + (depth_um - self.depth_um).abs();
        // states of one depth keep their order
        let time = self.times.last().map_or(way, |(_, last)| way.max(last.next_up()));
        self.times.push((frame.increment, time));
        self.depth_um = depth_um;
        self.surfaces
            .push(([json!(frame.increment), json!(frame.phase), json!(depth_um)], frame.surface.clone()));
    }

    /// Writes the surfaces of all frames to one file, if there are any.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write_surfaces(&self, folder: &mut dyn Sink) -> Result<(), Error> {
        let Some((_, first)) = self.surfaces.first() else { return Ok(()) };
        // the columns of a surface have one name in both symmetries
        let symmetry = Symmetry::Axisymmetric;
        let rows = self.surfaces.iter().flat_map(|(state, points)| {
            points.iter().map(move |point| Ok([&state[..], &values(point, symmetry)?].concat()))
        });
        folder.write("surfaces.csv", |out| {
            let state = ["increment", "phase", "depth_um"].map(String::from);
            write_values(out, state.into_iter().chain(names(first, symmetry)?), rows)
        })
    }

    /// The ParaView collection; its time is the way of the depth, µm: the depth while the tool advances
    /// first, and further on what it retreats, so that no two states share a time.
    fn write_collection(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "<?xml version=\"1.0\"?>")?;
        writeln!(
            out,
            "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n  <Collection>"
        )?;
        for (i, time) in &self.times {
            writeln!(
                out,
                "    <DataSet timestep=\"{time:?}\" group=\"\" part=\"0\" file=\"fields_{i:04}.vtu\"/>"
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
