//! Closed forms with their sources, and the bodies on which the solver is held against them.
//!
//! The claims are in `tests/`, one a file; what was reached is in `results/`, in tables that the programs of
//! `examples/` write with `report`. Closed forms: `contact` (elastic), `uniaxial`, `simple_shear`,
//! `slip_lines`, `thick_wall`, `manufactured`. Other codes: `calibration`. Metals that are found again:
//! `twins`. Bodies: `coverage_scenes` (with their `truth`), `test_meshes`, `single_asperity`, `friction`.
//! `single_increment` solves one increment.

pub mod contact;
pub mod manufactured;
pub mod several;
pub mod simple_shear;
pub mod slip_lines;
pub mod thick_wall;
pub mod uniaxial;

pub mod calibration;

pub mod twins;

pub mod coverage_scenes;
mod measured_scenes;
mod random_metal;
pub mod truth;

pub mod friction;
pub mod potential;
pub mod random_scenes;
pub mod single_asperity;
pub mod test_meshes;

pub mod roofline;
pub mod single_increment;
pub mod wave_on_wave;

pub mod report;

pub mod atlas;

pub mod atlas_fit;
pub mod atlas_table;
