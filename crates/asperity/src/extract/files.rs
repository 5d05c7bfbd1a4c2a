//! The files of an extraction.

use super::rows::AsperityRow;
use super::scenes::stem;
use crate::draw::rough_map::{self, Map, Mark};
use crate::error::Error;
use crate::extract::take::Extracted;
use crate::results::output::{Sink, SinkExt, write_csv};
use crate::results::units::MICROMETRE;
use serde::Serialize;

/// Most asperities that the picture numbers.
const MAX_NUMBERED: usize = 60;

#[derive(Serialize)]
struct RadiusRow {
    r_um: f64,
    z_um: f64,
}

#[derive(Serialize)]
struct LineRow {
    x_um: f64,
    z_um: f64,
}

impl Extracted {
    /// Writes `asperities.csv`, `profiles/`, `scenes/`, `asperities.png` and `summary.json`.
    ///
    /// # Errors
    /// A disk that refuses.
    pub fn write(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        let table: &[AsperityRow] = &self.table;
        sink.write("asperities.csv", |out| write_csv(out, table))?;
        for body in &self.bodies {
            let rows = body.profile.points.iter().map(|[r, z]| RadiusRow { r_um: um(*r), z_um: um(*z) });
            let name = stem(body.number);
            sink.csv(&format!("profiles/{name}.csv"), &rows.collect::<Vec<_>>())?;
            sink.text(&format!("scenes/{name}.toml"), &body.scene)?;
        }
        for line in &self.lines {
            let rows = line.points.iter().map(|[x, z]| LineRow { x_um: um(*x), z_um: um(*z) });
            sink.csv(&format!("profiles/{}.csv", line.name), &rows.collect::<Vec<_>>())?;
            sink.text(&format!("scenes/{}.toml", line.name), &line.scene)?;
        }
        self.write_picture(sink)?;
        sink.text("summary.json", &crate::results::output::sorted_json(&self.summary())?)
    }

    /// The map with the asperities that have a profile.
    fn write_picture(&self, sink: &mut dyn Sink) -> Result<(), Error> {
        let map = &self.surface.map;
        let values: Vec<f32> = map.heights().iter().map(|z| (z / MICROMETRE) as f32).collect();
        let view = Map {
            cells: [map.columns(), map.rows()],
            pixel: map.pixel(),
            values: &values,
            longest: rough_map::MAX_SIDE_DOTS,
        };
        let mark = |number: usize, one: &asperity_roughness::asperities::Asperity| {
            let ellipse = one.ellipse?;
            Some(Mark {
                // pixels of the picture are around the nodes
                centre: [0, 1].map(|k| um(ellipse.centre[k] + 0.5 * map.pixel()[k])),
                semi_axes: ellipse.semi_axes.map(um),
                angle: ellipse.direction[1].atan2(ellipse.direction[0]),
                label: number.to_string(),
            })
        };
        let marks: Vec<Mark> =
            self.bodies.iter().filter_map(|b| mark(b.number, &b.asperity)).take(MAX_NUMBERED).collect();
        sink.picture("asperities.png", rough_map::asperities(&view, &self.name, &marks))
    }
}

fn um(metres: f64) -> f64 {
    metres / MICROMETRE
}
