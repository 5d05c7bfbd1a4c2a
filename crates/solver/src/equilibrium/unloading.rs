//! The stiffness of unloading: how the force answers the tool when every point is elastic and the contact is
//! kept.
//!
//! Contact that is kept is a flat punch to what changes: S = 2E*a of a disc. Two errors of opposite sign
//! would stand in the stiffness of the mesh as it is:
//! * the springs of the penalty give way, more at the rim, where the pressure of a punch is singular, than to
//!   first order in 1/ε. The body does not change with them: they are made [`RIGID`] in this solve alone;
//! * displacements of a mesh do not follow the singular rim: a contact that ends at the end of an edge of
//!   length l is as stiff as one that is κl wider ([`rim_shift`]). A rigid spring on part of an edge holds
//!   the shape of all of it, so the stiffness is taken linearly in the end of contact from that of the edges
//!   which touch wholly to that of all which touch, and κ of the last edge before its end. On the edges that
//!   are widened so, the slope of the tool is linear ([`integrate_widened`]).
//!
//! [`integrate_widened`]: crate::contact::edge::ContactEdge::integrate_widened

use crate::body::failure::Failure;
use crate::contact::parts::{NOTHING, Parts, whole_edges_around};
use crate::equilibrium::Equilibrium;
use crate::equilibrium::tool_stiffness::ToolStiffness;

/// Stiffness of the springs of a rigid contact over the penalty: what they give way is 32 times less, while
/// the ratio of stiffnesses leaves a solve its digits.
const RIGID: f64 = 32.0;

/// The share κ of an edge by which a punch that ends at its end is wider for the mesh, of quadratic or linear
/// elements of this ratio of Poisson.
///
/// Found with a code of its own (`verification/measure/punch-on-a-mesh`) for a rigid disc on a half-space
/// with 6, 12 and 24 square elements below it: 0.115, 0.097, 0.093, 0.083 at ν 0, 0.25, 0.3, 0.45, and of
/// linear ones 0.243, 0.191, 0.181, 0.150, of first order in the edge alone. These are lines through them.
fn rim_shift(is_quadratic: bool, poissons_ratio: f64) -> f64 {
    if is_quadratic { 0.115 - 0.073 * poissons_ratio } else { 0.243 - 0.208 * poissons_ratio }
}

impl Equilibrium<'_> {
    /// dF/dh of unloading at the converged state, and dF per travel with the springs of the penalty.
    ///
    /// # Errors
    /// A stiffness that cannot be factorised.
    pub fn unloading_stiffness(&mut self) -> Result<ToolStiffness, Failure> {
        self.begin(self.state.tip, 0.0, |_| [0.0; 2]);
        let parts: Vec<Parts> = self.state.parts().collect();
        let ([inner, outer], share) = whole_edges_around(&parts);
        let wide = self.elastic_stiffness(&outer, RIGID)?.depth;
        let has_narrow = share > 0.0 && inner.iter().any(|touching| *touching != NOTHING);
        let narrow = if has_narrow { self.elastic_stiffness(&inner, RIGID)?.depth } else { wide };
        // last, since its factors are those with which unloading begins
        let travel = self.elastic_stiffness(&parts, 1.0)?.travel;
        self.contact_set.set_keeping(false);
        let is_quadratic = self.state.edges.first().is_some_and(|edge| edge.quadratic);
        let shift = rim_shift(is_quadratic, self.body.material.elastic.poissons_ratio);
        Ok(ToolStiffness { travel, depth: wide - (1.0 + shift - share) * (wide - narrow) })
    }

    /// Answer of the force to the tool with every point elastic and these parts of the edges in contact, on
    /// springs that are `stiffer` than the penalty.
    fn elastic_stiffness(&mut self, parts: &[Parts], stiffer: f64) -> Result<ToolStiffness, Failure> {
        let Equilibrium { body, state, trial, response, stiffness, .. } = self;
        body.assemble_elastic(state, trial, (parts, stiffer), response, stiffness)?;
        self.has_tangent = true;
        self.tool_stiffness()
    }
}
