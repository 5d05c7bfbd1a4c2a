//! Contact of a rough surface on a half-space: all of it at once, interaction included, no closure.
//!
//! A rigid plane presses the surface of an elastic half-space; every pixel carries a pressure between 0 and a
//! limit. Displacements are convolutions done by fast Fourier transforms; the pressure is searched by
//! preconditioned projected conjugate gradients, from coarse grids to the fine one. A periodic map is one
//! period of an endless surface; another stands free on a half-space without load around it.
//!
//! Sources: Stanley and Kato 1997 (periodic half-space), Polonsky and Keer 1999 (conjugate gradients),
//! Almqvist et al. 2007 (limit of pressure), Vollebregt 2014 (preconditioner), Yastrebov et al. 2017 (area
//! from pixels).

mod float;

mod convolution;

mod nodes;

mod grid_level;

mod conjugate_gradients;
mod projected_gradient;

mod cascade;

mod rim;

mod area;
mod stiffness;

mod half_space_contact;

mod limit;

pub use crate::half_space::half_space_contact::{
    FINEST_TOLERANCE, HalfSpace, HalfSpaceContact, HalfSpaceError, TOLERANCE,
};
pub(crate) use area::each_patch;
pub use area::{Area, patches};
pub(crate) use float::Real;
pub use limit::{LimitSource, PressureLimit, patch_slope};
pub use stiffness::Stiffness;

#[cfg(test)]
mod area_tests;
#[cfg(test)]
mod proof_tests;
#[cfg(test)]
mod tests;
