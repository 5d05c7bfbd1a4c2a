//! The elastic slip that an edge of the surface keeps, and the law of friction.

/// The law of the traction along the tool.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Friction {
    /// At most this share of the pressure.
    Coulomb(f64),
    /// A point that touches sticks.
    Sticking,
}

impl Friction {
    /// True where a traction is below its limit under this pressure.
    pub(crate) fn sticks(self, traction: f64, pressure: f64) -> bool {
        match self {
            Friction::Coulomb(coefficient) => traction.abs() < (1.0 - 1e-9) * coefficient * pressure,
            Friction::Sticking => true,
        }
    }
}

/// Places of an edge, evenly over -1 ≤ ξ ≤ 1, that keep its elastic slip: corners and mid-side are among
/// them.
pub const SLIP_PLACES: usize = 9;

/// Elastic slip at the places of an edge.
pub type EdgeSlip = [f64; SLIP_PLACES];

/// The friction of an increment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rubbing {
    /// The law.
    pub friction: Friction,
    /// Height of the tool's lowest point at the converged state.
    pub tip_before: f64,
    /// True where what touches sticks whatever its law: an infinitesimal unloading.
    pub holds: bool,
}

/// Coordinate ξ of a place of an edge.
pub(super) fn coordinate(place: usize) -> f64 {
    2.0 * place as f64 / (SLIP_PLACES - 1) as f64 - 1.0
}

/// Elastic slip at ξ, straight between the places.
pub(super) fn slip_between(slip: &EdgeSlip, xi: f64) -> f64 {
    let along = 0.5 * (xi + 1.0) * (SLIP_PLACES - 1) as f64;
    let place = (along.max(0.0) as usize).min(SLIP_PLACES - 2);
    let share = along - place as f64;
    slip[place] + share * (slip[place + 1] - slip[place])
}
