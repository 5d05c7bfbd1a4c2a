//! Estimates before a crush is computed: contact widths, pressure, depth under a force. None of it stands in
//! a result: the mesh is made for it and the penalty scaled with it.

use crate::contact::tool::Tool;
use crate::point::kinematics::Symmetry;
use crate::point::material::Metal;
use crate::run::curve::COUNTS_FROM;
use asperity_mesh::profile::{Asperity, Profile, Shape};
use std::f64::consts::FRAC_2_PI;

/// Contact half width of a crushed asperity over the half width of the cut at the same depth: 0.64 (elastic cone,
/// 2/π) to 1.06 (perfectly plastic), 0.89 for the single asperity.
const SPREAD: f64 = 0.9;

/// Contact half widths at `depth` below the highest summit.
pub fn half_widths(profile: &Profile, tool: &Tool, depth: f64) -> Vec<f64> {
    let mirrored = tool.mirrored();
    if let (Some(mirrored), true) = (&mirrored, profile.asperities.is_empty()) {
        return vec![SPREAD * mirrored.half_width(depth)];
    }
    let top = profile.height();
    let width = |a: &Asperity| {
        // a curved tool lies higher over the asperities beside the one that it comes down on
        let below = top - a.height + mirrored.as_ref().map_or(0.0, |m| m.drop(a.centre));
        SPREAD * half_width_under(a, mirrored.as_ref(), (depth - below).max(0.0))
    };
    profile.asperities.iter().map(width).collect()
}

/// Relative change of slope up to which a measured flank is straight.
const STRAIGHT: f64 = 0.1;

/// Half width over which the outlines of `asperity` and of the tool above it overlap at `depth`.
fn half_width_under(asperity: &Asperity, mirrored: Option<&Asperity>, depth: f64) -> f64 {
    let Some(tool) = mirrored else { return asperity.half_width(depth) };
    let (mut low, mut high) = (0.0, asperity.half_width(depth).min(tool.half_width(depth)));
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        // of an outline that is not symmetric, on the side where the two overlap further
        let drop = asperity.drop(middle).min(asperity.drop(-middle));
        if drop + tool.drop(middle) < depth {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Share of the contact half width at `reach`, for which the mesh is made, from which the contact must be resolved: the half
/// width at the depth from which the error of the force is promised, a share of `depth`. Under a flank that is the share of
/// the depth, whatever the tip that was crushed before; under a tip that is still round there it is larger, and the same
/// elements lie closer.
pub fn resolved_from(profile: &Profile, tool: &Tool, depth: f64, reach: f64) -> f64 {
    let first = COUNTS_FROM * depth;
    let highest = profile.asperities.iter().max_by(|a, b| a.height.total_cmp(&b.height));
    let tool = tool.mirrored();
    if let (Some(tool), Some(asperity)) = (&tool, highest) {
        let under = |depth: f64| half_width_under(asperity, Some(tool), depth);
        return under(first) / under(reach);
    }
    let Some(outline) = tool.as_ref().or(highest) else { return first / reach };
    let half_width = outline.half_width(first);
    let under_a_flank = match &outline.shape {
        Shape::Cone { .. } => half_width >= outline.cap_radius(),
        Shape::Sphere { .. } => false,
        Shape::Measured(_) => {
            let slope = |depth: f64| outline.slope_at(outline.half_width(depth));
            (slope(first) / slope(reach) - 1.0).abs() < STRAIGHT
        }
    };
    if under_a_flank { first / reach } else { half_width / outline.half_width(reach) }
}

/// Mean contact pressure to be expected at `depth`, in units of E: ½E* tan β of the elastic cone and 2.8 σ_r of full
/// plasticity (ε_r ≈ 0.1 tan β), joined harmonically. Only the penalty is scaled with it.
pub fn expected_pressure(metal: &Metal, profile: &Profile, tool: &Tool, depth: f64) -> f64 {
    let slope_of = |a: &Asperity| a.slope_at(SPREAD * a.half_width(depth));
    let slope = tool.mirrored().iter().chain(&profile.asperities).map(slope_of).fold(0.0, f64::max);
    let elastic = 0.5 * metal.elastic.reduced_modulus() * slope;
    match &metal.hardening {
        None => elastic,
        Some(h) => 1.0 / (1.0 / elastic + 1.0 / (2.8 * h.representative_stress(0.1 * slope))),
    }
}

/// Share of the depth 1 that indents a body in plane strain: the rest compresses it down to the depth `size`, where it is held, by
/// 2F/(πE*) ln(size/a) (Johnson 1985, section 2.3), of an elastic wedge most of the depth.
pub fn share_of_contact(metal: &Metal, profile: &Profile, tool: &Tool, size: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        let half_width = half_widths(profile, tool, middle).into_iter().fold(0.0, f64::max);
        let force = 2.0 * half_width * expected_pressure(metal, profile, tool, middle);
        let compressed =
            FRAC_2_PI * force / metal.elastic.reduced_modulus() * (size / half_width).ln().max(0.0);
        if middle + compressed < 1.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// a tan β/h to be expected of a sharp cone of the slope `tan`: 2/π of an elastic one, up to 1.08 - 0.6 n of a fully plastic one,
/// more where material piles up against a steep tool that `indents`, joined in X = E* tan β/σ_r (read off forty cones, within
/// 0.1). Only the mesh is laid out with it.
pub fn contact_ratio(metal: &Metal, tan: f64, indents: bool) -> f64 {
    let Some(hardening) = &metal.hardening else { return FRAC_2_PI };
    let exponent = hardening.exponent(metal.elastic.youngs_modulus);
    let x = metal.elastic.reduced_modulus() * tan / hardening.representative_stress(0.1 * tan);
    let pile_up = if indents { 0.3 * (1.0 - exponent) * tan } else { 0.0 };
    let plastic = 1.08 - 0.6 * exponent + pile_up;
    FRAC_2_PI + (plastic - FRAC_2_PI) * (x / (x + 6.0)).powi(2)
}

/// Depth per force that a clamped substrate of this size takes away from an elastic half space: 0.39/(E* size), its depth and its
/// radius alike. Measured from sizes of 25 to 800 contact radii: 0.387 under cones, 0.394 under balls, 0.37 to 0.40 on
/// crushed cones.
pub fn far_field(metal: &Metal, size: f64) -> f64 {
    0.39 / (metal.elastic.reduced_modulus() * size)
}

/// Depth (m) at which the expected pressure over the cut area carries `force` (N, or N/m in plane strain).
pub fn expected_depth(
    metal: &Metal,
    modulus: f64,
    symmetry: Symmetry,
    profile: &Profile,
    tool: &Tool,
    force: f64,
) -> f64 {
    let carried = |depth: f64| {
        let pressure = modulus * expected_pressure(metal, profile, tool, depth);
        let area: f64 = half_widths(profile, tool, depth)
            .iter()
            .zip(std::iter::once(0.0).chain(profile.asperities.iter().skip(1).map(|a| a.centre)))
            .map(|(w, centre)| match symmetry {
                Symmetry::PlaneStrain => 2.0 * w,
                Symmetry::Axisymmetric if centre == 0.0 => std::f64::consts::PI * w * w,
                Symmetry::Axisymmetric => 4.0 * std::f64::consts::PI * centre * w,
            })
            .sum();
        pressure * area
    };
    // the carried force grows with the depth: bisection in the logarithm over any physical size
    let (mut low, mut high) = (1e-15_f64.ln(), 1e6_f64.ln());
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if carried(middle.exp()) < force {
            low = middle;
        } else {
            high = middle;
        }
    }
    (0.5 * (low + high)).exp()
}
