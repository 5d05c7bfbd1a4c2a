#![doc = include_str!("../README.md")]
//!
//! In the order of the data: a case ([`case`]), its path ([`cone`]) and its constant ([`loading_curvature`]);
//! the grid ([`sweep`]), its rows on disk ([`row`]) and the run of a case ([`solve_case`]); the
//! representative strain of a slope ([`collapse`]) and of all ([`fit`]), the force as a formula
//! ([`dimensionless`]) and the unloading curve ([`unloading`]); cones that indent ([`indentation`]) and the
//! rows of the atlas of cones ([`cones`]).

pub mod case;

pub mod cone;

pub mod loading_curvature;

pub mod sweep;

pub mod row;

pub mod solve_case;

pub mod collapse;

pub mod fit;

pub mod dimensionless;

pub mod unloading;

pub mod indentation;

pub mod cones;
