//! Thick cylinder (plane strain) and thick sphere under inner pressure, perfectly plastic von Mises metal.
//!
//! R. Hill, The Mathematical Theory of Plasticity (1950), ch. V; numbers of E. A. de Souza Neto, D. Peric,
//! D. R. J. Owen, Computational Methods for Plasticity (2008), examples 7.5.1 and 7.5.2. Exact for the
//! sphere; for the cylinder the axial stress is taken to stay intermediate, which costs a few tenths of a
//! percent.

use asperity_numerics::bisection::bisect;

/// The wall.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Long cylinder that cannot change its length.
    Cylinder,
    /// Sphere.
    Sphere,
}

/// A wall and its metal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThickWall {
    /// Cylinder or sphere.
    pub shape: Shape,
    /// Inner radius a.
    pub inner: f64,
    /// Outer radius b.
    pub outer: f64,
    /// Young's modulus.
    pub youngs_modulus: f64,
    /// Poisson's ratio.
    pub poissons_ratio: f64,
    /// Uniaxial yield stress.
    pub yield_stress: f64,
}

impl ThickWall {
    /// Difference of hoop and radial stress at yield: Y = 2σ_y/√3 in plane strain, σ_y in the sphere.
    fn yield_difference(&self) -> f64 {
        match self.shape {
            Shape::Cylinder => 2.0 * self.yield_stress / 3.0_f64.sqrt(),
            Shape::Sphere => self.yield_stress,
        }
    }

    /// Exponent of 1/r in the elastic stress: 2 and 3.
    fn power(&self) -> i32 {
        match self.shape {
            Shape::Cylinder => 2,
            Shape::Sphere => 3,
        }
    }

    /// Pressure whose plastic front is at radius `front`; at `front` = a that of first yield, at b that of
    /// collapse.
    ///
    /// Cylinder p = Y ln(c/a) + ½Y(1 - c²/b²); sphere p = 2Y ln(c/a) + ⅔Y(1 - c³/b³).
    pub fn pressure(&self, front: f64) -> f64 {
        let (m, y) = (f64::from(self.power()), self.yield_difference());
        (m - 1.0) * y * ((front / self.inner).ln() + (1.0 - (front / self.outer).powi(self.power())) / m)
    }

    /// Plastic front at `pressure` (bisection), a below first yield, b from the limit pressure on.
    pub fn front(&self, pressure: f64) -> f64 {
        let [low, high] = bisect([self.inner, self.outer], 100, |front| self.pressure(front) < pressure);
        0.5 * (low + high)
    }

    /// Displacement of the outer surface at `pressure`.
    ///
    /// Below yield (Lamé): cylinder 2pb(1 - ν²)/(E(b²/a² - 1)), sphere 3pb(1 - ν)/(2E(b³/a³ - 1)). Beyond:
    /// the elastic shell outside the front c carries the yield difference there: Yc²(1 - ν²)/(Eb) and Yc³(1 -
    /// ν)/(Eb²).
    pub fn outer_displacement(&self, pressure: f64) -> f64 {
        let (a, b, e, nu) = (self.inner, self.outer, self.youngs_modulus, self.poissons_ratio);
        let c = self.front(pressure);
        let y = self.yield_difference();
        match (self.shape, pressure < self.pressure(a)) {
            (Shape::Cylinder, true) => 2.0 * pressure * b * (1.0 - nu * nu) / (e * ((b / a).powi(2) - 1.0)),
            (Shape::Sphere, true) => 1.5 * pressure * b * (1.0 - nu) / (e * ((b / a).powi(3) - 1.0)),
            (Shape::Cylinder, false) => y * c * c * (1.0 - nu * nu) / (e * b),
            (Shape::Sphere, false) => y * c * c * c * (1.0 - nu) / (e * b * b),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a = 100 mm, b = 200 mm, E = 210 GPa, ν = 0.3, σ_y = 0.24 GPa.
    fn wall(shape: Shape) -> ThickWall {
        ThickWall {
            shape,
            inner: 100.0,
            outer: 200.0,
            youngs_modulus: 210.0,
            poissons_ratio: 0.3,
            yield_stress: 0.24,
        }
    }

    #[test]
    fn cylinder_and_sphere_have_the_numbers_of_the_book() {
        let cylinder = wall(Shape::Cylinder);
        assert!((cylinder.pressure(100.0) - 0.103923).abs() < 1e-6);
        assert!((cylinder.pressure(200.0) - 0.192091).abs() < 1e-6);
        assert!((cylinder.outer_displacement(0.10) - 0.057778).abs() < 1e-6);
        for (p, c, u) in [(0.14, 120.539, 0.087242), (0.18, 159.785, 0.153301), (0.19, 182.888, 0.200837)] {
            assert!((cylinder.front(p) - c).abs() < 1e-3);
            assert!((cylinder.outer_displacement(p) - u).abs() < 1e-6);
        }
        let sphere = wall(Shape::Sphere);
        assert!((sphere.pressure(100.0) - 0.14).abs() < 1e-12);
        assert!((sphere.pressure(200.0) - 0.332711).abs() < 1e-6);
        for (p, c, u) in [(0.20, 115.993, 0.031212), (0.25, 133.066, 0.047122), (0.33, 187.733, 0.132327)] {
            assert!((sphere.front(p) - c).abs() < 1e-3);
            assert!((sphere.outer_displacement(p) - u).abs() < 1e-6);
        }
    }

    #[test]
    fn displacement_is_continuous_at_first_yield() {
        for shape in [Shape::Cylinder, Shape::Sphere] {
            let wall = wall(shape);
            let p = wall.pressure(wall.inner);
            let (below, above) =
                (wall.outer_displacement(0.999999 * p), wall.outer_displacement(1.000001 * p));
            assert!((below / above - 1.0).abs() < 1e-5);
        }
    }
}
