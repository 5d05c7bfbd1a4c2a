//! Claims of a limit of pressure: the error of one that the finite elements give covers the slope of the
//! patches, and the flow that it makes lowers the surface by what is said.
#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

use asperity_material::HardeningLaw;
use asperity_material::units::Stress;
use asperity_roughness::half_space::{HalfSpace, PressureLimit};
use asperity_roughness::{Grid, Kind, Load, Material, Surface, Target, generate};

/// The slope is known to a tenth, the table of the cones to a hundredth.
#[test]
fn a_limit_is_uncertain_by_that_of_steeper_patches() {
    let metal = Material {
        youngs_modulus: Stress(210e9),
        poissons_ratio: 0.3,
        hardness: None,
        hardness_error: None,
        yield_stress: Some(Stress(300e6)),
        hardening_exponent: Some(0.3),
        hardening_law: None,
    };
    for tan in [0.08, 0.15, 0.25] {
        let at = |tan: f64| PressureLimit::at_slope(&metal, HardeningLaw::Hollomon, tan).unwrap();
        let steeper = at(1.1 * tan).pressure / at(tan).pressure - 1.0;
        let table = (at(tan).error.powi(2) - steeper.powi(2)).sqrt();
        assert!(steeper > 0.02 && table < 0.01, "{tan}: {steeper} {table} {}", at(tan).error);
    }
}

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
