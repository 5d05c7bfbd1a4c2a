//! Bounds of the stiffness that hold whatever roughness of a known height range was left out.

use super::law::Law;

/// Bounds of the elastic stiffness at one load, in Pa/m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// It is no less.
    pub low: f64,
    /// It is no more; none where nothing bounds it.
    pub high: Option<f64>,
}

/// Bounds of the elastic stiffness at `pressure` (Pa) of every surface that differs from that of `law` by
/// heights within a range of `range` (m), peak to valley (Barber 2003).
///
/// At equal pressure the approach of the whole surface, counted from where the plane would touch the smooth
/// one raised by the highest of what was left out, lies between δ(p) and δ(p) + s. It grows ever slower with
/// the pressure, as the contact grows. So its slope at p is at most that of any chord to a smaller load, and
/// at least that of any chord to a greater one, of which the bracket bounds both ends: 1/S ≤ (δ(p) + s -
/// δ(q))/(p - q) for q < p and 1/S ≥ (δ(q) - δ(p) - s)/(q - p) for q > p, the best of each.
pub fn bounds(law: &Law, range: f64, pressure: f64) -> Bounds {
    let at = law.approach(pressure);
    let (mut low, mut high): (f64, Option<f64>) = (0.0, None);
    for q in law.fine_pressures() {
        let to = law.approach(q);
        if q < pressure {
            low = low.max((pressure - q) / (at + range - to));
        } else if q > pressure && to - at > range {
            let slope = (q - pressure) / (to - at - range);
            high = Some(high.map_or(slope, |known| known.min(slope)));
        }
    }
    Bounds { low, high }
}
