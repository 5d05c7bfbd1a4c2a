#![doc = include_str!("../README.md")]
//!
//! In order: quantities with units ([`units`]) and units of columns ([`dimension`]), memory that a file may
//! take ([`memory`]), tables of numbers ([`text`]), curves of indentation instruments ([`indentation`]), maps
//! of surfaces ([`surface`]).

pub mod units;

pub mod dimension;

pub mod memory;

pub mod text;

pub mod indentation;

pub mod surface;
