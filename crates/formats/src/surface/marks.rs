//! Numbers that programs write in the place of a height that was not measured.

use super::measured::{ReadError, Request};
use crate::text::TextError;
use crate::units::rounded;

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
const LEAST_DISTANCE: f64 = 1.0;

/// The same of 0 that stands there more than once, and of 0 that stands often among heights of many digits;
/// it also is the floor of a map that a program made: then heights follow close above it.
const DISTANCE_OF_ZERO: f64 = 1.0;
const DISTANCE_OF_ZERO_AMONG_DIGITS: f64 = 0.25;
/// The same of a number that is none of these, but stands there more than once; and of one of a few digits
/// that stands there more often, among heights of more.
const DISTANCE_OF_REPEATED: f64 = 10.0;
const DISTANCE_OF_ROUND: f64 = 1.0;
/// Significant digits of a round number, and how often it has to stand there.
const ROUND_DIGITS: usize = 4;
const TIMES_OF_ROUND: usize = 3;
/// The same of any number: no surface has a single point so far away.
const DISTANCE_OF_ANY: f64 = 1e3;

fn is_round(number: f64) -> bool {
    !number.is_finite() || rounded(number, ROUND_DIGITS) == number
}

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
    for end in range(None) {
        let [low, high] = range(Some(end));
        let distance = (low - end).max(end - high);
        let count = heights.iter().filter(|z| **z == end).count();
        let is_among_digits =
            || count >= TIMES_OF_ROUND && is_round(end) && !heights.iter().all(|z| is_round(*z));
        let least = match count {
            _ if MARKS.contains(&end) => LEAST_DISTANCE,
            1 => DISTANCE_OF_ANY,
            _ if end == 0.0 && is_among_digits() => DISTANCE_OF_ZERO_AMONG_DIGITS,
            _ if end == 0.0 => DISTANCE_OF_ZERO,
            _ if is_among_digits() => DISTANCE_OF_ROUND,
            _ => DISTANCE_OF_REPEATED,
        };
        if high > low && distance > least * (high - low) {
            let problem = format!(
                "holds {end} at {count} points, far from all other heights ({low} to {high}), as programs write it for points that \
                 were not measured: set missing_value = {end}, or override = true if it is a height"
            );
            return Err(TextError::whole(problem).into());
        }
    }
    Ok(())
}
