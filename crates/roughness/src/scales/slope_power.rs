//! The power of slopes by wave length, and how the slope goes on where the map ends.

use crate::surface::height_map::MapError;
use crate::{HeightMap, SpectrumPoint, spectrum};
use std::f64::consts::{LN_2, PI, TAU};

/// Half octaves below the highest frequency of an axis that are looked at.
const HALVES: usize = 8;
/// Half a band of the spectrum, as a natural logarithm.
const HALF_BAND: f64 = LN_2 / 16.0;
/// Shares of the two finest half octaves that are not finer waves taken for these, of points that were
/// picked: of a power law of H = 0.3 to 0.9 it is 0.5 and 0.8.
const NOT_ALIASED: [f64; 2] = [0.6, 0.8];
/// Largest growth of the power of slopes from octave to octave: that of white noise.
const MOST_GROWTH: f64 = 16.0;
/// The same where no more is taken for sure: that of H = 0.
const SURE_GROWTH: f64 = 4.0;
/// Scatter of these ratios.
const SCATTER: f64 = 1.1;
/// The share of the least growth that is taken, as the finer map may end sooner.
const LEAST: f64 = 0.8;
/// Growth by two octaves up to which a spectrum counts as one that has ended.
const ENDED: f64 = 0.1;

/// Mean squares of slopes and of curvatures by frequency.
#[derive(Clone, Debug)]
pub struct SlopePower {
    /// Frequency (1/m), mean square slope of its band.
    bands: Vec<[f64; 2]>,
    /// Share of the mean square slope of each half octave below the highest frequency, the finest first: that
    /// along x by the frequencies along x, and the same along y.
    halves: [f64; HALVES],
}

/// The growth of the rms slope by each of the two octaves below the pixel, as natural logarithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// If the spectrum bends, and the finest waves of the map are in part finer ones.
    pub least: [f64; 2],
    /// As the finest octaves go on.
    pub expected: [f64; 2],
    /// If the pixels are means, which damp the finest waves, and the spectrum goes on as steeply as it does
    /// anywhere.
    pub most: [f64; 2],
}

impl Growth {
    /// False where the spectrum ends before the pixel: finer waves are not to be expected.
    pub fn goes_on(&self) -> bool {
        self.most[0] + self.most[1] > ENDED
    }
}

/// Mean square slope along x of the half octaves of frequency along x, and the same along y: not of |f|, as a
/// map of grooves or of oblong pixels ends along each axis by itself.
fn halves(map: &HeightMap, points: &[SpectrumPoint]) -> [f64; HALVES] {
    let mut sums = [0.0; HALVES];
    for p in points {
        for (density, pixel) in [p.along_x, p.along_y].into_iter().zip(map.pixel()) {
            let Some(density) = density else { continue };
            // both signs of frequency; a band reaches half a band to both sides, but not beyond the pixel
            let power = 2.0 * density * p.frequency * (TAU * p.frequency).powi(2);
            let below = -(2.0 * pixel * p.frequency).ln();
            let [from, to] = [below - HALF_BAND, below + HALF_BAND].map(|x| x.max(0.0) / (0.5 * LN_2));
            for (k, sum) in sums.iter_mut().enumerate() {
                let inside = to.min(k as f64 + 1.0) - from.max(k as f64);
                *sum += power * inside.max(0.0) * 0.5 * LN_2;
            }
        }
    }
    sums
}

/// The inverse of what a pixel that is a mean leaves of the power of half octave `k`, along one axis.
fn damped(k: usize) -> f64 {
    let x = 0.5 * PI * 2f64.powf(-0.5 * (k as f64 + 0.5));
    (x / x.sin()).powi(2)
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
        let mut power = SlopePower { bands, halves: halves(map, &points) };
        let whole = power.filtered(None)[0].powi(2).max(f64::MIN_POSITIVE);
        power.halves.iter_mut().for_each(|half| *half /= whole);
        Ok((power, points))
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

    /// Growth of the slope below the pixel.
    pub fn growth(&self) -> Growth {
        let seen = self.halves;
        let octave = |h: &[f64], k: usize| h[2 * k] + h[2 * k + 1];
        let ratio = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        // of the power of an octave over that of the one before: by its halves, and by whole ones
        let ratios =
            |h: &[f64]| [ratio(h[0], h[1]).powi(2).min(MOST_GROWTH), ratio(octave(h, 0), octave(h, 1))];
        let grown = |ratio: f64, last: f64, more: f64| {
            let first = ratio * last;
            let squares = [1.0, 1.0 + more + first, 1.0 + more + first * (1.0 + ratio)];
            [0, 1].map(|k| (0.5 * (squares[k + 1] / squares[k]).ln()).max(0.0))
        };
        let whole: Vec<f64> = seen.iter().enumerate().map(|(k, h)| h * damped(k)).collect();
        // damped along its own axis, and about as much along the other
        let hidden = 2.0 * (whole.iter().sum::<f64>() - seen.iter().sum::<f64>());
        let [halves, octaves] = ratios(&whole);
        let most = grown((SCATTER * halves.max(octaves)).min(MOST_GROWTH), octave(&whole, 0), hidden);
        let middle = 0.5 * (octave(&seen, 0) + octave(&whole, 0));
        let expected = grown((halves * octaves).sqrt(), middle, 0.25 * hidden);
        let own = [seen[0] * NOT_ALIASED[0], seen[1] * NOT_ALIASED[1], seen[2], seen[3]];
        let [halves, octaves] = ratios(&own);
        let last = octave(&own, 0);
        let least = grown(halves.min(octaves).min(SURE_GROWTH), last, last - octave(&seen, 0));
        let least = [0, 1].map(|k| (LEAST * least[k]).min(expected[k]));
        Growth { least, expected, most }
    }
}
