#![doc = include_str!("../README.md")]
//!
//! One scene, from its keys to its rows: what is asked for ([`scene`]), the problem made of it ([`setup`]), the path of the
//! tool ([`load_path`]), what is recorded ([`record`]), the run and its companion ([`mod@simulate`]), the error estimate
//! ([`error_estimate`]), the depth that carries a force ([`depth_for_force`]), and all of it in order ([`run`]).

pub mod scene;

pub mod setup;

pub mod load_path;

pub mod record;

mod load_history;

pub mod simulate;

pub mod error_estimate;

pub mod depth_for_force;

pub mod run;
