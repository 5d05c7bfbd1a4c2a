//! The power of slopes by wave length, and how the slope goes on where the map ends.

use super::cutoffs::finest;
use crate::surface::height_map::MapError;
use crate::{HeightMap, SpectrumPoint, spectrum};
use std::f64::consts::{LN_2, SQRT_2, TAU};

/// Of a power law that goes on, the power of slopes of the finest half octave is not below this share of what
/// the law has by the one before: a map smoothed over its own pixel keeps a half, one that ends before its
/// pixel next to nothing.
const GOES_ON: f64 = 0.2;
/// The share of the mean square slope that the finest octave of such a spectrum has at least.
const LEAST_SHARE: f64 = 0.02;
/// Largest growth of that power from octave to octave: that of H = 0.
const MOST_GROWTH: f64 = 4.0;

/// Mean squares of slopes and of curvatures by frequency.
#[derive(Clone, Debug)]
pub struct SlopePower {
    /// Frequency (1/m), mean square slope of its band.
    bands: Vec<[f64; 2]>,
    /// Two pixels, in metres.
    finest: f64,
}

/// The growth of the slope below the pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// Relative growth of the rms slope by each of the two octaves below the pixel, as a natural logarithm.
    pub octaves: [f64; 2],
    /// False where the spectrum ends before the pixel: finer waves are not to be expected.
    pub goes_on: bool,
}

impl SlopePower {
    /// Of `map`; its holes are filled, and one that is not periodic is weighted with a Hann window.
    ///
    /// # Errors
    /// A map without any height.
    pub fn new(map: &HeightMap) -> Result<(SlopePower, Vec<SpectrumPoint>), MapError> {
        let points = spectrum(map)?;
        let [width, height] = [0, 1].map(|k| map.pixel()[k] * [map.columns(), map.rows()][k] as f64);
        let band = |p: &SpectrumPoint| {
            let heights = p.areal? * p.waves / (width * height);
            Some([p.frequency_of_power, heights * (TAU * p.frequency_of_power).powi(2)])
        };
        let bands = points.iter().filter_map(band).collect();
        Ok((SlopePower { bands, finest: finest(map) }, points))
    }

    /// Mean square of the slope, `order` 1, or of half the Laplacian, `order` 2, of waves each kept with the
    /// share `gain` of its power.
    fn sum(&self, order: i32, gain: impl Fn(f64) -> f64) -> f64 {
        let scale = |f: f64| if order == 1 { 1.0 } else { (0.5 * TAU * f).powi(2) };
        self.bands.iter().map(|[f, square]| square * scale(*f) * gain(*f)).sum()
    }

    /// Root mean square slope and half Laplacian (1/m) of all waves, or of those that the Gaussian filter of
    /// this `cutoff` (m) leaves.
    pub fn filtered(&self, cutoff: Option<f64>) -> [f64; 2] {
        let gain = |f: f64| cutoff.map_or(1.0, |c| (-2.0 * LN_2 * (c * f).powi(2)).exp());
        [1, 2].map(|order| self.sum(order, gain).sqrt())
    }

    /// Mean square slope of waves from `low` to `times` that, in metres.
    fn part(&self, low: f64, times: f64) -> f64 {
        let inside = |f: f64| f * low <= 1.0 + 1e-9 && times * f * low > 1.0 + 1e-9;
        self.sum(1, |f| if inside(f) { 1.0 } else { 0.0 })
    }

    /// Growth of the slope below the pixel: as the finest octaves grow, at least as the power law of `hurst`
    /// goes on, not at all where the spectrum ends before.
    pub fn growth(&self, hurst: Option<f64>) -> Growth {
        let [last, before] = [1.0, 2.0].map(|octave| self.part(octave * self.finest, 2.0));
        let [last_half, half_before] = [1.0, SQRT_2].map(|half| self.part(half * self.finest, SQRT_2));
        let whole = self.filtered(None)[0].powi(2);
        let law = 4f64.powf(1.0 - hurst.unwrap_or(0.8).clamp(0.0, 1.0));
        let goes_on = last_half > GOES_ON * law.sqrt() * half_before && last > LEAST_SHARE * whole;
        if !goes_on {
            return Growth { octaves: [0.0; 2], goes_on };
        }
        let ratio = (last / before).max(law).min(MOST_GROWTH);
        let first = ratio * last.max(law * before);
        let squares = [whole, whole + first, whole + first * (1.0 + ratio)];
        Growth { octaves: [0, 1].map(|k| 0.5 * (squares[k + 1] / squares[k]).ln()), goes_on }
    }
}
