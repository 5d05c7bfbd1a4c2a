//! Input of the mesher: the contacts, the surface and the body.

use crate::ElementKind;
use crate::grading::Grading;
use crate::profile::Profile;

/// Half width of a contact over that of its foot up to which it counts as untouched. A core of twenty columns
/// in it is then 1e-7 of a foot wide, far above the rounding of a place in a row of a thousand feet.
const LEAST_WIDTH_SHARE: f64 = 1e-6;

/// A contact to be resolved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Its centre.
    pub centre: f64,
    /// Its half width at the peak; 0 if the asperity stays untouched.
    pub half_width: f64,
    /// Half width of the foot of the asperity: that of its cell; the wider of two.
    pub foot: f64,
    /// Its left and right side over that.
    pub sides: [f64; 2],
    /// Steepest slope (tangent) of the profile over it.
    pub slope: f64,
}

impl Contact {
    /// Left and right end of the shell whose wider side is `x` away from the centre: shells around a core of
    /// the half width `half` grow towards the two feet.
    pub(super) fn shell(&self, half: f64, x: f64) -> [f64; 2] {
        let side = |share: f64| {
            if share == 1.0 { x } else { power([half, half], [self.foot, share * self.foot], x) }
        };
        [self.centre - side(self.sides[0]), self.centre + side(self.sides[1])]
    }

    /// True where it is wide enough for a mesh of its own: one of a rounding carries nothing, and its columns
    /// would lie closer than their coordinates can tell.
    pub(super) fn is_resolved(&self) -> bool {
        self.half_width > LEAST_WIDTH_SHARE * self.foot
    }

    /// Half width of the narrower side of its foot.
    pub(super) fn narrow(&self) -> f64 {
        self.foot * self.sides[0].min(self.sides[1])
    }

    /// Depth over half width of the core. The diagonals on which shells turn must stay steeper than the
    /// flank, or the shear under the profile turns their cells inside out.
    pub(super) fn depth_ratio(&self) -> f64 {
        (1.7 * self.slope).max(1.0)
    }
}

/// A body to mesh. Any unit of length.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The surface.
    pub profile: Profile,
    /// The contacts from left to right, at least one. One on the left side at its own centre is halved by the
    /// axis.
    pub contacts: Vec<Contact>,
    /// Left and right end of the row of cells and blocks; beyond it shells lead to the sides of the body.
    pub row: [f64; 2],
    /// Left and right side of the body.
    pub width: [f64; 2],
    /// Depth of the body below its highest summit.
    pub depth: f64,
    /// Sizes.
    pub grading: Grading,
    /// Kind of element.
    pub kind: ElementKind,
}

/// The power of x through two points (x, y), at `x`.
pub(super) fn power(from: [f64; 2], to: [f64; 2], x: f64) -> f64 {
    from[1] * (to[1] / from[1]).powf((x / from[0]).ln() / (to[0] / from[0]).ln())
}

/// Half width that the sizes around a contact follow: an untouched asperity is meshed coarsely after its
/// foot.
pub(super) fn contact_size(contact: &Contact) -> f64 {
    if contact.is_resolved() { contact.half_width } else { 0.1 * contact.foot }
}

pub(super) fn core_half_width(plan: &Plan, contact: &Contact) -> f64 {
    let wish =
        if contact.is_resolved() { plan.grading.start * contact.half_width } else { 0.3 * contact.foot };
    wish.min(0.6 * contact.narrow())
}

/// Distances of the kinks of the profile to the right of `centre`.
pub(super) fn kinks_from(plan: &Plan, centre: f64) -> Vec<f64> {
    plan.profile.kinks().into_iter().filter(|&k| k > centre).map(|k| k - centre).collect()
}
