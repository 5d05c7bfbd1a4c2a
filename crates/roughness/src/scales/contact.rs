//! The contact of a surface at one scale.

use super::regimes::{RegimeSlopes, Shares};
use crate::flow::{Axis, Gap, constriction, leak};
use crate::half_space::{Area, HalfSpace, HalfSpaceContact, HalfSpaceError};
use crate::{Load, Surface};

/// Share of the contact with no higher pressure.
const HIGH: f64 = 0.99;

/// The contact by a half-space at one scale.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScaleContact {
    /// Contact area.
    pub area: Area,
    /// Load over contact area, in Pa; None without contact.
    pub mean_pressure: Option<f64>,
    /// The pressure (Pa) that half of the contact is below, that 99 % are, and the largest; None without
    /// contact.
    pub pressures: Option<[f64; 3]>,
    /// Mean distance of plane and surface, in metres.
    pub mean_gap: f64,
    /// Gap of the critical constriction along x and y, in metres; none where no path crosses.
    pub critical_gaps: [Option<f64>; 2],
    /// Volume flux times viscosity over pressure difference along x and y, in m³; 0 where nothing passes,
    /// None where points without a height may close the way.
    pub leaks: [Option<f64>; 2],
    /// Relative errors of the leaks by the pixels.
    pub leak_errors: [Option<f64>; 2],
    /// -dp/d(mean gap), in Pa/m; None without contact or gap.
    pub stiffness: Option<f64>,
    /// Largest pressure that the metal carries, in Pa; None of elastic metal.
    pub limit: Option<f64>,
    /// Share of the contact area at that limit.
    pub limited_share: f64,
    /// Regimes by the slopes of the patches; None without contact, or where nothing of the strength is known.
    pub shares: Option<Shares>,
}

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
) -> Result<(ScaleContact, HalfSpaceContact), HalfSpaceError> {
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
    let numbers = ScaleContact {
        area: found.area,
        mean_pressure: found.mean_pressure(),
        pressures: distribution(&found),
        mean_gap: found.mean_gap,
        critical_gaps: [x.0, y.0],
        leaks: [x.1, y.1],
        leak_errors: [x.2, y.2],
        stiffness: found.stiffness,
        limit: found.limit,
        limited_share: found.limited_share,
        shares: regimes.and_then(|regimes| regimes.shares(&surface.map, &found)),
    };
    Ok((numbers, found))
}

/// Median, 99 % and largest pressure over the contact.
fn distribution(found: &HalfSpaceContact) -> Option<[f64; 3]> {
    let mut loaded: Vec<f32> = found.pressures.iter().copied().filter(|p| *p > 0.0).collect();
    if loaded.is_empty() {
        return None;
    }
    let mut below = |share: f64| {
        let place = ((share * loaded.len() as f64) as usize).min(loaded.len() - 1);
        f64::from(*loaded.select_nth_unstable_by(place, f32::total_cmp).1)
    };
    Some([below(0.5), below(HIGH), found.largest_pressure])
}
