//! The contact of a surface at one scale.

use super::numbers::Numbers;
use super::regimes::RegimeSlopes;
use crate::flow::{Axis, Gap, constriction, leak};
use crate::half_space::{HalfSpace, HalfSpaceContact, HalfSpaceError};
use crate::{Load, Surface};

/// Share of the contact with no higher pressure.
const HIGH: f64 = 0.99;

/// Presses `surface` on `body` by the nominal `pressure` (Pa), from the contact `start` where that has its
/// points; the numbers of the contact, and the contact itself for the next.
///
/// # Errors
/// A load beyond the limit of pressure, a search that does not end.
pub fn press_scale(
    body: &HalfSpace,
    surface: &Surface,
    pressure: f64,
    regimes: Option<&RegimeSlopes>,
    start: Option<&HalfSpaceContact>,
) -> Result<(Numbers, HalfSpaceContact), HalfSpaceError> {
    let found = body.press_from(surface, Load::Pressure(pressure), start)?;
    let gap = Gap::new(&surface.map, &found.gaps);
    let passage = |axis| {
        let narrowest = constriction(&gap, axis);
        let unknown = narrowest.is_none() && surface.map.missing() > 0;
        let flow = narrowest.and_then(|_| leak(&gap, axis));
        let conductance = (!unknown).then(|| flow.map_or(0.0, |leak| leak.conductance));
        let error = flow.map(|leak| leak.error).filter(|error| error.is_finite());
        (narrowest.map(|place| place.gap), conductance, error)
    };
    let (x, y) = rayon::join(|| passage(Axis::X), || passage(Axis::Y));
    let shares = regimes.and_then(|regimes| regimes.shares(&surface.map, &found));
    let numbers = Numbers {
        area_ratio: Some(found.area.ratio),
        area: Some(found.area),
        mean_pressure: found.mean_pressure(),
        pressures: distribution(&found),
        mean_gap: Some(found.mean_gap),
        critical_gaps: [x.0, y.0],
        leaks: [x.1, y.1],
        leak_errors: [x.2, y.2],
        stiffness: found.stiffness,
        by_load: shares.map_or([None; 3], |shares| shares.load.map(Some)),
        by_area: shares.map_or([None; 3], |shares| shares.area.map(Some)),
        limit: found.limit,
        limited_share: Some(found.limited_share),
    };
    Ok((numbers, found))
}

/// Median, 99 % and largest pressure over the contact.
fn distribution(found: &HalfSpaceContact) -> [Option<f64>; 3] {
    let mut loaded: Vec<f32> = found.pressures.iter().copied().filter(|p| *p > 0.0).collect();
    if loaded.is_empty() {
        return [None; 3];
    }
    let mut below = |share: f64| {
        let place = ((share * loaded.len() as f64) as usize).min(loaded.len() - 1);
        f64::from(*loaded.select_nth_unstable_by(place, f32::total_cmp).1)
    };
    [below(0.5), below(HIGH), found.largest_pressure].map(Some)
}
