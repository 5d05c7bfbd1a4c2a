//! Claim: the flow that a limit of pressure makes lowers the surface by what is said.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_roughness::half_space::HalfSpace;
use asperity_roughness::{Grid, Kind, Load, Surface, Target, generate};

#[test]
fn a_flattened_surface_is_lower_by_its_residual_displacement() {
    let grid = Grid { nodes: [64, 64], pixel: [1e-6, 1e-6], seed: 7 };
    let kind = Kind::SelfAffine { hurst: 0.8, rolloff: 40e-6, cutoff: 6e-6 };
    let surface = Surface::from_map(generate(kind, &grid, Target::Height(0.3e-6)).unwrap()).unwrap();
    let pressed = |limit| {
        let body = HalfSpace { reduced_modulus: 2e11, limit, tolerance: 1e-6 };
        let found = body.press(&surface, Load::Pressure(2e8)).unwrap();
        let lower = surface.extent.high - found.flattened_surface(&surface).unwrap().extent.high;
        (found.residual_displacement, lower)
    };
    let (said, lower) = pressed(Some(1e9));
    assert!(said > 1e-8 && (said / lower - 1.0).abs() < 1e-3, "{said} {lower}");
    assert_eq!(pressed(None).0, 0.0);
}
