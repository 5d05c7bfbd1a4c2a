#![doc = include_str!("../README.md")]
//!
//! One scene, from its keys to its rows. [`run::Run`] is the only entry; the modules stand below in the order
//! in which it calls them:
//!
//! 1. [`scene`]: what is asked for, and whether it makes sense.
//! 2. [`depth_for_force`]: the depth of the peak, from coarse crushes where a force is asked for.
//! 3. [`setup`]: the problem of the solver, dimensionless: mesh, penalty, schedule.
//! 4. `load_history`: the body as earlier loads leave it.
//! 5. [`mod@simulate`]: the problem from first touch to its end, along the path of the tool ([`load_path`]),
//!    with what is recorded on the way ([`record`]).
//! 6. `companion`: the same with numbers half as good, beside it.
//! 7. [`error_estimate`]: what the two say of the limit of both, and of the errors.
//! 8. `refine`: further rounds of all that, until what is stated is what the accuracy promises.

pub mod run;

pub mod scene;

pub mod depth_for_force;

pub mod setup;

mod load_history;

pub mod simulate;

pub mod load_path;

pub mod record;

mod companion;

pub mod error_estimate;

pub mod refine;

mod fitted;
