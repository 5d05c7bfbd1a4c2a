//! The numbers of the error estimate and of the ripple that no theory gives: they were chosen on measured
//! scenes.
//!
//! Orders and what the penetration widens were found on every second round of the scenes of the coverage and
//! hold on the others; shares of the bound were chosen on both.

use crate::scene::ElementChoice;

/// All of them.
pub(crate) const FITTED: Fitted = Fitted {
    errors: FittedErrors {
        force_share: 0.547,
        area_share: 1.0,
        area_share_of_other_element: 0.5,
        widened: 0.6,
        hidden_force: [0.12, 0.3],
        hidden_area: 210.0,
        end_of_contact: [0.9, 0.5],
        lost_by_steps: 1.8,
        toward_touch: 0.5,
        kept_of_force: 0.6,
        kept_of_area: 0.46,
        kept_of_other_element: 1.0,
        rest_in_bound: 2.0,
        rest_of_difference: 0.75,
        asymptotic: 0.055,
        line: 0.15,
        onset: 1.25,
        least_share: 0.05,
    },
    ripple: FittedRipple {
        rows_per_knot: 4,
        periods_per_knot: 1.1,
        apart_from_spline: 0.75,
        apart: 0.1,
        better: 0.6,
        selective: 0.2,
        steady: 1.67,
    },
};

/// Numbers that were chosen on measured scenes.
pub(crate) struct Fitted {
    /// Those of the error estimate.
    pub errors: FittedErrors,
    /// Those of the ripple.
    pub ripple: FittedRipple,
}

/// Numbers of the error estimate.
pub(crate) struct FittedErrors {
    /// Share of the difference to the companion that is subtracted from the force: 1/(2ᵖ - 1) of the order
    /// p = 3/2. Observed orders lie between 1 and 2.
    pub force_share: f64,
    /// The same of the area: p = 1.
    pub area_share: f64,
    /// The same of the area where the companion has the other element, of which no order is known.
    pub area_share_of_other_element: f64,
    /// ln of radius or half width, per penetration over depth, that Richardson's extrapolation of the first
    /// order leaves. A penetration widens by about 3 of it, of an order near 0.85, which leaves 3 (2 -
    /// 2^0.85). Observed are 0.5 to 0.65 at each level, and in every kind of scene.
    pub widened: f64,
    /// ln of the force of a cone at the peak, per penetration over depth, that mesh and penetration hide from
    /// the difference of run and companion, of an elastic body; twice as much where all work is dissipated.
    /// Of quadratic and of linear elements, whose errors in bending and in volume have opposite signs.
    pub hidden_force: [f64; 2],
    /// ln of the area at the peak, per square of penetration over depth, that they hide.
    pub hidden_area: f64,
    /// ln of radius or half width, per penetration over depth, by which scenes scatter about what mesh and
    /// penetration do in the mean; less where run and companion share a mesh. On the scenes this scatter does
    /// not hang on how much run and companion differ.
    pub end_of_contact: [f64; 2],
    /// ln of the force of a cone that steps lose at the peak where all work is dissipated, over the square of
    /// the last one's length in ln h: steps of 0.17 to 0.36 lose 3 to 8 %, and their companion no more.
    pub lost_by_steps: f64,
    /// Power of 1/h with which what mesh and penetration hide grows toward the first touch. Of the depth, a
    /// penetration under an even pressure is a share that falls as 1/h, and an edge one that does not change.
    pub toward_touch: f64,
    /// Factor of the smooth part of the force in its bound. What is left of it where the order is not the
    /// assumed one is less, for orders between 1 and 2.
    pub kept_of_force: f64,
    /// The same of the area: what is left of it for an order of 1.5, (2^1.5 - 2)/(2^1.5 - 1); for one of 0.8
    /// it is less.
    pub kept_of_area: f64,
    /// The same of the area where the companion has the other element, of which no order is known.
    pub kept_of_other_element: f64,
    /// The rest of the difference that the bound allows for, over the largest that is seen.
    pub rest_in_bound: f64,
    /// Weight of the difference in the geometric mean of its rest and the ripple of the run itself, where
    /// that is less, of the force. A kink of the metal, which the run smooths away, remains in the
    /// difference. The difference of the area ripples by the edges of the companion: there its weight is 0.
    pub rest_of_difference: f64,
    /// Largest smooth part of which a share is subtracted: a companion that differs by more is in no
    /// asymptotic range, and the whole difference stays in the bound.
    pub asymptotic: f64,
    /// Share of the variance about the mean below which what a line leaves makes it the smooth part of the
    /// area, whose companion ripples more than it differs.
    pub line: f64,
    /// Depth up to which the onset of another contact decides the difference, over that at which it begins:
    /// of a ring that begins at 0.4 of the depth the difference falls from 85 % to 11 % until there.
    pub onset: f64,
    /// Share of the force at the peak from which an asperity's onset counts, as in the steps that stop before
    /// it.
    pub least_share: f64,
}

impl FittedErrors {
    /// The share that a penetration hides of the force with this `element`.
    pub fn hidden_force_of(&self, element: ElementChoice) -> f64 {
        self.hidden_force[usize::from(element == ElementChoice::Q4)]
    }
}

/// Numbers of the ripple.
pub(crate) struct FittedRipple {
    /// Rows per interval of the spline: fewer, and it would follow the ripple.
    pub rows_per_knot: usize,
    /// Periods per interval of the spline, for the same reason.
    pub periods_per_knot: f64,
    /// Share of a harmonic that must lie outside all splines.
    pub apart_from_spline: f64,
    /// Share that must lie outside the splines and the harmonics before it.
    pub apart: f64,
    /// A ripple is removed if the mean square error of rows left out falls below this share of that of the
    /// best spline. Where curves have chance errors and no ripple, that happens twice in a hundred times.
    pub better: f64,
    /// Weight of a fit in the mean of all: its mean square error of rows left out to minus this power per
    /// row. Half would be that of its likelihood; less takes in more fits, whose errors differ.
    pub selective: f64,
    /// Edges that the front passes per ln h stay within this factor of those at the peak: elsewhere the mesh
    /// has another grading, or the contact has just begun, and the ripple another amplitude.
    pub steady: f64,
}
