//! A bar of Hencky metal under uniaxial stress or uniaxial strain.

use asperity_material::{Elastic, Hardening};

/// Kirchhoff stress of a bar at the total logarithmic strain `strain` > σ_y/E: eq. (1) of the paper, σ = Eⁿ
/// σ_y^(1-n) εⁿ.
///
/// The strain of eq. (1) is σ/E + ε_p, which in uniaxial stress is the logarithm of the axial stretch.
pub fn hollomon_stress(metal: &Hardening, strain: f64) -> f64 {
    metal.youngs_modulus.powf(metal.exponent)
        * metal.yield_stress.powf(1.0 - metal.exponent)
        * strain.powf(metal.exponent)
}

/// Force over the area before deformation, from the Kirchhoff stress: the work τ dε is (F/A₀) dλ, so F/A₀ =
/// τ/λ.
pub fn nominal_stress(kirchhoff: f64, strain: f64) -> f64 {
    kirchhoff * (-strain).exp()
}

/// Penetration of a frictionless plane into the end of an elastic bar of `height` that the plane has
/// shortened by `travel`, penetration included: the pressure per reference area ε p equals -(E ln λ)/λ of
/// uniaxial stress.
///
/// Newton on the monotone residual; the bar is as wide as it likes.
pub fn penetration(elastic: &Elastic, penalty: f64, height: f64, travel: f64) -> f64 {
    let mut depth = 0.0;
    for _ in 0..50 {
        let stretch = 1.0 - (travel - depth) / height;
        let pressure = -elastic.youngs_modulus * stretch.ln() / stretch;
        let slope = elastic.youngs_modulus * (1.0 - stretch.ln()) / (stretch * stretch * height);
        depth -= (penalty * depth - pressure) / (penalty + slope);
    }
    depth
}

/// Axial Kirchhoff stress of an elastic bar that cannot widen: τ = (K + 4G/3) ln λ.
pub fn confined_stress(elastic: &Elastic, stretch: f64) -> f64 {
    (elastic.bulk_modulus() + 4.0 / 3.0 * elastic.shear_modulus()) * stretch.ln()
}

/// Axial Kirchhoff stress of a perfectly plastic bar that cannot widen, shortened monotonically past yield:
/// τ = K ln λ - ⅔σ_y. (The deviator (-2/3, 1/3, 1/3) σ_y is all that yield leaves.)
pub fn confined_flow_stress(elastic: &Elastic, yield_stress: f64, stretch: f64) -> f64 {
    elastic.bulk_modulus() * stretch.ln() - 2.0 / 3.0 * yield_stress
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_material::HardeningLaw;

    /// E = 210 GPa, σ_y = 300 MPa, n = 0.3: values computed by hand from eq. (1), MPa.
    #[test]
    fn bar_of_equation_1() {
        let steel = Hardening {
            law: HardeningLaw::Hollomon,
            yield_stress: 300.0,
            exponent: 0.3,
            youngs_modulus: 210e3,
        };
        for (strain, kirchhoff, nominal) in
            [(0.002, 331.86, 331.20), (0.01, 537.84, 532.49), (0.1, 1073.13, 971.00), (1.0, 2141.17, 787.69)]
        {
            let stress = hollomon_stress(&steel, strain);
            assert!((stress - kirchhoff).abs() < 0.006, "{stress}");
            assert!((nominal_stress(stress, strain) - nominal).abs() < 0.006);
        }
        // the elastic line meets the curve at first yield
        assert!((hollomon_stress(&steel, 300.0 / 210e3) - 300.0).abs() < 1e-10);
    }

    #[test]
    fn penetration_balances_the_bar() {
        let elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };
        let d = penetration(&elastic, 5.0, 2.0, 0.7);
        let stretch = 1.0 - (0.7 - d) / 2.0;
        assert!((5.0 * d + stretch.ln() / stretch).abs() < 1e-14);
    }

    /// Elastic and plastic branch of the confined bar meet at yield, q = 2G |ln λ| = σ_y.
    #[test]
    fn confined_branches_meet_at_yield() {
        let elastic = Elastic { youngs_modulus: 1.0, poissons_ratio: 0.3 };
        let stretch = (-0.01 / (2.0 * elastic.shear_modulus())).exp();
        let gap = confined_stress(&elastic, stretch) - confined_flow_stress(&elastic, 0.01, stretch);
        assert!(gap.abs() < 1e-15);
    }
}
