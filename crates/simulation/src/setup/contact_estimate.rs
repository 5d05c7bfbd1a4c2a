//! Estimates before a crush is computed: contact widths, pressure, depth under a force. None of it stands in
//! a result: the mesh is made for it and the penalty scaled with it.

use asperity_mesh::profile::{Asperity, Profile, Shape};
use asperity_numerics::bisection::bisect;
use asperity_solver::contact::tool::Tool;
use asperity_solver::point::kinematics::Symmetry;
use asperity_solver::point::material::Metal;
use std::f64::consts::{FRAC_2_PI, PI};

/// Contact half width of a crushed asperity over the half width of the cut at the same depth: 0.64 (elastic
/// cone, 2/π) to 1.06 (perfectly plastic), 0.89 for the single asperity.
const CONTACT_WIDTH_RATIO: f64 = 0.9;

/// Contact of a tool and an asperity, or of a curved tool and a flat body.
pub struct Meeting<'p> {
    /// `None`: a flat body.
    asperity: Option<&'p Asperity>,
    mirrored: Option<&'p Asperity>,
    /// Of the contact.
    pub centre: f64,
    /// Depth of the tool at which it begins.
    pub below: f64,
}

impl Meeting<'_> {
    /// Contact half width at the depth `own` below its beginning.
    pub fn half_width(&self, own: f64) -> f64 {
        match (self.asperity, self.mirrored) {
            (Some(asperity), mirrored) => CONTACT_WIDTH_RATIO * half_width_under(asperity, mirrored, own),
            (None, mirrored) => mirrored.map_or(0.0, |tool| CONTACT_WIDTH_RATIO * tool.half_width(own)),
        }
    }

    /// Steepest slope (tangent) of the outlines at the half width of the contact.
    pub fn slope(&self, half_width: f64) -> f64 {
        let outlines = self.mirrored.into_iter().chain(self.asperity);
        outlines.map(|outline| outline.slope_at(half_width)).fold(0.0, f64::max)
    }
}

/// One for each asperity of `profile`, or for a flat body under the curved tool whose outline is `mirrored`.
pub fn meetings<'p>(profile: &'p Profile, mirrored: Option<&'p Asperity>) -> Vec<Meeting<'p>> {
    if profile.asperities.is_empty() {
        return vec![Meeting { asperity: None, mirrored, centre: 0.0, below: 0.0 }];
    }
    let top = profile.height();
    let of = |a: &'p Asperity| Meeting {
        asperity: Some(a),
        mirrored,
        centre: a.centre,
        // a curved tool lies higher over the asperities beside the one that it comes down on
        below: top - a.height + mirrored.map_or(0.0, |m| m.drop(a.centre)),
    };
    profile.asperities.iter().map(of).collect()
}

/// Relative change of slope up to which a flank is straight.
const LARGEST_SLOPE_CHANGE: f64 = 0.1;

/// Half width over which the outlines of `asperity` and of the tool above it overlap at `depth`.
fn half_width_under(asperity: &Asperity, mirrored: Option<&Asperity>, depth: f64) -> f64 {
    let Some(tool) = mirrored else { return asperity.half_width(depth) };
    let widest = asperity.half_width(depth).min(tool.half_width(depth));
    // of an outline that is not symmetric, on the side where the two overlap further
    let overlap = |x: f64| asperity.drop(x).min(asperity.drop(-x)) + tool.drop(x) < depth;
    bisect([0.0, widest], 60, overlap)[1]
}

/// Area of a contact of this centre and half width; its width in plane strain.
pub fn area(symmetry: Symmetry, centre: f64, half_width: f64) -> f64 {
    match symmetry {
        Symmetry::PlaneStrain => 2.0 * half_width,
        Symmetry::Axisymmetric if centre == 0.0 => PI * half_width * half_width,
        Symmetry::Axisymmetric => 4.0 * PI * centre * half_width,
    }
}

/// Contact half widths where each contact indents its surroundings as deep as `own` says.
pub fn half_widths(profile: &Profile, tool: &Tool, own: &[f64]) -> Vec<f64> {
    let mirrored = tool.mirrored();
    meetings(profile, mirrored.as_ref()).iter().zip(own).map(|(m, own)| m.half_width(*own)).collect()
}

/// Share of its half width at the peak, for which the mesh is made, from which a contact must be resolved:
/// the half width where the error of the force begins to be promised. `first` and `last` are the depths to
/// which contacts indent their surroundings there and at the peak; the deepest one there counts. Under a
/// flank the share is that of the depths, whatever the tip that was crushed before; under a tip that is still
/// round there it is larger, and the same elements lie closer.
pub fn resolved_from(profile: &Profile, tool: &Tool, first: &[f64], last: &[f64]) -> f64 {
    let mirrored = tool.mirrored();
    let meetings = meetings(profile, mirrored.as_ref());
    let depths = meetings.iter().zip(first.iter().zip(last));
    let Some((meeting, (&first, &last))) = depths.max_by(|(_, a), (_, b)| a.0.total_cmp(b.0)) else {
        return 1.0;
    };
    let [from, to] = [first, last].map(|depth| meeting.half_width(depth));
    let is_flank = (meeting.slope(from) / meeting.slope(to) - 1.0).abs() < LARGEST_SLOPE_CHANGE;
    let share = if is_flank { first / last } else { from / to };
    // neighbours may unload a contact
    if share < 1.0 { share } else { 1.0 }
}

/// Mean contact pressure to be expected at `depth`, in units of E. Only the penalty is scaled with it.
pub fn expected_pressure(metal: &Metal, profile: &Profile, tool: &Tool, depth: f64) -> f64 {
    let slope_of = |a: &Asperity| match &a.shape {
        // flat below the contact that it makes at its edge
        Shape::Own(tool) => tool.slope_of_contact(depth),
        _ => a.slope_at(CONTACT_WIDTH_RATIO * a.half_width(depth)),
    };
    let slope = tool.mirrored().iter().chain(&profile.asperities).map(slope_of).fold(0.0, f64::max);
    pressure_under(metal, slope, 0.0)
}

/// Mean pressure of a fully plastic contact over σ_r (Tabor, The Hardness of Metals, 1951).
const TABOR_RATIO: f64 = 2.8;

/// Representative strain ε_r over tan β, rounded: estimates need no more.
const STRAIN_PER_SLOPE: f64 = 0.1;

/// Mean contact pressure to be expected under outlines of this slope (tangent) at the edge of the contact, in
/// units of E: ½E* tan β of the elastic cone and that of full plasticity, joined harmonically. Earlier loads
/// `hardened` the metal to this yield stress, 0 where it is virgin.
pub fn pressure_under(metal: &Metal, slope: f64, hardened: f64) -> f64 {
    let elastic = 0.5 * metal.elastic.reduced_modulus() * slope;
    match &metal.hardening {
        None => elastic,
        Some(h) => {
            let strength = h.representative_stress(STRAIN_PER_SLOPE * slope).max(hardened);
            1.0 / (1.0 / elastic + 1.0 / (TABOR_RATIO * strength))
        }
    }
}

/// a tan β/h to be expected of a sharp cone of the slope `tan`: 2/π of an elastic one, up to 1.08 - 0.6 n of
/// a fully plastic one, more where material piles up against a steep tool that `indents`, joined in X = E*
/// tan β/σ_r (read off forty cones, within 0.1). Only the mesh is laid out with it.
pub fn contact_ratio(metal: &Metal, tan: f64, indents: bool) -> f64 {
    let Some(hardening) = &metal.hardening else { return FRAC_2_PI };
    let exponent = hardening.exponent(metal.elastic.youngs_modulus);
    let x = metal.elastic.reduced_modulus() * tan / hardening.representative_stress(STRAIN_PER_SLOPE * tan);
    let pile_up = if indents { 0.3 * (1.0 - exponent) * tan } else { 0.0 };
    let plastic = 1.08 - 0.6 * exponent + pile_up;
    FRAC_2_PI + (plastic - FRAC_2_PI) * (x / (x + 6.0)).powi(2)
}

/// Depth per force that a clamped substrate of this size takes away from an elastic half space: 0.39/(E*
/// size), its depth and its radius alike. Measured from sizes of 25 to 800 contact radii: 0.387 under cones,
/// 0.394 under balls, 0.37 to 0.40 on crushed cones.
pub fn far_field(metal: &Metal, size: f64) -> f64 {
    0.39 / (metal.elastic.reduced_modulus() * size)
}

/// Ratio of a depth to the length of the scene up to which it is looked for, on either side.
const SEARCHED_DEPTH_RATIO: f64 = (1_u64 << 50) as f64;

/// Halvings of the logarithm of that ratio, down to the rounding of a double.
const DEPTH_HALVINGS: usize = 60;

/// Depth, searched around `length`, at which the expected pressure over the cut area carries `force`.
pub fn expected_depth(
    metal: &Metal,
    symmetry: Symmetry,
    profile: &Profile,
    tool: &Tool,
    force: f64,
    length: f64,
) -> f64 {
    let mirrored = tool.mirrored();
    let meetings = meetings(profile, mirrored.as_ref());
    let carried = |depth: f64| {
        let pressure = expected_pressure(metal, profile, tool, depth);
        let areas =
            meetings.iter().map(|m| area(symmetry, m.centre, m.half_width((depth - m.below).max(0.0))));
        pressure * areas.sum::<f64>()
    };
    // the carried force grows with the depth; the logarithm of a ratio knows no unit
    let ends = [-1.0, 1.0].map(|sign| sign * SEARCHED_DEPTH_RATIO.ln());
    let [low, high] = bisect(ends, DEPTH_HALVINGS, |ratio| carried(length * ratio.exp()) < force);
    length * (0.5 * (low + high)).exp()
}
