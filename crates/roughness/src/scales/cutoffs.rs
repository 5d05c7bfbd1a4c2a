//! The cut-offs of a map, and what a filter leaves of it.

use crate::surface::filter::{FilterError, s_filter_at};
use crate::surface::gaussian::Places;
use crate::{HeightMap, Surface};

/// Waves of the coarsest cut-off along the shorter side: fewer are no sample.
const FEWEST_WAVES: f64 = 4.0;
/// Pixels of a wave of the cut-off, at least, where the map has them: coarser cut-offs lie on coarser grids.
pub const PIXELS_PER_WAVE: f64 = 8.0;
/// Points of a map up to which cut-offs are half an octave apart; on larger ones a whole.
const FINELY_STEPPED: usize = 1 << 20;

/// A map without the waves below a cut-off.
#[derive(Clone, Debug)]
pub struct Scale {
    /// The cut-off, in metres: of a wave so long the Gaussian filter keeps half the height. That of the whole
    /// map is two pixels, the shortest wave that it holds; it is not filtered.
    pub cutoff: f64,
    /// The shortest wave, in metres: the one of which the filter keeps half the power, √2 cut-offs; of the
    /// whole map two pixels.
    pub wave: f64,
    /// The filtered surface, on a grid of at least [`PIXELS_PER_WAVE`] pixels a cut-off where the map has
    /// them.
    pub surface: Surface,
}

/// Two pixels of a map, in metres: the shortest wave that it holds.
pub(super) fn finest(map: &HeightMap) -> f64 {
    2.0 * map.pixel()[0].max(map.pixel()[1])
}

/// The shorter side of a map, in metres.
pub(super) fn side(map: &HeightMap) -> f64 {
    (map.columns() as f64 * map.pixel()[0]).min(map.rows() as f64 * map.pixel()[1])
}

/// The cut-offs of `map` from the coarsest to that of the whole map, in metres: √2 apart, 2 on maps of more
/// than a million points, so that the shortest waves of filtered and whole maps are in steps of octaves.
pub fn cutoffs(map: &HeightMap) -> Vec<f64> {
    let finest = finest(map);
    let steps = if map.heights().len() <= FINELY_STEPPED { 2.0 } else { 1.0 };
    let filtered = (0..).map(|k| finest * 2f64.powf(0.5 + f64::from(k) / steps));
    let most = side(map) / FEWEST_WAVES * (1.0 + 1e-9);
    let mut found: Vec<f64> = std::iter::once(finest).chain(filtered.take_while(|c| *c <= most)).collect();
    found.reverse();
    found
}

impl Scale {
    /// `surface` without the waves below `cutoff` (m); the whole of it where that is two pixels.
    ///
    /// # Errors
    /// A cut-off that does not fit the map, or points so far between that no cell is left.
    pub fn new(surface: &Surface, cutoff: f64) -> Result<Scale, FilterError> {
        let map = &surface.map;
        if cutoff <= finest(map) * (1.0 + 1e-9) {
            return Ok(Scale { cutoff, wave: cutoff, surface: surface.clone() });
        }
        let smooth = s_filter_at(map, cutoff, kept(map, cutoff))?;
        let wave = std::f64::consts::SQRT_2 * cutoff;
        Ok(Scale { cutoff, wave, surface: Surface::from_map(smooth)? })
    }
}

/// Every so many points of a map along x and y, [`PIXELS_PER_WAVE`] to a cut-off at least, those of the edges
/// left out alike on both sides; of a periodic map the step divides the number of points.
fn kept(map: &HeightMap, cutoff: f64) -> [Places; 2] {
    let nodes = [map.columns(), map.rows()];
    [0, 1].map(|k| {
        let most = (cutoff / (PIXELS_PER_WAVE * map.pixel()[k])).floor().max(1.0) as usize;
        let divides = |s: &usize| !map.periodic() || nodes[k].is_multiple_of(*s);
        let step = (1..=most).rev().find(divides).unwrap_or(1);
        let count = nodes[k] / step;
        Places { first: (nodes[k] - 1 - (count - 1) * step) / 2, step, count }
    })
}
