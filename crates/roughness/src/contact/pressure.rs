//! Pressure on the pixels: each island's force spread over its pixels by a profile.

use super::ellipse::Ellipse;
use super::islands::Piece;
use crate::contact::islands_contact::Contact;
use crate::surface::height_map::HeightMap;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Fall of the pressure of an island from its middle to its edge, ρ being the elliptic radius.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum PressureProfile {
    /// 3/2 p √(1 - ρ²) (eq. (15)).
    #[default]
    Hertz,
    /// p arcosh(1/ρ), the elastic cone's (Sneddon 1965); infinite in the middle, so averaged over each pixel.
    Cone,
    /// p everywhere.
    Uniform,
}

impl PressureProfile {
    /// Pressure over mean pressure at squared elliptic radius `r2` < 1.
    fn relative_pressure(self, r2: f64) -> f64 {
        match self {
            PressureProfile::Hertz => 1.5 * (1.0 - r2).sqrt(),
            PressureProfile::Cone => (1.0 / r2.max(1e-12).sqrt()).acosh(),
            PressureProfile::Uniform => 1.0,
        }
    }
}

/// A pixel (cell of the map) that carries load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadedPixel {
    /// Number of the cell: row · cell columns + column.
    pub cell: u32,
    /// Island that it belongs to.
    pub island: u32,
    /// Force on the pixel over the area of the pixel, in Pa.
    pub pressure: f32,
    /// Part of the pixel in contact.
    pub contact: f32,
    /// Part of the pixel on the island.
    pub island_area: f32,
}

/// The pressure map of one contact.
#[derive(Clone, Debug)]
pub struct PressureField {
    /// Loaded pixels in the order of the cells; two in a row may share a cell (two islands at a saddle).
    pub pixels: Vec<LoadedPixel>,
    /// Largest pressure of a pixel, in Pa.
    pub largest: f64,
    /// Share of the load on islands whose ellipse does not describe them, so that they are uniform; None
    /// without load.
    pub uniform_share: Option<f64>,
}

/// Samples along a side of a pixel.
const SAMPLES: usize = 4;
/// An island that lies in its ellipse by less than this part of its area (a bent ridge, a ring) has no
/// ellipse.
const DESCRIBED_SHARE: f64 = 0.5;

impl PressureField {
    /// Spreads the forces of `contact` on the cells of `map`.
    ///
    /// 1. The weight of a pixel is the profile averaged over samples inside the ellipse of the true contact,
    ///    times the part of the pixel in contact; an island without an ellipse, or mostly outside it, is
    ///    uniform.
    /// 2. The weights of an island are scaled so that they sum to its force.
    pub fn distribute(map: &HeightMap, contact: &Contact, profile: PressureProfile) -> PressureField {
        let columns = map.cell_columns() as u32;
        let parts = map.chunks(|rows| {
            let mut pixels = Vec::new();
            for row in rows {
                contact.islands.pieces(map, row, |piece| {
                    let (weight, covered) = weigh(&piece, contact, profile, map.pixel());
                    pixels.push(LoadedPixel {
                        cell: piece.cell[0] * columns + piece.cell[1],
                        island: piece.island,
                        pressure: weight as f32,
                        contact: covered as f32,
                        island_area: piece.area as f32,
                    });
                });
            }
            pixels
        });
        let mut pixels = parts.concat();
        let mut sums = vec![(0.0, 0.0); contact.responses.len()];
        for pixel in &pixels {
            let (weights, covered) = &mut sums[pixel.island as usize];
            *weights += f64::from(pixel.pressure);
            *covered += f64::from(pixel.contact);
        }
        let (mut uniform, mut total) = (0.0, 0.0);
        let scales: Vec<Scale> = sums
            .iter()
            .enumerate()
            .map(|(j, (weights, covered))| {
                let (force, area) = (contact.force(j), contact.islands.islands[j].area);
                total += force;
                // part of the true contact that lies on the island and inside its ellipse
                let inside = covered * map.cell_area() / (area * contact.responses[j].area_ratio.min(1.0));
                if *weights > 0.0 && inside >= DESCRIBED_SHARE {
                    return Scale::Weights(force / map.cell_area() / weights);
                }
                uniform += force;
                Scale::Areas(force / area)
            })
            .collect();
        pixels.par_iter_mut().for_each(|pixel| {
            let ratio = contact.responses[pixel.island as usize].area_ratio.min(1.0) as f32;
            match scales[pixel.island as usize] {
                Scale::Weights(scale) => {
                    pixel.pressure = (scale * f64::from(pixel.pressure)) as f32;
                    // a contact as large as its island is the island, whatever its shape
                    pixel.contact = if ratio < 1.0 { pixel.contact } else { pixel.island_area };
                }
                Scale::Areas(pressure) => {
                    pixel.pressure = (pressure * f64::from(pixel.island_area)) as f32;
                    pixel.contact = ratio * pixel.island_area;
                }
            }
        });
        let mut largest = 0.0f64;
        for (i, pixel) in pixels.iter().enumerate() {
            let beside =
                pixels.get(i + 1).filter(|next| next.cell == pixel.cell).map_or(0.0, |next| next.pressure);
            largest = largest.max(f64::from(pixel.pressure + beside));
        }
        PressureField { pixels, largest, uniform_share: (total > 0.0).then(|| uniform / total) }
    }
}

/// The way the force of an island reaches its pixels.
#[derive(Clone, Copy)]
enum Scale {
    /// Times the weight of the pixel.
    Weights(f64),
    /// Pressure times the part of the pixel on the island.
    Areas(f64),
}

/// Weight of a piece of an island, and the part of its pixel on the island and inside the ellipse of the
/// contact.
fn weigh(piece: &Piece, contact: &Contact, profile: PressureProfile, pixel: [f64; 2]) -> (f64, f64) {
    let island = &contact.islands.islands[piece.island as usize];
    let ratio = contact.responses[piece.island as usize].area_ratio;
    let Some(ellipse) = &island.ellipse else {
        return (0.0, 0.0);
    };
    if profile == PressureProfile::Uniform && ratio >= 1.0 {
        return (piece.area, piece.area);
    }
    let (inside, mean) = sample(ellipse, profile, ratio, piece.offset, pixel);
    let covered = inside.min(piece.area);
    (mean * covered, covered)
}

/// Part of a pixel inside the ellipse of the true contact, and the mean of the profile over that part.
fn sample(
    ellipse: &Ellipse,
    profile: PressureProfile,
    ratio: f64,
    corner: [f64; 2],
    pixel: [f64; 2],
) -> (f64, f64) {
    let (mut inside, mut sum) = (0, 0.0);
    for i in 0..SAMPLES {
        for j in 0..SAMPLES {
            let at = |k: usize, axis: usize| (corner[axis] + (k as f64 + 0.5) / SAMPLES as f64) * pixel[axis];
            let r2 = ellipse.radius_squared(at(i, 0), at(j, 1)) / ratio;
            if r2 < 1.0 {
                inside += 1;
                sum += profile.relative_pressure(r2);
            }
        }
    }
    if inside == 0 {
        return (0.0, 0.0);
    }
    (f64::from(inside) / (SAMPLES * SAMPLES) as f64, sum / f64::from(inside))
}
