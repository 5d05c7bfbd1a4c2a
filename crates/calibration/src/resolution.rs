//! Every number of the discretisation of a cone, for each level of accuracy.

use asperity_solver::scene::Accuracy;

/// How finely a cone is computed. Lengths are in units of the final contact radius a, depths of the final depth h.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resolution {
    /// Elements across the final contact radius, all of one size: the ripple of the force then has one period.
    pub elements: usize,
    /// Width of the part with elements of that size, in a: beyond the estimated radius by what it may be exceeded.
    pub core: f64,
    /// Depth of that part, in a.
    pub core_depth: f64,
    /// Growth of its rows with depth.
    pub row_growth: f64,
    /// Growth of the shells around it, as a share of the distance.
    pub growth: f64,
    /// Radius and depth of the substrate, in a.
    pub domain: f64,
    /// Base radius of the cone, in a.
    pub foot: f64,
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
    /// The same added for n = 0, in proportion below n = 0.1: perfectly plastic metal takes finer meshes and steps.
    pub soft_bias: f64,
}

/// Share of the final depth from which K is fitted.
pub const FIT_FROM: f64 = 0.3;

impl Resolution {
    /// The numbers of a level.
    pub fn new(accuracy: Accuracy) -> Resolution {
        let standard = Resolution {
            elements: 10,
            core: 1.1,
            core_depth: 0.4,
            row_growth: 0.5,
            growth: 0.4,
            domain: 100.0,
            foot: 8.0,
            lead_steps: 4,
            steps: 24,
            penetration: 0.016,
            tolerance: 1e-4,
            carry: 0.8,
            bias: 0.005,
            soft_bias: 0.012,
        };
        match accuracy {
            Accuracy::Draft => Resolution {
                elements: 7,
                steps: 14,
                growth: 0.5,
                lead_steps: 3,
                bias: 0.015,
                soft_bias: 0.03,
                ..standard
            },
            Accuracy::Standard => standard,
            Accuracy::Reference => Resolution {
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
}
