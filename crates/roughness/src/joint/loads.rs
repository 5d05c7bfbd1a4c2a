//! The loads of a joint: from first touch to the largest.

use super::path::JointError;
use crate::half_space::HalfSpace;
use crate::{Load, Surface};

/// Loads unless more or fewer are asked for.
pub const USUAL_LOADS: usize = 25;
/// Fewer give no curve.
pub const FEWEST_LOADS: usize = 5;
/// Decades from the smallest load to the largest: the stiffness is linear over two of them.
const DECADES: f64 = 3.0;
/// Share of the limit of pressure to which a joint is pressed where no load is given: beyond, all of it
/// flows.
const SHARE_OF_LIMIT: f64 = 0.9;
/// Contact area at which an elastic joint counts as closed where no load is given.
const CLOSED_AREA: f64 = 0.99;
/// Proven error to which the closed contact is looked for.
const CLOSING_TOLERANCE: f64 = 1e-3;
/// Doublings and halvings of that search: a load to 4 %.
const DOUBLINGS: usize = 40;
const HALVINGS: usize = 4;

/// The largest nominal pressure of a joint, in Pa: that of `load`, else 0.9 of the limit of pressure, or 99 %
/// of the area in contact where that comes first.
///
/// # Errors
/// A load that touches nothing, one beyond the limit of pressure, a flat surface, which closes at once.
pub fn largest_pressure(body: &HalfSpace, surface: &Surface, load: Option<Load>) -> Result<f64, JointError> {
    if surface.extent.high <= surface.extent.low {
        return Err(JointError::Flat);
    }
    let pressure = match load {
        Some(Load::Pressure(pressure)) => {
            body.bears(pressure)?;
            pressure
        }
        Some(held @ Load::Separation(_)) => body.press(surface, held)?.pressure,
        None => closing_pressure(body, surface)?,
    };
    if pressure > 0.0 { Ok(pressure) } else { Err(JointError::NoTouch) }
}

/// `count` pressures from a thousandth of `largest` to all of it, each the same factor above the last.
pub fn loads(largest: f64, count: usize) -> Vec<f64> {
    let steps = count.max(2) - 1;
    let load = |k: usize| largest * 10f64.powf(-DECADES * (steps - k) as f64 / steps as f64);
    (0..=steps).map(load).collect()
}

fn closing_pressure(body: &HalfSpace, surface: &Surface) -> Result<f64, JointError> {
    let rough = HalfSpace { tolerance: body.tolerance.max(CLOSING_TOLERANCE), ..*body };
    let most = body.limit.map_or(f64::INFINITY, |limit| SHARE_OF_LIMIT * limit);
    // of full contact the pressures vary by E* h'/2 about their mean
    let mut high = (0.5 * body.reduced_modulus * surface.parameters.rms_gradient).min(most);
    let mut last = rough.press(surface, Load::Pressure(high))?;
    let mut low = 0.0;
    for _ in 0..DOUBLINGS {
        if last.area.ratio >= CLOSED_AREA || high >= most {
            break;
        }
        (low, high) = (high, (2.0 * high).min(most));
        last = rough.press_from(surface, Load::Pressure(high), Some(&last))?;
    }
    if last.area.ratio < CLOSED_AREA {
        return Ok(high);
    }
    if low == 0.0 {
        low = 0.5 * high;
    }
    for _ in 0..HALVINGS {
        let middle = (low * high).sqrt();
        last = rough.press_from(surface, Load::Pressure(middle), Some(&last))?;
        if last.area.ratio >= CLOSED_AREA { high = middle } else { low = middle }
    }
    Ok(high)
}
