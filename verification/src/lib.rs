//! Closed forms with their sources, and the bodies on which the solver is held against them.
//!
//! The claims are in `tests/`, one a file; what was reached is in `README.md`, in figures that
//! `examples/convergence.rs` prints. Closed forms: `contact` (elastic), `bar`, `simple_shear`, `thick_wall`,
//! `plane_field`. Other codes: `calibration`. Bodies: `battery`, `bodies`, `single_asperity`. `drive` solves one
//! increment.

pub mod bar;
pub mod contact;
pub mod plane_field;
pub mod several;
pub mod simple_shear;
pub mod thick_wall;

pub mod calibration;

pub mod battery;
pub mod bodies;
pub mod random_scenes;
pub mod single_asperity;

pub mod drive;
