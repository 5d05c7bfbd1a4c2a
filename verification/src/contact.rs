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

/// dF/dh of any axisymmetric contact of radius `radius` kept while the tool moves: 2 E* a. Johnson (1985),
/// eq. (6.35).
pub fn punch_stiffness(reduced_modulus: f64, radius: f64) -> f64 {
    2.0 * reduced_modulus * radius
}

/// A sphere of metal that does not harden, flattened by a frictionless rigid plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flattened {
    /// Radius R.
    pub radius: f64,
    /// E* = E/(1 - ν²).
    pub reduced_modulus: f64,
    /// Poisson's ratio ν.
    pub poissons_ratio: f64,
    /// Yield stress S.
    pub yield_stress: f64,
}

impl Flattened {
    /// Depth of first yield below the surface, ω_c = (π C S/(2E*))² R with C = 1.295 e^(0.736 ν).
    pub fn critical_depth(&self) -> f64 {
        let c = self.strength() * self.yield_stress;
        (PI * c / (2.0 * self.reduced_modulus)).powi(2) * self.radius
    }

    fn strength(&self) -> f64 {
        1.295 * (0.736 * self.poissons_ratio).exp()
    }

    /// Force and contact area at `depth` above 1.9 ω_c.
    ///
    /// R. L. Jackson, I. Green, J. Tribol. 127 (2005) 343: fits to finite elements, 1.9 < ω/ω_c < 3000, a/R <
    /// 0.41.
    pub fn jackson_green(&self, depth: f64) -> (f64, f64) {
        let (critical, strain) = (self.critical_depth(), self.yield_stress / self.reduced_modulus);
        let w = depth / critical;
        let exponent = 0.14 * (23.0 * strain).exp();
        let area = PI * self.radius * critical * w * (w / 1.9).powf(exponent);
        let spread = (area / PI).sqrt() / self.radius;
        let hardness = 2.84 * (1.0 - (-0.82 * spread.powf(-0.7)).exp());
        let elastic = (-0.25 * w.powf(5.0 / 12.0)).exp() * w.powf(1.5);
        let plastic = 4.0 * hardness / self.strength() * (1.0 - (-0.04 * w.powf(5.0 / 9.0)).exp()) * w;
        (hertz_force(self.reduced_modulus, self.radius, critical) * (elastic + plastic), area)
    }

    /// Force and contact area at `depth` from 1 to 110 ω_c.
    ///
    /// L. Kogut, I. Etsion, J. Appl. Mech. 69 (2002) 657: fits to finite elements in two pieces.
    pub fn kogut_etsion(&self, depth: f64) -> (f64, f64) {
        let factor = 0.454 + 0.41 * self.poissons_ratio;
        let strain = 2.8 * self.yield_stress / self.reduced_modulus; // H over their E, that of the pair
        let critical = (0.5 * PI * factor * strain).powi(2) * self.radius;
        let w = depth / critical;
        let (force, area) = if w < 6.0 {
            (1.03 * w.powf(1.425), 0.93 * w.powf(1.136))
        } else {
            (1.40 * w.powf(1.263), 0.94 * w.powf(1.146))
        };
        (hertz_force(self.reduced_modulus, self.radius, critical) * force, PI * self.radius * critical * area)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values of the two fits at S/E* = 1.3e-3, ν = 0.3, computed apart: P/P_c, A/A_c at six depths; the
    /// critical depths are 1.0876e-5 R and 1.0884e-5 R.
    #[test]
    fn fits_of_flattened_spheres_have_their_values() {
        let ball = Flattened { radius: 1.0, reduced_modulus: 1.0, poissons_ratio: 0.3, yield_stress: 1.3e-3 };
        assert!((ball.critical_depth() / 1.0876e-5 - 1.0).abs() < 1e-4);
        let (force, area) = (hertz_force(1.0, 1.0, ball.critical_depth()), PI * ball.critical_depth());
        for (w, f, a) in [
            (2.0, 2.829, 2.015),
            (6.0, 13.00, 7.08),
            (10.0, 25.89, 12.71),
            (50.0, 202.9, 80.1),
            (110.0, 520.8, 197.5),
            (200.0, 1036.7, 391.5),
        ] {
            let found = ball.jackson_green(w * ball.critical_depth());
            assert!((found.0 / force / f - 1.0).abs() < 1e-3, "{w} {found:?}");
            assert!((found.1 / area / a - 1.0).abs() < 1e-3, "{w} {found:?}");
        }
        for (w, f) in [(10.0, 25.65), (50.0, 195.9), (110.0, 530.2)] {
            let critical = 1.0884e-5;
            let found = ball.kogut_etsion(w * critical).0 / hertz_force(1.0, 1.0, critical);
            assert!((found / f - 1.0).abs() < 1e-3, "{w} {found}");
        }
    }

    /// dF/dh = 2 E* a for every axisymmetric elastic contact (Pharr, Oliver, Brotzen 1992), so force and
    /// radius of each closed form must agree in it.
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
