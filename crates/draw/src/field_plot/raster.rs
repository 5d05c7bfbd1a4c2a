//! Facets painted onto a grid of dots.

use super::deformed_mesh::{DeformedMesh, Vertex};
use super::window::{Window, range};
use crate::encode::indexed_png;
use crate::palette::Colour;

/// Dots a facet covers at most along a side.
const FACET: f64 = 6.0;

/// The fields at every dot.
pub struct Raster {
    /// Columns and rows of dots.
    pub size: [usize; 2],
    /// Row by row from the top; `None` outside the body.
    pub dots: Vec<Option<Dot>>,
}

/// The thing at a dot.
#[derive(Clone, Copy, Debug)]
pub struct Dot {
    /// Fields, single precision is plenty for a colour.
    pub values: [f32; 5],
}

impl Raster {
    /// Paints the part of `mesh` in `window`, and its mirror image where `mirrored`.
    pub fn draw(mesh: &DeformedMesh, window: &Window, mirrored: bool, size: [usize; 2]) -> Raster {
        let mut raster = Raster { size, dots: vec![None; size[0] * size[1]] };
        let span = window.size();
        let scale = size[0] as f64 / span[0];
        let sides: &[f64] = if mirrored { &[1.0, -1.0] } else { &[1.0] };
        for &side in sides {
            let shown = |[r, z]: [f64; 2]| [side * r, z];
            for cell in 0..mesh.cells() {
                let corners = mesh.corners(cell).map(shown);
                if !window.meets(&corners) {
                    continue;
                }
                let largest = (0..4)
                    .map(|k| {
                        let (a, b) = (corners[k], corners[(k + 1) % 4]);
                        (a[0] - b[0]).hypot(a[1] - b[1])
                    })
                    .fold(0.0, f64::max);
                let parts = ((largest * scale / FACET).ceil() as usize).clamp(2, 64);
                for facet in mesh.facets(cell, parts) {
                    let facet = facet.map(|v| {
                        let [r, z] = shown(v.at);
                        Vertex { at: [(r - window.low[0]) * scale, (window.high[1] - z) * scale], ..v }
                    });
                    raster.paint(&facet);
                }
            }
        }
        raster
    }

    /// Fills the dots whose centre lies in the facet.
    fn paint(&mut self, facet: &[Vertex; 3]) {
        let [a, b, c] = facet.map(|v| v.at);
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let span = |k: usize| {
            let (low, high) = (a[k].min(b[k]).min(c[k]), a[k].max(b[k]).max(c[k]));
            let end = self.size[k] as f64;
            (low - 0.5).ceil().clamp(0.0, end) as usize..(high + 0.5).floor().clamp(0.0, end) as usize
        };
        let (columns, rows) = (span(0), span(1));
        for y in rows {
            for x in columns.clone() {
                let p = [x as f64 + 0.5, y as f64 + 0.5];
                let share = |q: [f64; 2], s: [f64; 2]| {
                    ((q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0])) / area
                };
                let weights = [share(b, c), share(c, a), share(a, b)];
                if weights.iter().all(|w| *w >= -1e-9) {
                    let value =
                        |i: usize| (0..3).map(|k| weights[k] * facet[k].values[i]).sum::<f64>() as f32;
                    self.dots[y * self.size[0] + x] = Some(Dot { values: [0, 1, 2, 3, 4].map(value) });
                }
            }
        }
    }

    /// Least and largest of field `i` in the picture.
    pub fn range(&self, i: usize) -> [f64; 2] {
        range(self.dots.iter().flatten().map(|dot| f64::from(dot.values[i]))).unwrap_or_default()
    }

    /// A colour for every dot, counted from 1 in `palette`; 0 is transparent.
    ///
    /// # Errors
    /// A text for a person where the picture cannot be encoded.
    pub fn png(&self, palette: &[Colour], colour: impl Fn(&Dot) -> u8) -> Result<Vec<u8>, String> {
        let indices: Vec<u8> = self.dots.iter().map(|dot| dot.as_ref().map_or(0, &colour)).collect();
        indexed_png(self.size, palette, &indices)
    }
}
