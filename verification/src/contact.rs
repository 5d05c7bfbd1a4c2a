//! Frictionless elastic contact of a half space of reduced modulus E* = E/(1 - ν²) at small slope.

use std::f64::consts::PI;

/// Force of a sphere of radius `radius` (or on a rounded summit) at `depth`: F = (4/3) E* √R h^(3/2).
///
/// K. L. Johnson, Contact Mechanics (1985), eq. (4.23).
pub fn hertz_force(reduced_modulus: f64, radius: f64, depth: f64) -> f64 {
    4.0 / 3.0 * reduced_modulus * radius.sqrt() * depth.powf(1.5)
}

/// Contact radius of the sphere at `depth`: a = √(R h). Johnson (1985), eq. (4.22).
pub fn hertz_radius(radius: f64, depth: f64) -> f64 {
    (radius * depth).sqrt()
}

/// Force of a cone whose flank makes an angle with the plane of tangent `tan_slope`: F = (2/π) E* h²/tan β.
///
/// I. N. Sneddon, Int. J. Engng Sci. 3 (1965) 47; A. E. H. Love, Q. J. Math. 10 (1939) 161.
pub fn cone_force(reduced_modulus: f64, tan_slope: f64, depth: f64) -> f64 {
    2.0 / PI * reduced_modulus * depth * depth / tan_slope
}

/// Contact radius of the cone at `depth`: a = 2h/(π tan β). Sneddon (1965).
pub fn cone_radius(tan_slope: f64, depth: f64) -> f64 {
    2.0 * depth / (PI * tan_slope)
}

/// dF/dh of any axisymmetric contact of radius `radius` kept while the tool moves: 2 E* a. Johnson (1985), eq. (6.35).
pub fn punch_stiffness(reduced_modulus: f64, radius: f64) -> f64 {
    2.0 * reduced_modulus * radius
}

#[cfg(test)]
mod tests {
    use super::*;

    /// dF/dh = 2 E* a for every axisymmetric elastic contact (Pharr, Oliver, Brotzen 1992), so force and radius of
    /// each closed form must agree in it.
    #[test]
    fn force_and_radius_of_each_form_belong_together() {
        let (e, h, d) = (1.3, 0.2, 1e-5);
        let slope = |force: &dyn Fn(f64) -> f64| (force(h + d) - force(h - d)) / (2.0 * d);
        let hertz = slope(&|h| hertz_force(e, 7.0, h));
        assert!((hertz / punch_stiffness(e, hertz_radius(7.0, h)) - 1.0).abs() < 1e-9);
        let cone = slope(&|h| cone_force(e, 0.1, h));
        assert!((cone / punch_stiffness(e, cone_radius(0.1, h)) - 1.0).abs() < 1e-9);
    }
}
