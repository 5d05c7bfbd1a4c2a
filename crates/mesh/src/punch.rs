//! A flat punch with a rounded edge.

use crate::tool_outline::{Penetration, ToolOutline};

/// A flat-ended cylinder (block in plane strain) whose edge is a circular arc between the flat end and the
/// upright flank.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Punch {
    /// Radius of the cylinder, m.
    pub radius: f64,
    /// Radius of the arc, m, above 0 and at most `radius`.
    pub edge_radius: f64,
}

/// Slope of the flank where an outline needs a height beyond the punch: as good as upright.
const UPRIGHT: f64 = 1e3;

impl Punch {
    /// Radius of the flat part.
    fn flat(&self) -> f64 {
        self.radius - self.edge_radius
    }
}

impl ToolOutline for Punch {
    fn name(&self) -> &str {
        "punch"
    }

    fn parameters(&self) -> Vec<(&str, f64)> {
        vec![("radius_m", self.radius), ("edge_radius_m", self.edge_radius)]
    }

    fn penetration(&self, [r, z]: [f64; 2]) -> Penetration {
        let (out, up) = (r - self.flat(), z - self.edge_radius);
        if out <= 0.0 {
            return Penetration { depth: z, slope: [0.0, 1.0], curvature: [0.0; 3] };
        }
        if up >= 0.0 {
            return Penetration { depth: self.radius - r, slope: [-1.0, 0.0], curvature: [0.0; 3] };
        }
        let distance = out.hypot(up);
        let (n, m) = (out / distance, up / distance);
        Penetration {
            depth: self.edge_radius - distance,
            slope: [-n, -m],
            curvature: [-(m * m) / distance, -(n * n) / distance, n * m / distance],
        }
    }

    fn rise(&self, r: f64) -> f64 {
        let out = (r - self.flat()).max(0.0);
        if out >= self.edge_radius {
            return self.edge_radius + UPRIGHT * (out - self.edge_radius);
        }
        // ρ - √(ρ² - x²) without cancellation
        out * out / (self.edge_radius + ((self.edge_radius - out) * (self.edge_radius + out)).sqrt())
    }

    fn half_width(&self, height: f64) -> f64 {
        let height = height.clamp(0.0, self.edge_radius);
        self.flat() + (height * (2.0 * self.edge_radius - height)).sqrt()
    }

    fn slope(&self, r: f64) -> f64 {
        let out = (r - self.flat()).max(0.0);
        let up = ((self.edge_radius - out) * (self.edge_radius + out)).max(0.0).sqrt();
        if up > 0.0 { (out / up).min(UPRIGHT) } else { UPRIGHT }
    }

    fn kinks(&self) -> Vec<f64> {
        vec![self.flat(), self.radius]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PUNCH: Punch = Punch { radius: 2.0, edge_radius: 0.5 };

    #[test]
    fn the_outline_is_where_the_penetration_is_zero() {
        for r in [0.0, 1.0, 1.5, 1.6, 1.9, 1.999] {
            let z = PUNCH.rise(r);
            let inside = PUNCH.penetration([r, z]);
            assert!(inside.depth.abs() < 1e-15, "{r} {z}");
            assert!((inside.slope[0] + PUNCH.slope(r) * inside.slope[1]).abs() < 1e-12);
            assert!(r <= 1.5 || (PUNCH.half_width(z) - r).abs() < 1e-12);
        }
        assert_eq!((PUNCH.half_width(0.0), PUNCH.half_width(9.0)), (1.5, 2.0));
        assert_eq!(PUNCH.penetration([2.5, 3.0]).depth, -0.5);
        assert!(PUNCH.rise(2.1) > 50.0);
    }

    #[test]
    fn a_full_arc_is_a_ball() {
        let ball = Punch { radius: 1.0, edge_radius: 1.0 };
        assert!((ball.rise(0.6) - 0.2).abs() < 1e-15 && (ball.half_width(0.2) - 0.6).abs() < 1e-15);
    }
}
