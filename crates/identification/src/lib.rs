#![doc = include_str!("../README.md")]
//!
//! In the order of the data: the keys of a fit ([`fit_file`], [`known_or_unknown`]), measured curves made
//! ready ([`measured_curve`]), the unknowns ([`parameters`]); what finite elements answer to one metal
//! ([`response`]) and between metals ([`emulator`]); pyramids as cones ([`pyramid`]); imprints ([`imprint`],
//! [`imprint_file`]) with their noise ([`mod@far_field`], [`rings`]); a measurement ([`experiment`]) with its
//! covariance ([`mod@covariance`]), all of them ([`objective`]); the search ([`mod@search`],
//! [`levenberg_marquardt`], [`branches`]); intervals ([`profile_likelihood`]), samples ([`posterior`]) and
//! the null direction ([`identifiability`]); all that is said of the metal ([`inference`]).

pub mod known_or_unknown;

pub mod fit_file;

mod unloading_parabola;

pub mod measured_curve;

pub mod parameters;

pub mod response;

pub mod far_field;

pub mod rings;

pub mod imprint;

mod imprint_columns;

pub mod imprint_file;

mod imprint_level;
mod imprint_profile;

pub mod interpolation;

pub mod emulator;

pub mod pyramid;

pub mod experiment;

pub mod covariance;

pub mod levenberg_marquardt;

pub mod objective;

pub mod search;

pub mod branches;

pub mod profile_likelihood;

pub mod posterior;

pub mod identifiability;

pub mod numbers;

pub mod next_experiment;
pub mod noise;

mod accord;

pub mod inference;

mod verdict;
