//! A smooth exact solution of linear elasticity in plane strain without body forces.

/// Displacement (x, z) of the potentials φ(ζ) = ψ(ζ) = e^ζ, ζ = x + iz: 2G(u + iw) = κφ - ζ φ̄' - ψ̄, κ = 3 -
/// 4ν.
///
/// N. I. Muskhelishvili, Some Basic Problems of the Mathematical Theory of Elasticity (1953), §32. It has
/// shear, dilatation and rotation everywhere.
pub fn displacement(shear_modulus: f64, poissons_ratio: f64, [x, z]: [f64; 2]) -> [f64; 2] {
    let kappa = 3.0 - 4.0 * poissons_ratio;
    let (re, im) = (x.exp() * z.cos(), x.exp() * z.sin());
    // conjugate of φ' = e^ζ times ζ
    let (tr, ti) = (x * re + z * im, z * re - x * im);
    let scale = 0.5 / shear_modulus;
    [scale * (kappa * re - tr - re), scale * (kappa * im - ti + im)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Navier's equation (λ + G) ∇ div u + G ∇² u = 0 by central differences (step 1e-3: error about 1e-6).
    #[test]
    fn satisfies_naviers_equation() {
        let (g, nu) = (0.7, 0.3);
        let lambda = 2.0 * g * nu / (1.0 - 2.0 * nu);
        let d = 1e-3;
        let u = |x: f64, z: f64| displacement(g, nu, [x, z]);
        for [x, z] in [[0.3, 0.2], [0.9, -0.4]] {
            let here = u(x, z);
            let [xx, zz] = [0, 1].map(|i| {
                [
                    (u(x + d, z)[i] - 2.0 * here[i] + u(x - d, z)[i]) / (d * d),
                    (u(x, z + d)[i] - 2.0 * here[i] + u(x, z - d)[i]) / (d * d),
                ]
            });
            let mixed = [0, 1].map(|i| {
                (u(x + d, z + d)[i] - u(x + d, z - d)[i] - u(x - d, z + d)[i] + u(x - d, z - d)[i])
                    / (4.0 * d * d)
            });
            let first = (lambda + g) * (xx[0] + mixed[1]) + g * (xx[0] + xx[1]);
            let second = (lambda + g) * (mixed[0] + zz[1]) + g * (zz[0] + zz[1]);
            assert!(first.abs() < 1e-5 && second.abs() < 1e-5, "{first} {second}");
        }
    }
}
