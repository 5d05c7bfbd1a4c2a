#![doc = include_str!("../README.md")]
//!
//! In order: quantities with units ([`units`]) and units of columns ([`dimension`]), memory that a file may
//! take ([`memory`]), tables of numbers ([`text`], of workbooks too), curves of indentation instruments
//! ([`indentation`]), maps of surfaces ([`surface`]), the law of an interface for other programs
//! ([`interface_law`]), and the file in which many runs keep what they have finished ([`journal`]).

pub mod units;

pub mod dimension;

pub mod memory;

pub mod text;

mod workbook;

mod cantilever;

pub mod indentation;

mod heights;

pub mod profile;

pub mod surface;

pub mod interface_law;

pub mod journal;
