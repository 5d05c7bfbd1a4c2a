//! The files of a rough contact: table, load curve, summary, maps. Inside SI, in the files µm and MPa.

use super::run::Pressed;
use crate::cli::rough::AllPressed;
use crate::draw::chart::{self, Chart, Series};
use crate::draw::rough_map::{self as picture, Map};
use crate::error::Error;
use crate::output::{Sink, SinkExt};
use asperity_roughness::format::{CellArray, write_npy, write_vti, write_x3p};
use asperity_roughness::scene::{Prepared, Scene, SurfaceFormat};
use serde_json::{Value, json};

const MICROMETRE: f64 = 1e-6;
const MEGAPASCAL: f64 = 1e6;

const TABLE_COLUMNS: &str = "surface,closure,ra_um,beta_deg,mean_pressure_MPa,contact_area_ratio,plasticity_index,\
elastic_share,elastoplastic_share,plastic_share,max_pressure_over_nominal,separation_um,load_error,asperities,\
residual_displacement_um,elastic_energy_share";

/// Everything a run found out.
pub struct Outcome<'a> {
    /// What the surface is called.
    pub name: &'a str,
    /// The scene as resolved.
    pub scene: &'a Scene,
    /// The surface.
    pub prepared: &'a Prepared,
    /// One per closure.
    pub pressed: &'a AllPressed,
    /// What a reader should know.
    pub warnings: &'a [String],
}

/// A number as shortest digits that read back, nothing where there is none.
fn cell(value: Option<f64>) -> String {
    value.filter(|v| v.is_finite()).map_or_else(String::new, |v| format!("{v:?}"))
}

/// What a contact does to every cell.
pub struct Layers {
    /// MPa.
    pressure: Vec<f32>,
    /// Share of the cell in contact.
    contact: Vec<f32>,
    /// 0 none, 1 elastic, 2 elastoplastic, 3 plastic.
    regime: Vec<f32>,
}

impl Layers {
    fn of(one: &Pressed, count: usize) -> Layers {
        let [pressure, contact, regime] = [(); 3].map(|()| vec![0f32; count]);
        let mut layers = Layers { pressure, contact, regime };
        for pixel in &one.field.pixels {
            let i = pixel.cell as usize;
            layers.pressure[i] += pixel.pressure / MEGAPASCAL as f32;
            layers.contact[i] += pixel.contact;
            if pixel.contact > 0.0 {
                layers.regime[i] = f32::from(one.regime(pixel.island as usize));
            }
        }
        layers
    }
}

impl Outcome<'_> {
    fn row(&self, one: &Pressed) -> [Option<f64>; 14] {
        let contact = &one.contact;
        let share = |k: usize| contact.shares.filter(|_| one.model.hardness().is_some()).map(|s| s[k]);
        let touching = contact.area_ratio > 0.0;
        [
            Some(self.prepared.roughness.sa / MICROMETRE),
            Some(self.prepared.roughness.beta_deg()),
            contact.mean_pressure().map(|p| p / MEGAPASCAL),
            Some(contact.area_ratio),
            one.plasticity_index,
            share(0),
            share(1),
            share(2),
            one.peak_ratio().filter(|_| touching),
            Some(contact.separation / MICROMETRE),
            contact.load_error,
            Some(contact.islands.islands.len() as f64),
            one.unloading.as_ref().map(|u| u.residual_displacement / MICROMETRE),
            one.unloading.as_ref().and_then(|u| u.elastic_share),
        ]
    }

    /// table.csv, load_curve.csv, closures.svg, load_curve.svg, pressure_histogram.svg.
    pub fn write_tables(&self, folder: &mut dyn Sink) -> Result<(), Error> {
        folder.write("table.csv", |out| {
            writeln!(out, "{TABLE_COLUMNS}")?;
            for one in self.pressed {
                let row = self.row(one);
                let cells: Vec<String> =
                    row.iter()
                        .enumerate()
                        .map(|(i, v)| {
                            if i == 11 { format!("{}", one.contact.islands.islands.len()) } else { cell(*v) }
                        })
                        .collect();
                writeln!(out, "{},{},{}", quoted(self.name), one.model.closure.name(), cells.join(","))?;
            }
            Ok::<(), std::io::Error>(())
        })?;
        folder.write("load_curve.csv", |out| {
            writeln!(out, "closure,phase,separation_um,pressure_MPa,contact_area_ratio")?;
            for one in self.pressed {
                let unload = one.unloading.as_ref().map_or(&[][..], |u| &u.curve[..]);
                for (phase, points) in [("load", &one.contact.curve[..]), ("unload", unload)] {
                    for p in points {
                        let (d, pressure) = (p.separation / MICROMETRE, p.pressure / MEGAPASCAL);
                        writeln!(
                            out,
                            "{},{phase},{d:?},{pressure:?},{:?}",
                            one.model.closure.name(),
                            p.area_ratio
                        )?;
                    }
                }
            }
            Ok::<(), std::io::Error>(())
        })?;
        self.write_chart(folder, "closures.svg", &self.closure_chart())?;
        self.write_chart(folder, "load_curve.svg", &self.load_chart())?;
        self.write_chart(folder, "pressure_histogram.svg", &self.histogram())
    }

    fn write_chart(&self, folder: &mut dyn Sink, name: &str, chart: &Chart) -> Result<(), Error> {
        let text = chart::svg(chart).map_err(Error::Unfinished)?;
        folder.write(name, |out| out.write_all(text.as_bytes()))
    }

    /// The closures themselves: pressure on the contact of an island against its slope, to three times the mean slope.
    fn closure_chart(&self) -> Chart {
        const STEPS: u32 = 120;
        let steepest = 3.0 * self.prepared.roughness.mean_gradient;
        let series = self.pressed.iter().map(|one| {
            let point = |step| {
                let tan = steepest * f64::from(step) / f64::from(STEPS);
                let response = one.model.respond(tan);
                [tan.atan().to_degrees(), response.island_pressure / response.area_ratio / MEGAPASCAL]
            };
            Series::of_closure(one.model.closure.name(), false, (0..=STEPS).map(point).collect())
        });
        Chart {
            x_label: "slope of an island (degrees)".into(),
            y_label: "mean pressure on its contact (MPa)".into(),
            series: series.collect(),
        }
    }

    /// Pressure against the travel of the plane from first touch.
    fn load_chart(&self) -> Chart {
        let mut series = Vec::new();
        for one in self.pressed {
            let first = one.contact.curve.first().map_or(0.0, |p| p.separation);
            let points = |curve: &[asperity_roughness::CurvePoint]| {
                curve.iter().map(|p| [(first - p.separation) / MICROMETRE, p.pressure / MEGAPASCAL]).collect()
            };
            let name = one.model.closure.name();
            series.push(Series::of_closure(name, false, points(&one.contact.curve)));
            if let Some(unloading) = one.unloading.as_ref().filter(|_| !one.model.returns_everything()) {
                series.push(Series::of_closure(name, true, points(&unloading.curve)));
            }
        }
        Chart {
            x_label: "travel of the plane from first touch (µm)".into(),
            y_label: "nominal pressure (MPa)".into(),
            series,
        }
    }

    /// Share of the contact area per step of pressure, against pressure over nominal pressure.
    fn histogram(&self) -> Chart {
        const STEPS: usize = 60;
        let most = self.pressed.iter().filter_map(Pressed::peak_ratio).fold(0.0, f64::max);
        let width = if most > 0.0 { most / STEPS as f64 } else { 1.0 };
        let series = self.pressed.iter().filter(|one| one.nominal > 0.0).map(|one| {
            let mut bins = [0.0; STEPS];
            for pixel in &one.field.pixels {
                let ratio = f64::from(pixel.pressure) / one.nominal;
                bins[((ratio / width) as usize).min(STEPS - 1)] += f64::from(pixel.contact);
            }
            let total: f64 = bins.iter().sum::<f64>().max(f64::MIN_POSITIVE);
            let points =
                bins.iter().enumerate().map(|(i, b)| [(i as f64 + 0.5) * width, 100.0 * b / total]).collect();
            Series::of_closure(one.model.closure.name(), false, points)
        });
        Chart {
            x_label: "pressure over nominal pressure".into(),
            y_label: format!("contact area per step of {width:.2} (%)"),
            series: series.collect(),
        }
    }

    /// The surface as pressed, where the scene asks for it.
    pub fn write_surface(&self, folder: &mut dyn Sink) -> Result<(), Error> {
        let map = &self.prepared.map;
        let Some(format) = self.scene.output.surface else { return Ok(()) };
        let (columns, rows) = (map.columns(), map.rows());
        let file = folder.path(match format {
            SurfaceFormat::X3p => "surface.x3p",
            SurfaceFormat::Npy => "surface.npy",
        })?;
        match format {
            SurfaceFormat::X3p => write_x3p(&file, columns, rows, map.pixel(), map.heights()),
            SurfaceFormat::Npy => write_npy(&file, columns, rows, map.heights()),
        }
        .map_err(|e| Error::disk(&file, e))
    }

    /// Pictures and .vti of every closure.
    pub fn write_maps(&self, folder: &mut dyn Sink) -> Result<(), Error> {
        let map = &self.prepared.map;
        let cells = [map.cell_columns(), map.cell_rows()];
        let heights = self.heights(cells[0] + 1, cells[1] + 1);
        for one in self.pressed {
            let layers = self.write_pictures(folder, one, picture::LONGEST)?;
            let file = folder.path(&format!("contact-{}.vti", one.model.closure.name()))?;
            let points = [CellArray { name: "height_um", values: &heights }];
            let arrays = [
                CellArray { name: "pressure_MPa", values: &layers.pressure },
                CellArray { name: "contact_fraction", values: &layers.contact },
                CellArray { name: "regime", values: &layers.regime },
            ];
            write_vti(&file, cells, map.pixel().map(|p| p / MICROMETRE), &points, &arrays)
                .map_err(|e| Error::disk(&file, e))?;
        }
        Ok(())
    }

    /// Heights of the nodes in µm; beyond the last ones those of the next period.
    fn heights(&self, columns: usize, rows: usize) -> Vec<f32> {
        let map = &self.prepared.map;
        (0..rows)
            .flat_map(|row| {
                let row = map.row(row % map.rows());
                (0..columns).map(move |column| (row[column % row.len()] / MICROMETRE) as f32)
            })
            .collect()
    }

    /// The topography as topography.png, no side longer than `longest` dots.
    pub fn write_topography(&self, folder: &mut dyn Sink, longest: usize) -> Result<(), Error> {
        let map = &self.prepared.map;
        let cells = [map.columns(), map.rows()];
        let values = self.heights(cells[0], cells[1]);
        let file = folder.path("topography.png")?;
        picture::heights(&file, &Map { cells, pixel: map.pixel(), values: &values, longest }, self.name)
            .map_err(|e| Error::disk(&file, e))
    }

    /// Pressure and contact of one closure as PNG, no side longer than `longest` dots; what they show, by cell.
    pub fn write_pictures(
        &self,
        folder: &mut dyn Sink,
        one: &Pressed,
        longest: usize,
    ) -> Result<Layers, Error> {
        let (map, name) = (&self.prepared.map, one.model.closure.name());
        let cells = [map.cell_columns(), map.cell_rows()];
        let layers = Layers::of(one, cells[0] * cells[1]);
        let view = Map { cells, pixel: map.pixel(), values: &layers.pressure, longest };
        let file = folder.path(&format!("pressure-{name}.png"))?;
        let title = format!("{}, {name} closure", self.name);
        picture::pressure(&file, &view, &title, one.nominal / MEGAPASCAL)
            .map_err(|e| Error::disk(&file, e))?;
        let view = Map { values: &layers.contact, ..view };
        let file = folder.path(&format!("contact-{name}.png"))?;
        picture::contact(&file, &view, &title, &layers.regime, one.contact.shares)
            .map_err(|e| Error::disk(&file, e))?;
        Ok(layers)
    }

    /// The content of summary.json.
    pub fn summary(&self, wall_s: f64) -> Value {
        let (map, r) = (&self.prepared.map, &self.prepared.roughness);
        let closures: Vec<Value> = self.pressed.iter().map(|one| self.closure_summary(one)).collect();
        json!({
            "surface": self.name,
            "pixels": [map.columns(), map.rows()],
            "pixel_size_um": map.pixel().map(|p| p / MICROMETRE),
            "missing": self.prepared.missing,
            "nominal_area_um2": self.prepared.extent.cells as f64 * map.cell_area() / MICROMETRE / MICROMETRE,
            "sa_um": r.sa / MICROMETRE,
            "sq_um": r.sq / MICROMETRE,
            "ssk": r.ssk,
            "sku": r.sku,
            "sz_um": r.sz / MICROMETRE,
            "sdq": r.sdq,
            "ra_um": r.sa / MICROMETRE,
            "rq_um": r.sq / MICROMETRE,
            "mean_gradient": r.mean_gradient,
            "mean_slope_x": r.mean_slope_x,
            "beta_deg": r.beta_deg(),
            "definitions": {
                "standards": "sa, sq, ssk, sku, sz, sdq: ISO 25178-2 over the whole map, without further filters than those of the scene; \
                              ra and rq are sa and sq of the map",
                "beta": "atan of mean_gradient, the mean of |grad h|; mean_slope_x is the mean of |dz/dx|; both depend on the pixel size",
                "asperity_slope": "tan(beta_j) is the mean of |grad h| over the island, not the slope from summit to rim",
                "elastic_energy_share": "work returned over work done, at most 1; by_law is the unloading law's own figure, above 1 where asperities are shallower than the cones that stand for them",
                "separation": "from the mean height of the nodes",
                "pressure": "force on a pixel over the area of the pixel; an island mostly outside the ellipse of its moments is uniform (load_share_uniform)",
            },
            "closures": closures,
            "warnings": self.warnings,
            "wall_s": wall_s,
            "scene": self.scene,
            "version": env!("CARGO_PKG_VERSION"),
        })
    }

    fn closure_summary(&self, one: &Pressed) -> Value {
        let [
            _,
            _,
            mean,
            ratio,
            index,
            elastic,
            elastoplastic,
            plastic,
            peak,
            separation,
            error,
            _,
            residual,
            energy,
        ] = self.row(one);
        json!({
            "closure": one.model.closure.name(),
            "source": one.model.closure.source(),
            "nominal_pressure_MPa": one.nominal / MEGAPASCAL,
            "mean_pressure_MPa": mean,
            "contact_area_ratio": ratio,
            "plasticity_index": index,
            "elastic_share": elastic,
            "elastoplastic_share": elastoplastic,
            "plastic_share": plastic,
            "max_pressure_over_nominal": peak,
            "separation_um": separation,
            "load_error": error,
            "load_jumps": one.contact.jump,
            "load_share_outside_range": one.contact.outside_share,
            "load_share_uniform": one.field.uniform_share,
            "asperities": one.contact.islands.islands.len(),
            "residual_displacement_um": residual,
            "elastic_energy_share": energy,
            "elastic_energy_share_by_law": one.unloading.as_ref().and_then(|u| u.elastic_share_by_law),
            "load_share_return_limited": one.unloading.as_ref().and_then(|u| u.limited_share),
        })
    }

    /// What a person reads on the terminal.
    pub fn text(&self) -> String {
        let r = &self.prepared.roughness;
        let map = &self.prepared.map;
        let mut text = format!(
            "{}: {} x {} points of {:.4} x {:.4} um, {} missing; Sa {:.4} um, Sq {:.4} um, Sdq {:.4}, beta {:.3} deg (mean |grad h|)\n",
            self.name,
            map.columns(),
            map.rows(),
            map.pixel()[0] / MICROMETRE,
            map.pixel()[1] / MICROMETRE,
            self.prepared.missing,
            r.sa / MICROMETRE,
            r.sq / MICROMETRE,
            r.sdq,
            r.beta_deg(),
        );
        text += "closure       A/A0 %   P_m MPa     psi  peak/nom  separation um  asperities  residual um  elastic energy\n";
        let shown = |v: Option<f64>, digits: usize| v.map_or_else(|| "-".into(), |v| format!("{v:.digits$}"));
        for one in self.pressed {
            let row = self.row(one);
            text += &format!(
                "{:<11} {:>8} {:>9} {:>7} {:>9} {:>14} {:>11} {:>12} {:>15}\n",
                one.model.closure.name(),
                shown(row[3].map(|v| 100.0 * v), 3),
                shown(row[2], 1),
                shown(row[4], 3),
                shown(row[8], 2),
                shown(row[9], 4),
                one.contact.islands.islands.len(),
                shown(row[12], 4),
                shown(row[13], 3),
            );
        }
        text
    }
}

/// A name as a CSV field.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.into()
    }
}
