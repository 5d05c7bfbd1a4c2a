//! Sharp cones of another code.

use asperity_calibration::case::{Case, Tool, Yielding};
use asperity_material::{HardeningLaw, StressMeasure};

/// A cone crushed by a plane with CalculiX 2.20 (quadratic elements with reduced integration), its own load
/// steps extrapolated to zero; ν 0.3, law `swift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Peer {
    /// Slope, degrees.
    pub beta_deg: f64,
    /// Hardening exponent.
    pub exponent: f64,
    /// E/σ_y.
    pub e_over_sy: f64,
    /// K/E = F/(E h²).
    pub k_over_e: f64,
    /// Its relative error.
    pub error: f64,
}

const fn peer(beta_deg: f64, exponent: f64, e_over_sy: f64, k_over_e: f64, error: f64) -> Peer {
    Peer { beta_deg, exponent, e_over_sy, k_over_e, error }
}

/// The ten cones.
pub const PEERS: [Peer; 10] = [
    peer(3.0, 0.0, 100.0, 11.39, 0.005),
    peer(3.0, 0.1, 1000.0, 4.081, 0.004),
    peer(3.0, 0.3, 300.0, 8.747, 0.003),
    peer(3.0, 0.5, 1000.0, 6.536, 0.003),
    peer(6.0, 0.1, 300.0, 2.766, 0.007),
    peer(6.0, 0.5, 1000.0, 2.511, 0.004),
    peer(10.0, 0.0, 300.0, 1.078, 0.007),
    peer(10.0, 0.1, 100.0, 2.221, 0.003),
    peer(10.0, 0.3, 300.0, 1.5295, 0.004),
    peer(10.0, 0.5, 1000.0, 1.2126, 0.003),
];

/// A metal by its dimensionless groups.
pub fn metal(law: HardeningLaw, exponent: f64, e_over_sy: f64) -> Yielding {
    Yielding { law, exponent, e_over_sy }
}

/// The case of a peer.
pub fn peer_case(peer: &Peer) -> Case {
    Case {
        beta_deg: peer.beta_deg,
        yielding: Some(metal(HardeningLaw::Swift, peer.exponent, peer.e_over_sy)),
        poissons_ratio: 0.3,
        tool: Tool::Plane,
        stress_measure: StressMeasure::Kirchhoff,
        friction: None,
    }
}
