//! Simple shear x = X + γ Z of a Hencky solid, volume kept.

/// Shear stress τ_xz = 2G asinh(γ/2)/√(1 + γ²/4).
///
/// ln V has the principal values ± asinh(γ/2), in directions turned by ½ atan(2/γ) from x. It grows to
/// 1.325487 G at γ = 3.01776 and falls slowly afterwards. Source: A. Hoger, Int. J. Solids Struct. 23 (1987)
/// 1645 (Hencky solids).
pub fn shear_stress(shear_modulus: f64, gamma: f64) -> f64 {
    2.0 * shear_modulus * (0.5 * gamma).asinh() / (1.0 + 0.25 * gamma * gamma).sqrt()
}

/// Normal stress along the shear, τ_xx = -τ_zz = τ_xz γ/2.
pub fn normal_stress(shear_modulus: f64, gamma: f64) -> f64 {
    0.5 * gamma * shear_stress(shear_modulus, gamma)
}

/// Energy per volume, 2G asinh²(γ/2).
pub fn energy(shear_modulus: f64, gamma: f64) -> f64 {
    2.0 * shear_modulus * (0.5 * gamma).asinh().powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_at_unit_shear_modulus() {
        for (gamma, stress) in
            [(0.5, 0.480155), (1.0, 0.860818), (2.0, 1.246450), (3.01776, 1.325487), (4.0, 1.291227)]
        {
            assert!((shear_stress(1.0, gamma) - stress).abs() < 1e-6);
        }
    }

    /// Shear stress is the derivative of the energy with respect to γ (the volume is kept).
    #[test]
    fn stress_is_the_slope_of_the_energy() {
        let d = 1e-5;
        for gamma in [0.1, 1.0, 3.5] {
            let slope = (energy(1.0, gamma + d) - energy(1.0, gamma - d)) / (2.0 * d);
            assert!((slope - shear_stress(1.0, gamma)).abs() < 1e-9);
        }
    }
}
