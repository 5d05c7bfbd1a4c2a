//! The evaluation of an indentation by an instrument that knows no contact area.
//!
//! W. C. Oliver, G. M. Pharr, J. Mater. Res. 7 (1992) 1564 and 19 (2004) 3: from force F, depth h and
//! stiffness S at the peak, with the area function A of the tool,
//!   h_c = h - ε F/S,   H = F/A(h_c),   E_r = (√π/2) S/√A(h_c).
//! ε is that of the tool's outline up to h_c: with Sneddon's solution for a tool of revolution (Int. J. Engng
//! Sci. 3 (1965) 47) all three are exact for an elastic body. It is 2(π - 2)/π for a cone and 3/4 for a
//! paraboloid, and between the two for a cone that is in contact beyond its rounded tip. Metal that piles up
//! around the tool makes the true area larger than A(h_c): hence both are given.

use crate::record::rows::{OliverPharr, Summary};
use crate::scene::AreaFunction;
use crate::setup::problem::Problem;
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::kinematics::Symmetry;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI};

/// ε of a paraboloid.
const PARABOLOID: f64 = 0.75;

/// The peak of an indentation, any consistent units.
struct Peak {
    force: f64,
    depth: f64,
    /// Slope S = dF/dh of the unloading curve at the peak.
    stiffness: f64,
}

/// Places at which the slope of an outline is asked for.
const PLACES: usize = 512;

/// Range of ε of all outlines: from a cusp to the flat end of a punch.
const SENSIBLE: [f64; 2] = [0.5, 1.0];

/// Tries until ε belongs to the contact depth that it leads to; a few are enough.
const TRIES: usize = 40;

/// ε of an outline of rise and slope `outline(r)` in contact up to the radius `a`.
///
/// Sneddon's elastic contact has, with r = a sin t over a quarter turn and the slope f',
///   h = a ∫ f' dt,   F = 2E* ∫ r² f' dt,   S = 2E* a,
/// and ε = (h - f(a)) S/F. The midpoint rule leaves 1e-5 of it where the slope jumps.
fn factor_of_outline(outline: impl Fn(f64) -> [f64; 2], a: f64) -> f64 {
    let step = FRAC_PI_2 / PLACES as f64;
    let (mut depth, mut force) = (0.0, 0.0);
    for place in 0..PLACES {
        let r = a * ((place as f64 + 0.5) * step).sin();
        let [_, slope] = outline(r);
        depth += a * slope * step;
        force += r * r * slope * step;
    }
    (a * (depth - outline(a)[0]) / force).clamp(SENSIBLE[0], SENSIBLE[1])
}

/// ε of a tool that is in contact up to `height` above its apex; `None` for a plane, which has no tip from
/// which a contact depth could count.
///
/// A ball, and the rounded tip of a cone, is taken for the paraboloid, which joins the flank of the cone
/// where the ball does.
fn geometry_factor(tool: &Tool, height: f64) -> Option<f64> {
    let cone = 2.0 - 2.0 * FRAC_2_PI;
    let radius = tool.mirrored()?.half_width(height);
    Some(match tool {
        Tool::Plane => return None,
        Tool::Sphere { .. } => PARABOLOID,
        Tool::Cone { tip_radius, .. } if *tip_radius <= 0.0 => cone,
        &Tool::Cone { tan_slope, tip_radius } => {
            let join = tip_radius * tan_slope / tan_slope.hypot(1.0);
            let rounded = |r: f64| {
                let within = r.min(join);
                [tan_slope * (r - within + 0.5 * within * within / join), tan_slope * within / join]
            };
            if radius <= join { PARABOLOID } else { factor_of_outline(rounded, radius) }
        }
        Tool::Measured(outline) => factor_of_outline(|r| outline.drop_and_slope(r), radius),
        Tool::Own(tool) => factor_of_outline(|r| [tool.rise(r), tool.slope(r)], radius),
    })
    .filter(|factor| factor.is_finite())
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
    let depth_of = |epsilon: f64| peak.depth - epsilon * peak.force / peak.stiffness;
    let mut epsilon = geometry_factor(tool, peak.depth)?;
    for _ in 0..TRIES {
        let next = geometry_factor(tool, depth_of(epsilon)).unwrap_or(epsilon);
        if next == epsilon {
            break;
        }
        epsilon = next;
    }
    let contact_depth = depth_of(epsilon);
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

    /// Sneddon's contact of a rounded cone: with r = a sin t, b the radius where the tip ends and s = a/b,
    /// tan β = b = 1: h = s [s (1 - cos α) + π/2 - α] and F = 2E* {s³ (cos³α/3 - cos α + 2/3) + s² [(π/2 -
    /// α)/2 + sin 2α/4]}, sin α = 1/s. Before the tip ends it is a ball, far beyond it a cone.
    #[test]
    fn an_elastic_contact_on_a_rounded_tip_gives_its_own_area_and_modulus() {
        let (modulus, tan_slope) = (1.7, 0.01_f64);
        let join = 40.0 * tan_slope / tan_slope.hypot(1.0);
        let tool = Tool::Cone { tan_slope, tip_radius: 40.0 };
        for s in [1.0_f64, 1.1, 1.5, 3.0, 20.0] {
            let alpha = s.recip().asin();
            let (cos, rest) = (alpha.cos(), FRAC_PI_2 - alpha);
            let h = s * (s * (1.0 - cos) + rest) * tan_slope * join;
            let force = s.powi(3) * (cos.powi(3) / 3.0 - cos + 2.0 / 3.0)
                + s * s * (0.5 * rest + 0.25 * (2.0 * alpha).sin());
            let peak = Peak {
                force: 2.0 * modulus * force * tan_slope * join * join,
                depth: h,
                stiffness: 2.0 * modulus * s * join,
            };
            let outline = |z: f64| PI * tool.mirrored().unwrap().half_width(z).powi(2);
            let found = read(&tool, outline, &peak).unwrap();
            // the tip is a circle, which differs from the parabola by tan²β/4
            assert!((found.contact_area / (PI * (s * join).powi(2)) - 1.0).abs() < 2e-4, "{s}");
            assert!((found.reduced_modulus / modulus - 1.0).abs() < 1e-4, "{s}");
        }
    }

    #[test]
    fn a_contact_on_the_tip_of_a_cone_is_read_as_that_of_the_ball() {
        let (h, radius) = (0.1, 9.0_f64);
        let peak =
            Peak { force: 1.7 * h * (radius * h).sqrt(), depth: h, stiffness: 2.5 * (radius * h).sqrt() };
        let read_as =
            |tool: Tool| read(&tool, |z| PI * tool.mirrored().unwrap().half_width(z).powi(2), &peak).unwrap();
        let ball = read_as(Tool::Sphere { radius });
        let tip = read_as(Tool::Cone { tan_slope: 1.0, tip_radius: radius });
        assert_eq!((ball.epsilon, ball.contact_area), (tip.epsilon, tip.contact_area));
        assert_eq!(ball.reduced_modulus, tip.reduced_modulus);
    }

    #[test]
    fn a_plane_and_a_soft_contact_have_no_contact_depth() {
        let peak = Peak { force: 1.0, depth: 0.1, stiffness: 1.0 };
        assert!(read(&Tool::Plane, |z| z, &peak).is_none());
        assert!(read(&Tool::Sphere { radius: 1.0 }, |z| z, &peak).is_none());
    }
}
