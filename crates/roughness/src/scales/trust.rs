//! The scale below which a measurement says nothing of the surface.

use super::follow::ScalesError;
use super::slope_power::SlopePower;
use crate::{HeightMap, Surface};
use asperity_numerics::bisection::bisect;

/// Halvings of the search, in octaves from a tenth of a pixel up.
const HALVINGS: usize = 40;
const OCTAVES: f64 = 40.0;
/// Share of the power of slopes of one octave that noise may have.
const NOISE: f64 = 0.1;

/// The cut-off (m) below which the first of `maps` is not to be trusted: by the `tip` radius (m) of a stylus
/// or a probe, and by the noise that the others, repetitions of it, tell. None where neither limits it.
///
/// # Errors
/// Repetitions of another size, a map without heights.
pub fn trusted(maps: &[Surface], tip: Option<f64>) -> Result<Option<f64>, ScalesError> {
    let Some((first, others)) = maps.split_first() else { return Ok(None) };
    let (power, _) = SlopePower::new(&first.map)?;
    let pixel = first.map.pixel()[0];
    let mut found = tip.and_then(|radius| from(pixel, |cutoff| power.filtered(cutoff)[1] * radius > 1.0));
    for other in others {
        let noise = difference(&first.map, &other.map)?;
        let (noise, _) = SlopePower::new(&noise)?;
        // both maps have it; of one the power is half
        let octave = |power: &SlopePower, cutoff: f64| {
            power.filtered(Some(cutoff))[0].powi(2) - power.filtered(Some(2.0 * cutoff))[0].powi(2)
        };
        let drowned = |cutoff: Option<f64>| {
            let cutoff = cutoff.unwrap_or(2.0 * pixel);
            0.5 * octave(&noise, cutoff) > NOISE * octave(&power, cutoff)
        };
        found = [found, from(pixel, drowned)].into_iter().flatten().reduce(f64::max);
    }
    Ok(found)
}

/// The cut-off (m) at which `is_bad` ends, None where it does not hold of the whole map.
fn from(pixel: f64, is_bad: impl Fn(Option<f64>) -> bool) -> Option<f64> {
    if !is_bad(None) {
        return None;
    }
    let cutoff = |octave: f64| 0.1 * pixel * 2f64.powf(octave);
    let [_, high] = bisect([0.0, OCTAVES], HALVINGS, |octave| is_bad(Some(cutoff(octave))));
    Some(cutoff(high))
}

/// The surplus of the second map over the first.
fn difference(first: &HeightMap, second: &HeightMap) -> Result<HeightMap, ScalesError> {
    let size = |map: &HeightMap| [map.columns(), map.rows()];
    let ([a, b], [c, d]) = (size(first), size(second));
    if [a, b] != [c, d] {
        return Err(ScalesError::Repeated(a, b, c, d));
    }
    let heights = first.heights().iter().zip(second.heights()).map(|(a, b)| b - a);
    Ok(first.with_heights(heights.collect())?)
}
