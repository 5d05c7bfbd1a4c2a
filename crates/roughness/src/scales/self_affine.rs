//! Hurst exponent, roll-off and end of a power spectrum, with intervals.
//!
//! The density of a self-affine surface is flat above the roll-off and falls as f^-2(1+H) below it, down to
//! an end. Powers of single waves scatter as exponentials, so that a band of n of them has the deviance 2n
//! (r - ln r - 1) of its mean over the law, r (Whittle 1953). For a given roll-off the sum is convex in H,
//! and the level follows in closed form. Bands beyond the end are left out, each at a price.

use super::cutoffs::{finest, side};
use crate::{HeightMap, SpectrumPoint};
use asperity_numerics::bisection::bisect;

/// Relative scatter of bands about the law beside that of their waves: no surface is self-affine to better.
const SCATTER: f64 = 0.1;
/// The price of a band that is left out beyond the end, as a deviance; one that follows the law has 1.
const PRICE: f64 = 6.0;
/// The deviance by which the ends of 90 % intervals are above the least (χ² of one degree of freedom).
const INTERVAL: f64 = 2.71;
/// Waves of a window of Hann that are as one independent wave (35/18 along each axis).
const WAVES_OF_WINDOW: f64 = 3.78;
/// Longest wave of a map that is not periodic, in shares of its side: longer ones are the window's.
const LONGEST_OF_WINDOW: f64 = 1.0 / 1.5;
/// Roll-offs tried to an octave, bands that a law goes through at least, octaves of its power.
const ROLLOFFS: f64 = 24.0;
const FEWEST_BANDS: usize = 8;
const FEWEST_OCTAVES: f64 = 1.0;
/// 2(1 + H) that is sought, and the halvings of the search.
const EXPONENTS: [f64; 2] = [0.5, 8.0];
const HALVINGS: usize = 36;
/// Half a band of the spectrum, in octaves: where in its band a roll-off lies is not seen.
const HALF_BAND: f64 = 1.0 / 16.0;
/// Steps of H in its interval.
const HURST_STEP: f64 = 0.0025;

/// A number with its 90 % interval; an end that the map does not hold is infinite or 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The number.
    pub value: f64,
    /// The lower end.
    pub low: f64,
    /// The upper end.
    pub high: f64,
}

/// A spectrum as that of a self-affine surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SelfAffine {
    /// Hurst exponent H.
    pub hurst: Interval,
    /// Longest wave of the power law, in metres; without one in the map its value is NaN and its upper end
    /// infinite.
    pub rolloff: Interval,
    /// Shortest wave of the power law, in metres.
    pub shortest: Interval,
}

/// A band: ln f, mean density, effective number of waves.
type Band = [f64; 3];

/// The law through bands for one roll-off.
struct Law {
    /// Of each band ln(f/f_r), at least 0; density; waves.
    bands: Vec<Band>,
}

impl Law {
    fn new(bands: &[Band], rolloff: f64) -> Law {
        Law { bands: bands.iter().map(|[x, density, n]| [(x - rolloff).max(0.0), *density, *n]).collect() }
    }

    /// The deviance for the exponent `s`, the level being the best.
    fn deviance(&self, s: f64) -> f64 {
        let [mut waves, mut level, mut logs] = [0.0; 3];
        for [x, density, n] in &self.bands {
            waves += n;
            level += n * density * (s * x).exp();
            logs += n * (density.ln() + s * x);
        }
        2.0 * (waves * (level / waves).ln() - logs)
    }

    /// The exponent of the least deviance.
    fn exponent(&self) -> f64 {
        let falls = |s: f64| {
            let [mut waves, mut level, mut weighted, mut mean] = [0.0; 4];
            for [x, density, n] in &self.bands {
                let part = n * density * (s * x).exp();
                (waves, mean) = (waves + n, mean + n * x);
                (level, weighted) = (level + part, weighted + part * x);
            }
            weighted * waves < mean * level
        };
        let [low, high] = bisect(EXPONENTS, HALVINGS, falls);
        0.5 * (low + high)
    }
}

/// Roll-offs from that of the longest wave, as ln f, to those with enough of a power law before `end`.
fn rolloffs(bands: &[Band]) -> Vec<f64> {
    let octave = std::f64::consts::LN_2;
    let (first, last) = (bands[0][0], bands[bands.len() - 1][0] - FEWEST_OCTAVES * octave);
    let step = octave / ROLLOFFS;
    (0..).map(|k| first + f64::from(k) * step).take_while(|x| *x <= last).collect()
}

impl SelfAffine {
    /// Through the `points` of the spectrum of `map`; None of fewer than eight bands or of a flat map.
    pub fn new(map: &HeightMap, points: &[SpectrumPoint]) -> Option<SelfAffine> {
        let bands = bands(map, points);
        let count = end(&bands)?;
        let used = &bands[..count];
        let tried = rolloffs(used);
        let laws: Vec<Law> = tried.iter().map(|x| Law::new(used, *x)).collect();
        let best: Vec<[f64; 2]> =
            laws.iter().map(|law| law.exponent()).zip(&laws).map(|(s, law)| [law.deviance(s), s]).collect();
        let least = (0..best.len()).min_by(|a, b| best[*a][0].total_cmp(&best[*b][0]))?;
        let [deviance, exponent] = best[least];
        // where the law fits worse than chance, its intervals are wider
        let scale = (deviance / (count as f64 - 3.0)).max(1.0);
        let most = deviance + INTERVAL * scale;
        let inside = |k: &usize| best[*k][0] <= most;
        let first = (0..best.len()).find(inside).unwrap_or(least);
        let last = (0..best.len()).rev().find(inside).unwrap_or(least);
        let fits = |s: f64| laws.iter().any(|law| law.deviance(s) <= most);
        let reach = |sign: f64| {
            let steps = (1..).map(|k| exponent + sign * 2.0 * HURST_STEP * f64::from(k));
            steps.take_while(|s| (EXPONENTS[0]..=EXPONENTS[1]).contains(s) && fits(*s)).last()
        };
        let hurst = |s: f64| 0.5 * s - 1.0;
        let [low, high] = [-1.0, 1.0].map(|sign| reach(sign).unwrap_or(exponent) + sign * 2.0 * HURST_STEP);
        let half = HALF_BAND * std::f64::consts::LN_2;
        let resolved = first > 0;
        let shortest = (-used[count - 1][0]).exp();
        Some(SelfAffine {
            hurst: Interval { value: hurst(exponent), low: hurst(low), high: hurst(high) },
            rolloff: Interval {
                value: if resolved { (-tried[least]).exp() } else { f64::NAN },
                low: (-tried[last] - half).exp(),
                high: if resolved { (half - tried[first]).exp() } else { f64::INFINITY },
            },
            shortest: Interval {
                value: shortest,
                low: bands.get(count).map_or_else(|| finest(map), |next| (-next[0]).exp()),
                high: (-used[count - 2][0]).exp(),
            },
        })
    }

    /// True where the roll-off lies inside the map.
    pub fn has_rolloff(&self) -> bool {
        self.rolloff.high.is_finite()
    }
}

/// The bands of the spectrum of `map` that tell of its surface, from the longest waves to two pixels.
fn bands(map: &HeightMap, points: &[SpectrumPoint]) -> Vec<Band> {
    let whole = map.periodic() && map.missing() == 0;
    let waves_of_one = if whole { 2.0 } else { 2.0 * WAVES_OF_WINDOW };
    let longest = side(map) * if whole { 1.0 } else { LONGEST_OF_WINDOW };
    let near = 1.0 + 1e-9;
    let known = points.iter().filter(|p| p.frequency * longest * near >= 1.0);
    let known = known.filter(|p| p.frequency * finest(map) <= near);
    let band = |p: &SpectrumPoint| {
        let density = p.areal.filter(|density| *density > 0.0)?;
        let waves = 1.0 / (waves_of_one / p.waves + SCATTER * SCATTER);
        Some([p.frequency.ln(), density, waves])
    };
    known.filter_map(band).collect()
}

/// The number of bands before the end of the power law: those left out cost their price.
fn end(bands: &[Band]) -> Option<usize> {
    let cost = |count: usize| {
        let used = &bands[..count];
        let least = rolloffs(used).into_iter().step_by(4).map(|x| Law::new(used, x)).map(|law| {
            let s = law.exponent();
            law.deviance(s)
        });
        least.reduce(f64::min).map(|deviance| deviance + PRICE * (bands.len() - count) as f64)
    };
    let counts = (FEWEST_BANDS..=bands.len()).filter_map(|count| Some((count, cost(count)?)));
    counts.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(count, _)| count)
}
