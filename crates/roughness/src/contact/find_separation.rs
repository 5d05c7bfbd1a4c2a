//! The plane of a closure that is not linear in tan β: its islands have to be found at every plane that is
//! tried.

use super::bearing_area::{self, Planes};
use super::closures::ClosureLaw;
use super::load::Carrying;
use crate::surface::height_map::Extent;
use crate::surface::prepared_surface::Surface;

/// Residual at which the search ends: half of what is promised.
const SOUGHT_RESIDUAL: f64 = 5e-7;
/// Promised residual; a load that no plane meets to this jumps.
const PROMISED_RESIDUAL: f64 = 1e-6;
/// Secants before plain halving, which closes in on a jump.
const SECANTS: usize = 12;
/// Part of the surface's height below which a bracket is closed.
const CLOSED_WIDTH: f64 = 1e-13;

/// The plane that carries `pressure`, and whether the load jumps there; the largest load where none carries
/// it.
///
/// 1. Guess the load above each of some planes from the area and the mean slope there, as if all of it were
///    one island.
/// 2. Secants of the logarithm of the load, the first with the slope of the guess.
/// 3. No step leaves the bracket of the planes tried; what does not converge is halved. The load of a closure
///    is monotone in the plane (it rises with the area and with the slope integral, and merging never lowers
///    it).
pub(super) fn plane_for(surface: &Surface, model: &ClosureLaw, pressure: f64) -> Result<(f64, bool), f64> {
    let extent = &surface.extent;
    let guess = Guess::from_bearing_area(surface, model, pressure);
    let mut bracket = Bracket::whole_range(extent);
    // the runs above a plane some way below the guess serve every plane that is likely to be tried
    let base = |plane: f64| Carrying::new(surface, model, (plane - guess.step).max(extent.low));
    let mut carrying = base(guess.plane);
    let (mut plane, mut slope) = (guess.plane, guess.slope);
    let (mut last, mut best): (Option<Tried>, Option<Tried>) = (None, None);
    for step in 0.. {
        if plane < carrying.plane() {
            carrying = base(plane);
        }
        let load = carrying.pressure_and_area(plane).0;
        let tried = Tried { plane, excess: (load / pressure).ln() };
        if tried.excess < -SOUGHT_RESIDUAL && plane <= extent.low {
            return Err(load);
        }
        if best.is_none_or(|best| tried.excess.abs() < best.excess.abs()) {
            best = Some(tried);
        }
        let enough = if step < SECANTS { SOUGHT_RESIDUAL } else { PROMISED_RESIDUAL };
        if tried.excess.abs() <= enough || !bracket.take(&tried) {
            break;
        }
        if let Some(last) = last {
            slope = (tried.excess - last.excess) / (tried.plane - last.plane);
        }
        let secant = tried.plane - tried.excess / slope;
        plane = bracket.hold(if step < SECANTS { secant } else { f64::NAN });
        last = Some(tried);
    }
    Ok(best.map_or((guess.plane, false), |best| (best.plane, best.excess.abs() > PROMISED_RESIDUAL)))
}

/// A plane, and ln of what it carries over what is wanted.
#[derive(Clone, Copy)]
struct Tried {
    plane: f64,
    excess: f64,
}

/// Two planes between which the load lies.
struct Bracket {
    low: f64,
    high: f64,
    /// True where the lower end is known to carry the load.
    carries: bool,
    closed: f64,
}

impl Bracket {
    fn whole_range(extent: &Extent) -> Bracket {
        let Extent { low, high, .. } = *extent;
        Bracket { low, high, carries: false, closed: CLOSED_WIDTH * (high - low) }
    }

    /// Narrows; false once there is nothing left between the ends.
    fn take(&mut self, tried: &Tried) -> bool {
        if tried.excess >= 0.0 {
            (self.low, self.carries) = (tried.plane, true);
        } else {
            self.high = tried.plane;
        }
        let middle = self.middle();
        self.high - self.low > self.closed && middle > self.low && middle < self.high
    }

    fn middle(&self) -> f64 {
        self.low + 0.5 * (self.high - self.low)
    }

    /// `plane` if it lies inside; the lower end as long as that may not carry the load; else the middle.
    fn hold(&self, plane: f64) -> f64 {
        if plane > self.low && plane < self.high {
            plane
        } else if self.carries || plane >= self.high {
            self.middle()
        } else {
            self.low
        }
    }
}

/// The separation at which the load probably lies.
struct Guess {
    plane: f64,
    /// d(ln load)/d(plane) there, below 0.
    slope: f64,
    /// Distance below which the guess is uncertain.
    step: f64,
}

impl Guess {
    fn from_bearing_area(surface: &Surface, model: &ClosureLaw, pressure: f64) -> Guess {
        let (planes, sums) = bearing_area::estimate(&surface.map, &surface.extent);
        let cells = surface.extent.cells as f64;
        let load = |k: usize| {
            let above = &sums[k];
            let slope = if above.area > 0.0 { above.slope_area / above.area } else { 0.0 };
            model.respond(slope).island_pressure * above.area / cells
        };
        let Planes { step, count, .. } = planes;
        let k = (0..count - 1).rev().find(|k| load(*k) >= pressure);
        let Some(k) = k else { return Guess { plane: planes.low, slope: -1.0 / step, step } };
        let (below, over) = (load(k), load(k + 1));
        let slope = (over / below).ln() / step;
        if slope.is_finite() && slope < 0.0 {
            let plane = planes.height(k) + (pressure / below).ln() / slope;
            Guess { plane, slope, step }
        } else {
            Guess { plane: planes.height(k) + 0.5 * step, slope: -1.0 / step, step }
        }
    }
}
