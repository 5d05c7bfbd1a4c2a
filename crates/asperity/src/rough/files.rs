//! The files of a pressed surface: tables, charts, summary, maps, the surface itself.

use super::charts;
use super::curves;
use crate::draw::chart;
use crate::draw::rough_map::{self as picture, Map};
use crate::error::Error;
use crate::results::output::{Sink, SinkExt, write_csv};
use crate::results::units::{MEGAPASCAL, MICROMETRE};
use crate::rough::closure_contact::{Body, ClosureContact};
use crate::rough::contact::{MODEST_MAP_POINTS, Rough};
use asperity_formats::surface::{Vti, write_npy, write_x3p};
use asperity_roughness::HeightMap;
use asperity_roughness::scene::SurfaceFormat;

/// One number per cell of the map, row by row, of a contact.
#[derive(Clone, Debug)]
pub struct Layers {
    /// Force on a cell over its area, MPa.
    pub pressure: Vec<f32>,
    /// Share of the cell in contact.
    pub contact: Vec<f32>,
    /// 0 none, 1 elastic, 2 elastoplastic, 3 plastic.
    pub regime: Vec<f32>,
    /// Distance of plane and surface, µm; only on a half-space.
    pub gap: Option<Vec<f32>>,
    /// Cells along x and y: those between the nodes, or on a half-space the pixels around them.
    pub cells: [usize; 2],
}

/// Cells of a map along x and y.
fn cells(map: &HeightMap) -> [usize; 2] {
    [map.cell_columns(), map.cell_rows()]
}

/// Numbers of the nodes; beyond the last ones those of the next period.
fn repeated(values: &[f32], map: &HeightMap, columns: usize, rows: usize) -> Vec<f32> {
    let own = map.columns();
    let node = |i: usize| values[i / columns % map.rows() * own + i % columns % own];
    (0..columns * rows).map(node).collect()
}

/// Heights of the nodes in µm; beyond the last ones those of the next period.
fn heights(map: &HeightMap, columns: usize, rows: usize) -> Vec<f32> {
    let row = |row: usize| {
        let row = map.row(row % map.rows());
        (0..columns).map(move |column| (row[column % row.len()] / MICROMETRE) as f32)
    };
    (0..rows).flat_map(row).collect()
}

impl Rough {
    /// Pressure, contact and regime on the cells of the map; zeros where a closure failed.
    pub fn layers(&self, one: &ClosureContact) -> Layers {
        let map = &self.surface.map;
        let cells = if one.space().is_some() { [map.columns(), map.rows()] } else { cells(map) };
        let [pressure, contact, regime] = [(); 3].map(|()| vec![0f32; cells[0] * cells[1]]);
        let mut layers = Layers { pressure, contact, regime, gap: None, cells };
        match &one.body {
            Body::Islands(one) => {
                for pixel in &one.field.pixels {
                    let i = pixel.cell as usize;
                    layers.pressure[i] += pixel.pressure / MEGAPASCAL as f32;
                    layers.contact[i] += pixel.contact;
                    if pixel.contact > 0.0 {
                        let regime = one.contact.responses[pixel.island as usize].regime;
                        layers.regime[i] = 1.0 + regime as u8 as f32;
                    }
                }
            }
            Body::HalfSpace(one) => {
                let limit = one.body.limit.map_or(f32::INFINITY, |l| (l * (1.0 - 1e-6)) as f32);
                for (i, p) in one.contact.pressures.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                    layers.pressure[i] = p / MEGAPASCAL as f32;
                    layers.contact[i] = 1.0;
                    layers.regime[i] = if *p >= limit { 3.0 } else { 1.0 };
                }
                let um = |g: &f32| (f64::from(*g) / MICROMETRE) as f32;
                layers.gap = Some(one.contact.gaps.iter().map(um).collect());
            }
            Body::Failed(_) => {}
        }
        layers
    }

    /// Writes tables, charts and summary, and the maps and the surface where the scene asks for them.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        self.write_tables(sink)?;
        if self.summary.scene.output.maps {
            self.write_maps(sink)?;
        }
        self.write_surface(sink)
    }

    /// Writes table.csv, load_curve.csv, bearing.csv, spectrum.csv, gaps.csv, summary.json and the charts
    /// alone.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write_tables(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        sink.csv("table.csv", &self.table)?;
        sink.write("load_curve.csv", |out| write_csv(out, &self.load_curve))?;
        sink.csv("bearing.csv", &curves::bearing(&self.surface))?;
        let points = self.surface.map.heights().len();
        if self.summary.scene.output.spectrum.unwrap_or(points <= MODEST_MAP_POINTS) {
            sink.write("spectrum.csv", |out| write_csv(out, &curves::spectrum(&self.surface)))?;
        }
        let gaps: Vec<_> = self.contacts.iter().flat_map(curves::gaps).collect();
        if !gaps.is_empty() {
            sink.csv("gaps.csv", &gaps)?;
        }
        for (name, chart) in charts::all(&self.contacts, self.surface.parameters.mean_gradient) {
            let text = chart::svg(&chart).map_err(Error::Unfinished)?;
            sink.text(name, &text)?;
        }
        sink.text("summary.json", &self.json()?)
    }

    /// Pictures of every closure, and contact.vti with all of them: arrays begin with the closure's name.
    /// Those of a half-space are on the nodes, whose pixels carry them, the others on the cells between.
    fn write_maps(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        let map = &self.surface.map;
        let [columns, rows] = cells(map);
        let spacing = map.pixel().map(|p| p / MICROMETRE);
        let file = sink.path("contact.vti")?;
        let refused = |e: std::io::Error| Error::disk(&file, e);
        let mut image = Vti::new();
        image.add_points("height_um", &heights(map, columns + 1, rows + 1)).map_err(refused)?;
        for one in self.contacts.iter().filter(|one| !matches!(one.body, Body::Failed(_))) {
            let layers = self.write_pictures(sink, one, picture::MAX_SIDE_DOTS)?;
            let mut add = |name: &str, values: &[f32]| {
                let name = format!("{}_{name}", one.name());
                match layers.gap {
                    Some(_) => image.add_points(name, &repeated(values, map, columns + 1, rows + 1)),
                    None => image.add_cells(name, values),
                }
            };
            add("pressure_MPa", &layers.pressure).map_err(refused)?;
            add("contact_fraction", &layers.contact).map_err(refused)?;
            add("regime", &layers.regime).map_err(refused)?;
            if let Some(gap) = &layers.gap {
                add("gap_um", gap).map_err(refused)?;
            }
        }
        image.write(&file, [columns, rows], spacing).map_err(refused)
    }

    /// Pressure and contact of one closure as PNG, no side longer than `longest` dots; returns the numbers
    /// they show.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write_pictures(
        &self,
        sink: &mut dyn Sink,
        one: &ClosureContact,
        longest: usize,
    ) -> Result<Layers, Error> {
        let map = &self.surface.map;
        let layers = self.layers(one);
        let title = self.map_title(one);
        sink.picture(&format!("pressure-{}.png", one.name()), self.pressure_png(one, &layers, longest))?;
        let view = Map { cells: layers.cells, pixel: map.pixel(), values: &layers.contact, longest };
        let drawn = picture::contact(&view, &title, &layers.regime, one.shares());
        sink.picture(&format!("contact-{}.png", one.name()), drawn)?;
        Ok(layers)
    }

    /// The pressure of one closure as PNG, no side longer than `longest` dots.
    ///
    /// # Errors
    /// A picture that cannot be encoded.
    pub(super) fn pressure_png(
        &self,
        one: &ClosureContact,
        layers: &Layers,
        longest: usize,
    ) -> Result<Vec<u8>, String> {
        let pixel = self.surface.map.pixel();
        let view = Map { cells: layers.cells, pixel, values: &layers.pressure, longest };
        picture::pressure(&view, &self.map_title(one), one.nominal / MEGAPASCAL)
    }

    /// The title of a map of one closure.
    fn map_title(&self, one: &ClosureContact) -> String {
        format!("{} by {}", self.summary.surface, one.name())
    }

    /// The topography as topography.png, no side longer than `longest` dots.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write_topography(&self, sink: &mut dyn Sink, longest: usize) -> Result<(), Error> {
        sink.picture("topography.png", self.topography_png(longest))
    }

    /// The topography as PNG.
    ///
    /// # Errors
    /// A picture that cannot be encoded.
    pub(super) fn topography_png(&self, longest: usize) -> Result<Vec<u8>, String> {
        let map = &self.surface.map;
        let cells = [map.columns(), map.rows()];
        let values = heights(map, cells[0], cells[1]);
        picture::heights(&Map { cells, pixel: map.pixel(), values: &values, longest }, &self.summary.surface)
    }

    /// The surface as pressed, where the scene asks for it.
    fn write_surface(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        let map = &self.surface.map;
        let (columns, rows) = (map.columns(), map.rows());
        let Some(format) = self.summary.scene.output.surface else { return Ok(()) };
        let x3p = format == SurfaceFormat::X3p;
        let file = sink.path(if x3p { "surface.x3p" } else { "surface.npy" })?;
        let written = if x3p {
            write_x3p(&file, columns, rows, map.pixel(), map.heights())
        } else {
            write_npy(&file, columns, rows, map.heights())
        };
        written.map_err(|e| Error::disk(&file, e))
    }
}
