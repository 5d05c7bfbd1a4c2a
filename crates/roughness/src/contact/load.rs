//! The load that the islands above a plane carry.

use super::closures::ClosureLaw;
use super::islands::{Islands, Runs};
use crate::surface::prepared_surface::Surface;
use rayon::prelude::*;

/// Islands whose forces one task adds up: fixed, so that the sum is the same for any number of threads.
const ISLANDS_PER_CHUNK: usize = 1 << 12;

/// Nominal pressure and contact area ratio at planes above a lowest one, from the islands there.
///
/// A point above a plane also lies above every lower one, so the map is searched only once.
pub(super) struct Carrying<'a> {
    surface: &'a Surface,
    model: &'a ClosureLaw,
    plane: f64,
    runs: Runs,
}

impl<'a> Carrying<'a> {
    /// Ready for planes at or above `plane`.
    pub fn new(surface: &'a Surface, model: &'a ClosureLaw, plane: f64) -> Carrying<'a> {
        Carrying { surface, model, plane, runs: Runs::above_plane(&surface.map, plane) }
    }

    /// The lowest plane.
    pub fn plane(&self) -> f64 {
        self.plane
    }

    /// Nominal pressure and contact area ratio at `plane`.
    pub fn pressure_and_area(&self, plane: f64) -> (f64, f64) {
        self.carried(plane, self.runs.narrowed(&self.surface.map, plane))
    }

    /// The same, after which `plane` is the lowest.
    pub fn rise_to(&mut self, plane: f64) -> (f64, f64) {
        self.runs = self.runs.narrowed(&self.surface.map, plane);
        self.plane = plane;
        self.carried(plane, self.runs.clone())
    }

    fn carried(&self, plane: f64, runs: Runs) -> (f64, f64) {
        let nominal = self.surface.extent.cells as f64;
        let parts: Vec<(f64, f64)> = Islands::sizes(&self.surface.map, plane, runs)
            .par_chunks(ISLANDS_PER_CHUNK)
            .map(|part| {
                part.iter().fold((0.0, 0.0), |(force, area), island| {
                    let response = self.model.respond(island.slope_area / island.area);
                    (
                        force + response.island_pressure * island.area,
                        area + (response.area_ratio * island.area).min(nominal),
                    )
                })
            })
            .collect();
        let (force, area) = parts.iter().fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        (force / nominal, (area / nominal).min(1.0))
    }
}
