//! The evaluation of an indentation by an instrument that knows no contact area.
//!
//! W. C. Oliver, G. M. Pharr, J. Mater. Res. 7 (1992) 1564 and 19 (2004) 3: from force F, depth h and
//! stiffness S at the peak, with the area function A of the tool,
//!   h_c = h - ε F/S,   H = F/A(h_c),   E_r = (√π/2) S/√A(h_c).
//! ε is that of the tool's shape, 2(π - 2)/π for a cone and 3/4 for a paraboloid, with which all three are
//! exact for an elastic body. Metal that piles up around the tool makes the true area larger than A(h_c):
//! hence both are given.

use crate::record::rows::{OliverPharr, Summary};
use crate::scene::AreaFunction;
use crate::setup::problem::Problem;
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::kinematics::Symmetry;
use std::f64::consts::{FRAC_2_PI, PI};

/// The peak of an indentation, any consistent units.
struct Peak {
    force: f64,
    depth: f64,
    /// Slope S = dF/dh of the unloading curve at the peak.
    stiffness: f64,
}

/// ε of a tool that is in contact up to about `height` above its apex; `None` for a plane, which has no tip
/// from which a contact depth could count.
///
/// An outline that rises with r^n has ε = (1 + 1/n)(1 - Γ((n + 1)/2)/(√π Γ(n/2 + 1))) (Sneddon 1965), nearly
/// linear in n between the cone's and the paraboloid's (within 0.001).
fn geometry_factor(tool: &Tool, height: f64) -> Option<f64> {
    let (cone, paraboloid) = (2.0 - 2.0 * FRAC_2_PI, 0.75);
    match tool {
        Tool::Plane => None,
        Tool::Cone { .. } => Some(cone),
        Tool::Sphere { .. } => Some(paraboloid),
        Tool::Measured(outline) => {
            let r = outline.widths(height)[1];
            let [rise, slope] = outline.drop_and_slope(r);
            let exponent = (r * slope / rise).clamp(1.0, 2.0);
            Some(cone + (exponent - 1.0) * (paraboloid - cone))
        }
        Tool::Own(tool) => Some(cone + (tool.power(height) - 1.0) * (paraboloid - cone)),
    }
}

/// The readings of an instrument, in the units of the peak.
struct Reading {
    epsilon: f64,
    contact_depth: f64,
    contact_area: f64,
    hardness: f64,
    reduced_modulus: f64,
}

/// Evaluates `peak` of a tool of revolution with the area function `area`. `None` for a plane, or if nothing
/// is left of the depth or the area.
fn read(tool: &Tool, area: impl Fn(f64) -> f64, peak: &Peak) -> Option<Reading> {
    let epsilon = geometry_factor(tool, peak.depth)?;
    let contact_depth = peak.depth - epsilon * peak.force / peak.stiffness;
    if !(contact_depth > 0.0 && contact_depth.is_finite()) {
        return None;
    }
    let contact_area = area(contact_depth);
    if !(contact_area > 0.0 && contact_area.is_finite()) {
        return None;
    }
    Some(Reading {
        epsilon,
        contact_depth,
        contact_area,
        hardness: peak.force / contact_area,
        reduced_modulus: 0.5 * PI.sqrt() * peak.stiffness / contact_area.sqrt(),
    })
}

/// The peak of a run that was unloaded, in SI, as an instrument evaluates it that knows force, depth and
/// stiffness; by the `area` function of its calibration, or that of the tool's outline.
pub fn as_an_instrument(
    problem: &Problem,
    area: Option<&AreaFunction>,
    summary: &Summary,
) -> Option<OliverPharr> {
    let (tool, u) = (&problem.tool, problem.units);
    let mirrored = tool.mirrored().filter(|_| problem.symmetry == Symmetry::Axisymmetric)?;
    let stiffness = summary.unloading_stiffness.filter(|_| summary.residual_depth.is_some())?;
    let force = summary.peak_force / u.force;
    // the method knows the machine's frame and takes it off
    let frame = problem.rules.compliance.machine;
    let stiffness = stiffness * u.length / u.force;
    let peak = Peak {
        force,
        depth: summary.peak_depth / u.length - frame * force,
        stiffness: if frame > 0.0 { (stiffness.recip() - frame).recip() } else { stiffness },
    };
    let area_at = |height: f64| {
        let outline = || PI * mirrored.half_width(height).powi(2);
        area.map_or_else(outline, |area| area.area(height * u.length) / u.area)
    };
    let read = read(tool, area_at, &peak)?;
    Some(OliverPharr {
        contact_area: read.contact_area * u.area,
        contact_depth: read.contact_depth * u.length,
        epsilon: read.epsilon,
        hardness: read.hardness * u.stress,
        reduced_modulus: read.reduced_modulus * u.stress,
        true_contact_area: summary.contact_area,
        true_hardness: summary.peak_force / summary.contact_area,
        true_reduced_modulus: problem.reduced_modulus() * u.stress,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sneddon's cone, F = (2/π) E* h²/tan β, a = 2h/(π tan β); Hertz's paraboloid, F = (4/3) E* √R h^1.5, a²
    /// = R h.
    #[test]
    fn elastic_indentations_give_their_own_area_and_modulus() {
        let (modulus, h) = (1.7, 0.3);
        let (tan_slope, radius): (f64, f64) = (0.1, 9.0);
        let cone = Tool::Cone { tan_slope, tip_radius: 0.0 };
        let stiffness = 2.0 * FRAC_2_PI * modulus * h / tan_slope;
        let peak = Peak { force: 0.5 * stiffness * h, depth: h, stiffness };
        let found = read(&cone, |z| PI * (z / tan_slope).powi(2), &peak).unwrap();
        let area = PI * (FRAC_2_PI * h / tan_slope).powi(2);
        assert!((found.contact_area / area - 1.0).abs() < 1e-14);
        assert!((found.reduced_modulus / modulus - 1.0).abs() < 1e-14);

        let stiffness = 2.0 * modulus * (radius * h).sqrt();
        let peak = Peak { force: stiffness * h / 1.5, depth: h, stiffness };
        let found = read(&Tool::Sphere { radius }, |z| PI * 2.0 * radius * z, &peak).unwrap();
        assert!((found.contact_area / (PI * radius * h) - 1.0).abs() < 1e-14);
        assert!((found.reduced_modulus / modulus - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_plane_and_a_soft_contact_have_no_contact_depth() {
        let peak = Peak { force: 1.0, depth: 0.1, stiffness: 1.0 };
        assert!(read(&Tool::Plane, |z| z, &peak).is_none());
        assert!(read(&Tool::Sphere { radius: 1.0 }, |z| z, &peak).is_none());
    }
}
