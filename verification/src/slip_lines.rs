//! Indentation of a rigid, perfectly plastic half-space in plane strain, by fields of slip lines.
//!
//! A wedge whose flank rises by the slope against the surface raises a straight lip. The field is that of
//! Hill, Lee, Tupper, Proc. R. Soc. A 188 (1947), with friction that of Grunzweig, Longman, Petch, J. Mech.
//! Phys. Solids 2 (1954): a triangle under the free lip, a fan of the angle ψ about the edge of contact, and
//! a triangle under the flank, whose slip line leaves the edge at the angle λ to the flank. With the shear
//! yield stress k:
//! * the pressure on the flank is k (1 + 2ψ + sin 2λ), the shear k cos 2λ, which is μ times the pressure, and
//!   k at most, where λ is 0;
//! * the lip is √2 cos λ times as long as the contact on the flank, and leaves the edge at the angle χ = α +
//!   π/4 - λ - ψ to the surface, with α the half angle of the wedge;
//! * the lip holds what the wedge displaces.

use asperity_numerics::bisection::bisect;
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, SQRT_2};

/// Mean pressure over the shear yield stress of a flat punch, smooth or sticking (Prandtl).
pub const STRIP: f64 = 2.0 + PI;

/// Contact of a wedge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wedge {
    /// Force over the width of the contact and over the shear yield stress.
    pub mean_pressure: f64,
    /// Half width of the contact over the depth below the surface.
    pub half_width: f64,
}

/// Halvings of an interval down to the rounding.
const HALVINGS: usize = 60;

/// The angle λ at the flank for a fan of the angle ψ.
fn flank_angle(fan: f64, friction: f64) -> f64 {
    let shear_exceeds = |angle: f64| (2.0 * angle).cos() > friction * (1.0 + 2.0 * fan + (2.0 * angle).sin());
    if shear_exceeds(0.0) { bisect([0.0, FRAC_PI_4], HALVINGS, shear_exceeds)[0] } else { 0.0 }
}

/// Depth over the length of contact on the flank, and the area of the lip less that which is displaced.
fn lip(half_angle: f64, fan: f64, flank: f64) -> [f64; 2] {
    let (length, slope) = (SQRT_2 * flank.cos(), half_angle + FRAC_PI_4 - flank - fan);
    let risen = length * slope.sin();
    let depth = half_angle.cos() - risen;
    let base = half_angle.sin() + length * slope.cos() - depth * half_angle.tan();
    [depth, base * risen - depth * depth * half_angle.tan()]
}

/// A wedge whose flank rises by `slope` (rad), with this coefficient of friction. The lip shrinks as the fan
/// opens; a fan that leaves no lip displaces nothing.
pub fn wedge(slope: f64, friction: f64) -> Wedge {
    let half_angle = FRAC_PI_2 - slope;
    let is_too_much = |fan: f64| {
        let [depth, excess] = lip(half_angle, fan, flank_angle(fan, friction));
        depth <= 0.0 || excess > 0.0
    };
    let fan = bisect([0.0, PI], HALVINGS, is_too_much)[0];
    let flank = flank_angle(fan, friction);
    let [depth, _] = lip(half_angle, fan, flank);
    let pressure = 1.0 + 2.0 * fan + (2.0 * flank).sin();
    Wedge {
        mean_pressure: pressure + (2.0 * flank).cos() / half_angle.tan(),
        half_width: half_angle.sin() / depth,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Smooth: cos(2α - ψ) = cos ψ/(1 + sin ψ) and the pressure 2k (1 + ψ) (Hill 1950, § VIII.2).
    #[test]
    fn a_smooth_wedge_is_that_of_hill_lee_and_tupper() {
        for degrees in [5.0_f64, 20.0, 30.0, 45.0, 70.0] {
            let slope = degrees.to_radians();
            let fan = wedge(slope, 0.0).mean_pressure / 2.0 - 1.0;
            let left = (2.0 * (FRAC_PI_2 - slope) - fan).cos() - fan.cos() / (1.0 + fan.sin());
            assert!(left.abs() < 1e-9, "{degrees}°: {left}");
        }
    }

    /// A flat one is a punch, and friction that exceeds the yield stress sticks.
    #[test]
    fn a_flat_wedge_is_a_punch_and_large_coefficients_stick() {
        assert!((wedge(1e-5, 0.0).mean_pressure / STRIP - 1.0).abs() < 1e-2);
        assert_eq!(wedge(0.5, 0.6), wedge(0.5, 2.0));
        let [smooth, rough] = [0.0, 0.1].map(|friction| wedge(0.5, friction));
        assert!(rough.mean_pressure > smooth.mean_pressure && rough.half_width < smooth.half_width);
    }
}
