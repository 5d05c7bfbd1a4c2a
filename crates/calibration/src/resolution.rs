//! Every number of the discretisation of a cone, for each level of accuracy.

use crate::case::{Case, Tool};
use asperity_mesh::ElementKind;
use asperity_solver::scene::{Accuracy, Level};

/// How finely a cone is computed. Lengths are in units of the final contact radius a, depths of the final depth h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Kind of element.
    pub kind: ElementKind,
    /// Elements across the final contact radius, all of one size: the ripple of the force then has one period.
    pub elements: usize,
    /// How many of them, from the axis, are one wide column.
    pub at_axis: usize,
    /// Width of the part with elements of that size, in a: beyond the estimated radius by what it may be exceeded.
    pub core: f64,
    /// Depth of that part, in a.
    pub core_depth: f64,
    /// Growth of its rows with depth.
    pub row_growth: f64,
    /// Width of the first shell around it, in elements.
    pub first_shell: f64,
    /// Growth of the shells, as a share of the distance.
    pub growth: f64,
    /// Radius and depth of the substrate, in a.
    pub domain: f64,
    /// Base radius of the cone, in a.
    pub foot: f64,
    /// Radius over which the summit of the cone is rounded, in a: 0 but to show that it does not matter.
    pub rounding: f64,
    /// Steps to the depth where the fit of K begins, longer than the others.
    pub lead_steps: usize,
    /// Equal steps from there to the end.
    pub steps: usize,
    /// Mean penetration, in h. Soft: it halves the ripple of the force and saves iterations.
    pub penetration: f64,
    /// Relative residual at which Newton stops.
    pub tolerance: f64,
    /// Share of the flow that the second order of the step carries on. All of it overestimates K at long steps, none
    /// of it underestimates K; 0.8 leaves half the error of either at the steps of `standard`.
    pub carry: f64,
    /// Relative 95 % bound on what mesh, step, penalty and substrate do to K of a metal that hardens (n ≥ 0.1).
    pub bias: f64,
    /// The same added for n = 0, in proportion below n = 0.1.
    pub soft_bias: f64,
}

/// Share of the final depth from which K is fitted.
pub const FIT_FROM: f64 = 0.3;

/// Slope of a cone, degrees, from which the metal that its apex parts takes a mesh of its own. Scenes change elements at 11°
/// already (`discretise` of the solver), because they also come back; a case only loads.
const STEEP: f64 = 20.0;

/// Hardening exponent below which meshes and steps are finer: without hardening, flow gathers where the mesh lets it.
const SOFT: f64 = 0.1;

impl Resolution {
    /// The numbers for `case` at the coarsest level that promises `accuracy`.
    pub fn of(case: &Case, accuracy: Accuracy) -> Resolution {
        let level = accuracy.level();
        let resolution = match case.tool {
            Tool::Plane => Resolution::quadratic(level),
            // on a flat body the penetration costs more of the depth than on a cone: 0.5 % of K at 0.016
            Tool::Cone if case.beta_deg <= STEEP => {
                Resolution { penetration: 0.004, ..Resolution::quadratic(level) }
            }
            Tool::Cone => Resolution::linear(level),
        };
        let soft = case.yielding.is_some_and(|y| y.exponent < SOFT);
        match level {
            Level::Standard if soft && resolution.kind == ElementKind::Quad8 => {
                Resolution { elements: 16, steps: 36, soft_bias: 0.004, ..resolution }
            }
            _ => resolution,
        }
    }

    /// Relative 95 % bound on what mesh, step, penalty and substrate do to K of `case`.
    pub fn bias_of(&self, case: &Case) -> f64 {
        let softness = case.yielding.map_or(0.0, |y| (1.0 - y.exponent / SOFT).max(0.0));
        self.bias + softness * self.soft_bias
    }

    fn quadratic(level: Level) -> Resolution {
        let standard = Resolution {
            kind: ElementKind::Quad8,
            elements: 10,
            at_axis: 1,
            core: 1.1,
            core_depth: 0.4,
            row_growth: 0.5,
            first_shell: 1.0,
            growth: 0.4,
            domain: 100.0,
            foot: 8.0,
            rounding: 0.0,
            lead_steps: 4,
            steps: 24,
            penetration: 0.016,
            tolerance: 1e-4,
            carry: 0.8,
            bias: 0.005,
            soft_bias: 0.012,
        };
        match level {
            Level::Draft => Resolution {
                elements: 7,
                at_axis: 2,
                first_shell: 2.0,
                growth: 0.5,
                lead_steps: 3,
                steps: 14,
                tolerance: 1e-3,
                bias: 0.015,
                soft_bias: 0.03,
                ..standard
            },
            Level::Standard => standard,
            Level::Reference => Resolution {
                elements: 24,
                core_depth: 0.8,
                row_growth: 0.2,
                growth: 0.25,
                domain: 400.0,
                foot: 12.0,
                lead_steps: 10,
                steps: 96,
                penetration: 0.004,
                tolerance: 1e-6,
                carry: 1.0,
                bias: 0.001,
                soft_bias: 0.002,
                ..standard
            },
        }
    }

    /// Metal parts under the apex of a steep cone: what lies on the axis is stretched over a large part of the flank,
    /// the more the less it hardens. The quadratic element turns inside out there, the linear one bears it and wants
    /// finer meshes, also far away; a wide column at the axis leaves it room.
    fn linear(level: Level) -> Resolution {
        let standard = Resolution {
            kind: ElementKind::Quad4,
            elements: 16,
            at_axis: 2,
            core: 1.1,
            core_depth: 0.6,
            row_growth: 0.1,
            first_shell: 1.0,
            growth: 0.07,
            domain: 100.0,
            foot: 8.0,
            rounding: 0.0,
            lead_steps: 8,
            steps: 36,
            penetration: 0.004,
            tolerance: 1e-4,
            carry: 0.8,
            bias: 0.005,
            soft_bias: 0.012,
        };
        match level {
            Level::Draft => {
                Resolution { elements: 12, growth: 0.12, steps: 24, bias: 0.015, soft_bias: 0.03, ..standard }
            }
            Level::Standard => standard,
            Level::Reference => Resolution {
                elements: 40,
                at_axis: 5,
                core_depth: 0.8,
                row_growth: 0.05,
                growth: 0.035,
                domain: 400.0,
                lead_steps: 20,
                steps: 96,
                tolerance: 1e-6,
                carry: 1.0,
                bias: 0.001,
                soft_bias: 0.002,
                ..standard
            },
        }
    }
}
