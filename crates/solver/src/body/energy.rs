//! Energies and contact sums of a converged increment.

use crate::contact::edge::EdgeContact;
use crate::element::kernel::POINTS;
use crate::point::kinematics::Symmetry;
use crate::point::material::{Metal, PointState, elastic_energy};

/// Stored elastic energy Σ ψ(ε_e) dV₀ over all points.
pub fn stored(metal: &Metal, states: &[PointState], volume: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (states, volume) in states.chunks_exact(POINTS).zip(volume.chunks_exact(POINTS)) {
        let energy = elastic_energy(&metal.elastic, &PointState::side_by_side(states).b_minus_i);
        volume.iter().zip(energy.0).for_each(|(v, energy)| sum += v * energy);
    }
    sum
}

/// ∫F dh between two states of a loading or unloading path, exact for F = (a + b h)^2.
pub fn work(force: [f64; 2], travel: f64) -> f64 {
    let [f, g] = force.map(|f| f.max(0.0));
    travel * (f + (f * g).sqrt() + g) / 3.0
}

/// ∫F dh over the last of two increments of the lengths `travel`, by the parabola through the three forces.
pub fn work_by_parabola([before, from, to]: [f64; 3], [last, step]: [f64; 2]) -> f64 {
    let bend = ((to - from) / step - (from - before) / last) / (last + step);
    step * (0.5 * (from + to) - bend * step * step / 6.0)
}

/// ∫F dh between two states whose forces and slopes dF/dh are known: exact for a cubic.
pub fn work_by_slopes(force: [f64; 2], slope: [f64; 2], travel: f64) -> f64 {
    travel * (0.5 * (force[0] + force[1]) + travel * (slope[0] - slope[1]) / 12.0)
}

/// Exponents that a force has near separation as the tool retreats: 1 under a flat punch, 2 under a cone.
pub const SEPARATION_EXPONENTS: [f64; 2] = [1.0, 2.0];

/// Exponents that a force has after first touch: 1/2 of a plastic ridge with a round summit, 2 of a cone.
pub const FIRST_TOUCH_EXPONENTS: [f64; 2] = [0.5, 2.0];

/// ∫F dh between separation and a state of this force and slope that lies `travel` from it: F ∝ (distance to
/// separation)^m.
///
/// `exponents` are the least and the largest m: beyond them the slope is not one of this curve.
pub fn work_by_power(force: f64, slope: f64, travel: f64, exponents: [f64; 2]) -> f64 {
    if force <= 0.0 {
        return 0.0;
    }
    let exponent = (slope * travel.abs() / force).clamp(exponents[0], exponents[1]);
    travel * force / (exponent + 1.0)
}

/// Sums of the contact over some edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactSums {
    /// Force on the tool along z.
    pub force: f64,
    /// Projected current area.
    pub area: f64,
    /// Smallest and largest radius in contact (NaN without contact).
    pub reach: [f64; 2],
    /// Outer edge of the contact that holds the axis; half the width in plane strain.
    pub radius: f64,
    /// ½ε∫d² dA.
    pub energy: f64,
    /// Pressure-weighted mean penetration.
    pub penetration: f64,
    /// Largest contact pressure.
    pub max_pressure: f64,
}

/// Sums over `edges`.
pub fn contact_sums<'a>(edges: impl Iterator<Item = &'a EdgeContact>, symmetry: Symmetry) -> ContactSums {
    let mut sums = ContactSums {
        force: 0.0,
        area: 0.0,
        reach: [f64::NAN; 2],
        radius: 0.0,
        energy: 0.0,
        penetration: 0.0,
        max_pressure: 0.0,
    };
    let (mut pressure, mut weighted) = (0.0, 0.0);
    for edge in edges {
        sums.force += edge.load;
        sums.area += edge.area;
        sums.energy += edge.penalty_energy;
        pressure += edge.pressure;
        weighted += edge.pressure_penetration;
        sums.max_pressure = sums.max_pressure.max(edge.max_pressure);
        if edge.parts[0].is_some() {
            // the contact that holds the axis grows from 0 without a gap, edge after edge
            let gap = 1e-9 * edge.reach[1].abs();
            if edge.reach[0] <= sums.radius + gap {
                sums.radius = sums.radius.max(edge.reach[1]);
            }
            sums.reach = [sums.reach[0].min(edge.reach[0]), sums.reach[1].max(edge.reach[1])];
        }
    }
    if pressure > 0.0 {
        sums.penetration = weighted / pressure;
    }
    if symmetry == Symmetry::PlaneStrain {
        sums.radius = 0.5 * sums.area;
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn work_of_known_curves() {
        // F = 1 + h², from h = 1 to 3, with h = 0 before: 32/3
        assert!((work_by_parabola([1.0, 2.0, 10.0], [1.0, 2.0]) - 32.0 / 3.0).abs() < 1e-14);
        // F = (1 + h)², from h = 0 to 2: 26/3; F = 3 h³ from 2 back to 1: -45/4; F = 5 u^1.5 over u = 0.3
        assert!((work([1.0, 9.0], 2.0) - 26.0 / 3.0).abs() < 1e-14);
        assert!((work_by_slopes([24.0, 3.0], [36.0, 9.0], -1.0) + 11.25).abs() < 1e-14);
        let (force, slope) = (5.0 * 0.3_f64.powf(1.5), 7.5 * 0.3_f64.sqrt());
        assert!(
            (work_by_power(force, slope, -0.3, SEPARATION_EXPONENTS) + 2.0 * 0.3_f64.powf(2.5)).abs() < 1e-14
        );
        // F = √h up to h = 4: 16/3; as a tool parts, no power below 1 is taken: 4
        assert!((work_by_power(2.0, 0.25, 4.0, FIRST_TOUCH_EXPONENTS) - 16.0 / 3.0).abs() < 1e-14);
        assert!((work_by_power(2.0, 0.25, 4.0, SEPARATION_EXPONENTS) - 4.0).abs() < 1e-14);
    }
}
