//! Numbers that programs write in the place of a height that was not measured.

use super::measured::{ReadError, Request};
use crate::text::TextError;

const MARKS: [f64; 13] = [
    -32768.0,
    -32767.0,
    32767.0,
    65535.0,
    -999.0,
    999.0,
    -9999.0,
    9999.0,
    -99999.0,
    99999.0,
    -2147483648.0,
    2147483647.0,
    -2147483647.0,
];
/// Distance of a mark from all heights, in ranges of these.
const LEAST_DISTANCE: f64 = 3.0;

/// Refuses heights whose lowest or highest is such a number, far from all others.
///
/// # Errors
/// Such a number, with the key that makes it missing.
pub(super) fn refuse(heights: &[f64], request: &Request<'_>) -> Result<(), ReadError> {
    if request.override_file {
        return Ok(());
    }
    let range = |without: Option<f64>| {
        let there = heights.iter().filter(|z| z.is_finite() && Some(**z) != without);
        there.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| [low.min(*z), high.max(*z)])
    };
    for end in range(None).into_iter().filter(|end| MARKS.contains(end)) {
        let [low, high] = range(Some(end));
        let distance = (low - end).max(end - high);
        if high > low && distance > LEAST_DISTANCE * (high - low) {
            let count = heights.iter().filter(|z| **z == end).count();
            let problem = format!(
                "holds {end} at {count} points, far from all other heights ({low} to {high}), as programs write it for points that \
                 were not measured: set missing_value = {end}, or override = true if it is a height"
            );
            return Err(TextError::whole(problem).into());
        }
    }
    Ok(())
}
