#![doc = include_str!("../README.md")]
//!
//! In order: quantities with units ([`units`]), tables of numbers under a header ([`text_table`]), tables of
//! indentation instruments ([`indentation_table`]), maps of surfaces ([`surface`]).

pub mod units;

pub mod text_table;

pub mod indentation_table;

pub mod surface;
