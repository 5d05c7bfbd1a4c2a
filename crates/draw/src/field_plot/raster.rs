//! Facets painted onto a grid of dots.

use super::deformed_mesh::{DeformedMesh, Field, Vertex};
use super::window::{Window, range};
use crate::encode::indexed_png;
use crate::palette::Colour;

/// Dots a facet covers at most along a side.
const FACET: f64 = 6.0;

/// Share of a corner, below 0, to which a dot counts as inside: facets leave no gap between them.
const OUTSIDE: f64 = 1e-9;

/// The fields at every dot.
pub struct Raster {
    /// Columns and rows of dots.
    pub size: [usize; 2],
    /// Each field row by row from the top, NaN outside the body, single precision is plenty for a colour; of
    /// the fields that no panel shows nothing.
    planes: [Vec<f32>; Field::COUNT],
}

/// The least whole number from `x` on, which is not negative. (`f64::ceil` is a call on processors without an
/// instruction for it.)
fn ceiling(x: f64) -> usize {
    let whole = x as usize;
    whole + usize::from((whole as f64) < x)
}

impl Raster {
    /// Paints `fields` of the part of `mesh` in `window`; where `mirrored`, the window reaches as far to the
    /// left of the axis as to its right, and shows the mirror image there.
    pub fn draw(
        mesh: &DeformedMesh,
        window: &Window,
        mirrored: bool,
        size: [usize; 2],
        fields: &[Field],
    ) -> Raster {
        let mut raster = Raster { size, planes: Default::default() };
        for &field in fields {
            raster.planes[field as usize] = vec![f32::NAN; size[0] * size[1]];
        }
        let span = window.size();
        let scale = size[0] as f64 / span[0];
        for cell in 0..mesh.cells() {
            let corners = mesh.corners(cell);
            if !window.meets(&corners) {
                continue;
            }
            let largest = (0..4)
                .map(|k| {
                    let (a, b) = (corners[k], corners[(k + 1) % 4]);
                    (a[0] - b[0]).hypot(a[1] - b[1])
                })
                .fold(0.0, f64::max);
            let parts = ceiling(largest * scale / FACET).clamp(2, 64);
            for facet in mesh.facets(cell, parts) {
                let place = |[r, z]: [f64; 2]| [(r - window.low[0]) * scale, (window.high[1] - z) * scale];
                raster.paint(&facet.map(|v| Vertex { at: place(v.at), ..v }));
            }
        }
        if mirrored {
            let columns = size[0];
            for row in raster.planes.iter_mut().flat_map(|plane| plane.chunks_exact_mut(columns)) {
                let (left, right) = row.split_at_mut(columns / 2);
                left.iter_mut().zip(right.iter().rev()).for_each(|(image, value)| *image = *value);
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
        let per_area = area.recip();
        let end = self.size.map(|dots| dots as f64);
        let first = |from: f64, end: f64| ceiling((from - 0.5).clamp(0.0, end));
        let after = |to: f64, end: f64| (to + 0.5).clamp(0.0, end) as usize;
        let [top, bottom] = [a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1])];
        let [left, right] = [a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0])];
        // shares of the corners, which change evenly along a row of dots
        let sides = [[b, c], [c, a], [a, b]];
        let growth = sides.map(|[q, s]| (q[1] - s[1]) * per_area);
        let value = |shares: [f64; 3], i: usize| (0..3).map(|k| shares[k] * facet[k].values[i]).sum::<f64>();
        for y in first(top, end[1])..after(bottom, end[1]) {
            let (row, y) = (y * self.size[0], y as f64 + 0.5);
            let shares = sides.map(|[q, s]| (q[0] * (s[1] - y) - (q[1] - y) * s[0]) * per_area);
            let [mut from, mut to] = [left, right];
            for (share, growth) in shares.iter().zip(growth) {
                // from here the share is positive, or up to here
                let zero = -(share + OUTSIDE) / growth;
                match growth {
                    growth if growth > 0.0 => from = from.max(zero),
                    growth if growth < 0.0 => to = to.min(zero),
                    _ if *share < -OUTSIDE => to = f64::NEG_INFINITY,
                    _ => {}
                }
            }
            let [first, after] = [first(from, end[0]), after(to, end[0])];
            if first >= after {
                continue;
            }
            for (i, plane) in self.planes.iter_mut().enumerate().filter(|(_, plane)| !plane.is_empty()) {
                let (at_left, growth) = (value(shares, i), value(growth, i));
                for (x, dot) in (first..after).zip(&mut plane[row + first..row + after]) {
                    *dot = (at_left + (x as f64 + 0.5) * growth) as f32;
                }
            }
        }
    }

    /// `field` at every dot, row by row from the top, NaN outside the body.
    pub fn plane(&self, field: Field) -> &[f32] {
        &self.planes[field as usize]
    }

    /// Least and largest of `field` in the picture.
    pub fn range(&self, field: Field) -> [f64; 2] {
        let inside = self.plane(field).iter().filter(|value| !value.is_nan());
        range(inside.map(|value| f64::from(*value))).unwrap_or_default()
    }

    /// A colour for every dot by the value of `field`, counted from 1 in `palette`; 0 is transparent.
    ///
    /// # Errors
    /// A text for a person where the picture cannot be encoded.
    pub fn png(
        &self,
        palette: &[Colour],
        field: Field,
        mut colour: impl FnMut(f64) -> u8,
    ) -> Result<Vec<u8>, String> {
        let index = |&value: &f32| if value.is_nan() { 0 } else { colour(f64::from(value)) };
        let indices: Vec<u8> = self.plane(field).iter().map(index).collect();
        indexed_png(self.size, palette, &indices)
    }
}
