#![doc = include_str!("../README.md")]

pub mod lanes;

pub mod bisection;
pub mod least_squares;
pub mod monotone_cubic;
pub mod sobol;

pub mod transpose;
pub mod vectors;

pub mod corrected;
pub mod secants;

pub mod newton;

pub mod sparse;
